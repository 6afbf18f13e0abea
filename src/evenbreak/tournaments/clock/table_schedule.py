"""Matches on tables: whenever a table is free, the most important waiting match starts.

Importance means the longest path: the minutes for a match and everything that must follow it. List
scheduling gives a schedule at most 2 - 1/tables times as long as the best one.

R. L. Graham (1969), "Bounds on multiprocessing timing anomalies", SIAM Journal on Applied
Mathematics 17.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.tournaments.brackets.bracket import Bracket, Match, Source

_AT_ONCE = 500  # runs: their arrays then stay in the processor's cache


class Schedule(NamedTuple):
    """When matches start and end, in each run; a match that is not needed takes no time."""

    start: Floats
    end: Floats


def longest_paths(waits: Waiting, minutes: Floats) -> Floats:
    """Return each match's minutes until the end if there were always a free table."""
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
    """Return when each match starts and ends.

    Arrays have shape (runs, matches), but `tables`, when each becomes free, has shape (runs,
    tables). `now` is the earliest start. Among matches that can start, the one with the largest
    `priority` goes first (None: the longest remaining path); but those in `first`, by position,
    start before all others, even if their rounds would still have to wait. Matches `under_way` are
    on the first tables now.
    """
    taken = np.where(needed, minutes, 0.0)
    if priority is None:
        priority = longest_paths(waits, taken.mean(axis=0))
    count = minutes.shape[1]
    rank = np.empty(count)
    # Of matches of the same priority the first of the list.
    order = np.lexsort((-np.arange(count), priority))
    rank[order] = np.arange(count, dtype=float)
    free = np.maximum(tables, now)
    found = Schedule(np.zeros(taken.shape), np.zeros(taken.shape))
    for begin in range(0, len(taken), _AT_ONCE):
        rows = slice(begin, begin + _AT_ONCE)
        some = Schedule(found.start[rows], found.end[rows])
        of_some = taken[rows], needed[rows], turnover[rows], free[rows]
        _fill(some, waits, of_some, now, rank, first, under_way)
    return found


def _fill(
    found: Schedule,
    waits: Waiting,
    of_some: tuple[Floats, Bools, Floats, Floats],
    now: float,
    rank: Floats,
    first: Sequence[int],
    under_way: Sequence[int],
) -> None:
    """Schedule some runs, given minutes, needed matches, turnover, and when tables are free."""
    start, end = found
    taken, needed, turnover, free = of_some
    runs, count = taken.shape
    row = np.arange(runs)
    missing = np.tile(waits.after.sum(axis=0), (runs, 1))
    ready = np.full((runs, count), now)
    open_ = np.ones((runs, count), dtype=bool)

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


# What a schedule needs to know of a bracket: which match waits for which others.


@dataclass(frozen=True, eq=False)
class Waiting:
    """Which matches wait for which.

    after[i, j]: match j can't start before match i is over; shared[i, j]: both have the same player
    in a group, so they can't overlap.
    """

    names: tuple[str, ...]
    after: Bools
    shared: Bools


def waiting(bracket: Bracket, names: Collection[str], *, for_rounds: bool) -> Waiting:
    """Return which of some unfinished matches wait for which.

    With `for_rounds`, a round starts only when all rounds that feed it, and the round before it in
    a group, are over.
    """
    matches = [match for match in bracket.matches if match.name in names]
    place = {match.name: k for k, match in enumerate(matches)}
    groups = {group.name: group for group in bracket.groups}
    rounds: dict[tuple[str, int], list[str]] = {}
    for match in bracket.matches:
        rounds.setdefault((match.side, match.round), []).append(match.name)
    after = np.zeros((len(matches), len(matches)), dtype=bool)
    shared = np.zeros_like(after)
    for match in matches:
        feeds: set[str] = set()
        for slot in match.slots:
            if not isinstance(slot, Source):
                continue
            if bracket.runners_up and slot.match == bracket.runners_up.name:
                feeds |= {name for group in bracket.groups for name in group.matches}
            else:
                feeds |= set(groups[slot.match].matches if slot.match in groups else [slot.match])
        if for_rounds:
            feeds |= _rounds_before(bracket, match, feeds, rounds)
        for name in feeds & set(place):
            after[place[name], place[match.name]] = True
    for group in bracket.groups:
        seats = [(name, set(pair)) for name, pair in zip(group.matches, group.pairs, strict=True)]
        for one, players in seats:
            for other, others in seats:
                if one != other and players & others and one in place and other in place:
                    shared[place[one], place[other]] = True
    return Waiting(tuple(place), after, shared)


def _rounds_before(
    bracket: Bracket, match: Match, feeds: set[str], rounds: dict[tuple[str, int], list[str]]
) -> set[str]:
    before: set[str] = set()
    for name in feeds:
        feeding = bracket.by_name[name]
        before |= set(rounds[feeding.side, feeding.round])
    if any(match.name in group.matches for group in bracket.groups):
        before |= set(rounds.get((match.side, match.round - 1), ()))
    return before
