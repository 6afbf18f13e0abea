"""Simulate many replicas of a season on any number of workers, always with the same result.

Replicas are divided into batches, and these into chunks, by the season and the number of replicas
alone. Each chunk has its own stream of random numbers, the child of the seed with the chunk's
number, and tallies are added in chunk order. So the result does not depend on which worker did the
work or how fast.

The replicas of a *batch* share the draw of opponents. Standard errors come from the differences
between batches, so there must be many of them; but numpy is fast with long arrays. So a *chunk*,
which is played at a time, has several batches if these are small.

Workers are given several chunks at a time, a parcel, and return the sum of their tallies: sums of
integers do not depend on how they are grouped.
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

from evenbreak.checks import seed_of, whole
from evenbreak.league.counting import ALONE
from evenbreak.league.many_seasons import run_chunk
from evenbreak.league.season import Season, Tally
from evenbreak.workers import in_order

if TYPE_CHECKING:
    import distributed

_CHUNK = 1 << 16
"""Players times replicas in a chunk, unless the league alone is larger."""

_BATCHES = 20
"""The smallest number of batches, if there are as many replicas: standard errors need them."""

_CELLS = 1 << 22
"""The most cells in the tables in which a chunk's batches count their matches."""

_MATCHES = 1 << 24
"""The most matches in a chunk with several batches, so that long seasons can use all workers."""

_TALLIES = 64
"""Tallies that are summed before they are added to the rest, since each sum copies its terms."""

_PARCEL = 1 << 24
"""Approximate number of matches assigned at a time: half a second's work."""

_PARCELS = 64
"""The fewest parcels, if there are as many chunks, so that no worker is idle for long."""


class Batching(NamedTuple):
    """How replicas are divided: `replicas` in a batch, `batches` in a chunk."""

    replicas: int
    batches: int


def batching_of(season: Season, replicas: int) -> Batching:
    """Return how to divide replicas so that a chunk fits into the processor's cache.

    There are 20 batches or more, if there are as many replicas.

    >>> from evenbreak.league import LeaguePlayers, Season
    >>> season = Season(LeaguePlayers.of([50] * 64), "npl")
    >>> batching_of(season, 100_000), batching_of(season, 2000)
    (Batching(replicas=1024, batches=1), Batching(replicas=100, batches=10))
    """
    at_once = 1 if len(season.players) > ALONE else _CHUNK // len(season.players)
    batch = max(1, min(at_once, replicas // _BATCHES))
    matches = batch * season.weeks * len(season.players) // 2
    most = at_once // batch, _CELLS // len(season.lookup.wins), _MATCHES // max(matches, 1)
    return Batching(batch, max(1, min(most)))


class _Work(NamedTuple):
    """The data that all workers share: the season, and the division of its replicas into chunks."""

    season: Season
    replicas: int
    batching: Batching
    seed: int

    def chunks(self) -> int:
        """Return the number of chunks: the full ones, plus one for leftover replicas."""
        full, left = divmod(self.replicas, self.batching.replicas)
        return -(-full // self.batching.batches) + (left > 0)

    def parcels(self) -> list[range]:
        """Return the chunk numbers in each parcel."""
        matches = (
            self.batching.replicas
            * self.batching.batches
            * self.season.weeks
            * len(self.season.players)
            // 2
        )
        many = max(1, min(_PARCEL // max(matches, 1), self.chunks() // _PARCELS))
        numbers = range(self.chunks())
        return [numbers[first : first + many] for first in numbers[::many]]

    def play(self, number: int) -> Tally:
        """Return the tally of one chunk."""
        size, many = self.batching
        full, left = divmod(self.replicas, size)
        batches = min(many, full - number * many)
        if batches <= 0:
            size, batches = left, 1
        # The child that `spawn` would give this number, without making the ones before it.
        child = np.random.SeedSequence(self.seed, spawn_key=(number,))
        return run_chunk(self.season, size, child, batches=batches)


def simulate(
    season: Season,
    *,
    replicas: int,
    seed: int | np.random.Generator,
    executor: Executor | distributed.Client | None = None,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> Tally:
    """Return the tally of many replicas of a season, the same for any number of workers.

    Parameters
    ----------
    replicas
        1 or more; 20 or more for good standard errors.
    seed
        a whole number from 0, which gives the same tally to the last bit, or a generator.
    executor
        any executor of `concurrent.futures`, or a `distributed.Client` for a dask cluster; None: as
        many processes as `jobs`.
    jobs
        the number of processes if there is no executor; 1: only this process.
    progress
        called with the replicas done and `replicas`, at the start and after each parcel.

    Raises
    ------
    InputError
        if a number is not whole or too small.
    WorkerError
        if a worker process ends before its work is done.

    Notes
    -----
    A script that uses two jobs or more must do so under ``if __name__ == "__main__":``, since
    each worker imports it. Memory grows with the replicas only by some kilobytes a batch.

    >>> from evenbreak.league import LeaguePlayers
    >>> season = Season(LeaguePlayers.of([92, 80, 71, 64]), "npl", weeks=12)
    >>> tally = simulate(season, replicas=1000, seed=1)
    >>> int(tally.replicas.sum()), tally.matches
    (1000, array([12000, 12000, 12000, 12000]))
    """
    replicas = whole(replicas, "replicas", at_least=1)
    seed, jobs = seed_of(seed), whole(jobs, "jobs", at_least=1)

    work = _Work(season, replicas, batching_of(season, replicas), seed)
    parcels = work.parcels()
    jobs = min(jobs, len(parcels))
    if progress is not None:
        progress(0, replicas)
    with closing(in_order(_play, work, parcels, executor=executor, jobs=jobs)) as tallies:
        return _sum(tallies if progress is None else _reported(tallies, replicas, progress))


def _play(work: _Work, numbers: range) -> Tally:
    return _sum(map(work.play, numbers))


def _reported(
    tallies: Iterable[Tally], replicas: int, progress: Callable[[int, int], None]
) -> Iterator[Tally]:
    """Yield tallies, and report the replicas done after each."""
    done = 0
    for tally in tallies:
        yield tally
        done += int(tally.replicas.sum())
        progress(done, replicas)


def _sum(tallies: Iterator[Tally]) -> Tally:
    """Add tallies in order, several at a time; the grouping does not change the sum."""
    total = next(tallies)
    for first in tallies:
        total += reduce(add, islice(tallies, _TALLIES - 1), first)
    return total
