"""Who has a place in a list: laws of the number of games, and what a winner is worth in games."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.matches.win import race_win_probability
from evenbreak.ratings import Beginning, Levels, Results, fit
from evenbreak.ratings.provisional import (
    ESTABLISHED,
    established_from,
    games_of_winner,
    is_provisional,
)
from evenbreak.ratings.roster import NOT_STATED, Roster

GAMES = st.lists(st.integers(0, 2_000), min_size=1, max_size=60)


@given(GAMES)
def test_somebody_has_a_place_and_whoever_has_200_games_always(games):
    least, few = established_from(games), is_provisional(games)
    assert 1 <= least <= ESTABLISHED
    assert few[[k for k, n in enumerate(games) if n < least]].all()
    assert not few[[k for k, n in enumerate(games) if n >= ESTABLISHED]].any()
    if any(games):
        # Half of all games are played by players with three times as many, or with 600.
        played = np.array(games)
        assert played[played >= 3 * (least - 1)].sum() * 2 >= played.sum()
        assert not few[np.argmax(games)]


def test_visitors_change_nothing():
    regulars = [60] * 12
    assert established_from([*regulars, *[1] * 300]) == established_from(regulars) == 20


@pytest.mark.parametrize("race", [(1, 1), (2, 1), (7, 7), (9, 5), (3, 11)])
def test_a_winner_is_worth_the_games_with_the_same_information(race):
    # The curvature of the expected log-likelihood where the race is even, by differences.
    odds = np.linspace(-8.0, 8.0, 160_001)
    win = race_win_probability(1.0 / (1.0 + np.exp(-odds)), *race)
    at = int(np.argmin(np.abs(win - 0.5)))
    slope = (win[at + 1] - win[at - 1]) / (odds[at + 1] - odds[at - 1])
    p = 1.0 / (1.0 + math.exp(-odds[at]))
    of_race, of_game = slope**2 / (win[at] * (1.0 - win[at])), p * (1.0 - p)
    assert games_of_winner(*race) == pytest.approx(of_race / of_game, rel=1e-3)


def test_what_each_rating_rests_on():
    names = ("Ann", "Bo", "Cy")
    season = Results(
        names,
        *(np.array(column) for column in ([0, 1], [1, 2], [7, 0], [4, 0])),
        race_a=np.array([7, 7]),
        race_b=np.array([7, 7]),
        winner=np.array([1, 1], dtype=np.int8),
        unscored=np.array([False, True]),
    )
    winner = float(games_of_winner(7, 7))
    assert fit(season).games_behind == pytest.approx([11, 11 + winner, winner])
    old = Beginning(["Cy", "Di"], [90, 60], [9, 9], games=[300, 50])
    begun = fit(season, levels=Levels(beginning=old))
    assert begun.games_behind == pytest.approx([11, 11 + winner, 300 + winner])
    assert begun.provisional.tolist() == [True, True, False]
    # A list that is not used says nothing about how much was played.
    unused = Beginning(["Cy"], [90], games=[300])
    assert fit(season, levels=Levels(beginning=unused)).games_behind[2] == pytest.approx(winner)


def season_with_a_visitor():
    """Return a league in which the highest rating is that of a player of one match."""
    a = ["Ann", "Bo", "Cy", "Ann"] * 6 + ["Eve"]
    b = ["Bo", "Cy", "Di", "Di"] * 6 + ["Ann"]
    return Results.from_names(a, b, [7] * 25, [6, 5, 6, 4] * 6 + [0])


def test_the_highest_rating_of_a_visitor_heads_no_list():
    ratings = fit(season_with_a_visitor())
    names = np.array(ratings.players)
    assert names[ratings.rating.argmax()] == "Eve"
    assert names[ratings.strongest_first()].tolist() == ["Ann", "Bo", "Cy", "Di", "Eve"]
    frame = ratings.to_frame()
    assert frame["player"].tolist()[0] == "Ann"
    assert frame["provisional"].tolist() == [False] * 4 + [True]
    everybody = fit(season_with_a_visitor(), provisional=0)
    assert names[everybody.strongest_first()[0]] == "Eve"
    nobody = fit(season_with_a_visitor(), provisional=10_000)
    assert nobody.provisional.all()


def test_a_roster_lists_those_with_few_games_last():
    club = Roster(["Ann", "Bo", "Cy", "Di"], [500, 700, 600, 400], games=[300, 3, NOT_STATED, 250])
    assert club.provisional.tolist() == [False, True, True, False]
    assert [club.players[k] for k in club.strongest_first()] == ["Ann", "Di", "Bo", "Cy"]
    silent = Roster(["Ann", "Bo"], [500, np.nan])
    assert silent.provisional.tolist() == [False, True]
    started = silent.with_starters(600.0, 100.0, "fargo")
    assert started.strongest_first().tolist() == [0, 1]
