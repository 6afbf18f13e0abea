import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from math import log, log1p
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.games import (
    BREAK_FORMATS,
    Ahead,
    Race,
    Rack,
    alternate_breaks,
    winner_breaks,
)
from evenbreak.games.match import Match
from evenbreak.matches import (
    hill_hill_probability,
    match_length,
    match_odds,
    shutout_probability,
    win_probability,
)

CHANCE = st.floats(0.05, 0.95)
FORMATS = st.sampled_from(list(BREAK_FORMATS.values()))


@st.composite
def matches(draw: Any) -> Match:
    p1, p2, breaks = draw(CHANCE), draw(st.none() | CHANCE), draw(FORMATS)
    m, n = draw(st.integers(1, 6)), draw(st.integers(1, 6))
    first = draw(st.integers(1, 2))
    kind = draw(st.sampled_from(["race", "deuce", "ahead", "sets", "ahead of sets"]))
    rack = Rack(p1, p2)
    common = {"breaks": breaks, "first_breaker": first}
    if kind == "race":
        score = draw(st.integers(0, m - 1)), draw(st.integers(0, n - 1))
        return Race(m, n, rack, score=score, **common)
    if kind == "deuce":
        return Race(m, n, rack, win_by=draw(st.integers(2, 3)), **common)
    if kind == "ahead":
        return Ahead(m, n, rack, **common)
    inner = Race(2, 3, rack, breaks=breaks)
    outer = {"breaks": draw(st.none() | FORMATS), "first_breaker": first}
    if kind == "sets":
        return Race(min(m, 3), min(n, 3), inner, **outer)
    return Ahead(min(m, 2), min(n, 2), inner, **outer)


def assert_equal(scalar: float | None, other: float | None) -> None:
    assert (scalar is None) == (other is None)
    assert scalar is None or scalar == pytest.approx(other, rel=1e-12, abs=0)


@given(matches())
def test_the_scalar_and_the_array_kernels_agree(match: Match) -> None:
    odds, length = match_odds(match), match_length(match)
    assert odds.p_win_1 == pytest.approx(win_probability(match), rel=1e-12, abs=0)
    assert odds.p_win_2 == pytest.approx(win_probability(match, player=2), rel=1e-12, abs=0)
    assert odds.p_never_ends == length.p_never_ends == 0.0
    assert odds.mean_games == pytest.approx(length.mean, rel=1e-12)
    assert odds.sd_games == pytest.approx(length.sd, rel=1e-12)
    assert odds.games_p50 == length.quantile(0.5)
    assert odds.games_p90 == length.quantile(0.9)
    if isinstance(match.rack, Rack):
        assert_equal(odds.p_hill_hill, hill_hill_probability(match))
        assert_equal(odds.p_shutout_1, shutout_probability(match))
        assert_equal(odds.p_shutout_2, shutout_probability(match, player=2))
    else:
        assert odds.p_hill_hill is odds.p_shutout_1 is odds.p_shutout_2 is None


def test_what_means_nothing_is_none() -> None:
    ahead = match_odds(Ahead(3, 2, Rack(0.5)))
    assert ahead.p_hill_hill is ahead.p_shutout_1 is ahead.p_shutout_2 is None
    deuce = match_odds(Race(3, 3, Rack(0.5), win_by=2))
    assert deuce.p_hill_hill is None
    assert deuce.p_shutout_1 == 0.5**3


def test_a_match_of_sets_of_the_text() -> None:
    # P5.8: .493, and a set takes 3 to 5 racks.
    odds = match_odds(Race(3, 1, Race(3, 3, Rack(2 / 3))))
    assert odds.p_win_1 == pytest.approx(0.493270184272572, rel=1e-13)
    assert odds.mean_games is not None
    assert 3 * 1.0 < odds.mean_games < 5 * 3


def test_a_decided_match() -> None:
    for match in (Race(3, 2, Rack(0.5), score=(3, 1)), Ahead(3, 2, Rack(0.5), score=(3, 0))):
        odds = match_odds(match)
        assert (odds.p_win_1, odds.p_win_2, odds.mean_games, odds.games_p90) == (1, 0, 0, 0)
    odds = match_odds(Race(3, 2, Rack(0.5), score=(2, 2)))
    assert (odds.p_win_1, odds.p_win_2, odds.mean_games, odds.p_hill_hill) == (0.0, 1.0, 0.0, 0.0)
    assert (odds.p_shutout_1, odds.p_shutout_2) == (0.0, 1.0)


