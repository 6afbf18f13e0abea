"""Many replicas of a season, on as many workers as there are, with the same result for any number.

Replicas are parted into batches, and these into chunks, by the season and the number of replicas
alone. Each chunk has its own stream of random numbers, the child of the seed that bears its
number, and tallies are added in the order of the chunks. So who worked, and how fast, leaves no
trace in the result.

Chunks are given out by the parcel, whose tallies are added where they are made: sums of whole
numbers do not depend on how they are bracketed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from contextlib import closing
from functools import reduce
from itertools import islice
from operator import add
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from evenbreak.checks import whole
from evenbreak.league.batches import Batching, batching_of
from evenbreak.league.many_seasons import run_chunk
from evenbreak.league.season import Season
from evenbreak.league.tally import Tally
from evenbreak.league.workers import in_order

if TYPE_CHECKING:
    import distributed

_BATCH = 64
"""Tallies that are added up before they are added to the rest: each sum copies what it has."""


_PARCEL = 1 << 24
"""Matches, more or less, that are given out at a time: half a second's work, for which it pays to
send a tally."""

_PARCELS = 64
"""Parcels that there are at least where there are as many chunks: no worker is idle for long."""


class _Work(NamedTuple):
    """What all workers know: the season, and how its replicas are parted into chunks."""

    season: Season
    replicas: int
    parts: Batching
    seed: int

    def chunks(self) -> int:
        """Return how many chunks there are: the full ones, and one of the replicas left over."""
        full, left = divmod(self.replicas, self.parts.replicas)
        return -(-full // self.parts.batches) + (left > 0)

    def parcels(self) -> list[range]:
        """Return the numbers of the chunks of each parcel."""
        matches = (
            self.parts.replicas
            * self.parts.batches
            * self.season.weeks
            * len(self.season.players)
            // 2
        )
        many = max(1, min(_PARCEL // max(matches, 1), self.chunks() // _PARCELS))
        numbers = range(self.chunks())
        return [numbers[first : first + many] for first in numbers[::many]]

    def play(self, number: int) -> Tally:
        """Return the tally of one chunk."""
        size, many = self.parts
        full, left = divmod(self.replicas, size)
        batches = min(many, full - number * many)
        if batches <= 0:
            size, batches = left, 1
        # The child that `spawn` gives as the one of this number, without its elder siblings.
        child = np.random.SeedSequence(self.seed, spawn_key=(number,))
        return run_chunk(self.season, size, child, batches=batches)


def simulate(
    season: Season,
    *,
    replicas: int,
    seed: int,
    executor: Executor | distributed.Client | None = None,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> Tally:
    """Return the tally of many replicas of a season, the same for any workers.

    Parameters
    ----------
    season
        what is played.
    replicas
        how many times, 1 or more. Standard errors want twenty or more.
    seed
        a whole number from 0; the same one gives the same tally to the last bit.
    executor
        who works: any executor of `concurrent.futures`, or a `distributed.Client` for a dask
        cluster; None: as many processes as `jobs` says.
    jobs
        number of processes where there is no executor; 1 works in this one.
    progress
        called with the replicas done and `replicas` as the work begins, and after each parcel.

    Raises
    ------
    InputError
        if a number is not whole or too small.
    WorkerError
        if a worker process ends before its work is done.

    Notes
    -----
    A script that asks for two jobs or more does so under ``if __name__ == "__main__":``, since
    each worker imports it. Memory does not grow with the replicas but for some kilobytes a batch.

    >>> from evenbreak.league import LeaguePlayers
    >>> season = Season(LeaguePlayers.of([92, 80, 71, 64]), "npl", weeks=12)
    >>> tally = simulate(season, replicas=1000, seed=1)
    >>> int(tally.replicas.sum()), tally.matches
    (1000, array([12000, 12000, 12000, 12000]))
    """
    replicas = whole(replicas, "replicas", at_least=1)
    seed, jobs = whole(seed, "seed"), whole(jobs, "jobs", at_least=1)
    # Made once and sent: computed by each worker, its last bits might be those of another machine.
    _ = season.lookup
    work = _Work(season, replicas, batching_of(season, replicas), seed)
    parcels = work.parcels()
    jobs = min(jobs, len(parcels))
    tell = progress or _tell_nobody
    tell(0, replicas)
    with closing(in_order(_play, work, parcels, executor=executor, jobs=jobs)) as tallies:
        return _sum(_told(tallies, replicas, tell))


def _play(work: _Work, numbers: range) -> Tally:
    return _sum(map(work.play, numbers))


def _told(
    tallies: Iterable[Tally], replicas: int, tell: Callable[[int, int], None]
) -> Iterator[Tally]:
    done = 0
    for tally in tallies:
        yield tally
        done += int(tally.replicas.sum())
        tell(done, replicas)


def _tell_nobody(done: int, replicas: int) -> None:
    pass


def _sum(tallies: Iterator[Tally]) -> Tally:
    """Add tallies up in their order, some at a time: how sums are bracketed changes nothing."""
    total = next(tallies)
    for first in tallies:
        total += reduce(add, islice(tallies, _BATCH - 1), first)
    return total
