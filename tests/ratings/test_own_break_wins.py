"""In how many ways a score can come about, against all sequences of racks written out."""

import math
from collections import Counter
from itertools import product

import numpy as np

from evenbreak.ratings.who_broke import BreakWinsTerms, break_wins
from rows import each_of


def written_out(form, first, games, last):
    """Return how many sequences there are by (racks that a broke, of these won by a)."""
    counts = Counter()
    for racks in product((1, 2), repeat=sum(games)):
        if racks.count(1) != games[0] or racks[-1] != last:
            continue
        breaker, broke, won = first, 0, 0
        for winner in racks:
            broke += breaker == 1
            won += breaker == 1 and winner == 1
            breaker = {"winner": winner, "loser": 3 - winner, "alternate": 3 - breaker}[form]
        counts[broke, won] += 1
    return counts


@each_of("form", ["winner", "loser", "alternate"])
@each_of("first", [1, 2])
@each_of("last", [1, 2])
def test_against_all_sequences(form, first, last):
    for games in product(range(6), range(6)):
        if games[last - 1] == 0:
            continue
        wins = break_wins(form, first, games, last)
        got = {
            (wins.broke_a, int(k)): round(math.exp(count))
            for k, count in zip(wins.won, wins.log_count, strict=True)
        }
        assert got == dict(written_out(form, first, games, last)), games


def test_the_derivatives_are_those_of_the_sums():
    splits = BreakWinsTerms.of(
        [break_wins("winner", 1, (7, 5), 1), break_wins("alternate", 2, (3, 9), 2)]
    )
    low, at, high = (splits.log_sums(0.3 + step) for step in (-1e-5, 0.0, 1e-5))
    np.testing.assert_allclose((high[0] - low[0]) / 2e-5, at[1], rtol=1e-6)
    np.testing.assert_allclose((high[1] - low[1]) / 2e-5, at[2], rtol=1e-6)


def test_without_matches_there_are_no_sums():
    assert all(part.shape == (0,) for part in BreakWinsTerms.of([]).log_sums(0.1))
