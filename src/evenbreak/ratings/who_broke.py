"""Who broke each rack, as far as the results show it.

`first_break` broke the first rack; who broke the next follows from the break format and,
for winner and loser breaks, from who won the rack before.

A match known only by its score says less. In a race whose break format and first breaker are known,
the score i:j and the winner of the last rack determine how many racks each player broke: a broke n
of them. It is not known how many of those a won, k. The sequences of racks with the same k are
equally likely, and there are c(k) of them, so that with the skills' difference d and the break
advantage β

    P(score) = exp(d i) / ((1 + exp(d + β))^n (1 + exp(d - β))^(i + j - n))
               * Σ_k c(k) exp(β (2k - i)):

the difference is known as well as if every rack were known; only β is known less well.
"""

from __future__ import annotations

from math import comb, log
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

from evenbreak.arrays import Floats, Ints, Places
from evenbreak.errors import InputError
from evenbreak.ratings.results import Results
from evenbreak.ratings.results_frame import FORMATS


class BreakWins(NamedTuple):
    """The racks that a broke, how many of them (k) a may have won, and the log of c(k)."""

    broke_a: int
    won: Floats
    log_count: Floats


class BreakWinsTerms(NamedTuple):
    """Likelihood terms: 2k minus its middle value, and log c(k), -inf beyond its end.

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

    Players are 1 for a, 2 for b; the form is 'winner', 'loser' or 'alternate'; the winner of the
    last rack won at least one.

    Sequences are counted by their runs: there are C(t - 1, r - 1) of t racks in r runs.

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


_A, _B = FORMATS.index("a"), FORMATS.index("b")


class Broken(NamedTuple):
    """Games by who broke, match by match: shape (3, rows), in the order not known, a, b.

    `won` by player a, `lost` by player a. If only the score is known, `pattern` is the row of
    `own_breaks` that applies, else -1; won and lost then hold its middle.
    """

    won: Floats
    lost: Floats
    pattern: Ints
    own_breaks: BreakWinsTerms


def count_broken(results: Results) -> Broken:
    """Return how many games in each match were broken by a, by b, or by an unknown player.

    The breaker is known if one player broke throughout (break format a or b), and rack by rack if
    `racks`, the break format and `first_break` are given; for the first rack, `first_break` is
    enough. The number of racks that each player broke is known if the break format, `first_break`
    and a race that one of the players reached are given (see `evenbreak.ratings.who_broke`). Raises
    InputError if racks do not fit the score.
    """
    rows = len(results)
    won, lost = np.zeros((3, rows)), np.zeros((3, rows))
    form = np.zeros(rows, np.int8) if results.break_format is None else results.break_format
    first = np.zeros(rows, np.int8) if results.first_break is None else results.first_break
    for code, side in ((_A, 1), (_B, 2)):
        same = form == code
        won[side, same] = results.score_a[same]
        lost[side, same] = results.score_b[same]
    one_breaks = (form == _A) | (form == _B)
    stated = np.zeros(rows, dtype=bool)
    if results.racks is not None:
        stated = np.array([bool(text) for text in results.racks], dtype=bool)
        for row in np.flatnonzero(stated & ~one_breaks & ((form > 0) | (first > 0))):
            text = results.racks[row]
            for winner, breaker in zip(
                text, breakers(text, FORMATS[form[row]], int(first[row])), strict=True
            ):
                (won if winner == "a" else lost)[breaker, row] += 1
            won[0, row] = lost[0, row] = 0
    last = _last_winner(results)
    scores = (form > 0) & ~one_breaks & (first > 0) & ~stated & (last > 0)
    pattern, own_breaks = _by_score(results, np.flatnonzero(scores), form, first, last, won, lost)
    won[0] = results.score_a - won[1:].sum(axis=0)
    lost[0] = results.score_b - lost[1:].sum(axis=0)
    if (won[0] < 0).any() or (lost[0] < 0).any():
        raise InputError(
            "the racks add up to more games than the score. Fix the problems that "
            "find_problems lists."
        )
    return Broken(won, lost, pattern, own_breaks)


def breakers(racks: str, form: str, first: int) -> list[int]:
    """Return who broke each rack, given who won it: 1 for a, 2 for b, 0 if unknown.

    The break format is one of `FORMATS`; the first breaker is also 1, 2 or 0.

    >>> breakers("abb", "winner", 2), breakers("abb", "alternate", 1), breakers("abb", "", 1)
    ([2, 1, 2], [1, 2, 1], [1, 0, 0])
    """
    after = [1 if letter == "a" else 2 for letter in racks]  # under winner breaks
    match form:
        case "loser":
            after = [3 - winner for winner in after]
        case "alternate":
            second = 3 - first if first else 0
            after = [second if k % 2 == 0 else first for k in range(len(racks))]
        case "a" | "b":
            after = ["ab".index(form) + 1] * len(racks)
        case "":
            after = [0] * len(racks)
    return [first, *after][: len(racks)]


def _last_winner(results: Results) -> NDArray[np.int8]:
    """Return who won the last rack: the only one to reach the race; 0 if no race tells."""
    race_a, race_b = results.races
    raced = (race_a > 0) & (race_b > 0)
    a = raced & (results.score_a == race_a) & (results.score_b < race_b)
    b = raced & (results.score_b == race_b) & (results.score_a < race_a)
    return np.where(a, 1, np.where(b, 2, 0)).astype(np.int8)


def _by_score(
    results: Results,
    rows: Places,
    form: NDArray[np.int8],
    first: NDArray[np.int8],
    last: NDArray[np.int8],
    won: Floats,
    lost: Floats,
) -> tuple[Ints, BreakWinsTerms]:
    """Fill in the games of matches known only by score, and return the ways to divide them."""
    pattern = np.full(len(results), -1)
    keys = np.column_stack([form, first, last, results.score_a, results.score_b])[rows]
    distinct, place = np.unique(keys, axis=0, return_inverse=True)
    wins = [
        break_wins(FORMATS[f], breaker, (i, j), winner)
        for f, breaker, winner, i, j in distinct.tolist()
    ]
    middle = np.array([(wins_of.won[0] + wins_of.won[-1]) / 2 for wins_of in wins])[place]
    broke_a = np.array([wins_of.broke_a for wins_of in wins])[place]
    score_a, score_b = results.score_a[rows], results.score_b[rows]
    pattern[rows] = place
    won[1, rows], lost[1, rows] = middle, broke_a - middle
    won[2, rows], lost[2, rows] = score_a - middle, score_b - (broke_a - middle)
    return pattern, BreakWinsTerms.of(wins)
