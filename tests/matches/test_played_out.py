"""Every kernel against play itself: all sequences of racks, in rational arithmetic.

Nothing here but the rules: who breaks, who needs what. Sets are played out too.
"""

from collections import defaultdict
from collections.abc import Iterator
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest

from evenbreak.games import BREAK_FORMATS, Race, Rack, winner_breaks
from evenbreak.matches import (
    final_scores,
    hill_hill_probability,
    match_length,
    match_odds,
    race_odds,
    shutout_probability,
    win_probability,
)
from rows import each_of

# Floats that are simple fractions, so that floats and rationals are the same numbers.
P1, P2 = Fraction(5, 8), Fraction(3, 16)

Course = tuple[tuple[int, int], int, int, Fraction]


def courses(
    needs: tuple[int, int], breaks: Any, breaker: int, score: tuple[int, int] = (0, 0)
) -> Iterator[Course]:
    """Yield final score, racks played, next breaker and chance of each course of a race."""
    if score[0] >= needs[0] or score[1] >= needs[1]:
        yield score, 0, breaker, Fraction(1)
        return
    one = P1 if breaker == 1 else 1 - P2
    for winner, chance in ((1, one), (2, 1 - one)):
        after = (score[0] + (winner == 1), score[1] + (winner == 2))
        for end, racks, then, rest in courses(needs, breaks, breaks(breaker, winner), after):
            yield end, racks + 1, then, chance * rest


def courses_of_sets(
    needs: tuple[int, int],
    set_needs: tuple[int, int],
    breaks: Any,
    set_breaks: Any,
    breaker: int,
    score: tuple[int, int] = (0, 0),
) -> Iterator[Course]:
    if score[0] >= needs[0] or score[1] >= needs[1]:
        yield score, 0, breaker, Fraction(1)
        return
    for end, racks, carried, chance in courses(set_needs, set_breaks, breaker):
        winner = 1 if end[0] >= set_needs[0] else 2
        after = (score[0] + (winner == 1), score[1] + (winner == 2))
        opener = carried if breaks is None else breaks(breaker, winner)
        rest = courses_of_sets(needs, set_needs, breaks, set_breaks, opener, after)
        for final, more, then, probability in rest:
            yield final, racks + more, then, chance * probability


def summed(pairs: Iterator[tuple[Any, Fraction]]) -> dict[Any, float]:
    total: dict[Any, Fraction] = defaultdict(Fraction)
    for key, chance in pairs:
        total[key] += chance
    return {key: float(chance) for key, chance in total.items()}


def lengths_of(length: Any) -> dict[int, float]:
    chances = zip(length.games.tolist(), length.probability.tolist(), strict=True)
    return {k: chance for k, chance in chances if chance}


@pytest.mark.parametrize("breaks", BREAK_FORMATS.values(), ids=list(BREAK_FORMATS))
def test_races(breaks: Any) -> None:
    for m, n, first in product(range(1, 5), range(1, 5), (1, 2)):
        played = list(courses((m, n), breaks, first))
        race = Race(m, n, Rack(float(P1), float(P2)), breaks=breaks, first_breaker=first)
        odds = race_odds(m, n, Rack(float(P1), float(P2)), breaks, first)
        by_score = summed((end, chance) for end, _, _, chance in played)
        by_length = summed((racks, chance) for _, racks, _, chance in played)
        assert final_scores(race).probability == pytest.approx(by_score, rel=1e-14, abs=0)
        assert lengths_of(match_length(race)) == pytest.approx(by_length, rel=1e-14, abs=0)
        scalar = {
            k: chance for k, chance in zip(odds.games, odds.probability, strict=True) if chance
        }
        assert scalar == pytest.approx(by_length, rel=1e-14, abs=0)
        one = sum(chance for (a, _), chance in by_score.items() if a == m)
        assert win_probability(race) == pytest.approx(one, rel=1e-14, abs=0)
        assert odds.p_win_1 == pytest.approx(one, rel=1e-14, abs=0)
        assert match_odds(race).p_win_1 == odds.p_win_1
        decider = by_score[m, n - 1] + by_score[m - 1, n]
        assert hill_hill_probability(race) == pytest.approx(decider, rel=1e-14, abs=0)
        assert odds.p_hill_hill == pytest.approx(decider, rel=1e-14, abs=0)
        for player, scalar_chance, nil in (
            (1, odds.p_shutout_1, (m, 0)),
            (2, odds.p_shutout_2, (0, n)),
        ):
            assert scalar_chance == pytest.approx(by_score[nil], rel=1e-14, abs=0)
            assert shutout_probability(race, player=player) == pytest.approx(
                by_score[nil], rel=1e-14, abs=0
            )


