"""The closed form of n-ahead matches, beside fractions, decimals and the graph of the match."""

import random
import time
from collections.abc import Callable
from decimal import Decimal, localcontext
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest

from evenbreak.games import BREAK_FORMATS, Ahead, Race, Rack, winner_breaks
from evenbreak.matches import match_odds, win_probability
from rows import each_of
from tries import tries

FORMATS = pytest.mark.parametrize("breaks", BREAK_FORMATS.values(), ids=list(BREAK_FORMATS))
ALL_FORMATS = [
    lambda breaker, winner, to=to: to[2 * breaker + winner - 3] for to in product((1, 2), repeat=4)
]
CHANCES = [1e-300, 2.0**-900, 2.0**-40, 0.25, 0.5, 0.5 + 2.0**-40, 0.625, 1.0 - 2.0**-20]
LEAST = Fraction(1, 10**290)

Racks = dict[int, tuple[Fraction, Fraction]]


def racks_of(rack: Rack) -> Racks:
    """Return the chances of both players by who breaks, with sums of exactly 1."""
    found = {}
    for breaker in (1, 2):
        one, two = (Fraction(rack.chance(player, breaker)) for player in (1, 2))
        found[breaker] = one / (one + two), two / (one + two)
    return found


def exact(m: int, n: int, racks: Racks, breaks: Callable[[int, int], int], first: int) -> Fraction:
    """Return P(player 1 wins), climbing from -n to m lead by lead.

    rise[b, c] is P(the lead grows by one before play ends at -n, and c breaks then | b breaks).
    """
    rise = dict.fromkeys(product((1, 2), repeat=2), Fraction(0))
    held = {breaker: Fraction(breaker == first) for breaker in (1, 2)}
    for lead in range(1 - n, m):
        up = dict.fromkeys(rise, Fraction(0))
        again = dict.fromkeys(rise, Fraction(0))
        for b in (1, 2):
            p, q = racks[b]
            up[b, breaks(b, 1)] += p
            for c in (1, 2):
                again[b, c] += q * rise[breaks(b, 2), c]
        k, across, s, t = 1 - again[1, 1], again[1, 2], again[2, 1], 1 - again[2, 2]
        whole = k * t - across * s
        if whole == 0:
            return Fraction(0)
        for c in (1, 2):
            rise[1, c] = (t * up[1, c] + across * up[2, c]) / whole
            rise[2, c] = (s * up[1, c] + k * up[2, c]) / whole
        if lead >= 0:
            held = {c: sum((held[b] * rise[b, c] for b in (1, 2)), Fraction(0)) for c in (1, 2)}
    return sum(held.values(), Fraction(0))


def both(match: Ahead, lead: int) -> tuple[Fraction, Fraction]:
    racks, breaks = racks_of(match.rack), match.breaks  # type: ignore[arg-type]
    assert breaks is not None
    m, n = match.m - lead, match.n + lead
    theirs = {breaker: (q, p) for breaker, (p, q) in racks.items()}
    return (
        exact(m, n, racks, breaks, match.first_breaker),
        exact(n, m, theirs, lambda b, w: breaks(b, 3 - w), match.first_breaker),
    )


def score_of(lead: int) -> tuple[int, int]:
    return max(lead, 0), max(-lead, 0)


@pytest.mark.slow_after(2)
@FORMATS
def test_chances_are_right_to_the_last_digits(breaks: Any) -> None:
    draw = random.Random(f"ahead {breaks.__name__}")
    for _ in range(tries("leads", 15, parts=5)):
        longest = draw.choice((3, 8, 40))
        m, n = draw.randint(1, longest), draw.randint(1, longest)
        lead, first = draw.randint(1 - n, m - 1), draw.choice((1, 2))
        p1, p2 = (draw.choice([*CHANCES, *draw.sample(range(1, 2**20), 4)]) for _ in range(2))
        rack = Rack(*(float(p) if p < 1 else p / 2**20 for p in (p1, p2)))
        match = Ahead(m, n, rack, breaks=breaks, first_breaker=first)
        for player, right in zip((1, 2), both(match, lead), strict=True):
            found = win_probability(match, score_of(lead), player=player)
            if right > LEAST:
                assert abs(Fraction(found) / right - 1) < Fraction(15, 10**16), (match, lead)
            else:
                assert found <= 1e-289


