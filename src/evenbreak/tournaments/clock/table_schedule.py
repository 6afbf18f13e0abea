"""Matches on tables: whenever a table is free, the waiting match that matters most begins.

What matters is the longest path: the minutes of a match and of all that must follow it. The
schedule of list scheduling is at most 2 - 1/tables times as long as the best one.

R. L. Graham (1969), "Bounds on multiprocessing timing anomalies", SIAM Journal on Applied
Mathematics 17.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.tournaments.clock.matches_of import Waiting


class Schedule(NamedTuple):
    """When matches begin and end, in each run; a match that is not needed takes no time."""

    start: Floats
    end: Floats


def longest_paths(waits: Waiting, minutes: Floats) -> Floats:
    """Return for each match the minutes until the end if tables were never short.

    Parameters
    ----------
    waits
        which match waits for which.
    minutes
        the minutes of each match.
    """
    path = minutes.copy()
    for k in range(len(minutes) - 1, -1, -1):
        follow = np.flatnonzero(waits.after[k])
        if follow.size:
            path[k] += path[follow].max()
    return path


def schedule(
    waits: Waiting,
    minutes: Floats,
    needed: Bools,
    turnover: Floats,
    tables: Floats,
    *,
    now: float = 0.0,
    priority: Floats | None = None,
    first: Sequence[int] = (),
    under_way: Sequence[int] = (),
) -> Schedule:
    """Return when each match begins and ends.

    Parameters
    ----------
    waits
        which match waits for which.
    minutes
        how long each match takes, shape (runs, matches).
    needed
        whether it is played, shape (runs, matches).
    turnover
        how long its table needs after it, shape (runs, matches).
    tables
        from when on each table is free, shape (runs, tables).
    now
        the earliest start.
    priority
        which match comes first, the largest number; None: by the longest remaining path.
    first
        the matches that begin first of all, by position and in this order, even if their rounds
        would still wait.
    under_way
        the matches that are on the first tables now, by position.
    """
    runs, count = minutes.shape
    row = np.arange(runs)
    taken = np.where(needed, minutes, 0.0)
    if priority is None:
        priority = longest_paths(waits, taken.mean(axis=0))
    rank = np.empty(count)
    # Of matches of the same priority the first of the list.
    order = np.lexsort((-np.arange(count), priority))
    rank[order] = np.arange(count, dtype=float)
    missing = np.tile(waits.after.sum(axis=0), (runs, 1))
    ready = np.full((runs, count), now)
    open_ = np.ones((runs, count), dtype=bool)
    free = np.maximum(tables, now)
    start, end = np.zeros((runs, count)), np.zeros((runs, count))

    def take(match: Ints, table: Ints, begin: Floats) -> None:
        played, over = needed[row, match], begin + taken[row, match]
        start[row, match], end[row, match] = begin, over
        free[row[played], table[played]] = (over + turnover[row, match])[played]
        open_[row, match] = False
        follow = waits.after[match]
        missing[:] -= follow
        np.maximum(ready, np.where(follow | waits.shared[match], over[:, None], 0.0), out=ready)

    for k, match in enumerate(under_way):
        take(np.full(runs, match), np.full(runs, k), np.full(runs, now))
    for match in first:  # the round does not matter, only players of a group who are busy
        busy = [other for other in under_way if waits.shared[other, match]]
        ready[:, match] = end[:, busy].max(axis=1, initial=now)
    for match in first:
        table = free.argmin(axis=1)
        moment = np.maximum(free[row, table], ready[:, match])
        each = np.full(runs, match)
        take(each, table, np.where(needed[:, match], moment, ready[:, match]))
    for _ in range(count - len(under_way) - len(first)):
        can = open_ & (missing == 0)
        table = free.argmin(axis=1)
        at = np.where(can, ready, np.inf)
        moment = np.maximum(free[row, table], at.min(axis=1))
        waiting = can & (ready <= moment[:, None])
        match = np.where(waiting, rank, -1.0).argmax(axis=1)
        take(match, table, np.where(needed[row, match], moment, ready[row, match]))
    return Schedule(start, end)
