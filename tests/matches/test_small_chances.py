"""Chances far below the rounding of a float near 1, by every way that leads to them."""

import math
from fractions import Fraction

import pytest

from evenbreak.games import Ahead, Race, Rack, loser_breaks, winner_breaks
from evenbreak.matches import match_odds, race_odds, win_probability
from evenbreak.practice import compare_break_formats, long_run_sd
from evenbreak.ratings.scale import scale_of
from evenbreak.stats import InningsScore
from rows import each_of

NPL = scale_of("npl")


@each_of("difference", [300.0, 1300.0, 1600.0, 20_000.0])
@each_of("race", [(1, 1), (3, 2), (2, 5)])
def test_swapping_the_players_swaps_the_chances(difference: float, race: tuple[int, int]) -> None:
    m, n = race
    ours = match_odds(Race(m, n, NPL.rack(difference)))
    theirs = match_odds(Race(n, m, NPL.rack(-difference)))
    assert (ours.p_win_1, ours.p_win_2) == (theirs.p_win_2, theirs.p_win_1)
    for player, found in ((1, ours.p_win_1), (2, ours.p_win_2)):
        assert win_probability(Race(m, n, NPL.rack(difference)), player=player) == pytest.approx(
            found, rel=1e-13, abs=0
        )


def test_the_weaker_player_of_1600_points() -> None:
    x = Fraction(2.0 ** (-1600 / 30))
    odds = race_odds(1, 1, NPL.rack(1600.0))
    assert odds.p_win_2 == pytest.approx(float(x / (1 + x)), rel=1e-15, abs=0)


def test_ahead_matches_and_break_formats_keep_them() -> None:
    rack = NPL.rack(1600.0)
    q = rack.chance(2)
    assert win_probability(Ahead(2, 2, rack), player=2) == pytest.approx(q * q, rel=1e-14, abs=0)
    breaks = Rack(rack.p1, rack.p1, q1=q, q2=q)
    race = Race(2, 1, breaks, breaks=winner_breaks)
    assert win_probability(race, player=2) == pytest.approx(2 * q, rel=1e-14, abs=0)


def test_scores_of_players_who_hardly_ever_make_a_shot() -> None:
    exact = math.comb(28, 19) * Fraction(1, 10 ** (16 * 19))
    assert InningsScore(1e-16, 10).at_least(19) == pytest.approx(float(exact), rel=1e-12, abs=0)


def test_break_formats_of_breakers_who_hardly_ever_win() -> None:
    p = 1e-160
    for value in compare_break_formats(Rack(p, p)):
        assert math.isfinite(value.sd_points)
    # Losers break: as long as player 1 breaks they lose; the break changes after 1/p racks.
    assert long_run_sd(p, p, loser_breaks) == pytest.approx(0.5 / math.sqrt(p), rel=1e-12)
    assert long_run_sd(1e-8, 1e-8, loser_breaks) == pytest.approx(
        0.5 * math.sqrt((1 - 1e-8) / 1e-8), rel=1e-12
    )
