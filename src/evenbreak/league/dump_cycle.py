"""Long-run gain from losing on purpose, in cycles of dumping and playing in earnest.

A cycle of D dumped matches and E in earnest is one step of a chain of rating errors, C = K^E B^D,
and its stochastic limit is the rating error at which the player arrives each time.

If a match won is a point up and one lost a point down, the rating comes back to where it was
exactly if the player wins (D + E) / 2 of the E matches: so the share of wins follows from the
counts alone, for any chart. The chart only determines how low the rating must be for that; if it
has no race that one-sided, the rating falls forever.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.league.sandbag_pay import (
    MOST_HELD,
    at_the_end,
    dumped_matrix,
    earnest_matrix,
    start_law,
)

_FOLLOWED, _SQUARINGS = 256, 40
"""Number of steps taken before the chain is squared, and the largest number of squarings."""

_SETTLED = 1e-15
"""A change smaller than this is only rounding."""


class DumpCycle(NamedTuple):
    """Long-run behavior of a cycle.

    Parameters
    ----------
    dumped, earnest
        matches in a cycle: dumped, and played to win.
    rating_error
        mean rating minus skill when the matches that count start, in points.
    p_win
        P(a match that counts is won), averaged over a cycle.
    profit
        per match, including dumped ones, compared with a player who always plays to win (and wins
        half of the matches, if the system takes as much as it gives).
    held
        P(before a match that counts the rating is at the lower end of the ladder, or so close that
        another defeat would pass it); above a millionth, the end decides, not the chart.
    """

    dumped: int
    earnest: int
    rating_error: float
    p_win: float
    profit: float
    held: float


def dump_cycle(
    ladder: Ladder, dumped: int, earnest: int, *, stake: float = 10.0, dumped_stake: float = 1.0
) -> DumpCycle:
    """Return the profit of dumping matches and playing to win in turn, forever.

    Parameters
    ----------
    ladder
        the ladder; a rating does not fall below its lower end.
    dumped, earnest
        matches dumped and then played to win, again and again.
    stake, dumped_stake
        difference in value between winning and losing, for a match that counts and for a dumped
        one.

    Raises
    ------
    InputError
        if a number is out of range, or the ladder's player drifts.

    >>> from evenbreak.handicaps import Ladder
    >>> cycle = dump_cycle(Ladder("npl"), 5, 15)
    >>> round(cycle.p_win, 6), round(cycle.rating_error, 1), round(cycle.profit, 4)
    (0.666667, -15.2, 1.125)
    """
    down, many = whole(dumped, "dumped"), whole(earnest, "earnest", at_least=1)
    return _cycles(ladder, [(down, many)], stake, dumped_stake)[0]


def _limit(chain: Floats, start: Floats) -> Floats:
    """Return the stochastic limit of a column-stochastic chain, given the start."""
    # The chain may have a period; its average with standing still has none, and the same limit.
    # Single steps are cheap; where convergence is slow, squaring makes them longer.
    lazy, law = (chain + np.eye(chain.shape[0])) / 2.0, start
    for _ in range(_SQUARINGS):
        for _ in range(_FOLLOWED):
            before, law = law, lazy @ law
            if np.abs(law - before).max() < _SETTLED:
                return np.asarray(law / law.sum())
        lazy = lazy @ lazy
        lazy /= lazy.sum(axis=0)
    return np.asarray(law / law.sum())


def _cycles(
    ladder: Ladder, counts: Iterable[tuple[int, int]], stake: float, dumped_stake: float
) -> list[DumpCycle]:
    """Return the long run of each cycle, given as matches dumped and matches played in earnest."""
    step, dump = earnest_matrix(ladder), dumped_matrix(ladder)
    last, start = at_the_end(ladder), start_law(ladder, 0)
    errors, wins = np.asarray(ladder.errors, dtype=float), np.asarray(ladder.wins)
    honest = float(wins @ _limit(step, start))
    # Where a dumped match takes each error, and where no match does.
    falls, here = dump.argmax(axis=0), np.arange(errors.size)
    played, matches = np.eye(errors.size), 0
    cycles = []
    for down, many in sorted(counts, key=lambda count: count[1]):
        played, matches = np.linalg.matrix_power(step, many - matches) @ played, many
        low = here
        for _ in range(down):
            low = falls[low]
        begun = _limit(played[:, low], start)
        law = np.asarray(np.bincount(low, begun, errors.size), dtype=float)
        first, won, held = float(law @ errors), 0.0, 0.0
        for _ in range(many):
            won += float(wins @ law) / many
            held += float(law[last].sum()) / many
            law = step @ law
        gain = stake * many * (won - honest) - dumped_stake * down * honest
        cycles.append(DumpCycle(down, many, first, won, gain / (down + many), held))
    return cycles


def best_cycle(
    ladder: Ladder,
    lengths: Iterable[int] = (5, 10, 20),
    *,
    lowest: float | None = None,
    stake: float = 10.0,
    dumped_stake: float = 1.0,
) -> DumpCycle:
    """Return the cycle with the largest profit per match among the given lengths.

    Parameters
    ----------
    lengths
        the number of matches in a cycle, including dumped ones.
    lowest
        the lowest mean rating error, in points and below 0, at which the player is willing to start
        playing to win; None: any that the chart allows.
    stake, dumped_stake
        as of `dump_cycle`.

    Raises
    ------
    InputError
        if no length is given, or one is not a whole number above 0.

    >>> from evenbreak.handicaps import Ladder
    >>> best = best_cycle(Ladder("npl"), [10], lowest=-20)
    >>> best.dumped, best.earnest, round(best.p_win, 3)
    (3, 7, 0.714)
    """
    listed = [whole(length, "lengths", at_least=1) for length in lengths]
    if not listed:
        raise InputError(
            "lengths must not be empty. Give the number of matches in a cycle, such as 10."
        )
    counts = [(down, length - down) for length in set(listed) for down in range(length)]
    cycles = _cycles(ladder, counts, stake, dumped_stake)
    allowed = [
        cycle
        for cycle in cycles
        if not cycle.dumped
        or (cycle.held < MOST_HELD and (lowest is None or cycle.rating_error >= lowest))
    ]
    return max(allowed, key=lambda cycle: (cycle.profit, -cycle.dumped))
