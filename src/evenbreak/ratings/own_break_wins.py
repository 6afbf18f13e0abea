"""How many racks players won on their own break, where a match is known by its score alone.

In a race whose break format and first breaker are known, the score i:j and the winner of the
last rack determine how many racks each player broke: a broke n of them. It is
not known how many of those a won, k. The sequences of racks with the same k are equally
likely, and there are c(k) of them, so that with the skills' difference d and the break
advantage β

    P(score) = exp(d i) / ((1 + exp(d + β))^n (1 + exp(d - β))^(i + j - n))
               * Σ_k c(k) exp(β (2k - i)):

the difference is as well known as if every rack were, and only β is known less well.
"""

from __future__ import annotations

from math import comb, log
from typing import NamedTuple

import numpy as np
from scipy.special import logsumexp

from evenbreak.arrays import Floats


class BreakWins(NamedTuple):
    """The racks that a broke, how many of them (k) a may have won, and the logarithm of c(k)."""

    broke_a: int
    won: Floats
    log_count: Floats


class BreakWinsTerms(NamedTuple):
    """Terms of the likelihood: 2k less its middle value, and log c(k), -inf beyond its end.

    Shape (terms, most values of k).
    """

    value: Floats
    log_count: Floats

    @classmethod
    def of(cls, matches: list[BreakWins]) -> BreakWinsTerms:
        """Return the terms of several matches."""
        width = max((len(match.won) for match in matches), default=1)
        value = np.zeros((len(matches), width))
        log_count = np.full((len(matches), width), -np.inf)
        for row, match in enumerate(matches):
            own = len(match.won)
            value[row, :own] = 2.0 * match.won - (match.won[0] + match.won[-1])
            log_count[row, :own] = match.log_count
        return cls(value, log_count)

    def log_sums(self, advantage: float | Floats) -> tuple[Floats, Floats, Floats]:
        """Return log Σ c(k) exp(β value) of each term, and its first two derivatives in β.

        Several advantages give one row each.
        """
        beta = np.asarray(advantage, dtype=np.float64)[..., None, None]
        if not len(self.value):
            none = np.zeros((*np.shape(advantage), 0))
            return none, none, none
        terms = self.log_count + beta * self.value
        total = logsumexp(terms, axis=-1)
        share = np.exp(terms - total[..., None])
        mean = (share * self.value).sum(axis=-1)
        spread = (share * (self.value - mean[..., None]) ** 2).sum(axis=-1)
        return total, mean, spread


def break_wins(form: str, first: int, games: tuple[int, int], last: int) -> BreakWins:
    """Return how many racks a may have won on their own break, and in how many ways.

    Parameters
    ----------
    form
        the break format: 'winner', 'loser' or 'alternate'.
    first, last
        who broke the first rack, and who won the last one: 1 for a, 2 for b.
    games
        the games that a and b won; the winner of the last rack won at least one.

    Notes
    -----
    Sequences are counted by their runs: of t racks in r runs there are C(t - 1, r - 1).

    >>> wins = break_wins("winner", 1, (2, 1), 1)  # aba or baa: a won 1 of 2
    >>> wins.broke_a, wins.won, np.exp(wins.log_count)
    (2, array([1.]), array([2.]))
    """
    i, j = games
    a_first, a_last = int(first == 1), int(last == 1)
    if form == "alternate":
        broke_a = (i + j + a_first) // 2
    elif form == "winner":
        broke_a = a_first + i - a_last
    else:
        broke_a = a_first + j - (1 - a_last)
    count = {"alternate": _alternate, "winner": _winner, "loser": _loser}[form]
    ways = {
        k: count(k, i, j, broke_a, a_first, a_last)
        for k in range(max(0, broke_a - j), min(broke_a, i) + 1)
    }
    possible = [k for k, number in ways.items() if number]
    return BreakWins(
        broke_a,
        np.array(possible, dtype=np.float64),
        np.array([log(ways[k]) for k in possible]),
    )


def _alternate(k: int, i: int, j: int, broke_a: int, a_first: int, a_last: int) -> int:
    """Count the ways to win k of the racks that a broke, and i - k of the others."""
    broke_b = i + j - broke_a
    if (i + j) % 2 == a_first:  # a broke the last rack
        return _choose(broke_a - 1, k - a_last) * _choose(broke_b, i - k)
    return _choose(broke_a, k) * _choose(broke_b - 1, i - k - a_last)


def _winner(k: int, i: int, j: int, broke_a: int, a_first: int, a_last: int) -> int:  # noqa: ARG001
    """Count sequences of winners, the first breaker put before them, by their runs."""
    return _runs(i + a_first, i - k + a_first) * _runs(j + 1 - a_first, broke_a - k + 1 - a_first)


def _loser(k: int, i: int, j: int, broke_a: int, a_first: int, a_last: int) -> int:
    """Count sequences of breakers, the loser of the last rack put after them, by their runs."""
    broke_b = i + j - broke_a
    runs_a, runs_b = broke_b - i + k + a_first, k + 1 - a_first
    return _runs(broke_a + 1 - a_last, runs_a) * _runs(broke_b + a_last, runs_b)


def _runs(racks: int, runs: int) -> int:
    return int(racks == runs) if racks == 0 else _choose(racks - 1, runs - 1)


def _choose(n: int, k: int) -> int:
    return comb(n, k) if 0 <= k <= n else 0