def test_a_match_that_never_ends_is_answered() -> None:
    odds = match_odds(Ahead(2, 2, Rack(1.0, 1.0), breaks=alternate_breaks))
    assert (odds.p_win_1, odds.p_win_2, odds.p_never_ends) == (0.0, 0.0, 1.0)
    assert odds.mean_games is odds.sd_games is odds.games_p50 is odds.games_p90 is None


def test_quantiles_of_a_match_that_takes_a_trillion_racks() -> None:
    # A pair of racks ends the match with chance 2q(1-q).
    p, q = 1.0 - 1e-12, Fraction(1, 10**12)
    odds = match_odds(Ahead(2, 2, Rack(p, p), breaks=alternate_breaks))
    chance = float(2 * q * (1 - q))
    assert odds.mean_games == pytest.approx(2 / chance, rel=1e-12)
    for found, level in ((odds.games_p50, 0.5), (odds.games_p90, 0.1)):
        assert found == pytest.approx(2 * log(level) / log1p(-chance), rel=1e-11)


def test_a_match_of_more_racks_than_a_float_can_square() -> None:
    # Player 1 breaks at leads 0 and 2 and, up to parts of p, wins a rack with chance p there;
    # from 0 one such rack leads to 2 or loses the match, from 2 it leads to 0 or wins it.
    p = 1e-300
    odds = match_odds(Ahead(3, 3, Rack(p, p), breaks=alternate_breaks))
    assert odds.p_win_1 == pytest.approx(1 / 3, rel=1e-12)
    # Each of these comes after 1 / 2p turns of two racks; there are 2 of them on average,
    # and a number with the law 1/2, 1/4, ... of such waits is again exponential.
    assert odds.mean_games == pytest.approx(2 / p, rel=1e-12)
    assert odds.sd_games == pytest.approx(2 / p, rel=1e-12)
    assert odds.games_p50 == pytest.approx(2 * log(2) / p, rel=1e-9)


def test_a_mean_that_no_float_holds_is_none() -> None:
    odds = match_odds(Ahead(3, 3, Rack(1e-310, 1e-310), breaks=alternate_breaks))
    assert odds.p_never_ends == 0.0
    assert odds.mean_games is odds.sd_games is None
    assert odds.games_p50 is not None
    assert odds.games_p50 > 10**310


def test_a_long_lead_needs_no_patience() -> None:
    odds = match_odds(Ahead(60, 60, Rack(0.5)))
    assert odds.mean_games == pytest.approx(3600, rel=1e-12)
    # The walk of +-1 steps out of (-1, 1) in Brownian time: the median is .7576 n^2 or so.
    assert odds.games_p50 == pytest.approx(0.7576 * 3600, rel=1e-3)


def test_arrays_are_for_the_other_kernels() -> None:
    with pytest.raises(InputError, match=r"p1 must be one number\. For an array"):
        match_odds(Race(2, 2, Rack([0.5, 0.6])))
    with pytest.raises(InputError, match="an array"):
        match_odds(Race(2, 2, Race(1, 1, Rack(0.5, [0.6]), breaks=winner_breaks)))


def test_the_scalar_path_needs_no_numpy() -> None:
    code = (
        "import sys; from evenbreak.matches.odds import match_odds; "
        "from evenbreak.games import *; "
        "match_odds(Race(7, 7, Rack(0.6, 0.5), breaks=winner_breaks)); "
        "match_odds(Race(3, 3, Race(7, 7, Rack(0.6)))); match_odds(Ahead(3, 3, Rack(0.6))); "
        "match_odds(Race(7, 7, Rack(0.6), win_by=2)); "
        "print(sorted({'numpy', 'scipy', 'pandas', 'networkx'} & set(sys.modules)))"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"


def test_the_score_moves_through_the_match() -> None:
    race = Race(5, 5, Rack(0.6, 0.55), breaks=winner_breaks)
    here = match_odds(race).p_win_1
    won = match_odds(replace(race, score=(1, 0), first_breaker=1)).p_win_1
    lost = match_odds(replace(race, score=(0, 1), first_breaker=2)).p_win_1
    assert here == pytest.approx(0.6 * won + 0.4 * lost, rel=1e-14)