@each_of("outer", [None, winner_breaks, BREAK_FORMATS["alternate"]])
@each_of("inner", BREAK_FORMATS.values())
def test_matches_of_sets(outer: Any, inner: Any) -> None:
    for needs, set_needs, first in (((2, 1), (2, 2), 1), ((1, 2), (1, 2), 2), ((2, 2), (2, 1), 1)):
        played = list(courses_of_sets(needs, set_needs, outer, inner, first))
        one_set = Race(*set_needs, Rack(float(P1), float(P2)), breaks=inner)
        match = Race(*needs, one_set, breaks=outer, first_breaker=first)
        by_score = summed((end, chance) for end, _, _, chance in played)
        by_length = summed((racks, chance) for _, racks, _, chance in played)
        assert final_scores(match).probability == pytest.approx(by_score, rel=1e-13, abs=0)
        assert lengths_of(match_length(match)) == pytest.approx(by_length, rel=1e-13, abs=0)
        one = sum(chance for (a, _), chance in by_score.items() if a == needs[0])
        odds = match_odds(match)
        assert win_probability(match) == pytest.approx(one, rel=1e-13, abs=0)
        assert odds.p_win_1 == pytest.approx(one, rel=1e-13, abs=0)
        mean = sum(k * chance for k, chance in by_length.items())
        sd = sum((k - mean) ** 2 * chance for k, chance in by_length.items()) ** 0.5
        assert (odds.mean_games, odds.sd_games) == pytest.approx((mean, sd), rel=1e-13)
        length = match_length(match)
        assert (length.mean, length.sd) == pytest.approx((mean, sd), rel=1e-13)
        for q, k in ((0.5, odds.games_p50), (0.9, odds.games_p90)):
            exact = summed((racks, chance) for _, racks, _, chance in played)
            reached = np.cumsum([exact.get(i, 0.0) for i in range(max(exact) + 1)])
            assert k == length.quantile(q) == int(np.argmax(reached >= q))


def test_an_even_race_is_worth_the_same_in_three_break_formats() -> None:
    """Kingston (1976), Anderson (1977), whatever the players' chances are.

    The chances are multiples of 2^-k with k < 53 here, so that equal means equal.
    """
    quarters = (0.0, 0.25, 0.5, 0.75, 1.0)
    formats = [BREAK_FORMATS[name] for name in ("winner", "loser", "alternate")]
    for n, p1, p2, first in product(range(1, 8), quarters, quarters, (1, 2)):
        scalar = {race_odds(n, n, Rack(p1, p2), breaks, first).p_win_1 for breaks in formats}
        assert len(scalar) == 1, (n, p1, p2, first, scalar)
    grid = Rack(quarters, np.array(quarters)[:, np.newaxis])
    for n in range(1, 8):
        winner, loser, alternate = (
            win_probability(Race(n, n, grid, breaks=breaks)) for breaks in formats
        )
        assert (winner == loser).all()
        assert (winner == alternate).all()


def test_the_break_format_does_change_an_uneven_race_and_the_length() -> None:
    winner, alternate = (
        race_odds(5, 4, Rack(0.75, 0.5), BREAK_FORMATS[k]) for k in ("winner", "alternate")
    )
    assert winner.p_win_1 == 0.7261962890625
    assert alternate.p_win_1 == 0.655517578125
    means = {race_odds(5, 5, Rack(0.75, 0.75), breaks).mean for breaks in BREAK_FORMATS.values()}
    assert len(means) == len(BREAK_FORMATS)
