import math

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.ratings.roster import NOT_STATED, Roster, error_of_games
from evenbreak.ratings.scale import scale_of


def test_what_is_not_stated():
    roster = Roster(["Ann", "Bo"], [92, 71.5])
    assert np.isnan(roster.standard_error).all()
    assert roster.games.tolist() == [NOT_STATED, NOT_STATED]
    assert roster.component.tolist() == [0, 0]


def test_columns_are_copies_that_cannot_be_changed():
    points = np.array([92.0, 71.5])
    roster = Roster(["Ann", "Bo"], points)
    points[0] = 0.0
    assert roster.rating[0] == 92.0
    with pytest.raises(ValueError, match="read-only"):
        roster.rating[0] = 1.0


def test_only_new_players_get_what_starters_get_and_games_give_an_error():
    roster = Roster(
        ["new", "seeded", "sure", "stated", "silent"],
        [np.nan, 95.0, 90.0, np.nan, 70.0],
        [np.nan, np.nan, np.nan, 12.0, np.nan],
        [0, 0, 300, 0, NOT_STATED],
    )
    started = roster.with_starters(80.0, 30.0, "npl")
    assert started.rating.tolist() == [80.0, 95.0, 90.0, 80.0, 70.0]
    assert started.standard_error[[0, 1, 3]].tolist() == [30.0, 30.0, 12.0]
    assert started.standard_error[2] == pytest.approx(30 / math.log(2) * 2 / math.sqrt(300))
    assert started.standard_error[4] == 30.0  # no number of games is not any number of them


def test_where_no_rating_has_games_those_that_have_none_stay_without_an_error():
    roster = Roster(["Ann", "Bo", "Cy"], [95.0, 90.0, np.nan], games=[NOT_STATED, NOT_STATED, 0])
    assert roster.with_starters(80.0, 30.0, "npl").standard_error.tolist()[2] == 30.0
    assert np.isnan(roster.with_starters(80.0, 30.0, "npl").standard_error[:2]).all()


@pytest.mark.parametrize("scale", ["npl", "fargo", "elo", 40])
def test_more_games_never_make_a_rating_less_certain(scale):
    new = scale_of(scale).points_per_doubling
    errors = error_of_games(np.arange(2000), scale, new)
    assert errors[0] == new
    assert (np.diff(errors) <= 0).all()
    assert (np.diff(errors[9:]) < 0).all()
    assert errors / new == pytest.approx(error_of_games(np.arange(2000), "fargo", 100.0) / 100)


def test_the_error_of_so_many_games_on_the_fargo_scale():
    errors = error_of_games([0, 1, 12, 200, 500, 1000], "fargo", 100.0)
    assert errors.round().tolist() == [100, 100, 83, 20, 13, 9]


def test_position():
    roster = Roster(["Ann", "Bo"], [92.0, 71.5])
    assert [roster.position(name) for name in roster.players] == [0, 1]
    with pytest.raises(InputError, match="player 'Cy' isn't in the roster"):
        roster.position("Cy")


@pytest.mark.parametrize(
    ("columns", "remedy"),
    [
        ((["Ann", "Ann"], [1, 2]), "each name once"),
        ((["Ann"], [1, 2]), "one value for each of 1 players"),
        ((["Ann"], [np.inf]), "NaN for a new player"),
        ((["Ann"], ["x"]), "rating must"),
        ((["Ann"], [1.0], None, [np.nan]), "must be whole numbers"),
        ((["Ann"], [1.0], None, np.array([1.5])), "must be whole numbers"),
        (
            (["Ann"], [1.0], [-1.0]),
            "standard_error must be 0 or more; one value is negative or infinite",
        ),
        (
            (["Ann"], [1.0], [np.inf]),
            "standard_error must be 0 or more; one value is negative or infinite",
        ),
    ],
)
def test_refused(columns, remedy):
    with pytest.raises(InputError, match=remedy):
        Roster(*columns)


def test_starters_are_numbers():
    roster = Roster(["Ann"], [np.nan])
    with pytest.raises(InputError, match="finite number of points"):
        roster.with_starters(np.nan, 30.0, "npl")
    with pytest.raises(InputError, match="0 or more points"):
        roster.with_starters(80.0, -1.0, "npl")


def test_matches_are_kept_and_not_stated_where_nobody_says_them():
    assert list(Roster(["Ann", "Bo"], [92, 80]).matches) == [NOT_STATED, NOT_STATED]
    started = Roster(["Ann", "Bo"], [92, np.nan], matches=[64, 0]).with_starters(80.0, 30.0, "npl")
    assert list(started.matches) == [64, 0]


def test_matches_are_counts():
    with pytest.raises(
        InputError,
        match="matches must be 0 or more, or NOT_STATED if unknown; one value is negative",
    ):
        Roster(["Ann"], [92], matches=[-2])
    with pytest.raises(
        InputError, match="games must be 0 or more, or NOT_STATED if unknown; one value is negative"
    ):
        Roster(["Ann"], [92], games=[-2])


def test_ratings_are_not_text():
    with pytest.raises(InputError, match=r"rating must be numbers"):
        Roster(["Ann", "Bo"], ["92", "71.5"])
