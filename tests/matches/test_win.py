from fractions import Fraction
from math import comb
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.games import (
    BREAK_FORMATS,
    Ahead,
    OneBall,
    Race,
    Rack,
    alternate_breaks,
    loser_breaks,
    winner_breaks,
)
from evenbreak.games.match import Match
from evenbreak.matches import (
    final_scores,
    match_length,
    match_odds,
    race_odds,
    race_win_probability,
    win_probability,
)
from rows import each_of

PROBABILITY = st.floats(0.0, 1.0, allow_subnormal=False)
GAMES = st.integers(1, 9)
FORMATS = st.sampled_from(list(BREAK_FORMATS.values()))


def exact_race(m: int, n: int, p: float) -> Fraction:
    """Return the chance to win m games or more of m+n-1."""
    x, last = Fraction(p), m + n - 1
    return sum(
        (comb(last, k) * x**k * (1 - x) ** (last - k) for k in range(m, last + 1)), Fraction(0)
    )


PUBLISHED = [
    ("P5.5", Race(3, 2, Rack(2 / 3)), 0.5925925925925926, 1e-12),
    ("P5.8", Race(9, 5, Rack(2 / 3)), 0.552, 0.0005),
    ("P5.8", Race(3, 3, Rack(2 / 3)), 0.79, 0.0005),
    ("P5.8", Race(3, 1, Race(3, 3, Rack(2 / 3))), 0.493, 0.0005),
    ("P5.7", Race(4, 2, Rack(0.6861898295443056)), 0.5, 1e-12),
    ("NPL", Race(5, 4, Rack(0.5)), 0.36328125, 1e-15),
    ("NPL", Race(4, 5, Rack(0.5)), 0.63671875, 1e-15),
    ("P5.27", Ahead(1, 5, Rack(0.3)), 0.4250085528566541, 1e-12),
    ("P5.27", Ahead(1, 5, Rack(0.5)), 0.8333333333333334, 1e-12),
    ("P5.27", Ahead(1, 5, Rack(0.6)), 0.9518796992481203, 1e-12),
    ("P5.27", Ahead(2, 4, Rack(0.3)), 0.1785836469380773, 1e-12),
    ("P5.27", Ahead(2, 4, Rack(0.5)), 0.6666666666666666, 1e-12),
    ("P5.27", Ahead(2, 4, Rack(0.6)), 0.8796992481203008, 1e-12),
    ("P5.27", Ahead(3, 3, Rack(0.3)), 0.07297297297297296, 1e-12),
    ("P5.27", Ahead(3, 3, Rack(0.5)), 0.5, 1e-12),
    ("P5.27", Ahead(3, 3, Rack(0.6)), 0.7714285714285715, 1e-12),
    ("P5.27", Ahead(4, 2, Rack(0.3)), 0.027711255559356822, 1e-12),
    ("P5.27", Ahead(4, 2, Rack(0.5)), 0.3333333333333333, 1e-12),
    ("P5.27", Ahead(4, 2, Rack(0.6)), 0.6090225563909775, 1e-12),
    ("P5.27", Ahead(5, 1, Rack(0.3)), 0.008313376667807045, 1e-12),
    ("P5.27", Ahead(5, 1, Rack(0.5)), 0.16666666666666666, 1e-12),
    ("P5.27", Ahead(5, 1, Rack(0.6)), 0.3654135338345864, 1e-12),
]


@each_of("source, match, printed, tolerance", PUBLISHED)
def test_published(source: str, match: Match, printed: float, tolerance: float) -> None:
    assert win_probability(match) == pytest.approx(printed, abs=tolerance), source


TINY = 10.0**-290
CHANCES = [1e-12, 1e-3, 0.3, 0.5, 0.999, 1 - 1e-12]
SIZES = [(1, 1), (7, 7), (25, 3), (3, 25), (60, 60)]


def assert_right(found: float, exact: Fraction) -> None:
    """Relative accuracy, except where the answer is near the smallest number there is."""
    if exact > TINY:
        assert found == pytest.approx(float(exact), rel=1e-12, abs=0)


@each_of("m, n", SIZES)
@each_of("p", CHANCES)
def test_both_tails_of_a_race_are_right(m: int, n: int, p: float) -> None:
    race = Race(m, n, Rack(p))
    one = exact_race(m, n, p)
    assert_right(win_probability(race), one)
    # The chance of losing is that of the decimal p.
    assert_right(win_probability(race, player=2), exact_race(n, m, float(1 - Fraction(repr(p)))))
    odds = race_odds(m, n, p)
    assert_right(odds.p_win_1, one)


