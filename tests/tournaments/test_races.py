"""Races by round: chances and lengths are those of single matches."""

from __future__ import annotations

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.games.breaks import alternate_breaks, winner_breaks
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.handicaps import chart, fair_races
from evenbreak.matches import match_length, match_odds
from evenbreak.matches.races import race_odds
from evenbreak.ratings.scale import scale_of
from evenbreak.tournaments import (
    Fairest,
    Races,
    chances_given,
    double_elimination,
    pair_odds,
    single_elimination,
    title_odds,
)

RATINGS = np.array([640.0, 570.0, 500.0, 415.0])
BRACKET = double_elimination(4)


def test_even_races_by_side() -> None:
    laws = pair_odds(BRACKET, RATINGS, Races(7, losers=5, final=9, by_match={"W2.1": 3}))
    p = scale_of("fargo").win_probability(640.0 - 415.0)
    for name, race in (("W1.1", 7), ("L1.1", 5), ("F", 9), ("F2", 9), ("W2.1", 3)):
        law = race_odds(race, race, p)
        assert laws[name].win[0, 3] == pytest.approx(law.p_win_1)
        assert laws[name].mean_games[0, 3] == pytest.approx(law.mean)
        assert laws[name].ends[0, 3][law.games] == pytest.approx(law.win_1)
        assert laws[name].ends[3, 0][law.games] == pytest.approx(law.win_2)
    assert laws["W1.1"].win + laws["W1.1"].win.T == pytest.approx(np.ones((4, 4)))


def test_a_chart() -> None:
    table = chart("fargo_r6_hot")
    laws = pair_odds(BRACKET, RATINGS, table)
    for i, j in ((0, 1), (0, 3), (2, 1)):
        m, n = table.race(RATINGS[i] - RATINGS[j])
        p = scale_of("fargo").win_probability(RATINGS[i] - RATINGS[j])
        assert laws["F"].win[i, j] == pytest.approx(race_odds(m, n, p).p_win_1)


def test_the_fairest_race_of_a_length() -> None:
    laws = pair_odds(BRACKET, RATINGS, Fairest(7))
    for i, j in ((0, 1), (0, 3), (1, 2)):
        p = scale_of("fargo").win_probability(RATINGS[i] - RATINGS[j])
        best = fair_races(p, race_to=7, top=1)[0]
        assert laws["F"].win[i, j] == pytest.approx(best.p_win_1)


def test_fargorates_races_for_576_against_419() -> None:
    """What the races that FargoRate lists as fair are worth to the stronger player."""
    p = scale_of("fargo").win_probability(576 - 419)
    races = [
        (3, 2),
        (4, 2),
        (5, 3),
        (6, 3),
        (7, 4),
        (8, 4),
        (9, 4),
        (10, 5),
        (11, 5),
        (12, 5),
        (13, 6),
    ]
    worth = [0.735, 0.629, 0.752, 0.674, 0.771, 0.708, 0.643, 0.736, 0.680, 0.623, 0.711]
    assert [race_odds(m, n, p).p_win_1 for m, n in races] == pytest.approx(worth, abs=5e-4)


@pytest.mark.parametrize("breaks", [alternate_breaks, winner_breaks])
def test_breaks(breaks) -> None:
    scale = scale_of("npl")
    laws = pair_odds(BRACKET, RATINGS, 5, scale="npl", break_advantage=12, breaks=breaks)
    p1, p2 = scale.win_probability(70.0 + 12), scale.win_probability(12 - 70.0)
    both = [race_odds(5, 5, Rack(p1, p2), breaks, first).p_win_1 for first in (1, 2)]
    assert laws["F"].win[0, 1] == pytest.approx(np.mean(both))


@pytest.mark.parametrize("race", [6, chart("npl_10"), Fairest(5), Races(7, losers=Fairest(4))])
@pytest.mark.parametrize("advantage", [0.0, 20.0])
def test_chances_alone_are_those_of_the_laws(race, advantage: float) -> None:
    laws = pair_odds(BRACKET, RATINGS, race, scale="npl", break_advantage=advantage)
    chances = chances_given(BRACKET, RATINGS, race, scale="npl", break_advantage=advantage)
    for name, table in chances(RATINGS).items():
        assert table == pytest.approx(laws[name].win, rel=1e-11)


def test_what_cannot_be_played_is_refused() -> None:
    with pytest.raises(InputError, match="X9"):
        pair_odds(BRACKET, RATINGS, Races(7, by_match={"X9": 5}))
    with pytest.raises(InputError, match="race"):
        pair_odds(BRACKET, RATINGS, 0)
    with pytest.raises(InputError, match="ratings"):
        pair_odds(BRACKET, [500, 600], 7)
    with pytest.raises(InputError, match="ratings"):
        pair_odds(BRACKET, [500, 600, np.nan, 500], 7)


def test_with_form_lengths_are_those_of_single_matches() -> None:
    laws = pair_odds(BRACKET, RATINGS, Races(7, losers=5), form=0.4)
    for name, race in (("W1.1", 7), ("L1.1", 5)):
        match = Race(race, race, scale_of("fargo").rack(640.0 - 500.0))
        odds, length = match_odds(match, form=0.4), match_length(match, form=0.4)
        assert laws[name].win[0, 2] == pytest.approx(odds.p_win_1, abs=1e-9)
        both = laws[name].ends[0, 2] + laws[name].ends[2, 0]
        assert both[length.games] == pytest.approx(length.probability, abs=1e-9)
    plain, same = (pair_odds(BRACKET, RATINGS, 7, **how)["F"] for how in ({}, {"form": 0.0}))
    assert (plain.ends == same.ends).all()


def test_one_sided_long_races_stay_chances() -> None:
    ratings = [843.0, 250.0]
    win = pair_odds(single_elimination(2), ratings, 13, scale="fargo")["F"].win
    assert win[0, 1] == 1.0
    assert title_odds(single_elimination(2), win).title.tolist() == pytest.approx([1.0, 0.0])
