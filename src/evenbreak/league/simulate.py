"""Many replicas of a season, on as many workers as there are, with the same result for any number.

Replicas are parted into chunks by the season and the number of replicas alone; each chunk has its
own stream of random numbers, the child of the seed that bears its number; and tallies are added in
the order of the chunks. So who worked, and how fast, leaves no trace in the result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from contextlib import closing
from functools import reduce
from itertools import islice
from operator import add
from typing import NamedTuple

import numpy as np

from evenbreak.checks import whole
from evenbreak.league.executors import in_order
from evenbreak.league.play import chunk_replicas, run_chunk
from evenbreak.league.season import Season
from evenbreak.league.tally import Tally

__all__ = ["simulate"]

_BATCH = 64
"""Tallies that are added up before they are added to the rest: each sum copies what it has."""


class _Chunk(NamedTuple):
    replicas: int
    seed: int
    number: int


def simulate(
    season: Season,
    *,
    replicas: int,
    seed: int,
    executor: Executor | None = None,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> Tally:
    """Return the tally of many replicas of a season, the same for any workers.

    Parameters
    ----------
    season
        what is played.
    replicas
        how many times, 1 or more. Standard errors want ten or more.
    seed
        a whole number from 0; the same one gives the same tally to the last bit.
    executor
        who works: a `DaskExecutor` for a cluster, or any executor of `concurrent.futures`; None
        for as many processes as `jobs` says.
    jobs
        number of processes where there is no executor; 1 works in this one.
    progress
        called with the replicas done and `replicas` as the work begins, and after each chunk.

    Raises
    ------
    InputError
        if a number is not whole or too small.
    WorkerError
        if a worker process ends before its work is done, or the cluster is gone.

    Notes
    -----
    A script that asks for two jobs or more does so under ``if __name__ == "__main__":``, since
    each worker imports it. Memory does not grow with the replicas but for some kilobytes a chunk.

    >>> from evenbreak.league import LeaguePlayers
    >>> season = Season(LeaguePlayers.of([92, 80, 71, 64]), "npl", weeks=12)
    >>> tally = simulate(season, replicas=1000, seed=1)
    >>> int(tally.replicas.sum()), tally.matches
    (1000, array([12000, 12000, 12000, 12000]))
    """
    replicas = whole(replicas, "replicas", at_least=1)
    seed, jobs = whole(seed, "seed"), whole(jobs, "jobs", at_least=1)
    size = chunk_replicas(season, replicas)
    # Made once and sent: computed by each worker, its last bits might be those of another machine.
    _ = season.lookup
    tell = progress or _tell_nobody
    tell(0, replicas)
    chunks = _chunks(replicas, size, seed)
    jobs = min(jobs, -(-replicas // size))  # no more processes than chunks
    with closing(in_order(_play, season, chunks, executor=executor, jobs=jobs)) as tallies:
        return _sum(_told(tallies, replicas, tell))


def _chunks(replicas: int, size: int, seed: int) -> Iterator[_Chunk]:
    for number, done in enumerate(range(0, replicas, size)):
        yield _Chunk(min(size, replicas - done), seed, number)


def _play(season: Season, chunk: _Chunk) -> Tally:
    # The child that `spawn` gives as the one of this number, without its elder siblings.
    return run_chunk(
        season, chunk.replicas, np.random.SeedSequence(chunk.seed, spawn_key=(chunk.number,))
    )


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