@each_of("m, n", SIZES[:-1])
@each_of("p1", CHANCES)
def test_both_tails_are_right_with_breaks(m: int, n: int, p1: float) -> None:
    for p2, breaks in ((0.3, winner_breaks), (1e-12, alternate_breaks), (0.999, loser_breaks)):
        won = [Fraction(repr(p1)), 1 - Fraction(repr(p2))]
        lost = [1 - Fraction(repr(p1)), Fraction(repr(p2))]
        mass = {(0, 0, 1): Fraction(1)}
        ends = [Fraction(0), Fraction(0)]
        for _ in range(m + n - 1):
            after: dict[tuple[int, int, int], Fraction] = {}
            for (a, b, s), held in mass.items():
                for winner, chance in ((1, won[s - 1]), (2, lost[s - 1])):
                    x, y = a + (winner == 1), b + (winner == 2)
                    if x == m or y == n:
                        ends[winner - 1] += held * chance
                    else:
                        key = (x, y, breaks(s, winner))
                        after[key] = after.get(key, Fraction(0)) + held * chance
            mass = after
        race = Race(m, n, Rack(p1, p2), breaks=breaks)
        odds = race_odds(m, n, Rack(p1, p2), breaks)
        for player, scalar, exact in zip((1, 2), (odds.p_win_1, odds.p_win_2), ends, strict=True):
            assert_right(win_probability(race, player=player), exact)
            assert_right(scalar, exact)


@given(p=st.floats(1e-9, 1.0), m=GAMES, n=GAMES)
def test_an_n_ahead_match_is_a_gamblers_ruin(p: float, m: int, n: int) -> None:
    rack = Rack(p)
    x, y = Fraction(rack.chance(1)), Fraction(rack.chance(2))
    # The chance to gain m before losing n is a ratio of two sums of powers of the odds.
    all_ = sum((x ** (m + n - 1 - k) * y**k for k in range(m + n)), Fraction(0))
    one = sum((x ** (m + n - 1 - k) * y**k for k in range(n)), Fraction(0)) / all_
    match = Ahead(m, n, rack)
    assert win_probability(match) == pytest.approx(float(one), rel=1e-12, abs=0)
    assert win_probability(match, player=2) == pytest.approx(float(1 - one), rel=1e-12, abs=0)


def test_a_fifty_ahead_match_keeps_its_digits() -> None:
    chance = win_probability(Ahead(50, 50, Rack(1e-4)))
    odds = Fraction(1e-4) / (1 - Fraction(1e-4))
    assert chance == pytest.approx(float(odds**50 / (1 + odds**50)), rel=1e-12, abs=0)


@given(p1=PROBABILITY, p2=PROBABILITY, m=GAMES, n=GAMES, breaks=FORMATS, first=st.integers(1, 2))
def test_swapping_the_players_swaps_the_chances(
    p1: float, p2: float, m: int, n: int, breaks: Any, first: int
) -> None:
    def swapped(breaker: int, winner: int) -> int:
        return 3 - int(breaks(3 - breaker, 3 - winner))

    here = Race(m, n, Rack(p1, p2), breaks=breaks, first_breaker=first)
    there = Race(n, m, Rack(p2, p1), breaks=swapped, first_breaker=3 - first)
    one, two = win_probability(here), win_probability(here, player=2)
    assert two == pytest.approx(win_probability(there), rel=1e-13, abs=0)
    assert one == pytest.approx(win_probability(there, player=2), rel=1e-13, abs=0)
    assert one + two == pytest.approx(1.0, rel=1e-13)


@given(m=GAMES, n=GAMES, breaks=FORMATS, p2=PROBABILITY, kind=st.sampled_from([Race, Ahead]))
def test_a_better_player_wins_more(m: int, n: int, breaks: Any, p2: float, kind: Any) -> None:
    p1 = np.linspace(0.0, 1.0, 21)
    if kind is Ahead and p2 in (0.0, 1.0):
        p2 = 0.5  # otherwise a match may never end, and a better player only ends it less often
    chances = win_probability(kind(m, n, Rack(p1, p2), breaks=breaks))
    assert (np.diff(chances) >= -1e-15).all()


def test_arrays_broadcast_and_numbers_stay_numbers() -> None:
    p1, p2 = np.array([0.2, 0.5, 0.9]), np.array([[0.4], [0.7]])
    inner = Race(2, 3, Rack(p1, p2), breaks=loser_breaks)
    for match in (
        Race(4, 3, Rack(p1, p2), breaks=winner_breaks),
        Race(4, 3, Rack(p1, p2), breaks=BREAK_FORMATS["player 1"], win_by=2),
        Ahead(2, 3, Rack(p1, p2), breaks=alternate_breaks),
        Race(2, 2, inner),
    ):
        chances = win_probability(match)
        assert chances.shape == (2, 3)
        rack = Rack(0.9, 0.4)
        scalar: Any = (
            Race(2, 2, Race(2, 3, rack, breaks=loser_breaks))
            if match.rack is inner
            else type(match)(
                match.m,
                match.n,
                rack,
                breaks=match.breaks,
                **({"win_by": match.win_by} if isinstance(match, Race) else {}),
            )
        )
        assert isinstance(win_probability(scalar), float)
        assert chances[0, 2] == pytest.approx(win_probability(scalar), rel=1e-14)
    assert win_probability(Race(2, 2, Rack([0.5])), (2, 0)).tolist() == [1.0]
    assert win_probability(Race(5, 3, Rack(np.empty((0, 2)), 0.5), breaks=winner_breaks)).shape == (
        0,
        2,
    )


