"""Work in pieces, done by whoever does it: this process, others, or a cluster.

A task is a plain function of what all pieces share and of one piece. It is told nothing of who
else works, and results come back in the order of the pieces, so what is made of them does not
depend on the number of workers, on their speed, or on what kind they are. Only a few pieces are
given out at a time: memory does not grow with their number.
"""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, wait
from contextlib import closing, contextmanager
from functools import partial
from itertools import islice
from typing import TypeVar

from evenbreak.checks import whole
from evenbreak.errors import WorkerError
from evenbreak.league.on_dask import DaskExecutor
from evenbreak.league.processes import interrupts_wait, worker_processes

Shared = TypeVar("Shared")
Piece = TypeVar("Piece")
Result = TypeVar("Result")

_AHEAD = 2
"""Pieces given out for each worker: one that it does, and one that it finds when it is done."""

_LOOK_EVERY = 2.0
"""Seconds between two looks whether a cluster is still there."""

_SLICE = 0.2
"""Seconds that an interrupt waits at most."""

Submit = Callable[[Piece], "Future[Result]"]


def in_order(
    task: Callable[[Shared, Piece], Result],
    shared: Shared,
    pieces: Iterable[Piece],
    *,
    executor: Executor | None = None,
    jobs: int = 1,
) -> Generator[Result]:
    """Yield ``task(shared, piece)`` for each piece, in the order of the pieces.

    Parameters
    ----------
    task
        a function that a worker can import by its name.
    shared
        what every piece needs; sent to each of our own processes and to a cluster once.
    pieces
        what the task is done with, one after the other; taken only as they are needed.
    executor
        who works; None for as many processes as `jobs` says.
    jobs
        number of processes where there is no executor; 1 works in this one.

    Raises
    ------
    InputError
        if `jobs` is not a whole number from 1.
    WorkerError
        if a worker process ends before its work is done, or the cluster is gone.

    Notes
    -----
    An iterator that is closed, or that an interrupt ends, withdraws what was given out: our own
    processes end at once, others when they are done with the pieces that they have begun.

    >>> list(in_order(pow, 2, range(5)))
    [1, 2, 4, 8, 16]
    """
    jobs = whole(jobs, "jobs", at_least=1)
    if executor is None and jobs == 1:
        yield from map(partial(task, shared), pieces)
        return
    with _broken_as_error(), _workers(task, shared, executor, jobs) as (submit, workers):
        look = executor.look if isinstance(executor, DaskExecutor) else _no_look
        given = _results(submit, pieces, _AHEAD * workers, look, withdraw=executor is not None)
        with closing(given):
            yield from given


@contextmanager
def _workers(
    task: Callable[[Shared, Piece], Result], shared: Shared, executor: Executor | None, jobs: int
) -> Iterator[tuple[Submit[Piece, Result], int]]:
    """Yield how to give out a piece, and the number of workers."""
    match executor:
        case None:
            with worker_processes(jobs, task, shared) as submit:
                yield submit, jobs
        case DaskExecutor():
            with executor.losses_told():
                held = executor.share(shared)
                yield lambda piece: executor.submit(task, held, piece), executor.workers
        case _:
            at_once = max(jobs, os.cpu_count() or 1)
            yield lambda piece: executor.submit(task, shared, piece), at_once


@contextmanager
def _broken_as_error() -> Iterator[None]:
    try:
        yield
    except BrokenExecutor as error:
        raise WorkerError(
            "a worker process ended before its work was done: it was killed (did memory run out?), "
            "or it could not start (a script that asks for workers must do so under "
            "`if __name__ == '__main__':`); use fewer jobs, or a dask cluster, which does the work "
            "of a lost worker again"
        ) from error


def _results(
    submit: Submit[Piece, Result],
    pieces: Iterable[Piece],
    window: int,
    look: Callable[[], None],
    *,
    withdraw: bool,
) -> Generator[Result]:
    """Yield the results in the order of the pieces, at most `window` of them under way.

    At the end those that are under way are withdrawn, unless the workers end too: a pool that is
    broken stumbles over what was withdrawn before.
    """
    rest = iter(pieces)
    under_way: deque[Future[Result]] = deque()
    try:
        while True:
            under_way.extend(map(submit, islice(rest, window - len(under_way))))
            if not under_way:
                return
            result = _wait(under_way[0], look)
            under_way.popleft()  # not before: an interrupt must find it here
            yield result
    finally:
        for future in under_way if withdraw else ():
            future.cancel()


def _wait(future: Future[Result], look: Callable[[], None]) -> Result:
    looked = time.monotonic()
    while True:
        with interrupts_wait():
            if wait([future], _SLICE).done:
                return future.result()
        if time.monotonic() - looked > _LOOK_EVERY:
            looked = time.monotonic()
            look()


def _no_look() -> None:
    pass
