import itertools
import math

import pytest

from evenbreak.answers.fair_pairs import (
    NOT_LINKED,
    RaceLimits,
    by_strength,
    find_players,
    matchups_frame,
    most_active,
)
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.fair import fair_races
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results


@pytest.fixture(scope="module")
def ratings():
    """Ann > Bo > Cy play each other; Di and Ed play only each other."""
    season = Results.from_names(
        ["Ann", "Bo", "Cy", "Di"], ["Bo", "Cy", "Ann", "Ed"], [7, 7, 3, 5], [4, 5, 7, 5]
    )
    return fit(season, scale="fargo")


def test_race_limits_are_one_or_the_other():
    with pytest.raises(InputError, match="give just one of them"):
        RaceLimits()
    with pytest.raises(InputError, match="give just one of them"):
        RaceLimits((5, 9), 7)


def test_the_most_active_come_first_and_ties_by_name(ratings):
    assert [ratings.players[k] for k in most_active(ratings, 4)] == ["Bo", "Cy", "Ann", "Di"]
    assert len(most_active(ratings, 99)) == 5


@pytest.mark.parametrize("scale", ["npl", 0.01, 1e6])
def test_the_strongest_come_first_on_any_scale(scale):
    season = Results.from_names(["Ann", "Bo", "Di"], ["Bo", "Cy", "Ed"], [3, 4, 5], [7, 7, 5])
    ratings = fit(season, scale=scale)
    order = by_strength(ratings, range(5))
    assert [ratings.players[k] for k in order] == ["Cy", "Bo", "Di", "Ed", "Ann"]


def test_players_are_found_by_name_in_any_case_and_once(ratings):
    assert find_players(ratings, ["Cy", " ann ", "CY", "Bo"]) == [2, 0, 1]


def test_all_unknown_players_are_told_with_names_that_are_like_them(ratings):
    with pytest.raises(InputError) as caught:
        find_players(ratings, ["Anne", "Bo", "Xaver", "Anne"])
    assert str(caught.value) == (
        "players: not in the results: 'Anne' (did you mean 'Ann'?), 'Xaver'; "
        "write names as the results do"
    )


def test_names_that_differ_in_case_alone_must_be_given_as_written():
    season = Results.from_names(["Ann", "ANN"], ["Bo", "Bo"], [7, 5], [5, 7])
    ratings = fit(season)
    assert find_players(ratings, ["ANN"]) == [0]
    with pytest.raises(InputError, match="did you mean 'ANN' or 'Ann'"):
        find_players(ratings, ["ann"])


@pytest.mark.parametrize("limits", [RaceLimits(race_to=7), RaceLimits((7, 13))])
def test_every_pair_has_the_fairest_race_and_the_stronger_comes_first(ratings, limits):
    frame = matchups_frame(ratings, [2, 0, 1], limits)
    assert list(zip(frame["player_a"], frame["player_b"], strict=True)) == list(
        itertools.combinations(["Ann", "Bo", "Cy"], 2)
    )
    for row in frame.itertuples():
        p = ratings.win_probability(row.player_a, row.player_b)
        (race,) = fair_races(p, games=limits.games, race_to=limits.race_to, top=1)
        assert math.isclose(row.p_game_a, p, rel_tol=1e-12)
        assert p > 0.5
        assert (row.race_a, row.race_b, row.games_p90) == (
            race.race_1,
            race.race_2,
            race.games_p90,
        )
        assert math.isclose(row.p_win_a, race.p_win_1, rel_tol=1e-12)
        assert math.isclose(row.mean_games, race.mean_games, rel_tol=1e-12)
        assert row.note == ""
        if limits.race_to:
            assert row.race_a == 7


def test_players_whom_no_opponents_link_get_no_race(ratings):
    frame = matchups_frame(ratings, range(5), RaceLimits(race_to=5))
    apart = frame[frame["note"] == NOT_LINKED]
    assert len(frame) == 10
    assert len(apart) == 6
    assert apart[["p_game_a", "race_a", "race_b", "p_win_a", "mean_games"]].isna().all(axis=None)
    assert not frame.drop(apart.index)["race_a"].isna().any()


def test_equal_players_get_an_even_race():
    ratings = fit(Results.from_names(["Ann"], ["Bo"], [5], [5]))
    (row,) = matchups_frame(ratings, [0, 1], RaceLimits(race_to=7)).itertuples()
    assert (row.player_a, row.race_a, row.race_b) == ("Ann", 7, 7)
    assert math.isclose(row.p_win_a, 0.5, abs_tol=1e-9)