def test_a_score_mid_match_is_a_shorter_match() -> None:
    race = Race(7, 5, Rack(0.6, 0.3), breaks=alternate_breaks, first_breaker=2)
    rest = Race(4, 4, Rack(0.6, 0.3), breaks=alternate_breaks, first_breaker=2)
    assert win_probability(race, (3, 1)) == win_probability(rest)
    assert win_probability(race, (6, 5), player=2) == 1.0
    assert win_probability(Ahead(3, 2, Rack(0.6)), (2, 1)) == pytest.approx(
        win_probability(Ahead(2, 3, Rack(0.6))), rel=1e-15
    )
    with pytest.raises(InputError, match="score is 8-0, which can't be reached"):
        win_probability(race, (8, 0))
    with pytest.raises(InputError, match="player must be 1 or 2; you gave 3"):
        win_probability(race, player=3)


def test_a_match_that_may_never_end() -> None:
    match = Ahead(2, 2, Rack([1.0, 1.0, 0.5], [1.0, 0.5, 1.0]), breaks=alternate_breaks)
    one, two = win_probability(match), win_probability(match, player=2)
    assert one.tolist() == [0.0, 1.0, 0.0]
    assert two.tolist() == [0.0, 0.0, 1.0]


def test_race_win_probability_is_the_beta_function_of_the_text() -> None:
    p = np.array([0.0, 0.25, 2 / 3, 1.0])
    found = race_win_probability(p[:, np.newaxis], [3, 9], [2, 5])
    exact = [[float(exact_race(m, n, x)) for m, n in ((3, 2), (9, 5))] for x in p]
    assert found.tolist() == [pytest.approx(row, rel=1e-13, abs=0) for row in exact]
    assert isinstance(race_win_probability(0.5, 3, 2), float)
    # Who needs nothing has won.
    assert race_win_probability(0.0, 0, 3) == 1.0
    assert race_win_probability([1.0, 0.3], 3, 0).tolist() == [0.0, 0.0]


@pytest.mark.parametrize(
    ("p", "m", "n", "message"),
    [
        (1.5, 3, 2, r"gave 1\.5"),
        ([0.5, float("nan")], 3, 2, "holds nan"),
        (0.5, -1, 2, "m must be whole numbers, 0 or more; it is -1"),
        (0.5, 3, [2, 2.5], r"n must be whole numbers, 0 or more; it holds 2\.5"),
        (0.5, "3", 2, "m must be whole numbers, 0 or more; it is '3'"),
        (0.5, 3, float("inf"), "n must be whole numbers, 0 or more; it is inf"),
        (0.5, [1, 0], 0, "both 0 somewhere"),
        ([0.5, 0.6], [1, 2, 3], 4, r"p has shape \(2,\), m has shape \(3,\)"),
    ],
)
def test_wrong_needs_are_refused(p: Any, m: Any, n: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        race_win_probability(p, m, n)


@pytest.mark.parametrize("ask", [win_probability, match_length, final_scores, match_odds])
@pytest.mark.parametrize("wrong", [Rack(0.5), 0.5])
def test_what_is_not_a_match_is_refused(ask: Any, wrong: Any) -> None:
    with pytest.raises(InputError, match=r"must be a Race or an Ahead"):
        ask(wrong)


@pytest.mark.parametrize("ask", [final_scores, match_odds])
def test_other_games_have_no_score(ask: Any) -> None:
    with pytest.raises(InputError, match=r"must be a Race or an Ahead"):
        ask(OneBall(0.4, 0.8))


@each_of("p", [1e-12, 1e-3, 0.999, 1 - 1e-12])
@each_of("m", [3, 7, 9])
def test_no_chance_is_above_one(p, m):
    for match in (
        Race(m, 7, Rack(p)),
        Race(m, 7, Rack(p, p), breaks=winner_breaks),
        Race(m, 7, Rack(p), win_by=2),
        Ahead(m, 2, Rack(p, 1 - p), breaks=alternate_breaks),
    ):
        odds = match_odds(match)
        chances = [odds.p_win_1, odds.p_win_2]
        chances += [win_probability(match, player=player) for player in (1, 2)]
        assert max(chances) <= 1.0