@each_of("n", [50, 5_000, 50_000])
@each_of("p", [0.5, 0.5 + 2.0**-53, 0.4999, 0.51, 0.496, 1e-5])
def test_long_matches_without_a_break(n: int, p: float) -> None:
    for m in (n, n // 3, 1):
        rack = Rack(p)
        with localcontext() as context:
            context.prec = 80
            odds = Decimal(rack.chance(2)) / Decimal(rack.chance(1))
            if odds == 1:
                one, two = (Decimal(k) / (m + n) for k in (n, m))
            else:
                one = (1 - odds**n) / (1 - odds ** (m + n))
                two = (1 - odds**-m) / (1 - odds ** -(m + n))
        for player, right in ((1, one), (2, two)):
            if right > Decimal("1e-290"):
                found = win_probability(Ahead(m, n, rack), player=player)
                assert abs(Decimal(found) / right - 1) < Decimal("1e-15")


@FORMATS
def test_long_matches_with_a_break_are_chains_of_short_ones(breaks: Any) -> None:
    """A match 2k:2k is one that is 2:2 ahead in matches k:k, for which no format is needed."""
    for p1, p2 in ((0.5625, 0.5625), (0.5, 0.625), (0.4375, 0.5)):
        rack = Rack(p1, p2)
        whole = win_probability(Ahead(96, 96, rack, breaks=breaks))
        parts = Ahead(2, 2, Ahead(3, 3, Ahead(16, 16, rack, breaks=breaks)))
        assert whole == pytest.approx(win_probability(parts), rel=1e-13, abs=0)


@pytest.mark.slow
def test_any_break_format_of_ones_own() -> None:
    p1, p2 = np.array([[0.25, 0.0, 1.0, 1.0], [0.625, 0.5, 1.0, 0.0]])
    for breaks, (m, n), first in product(ALL_FORMATS, [(1, 2), (3, 2)], (1, 2)):
        match = Ahead(m, n, Rack(p1, p2), breaks=breaks, first_breaker=first)
        for player in (1, 2):
            many = win_probability(match, player=player)
            for at in np.ndindex(many.shape):
                rack = Rack(float(p1[at]), float(p2[at]))
                one = Ahead(m, n, rack, breaks=breaks, first_breaker=first)
                graph = win_probability(one, player=player, via="elimination")
                assert many[at] == pytest.approx(graph, rel=1e-14, abs=0)
                assert win_probability(one, player=player) == pytest.approx(graph, rel=1e-14, abs=0)


@FORMATS
def test_play_that_goes_back_and_forth_never_ends(breaks: Any) -> None:
    """Where both always win, or always lose, their own break, who breaks next decides."""
    for p, first in product((0.0, 1.0), (1, 2)):
        rack = Rack(p, p)
        match = Ahead(3, 2, rack, breaks=breaks, first_breaker=first)
        odds = match_odds(match)
        one, two = (win_probability(match, player=player) for player in (1, 2))
        assert (one, two) == (odds.p_win_1, odds.p_win_2)
        assert 1.0 - one - two == odds.p_never_ends


@FORMATS
def test_arrays_are_the_numbers_at_once(breaks: Any) -> None:
    draw = np.random.default_rng(7)
    p1 = np.concatenate([draw.random(30), CHANCES, [0.0, 1.0, 0.5]])[:, np.newaxis]
    p2 = np.array([0.0, 1e-300, 0.3, 0.5, 0.7, 1.0])
    for m, n, first in ((5, 3, 1), (2, 7, 2), (30, 31, 1)):
        many = win_probability(Ahead(m, n, Rack(p1, p2), breaks=breaks, first_breaker=first))
        assert many.shape == (41, 6)
        for i, k in np.ndindex(many.shape):
            rack = Rack(float(p1[i, 0]), float(p2[k]))
            one = win_probability(Ahead(m, n, rack, breaks=breaks, first_breaker=first))
            assert many[i, k] == pytest.approx(one, rel=1e-15, abs=1e-300)


def test_sets_keep_the_closed_form() -> None:
    inner = Race(3, 3, Rack(0.55, 0.6), breaks=winner_breaks)
    for m, n in ((4, 4), (3, 5)):
        match = Ahead(m, n, inner, breaks=winner_breaks)
        assert win_probability(match) == pytest.approx(
            win_probability(match, via="elimination"), rel=1e-13, abs=0
        )


def test_the_time_does_not_grow_with_the_match() -> None:
    def took(n: int) -> float:
        match = Ahead(n, n, Rack(0.5001, 0.5001), breaks=winner_breaks)
        best = float("inf")
        for _ in range(20):
            begin = time.process_time()
            win_probability(match)
            best = min(best, time.process_time() - begin)
        return best

    assert took(500_000) < 5 * took(50)
