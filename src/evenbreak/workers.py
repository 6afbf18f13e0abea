"""Do work in pieces in this process, in several, or on a cluster, always with the same results.

Results come back in the order of the pieces, so they do not depend on how many workers there are
or how fast they are. Only a few pieces are under way at a time, so memory does not grow with
their number.

The processes come from `concurrent.futures`, with two additions. Worker processes end when their
parent is killed, whereas those in a bare pool would wait for work forever. And Ctrl-C, which a
terminal sends to all of a program's processes, ends the workers silently instead of with a
traceback each.
"""

from __future__ import annotations

import os
import signal
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial
from itertools import count, islice
from multiprocessing import get_context, parent_process
from threading import Thread
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from evenbreak.checks import whole
from evenbreak.errors import WorkerError

if TYPE_CHECKING:
    import distributed

_SAFE_PATH = "PYTHONSAFEPATH"

Shared = TypeVar("Shared")
Piece = TypeVar("Piece")
Result = TypeVar("Result")

_AHEAD = 2
"""Pieces assigned to each worker: the one in progress and the next one."""


def in_order(
    task: Callable[[Shared, Piece], Result],
    shared: Shared,
    pieces: Iterable[Piece],
    *,
    executor: Executor | distributed.Client | None = None,
    jobs: int = 1,
) -> Generator[Result]:
    """Yield ``task(shared, piece)`` for each piece, in the order of the pieces.

    Parameters
    ----------
    task
        a function that a worker can import by its name.
    shared
        data that every piece needs; sent once to each built-in worker process and to a cluster, and
        with each piece to any other executor.
    pieces
        the pieces, an iterable that is consumed only as needed.
    executor
        an executor of `concurrent.futures`, or a `distributed.Client`; None: as many processes as
        `jobs` says.
    jobs
        the number of processes if there is no executor; 1: only this process.

    Raises
    ------
    InputError
        if `jobs` is not a whole number from 1.
    WorkerError
        if a worker process ends before its work is done.

    >>> list(in_order(pow, 2, range(5)))
    [1, 2, 4, 8, 16]
    """
    jobs = whole(jobs, "jobs", at_least=1)
    if executor is None and jobs == 1:
        yield from map(partial(task, shared), pieces)
        return
    with _broken_is_said():
        if executor is None:
            with _processes(jobs, task, shared) as submit:
                yield from _results(submit, pieces, jobs)
        elif isinstance(executor, Executor):
            give, workers = executor.submit, os.cpu_count() or 1
            yield from _results(lambda piece: give(task, shared, piece), pieces, workers)
        else:
            client: Any = executor
            workers = sum(client.nthreads().values())
            yield from _results(_on_cluster(client, task, shared), pieces, workers)


Share: TypeAlias = Callable[[Callable[[Any, Any], Any], Any, Iterable[Any]], Iterator[Any]]
"""Runs several tasks like `in_order`, with the same workers: task, shared, pieces."""


@contextmanager
def crew(
    *, executor: Executor | distributed.Client | None = None, jobs: int = 1
) -> Iterator[Share | None]:
    """Yield a function that runs several tasks in turn with the workers of `in_order`.

    Built-in worker processes are kept for all of them. None: there is only this process.

    >>> with crew() as share:
    ...     share is None
    True
    """
    jobs = whole(jobs, "jobs", at_least=1)
    if executor is not None:
        yield partial(in_order, executor=executor)
    elif jobs == 1:
        yield None
    else:
        with _broken_is_said(), _processes(jobs, _do_any, None) as submit:

            def share(task: Any, shared: Any, pieces: Iterable[Any]) -> Iterator[Any]:
                return _results(submit, ((task, shared, piece) for piece in pieces), jobs)

            yield share


def _do_any(_: None, piece: tuple[Callable[[Any, Any], Any], Any, Any]) -> Any:
    task, shared, own = piece
    return task(shared, own)


@contextmanager
def _broken_is_said() -> Iterator[None]:
    """Return the error that explains why a pool of processes is broken."""
    try:
        yield
    except BrokenExecutor as error:
        raise WorkerError(
            "a worker process stopped before its work was done: either it was killed (perhaps "
            "memory ran out), or it couldn't start (a script that uses workers must do so "
            "under `if __name__ == '__main__':`). Use fewer jobs."
        ) from error


def _results(
    submit: Callable[[Piece], Any], pieces: Iterable[Piece], workers: int
) -> Generator[Any]:
    rest = iter(pieces)
    under_way = deque(map(submit, islice(rest, _AHEAD * workers)))
    while under_way:
        result = under_way.popleft().result()
        under_way.extend(map(submit, islice(rest, 1)))
        yield result


def _on_cluster(
    client: distributed.Client, task: Callable[[Shared, Piece], Result], shared: Shared
) -> Callable[[Piece], Any]:
    """Return a function that submits pieces to a cluster, which keeps their shared data.

    The data is kept as the result of a task, which dask repeats if the worker that held it is lost.
    """
    import dask

    with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 PiB"}):
        held = client.submit(_same, shared, pure=False)
    number = count()
    # Without priorities dask may leave the first piece, which all others wait for, to the last.
    return lambda piece: client.submit(task, held, piece, pure=False, priority=-next(number))


def _same(value: Shared) -> Shared:
    return value


_kept: tuple[Callable[[Any, Any], Any], Any]
"""In a worker process: the task, and the data that its pieces share."""


@contextmanager
def _processes(
    jobs: int, task: Callable[[Shared, Piece], Result], shared: Shared
) -> Iterator[Callable[[Piece], Any]]:
    """Yield a function that submits pieces to built-in worker processes, which end with the block.

    They are spawned: a fork copies the locks that other threads hold, and Windows has none.
    """
    with _safe_path():  # a process that keeps track of the others is started
        pool = ProcessPoolExecutor(
            jobs, get_context("spawn"), initializer=_begin, initargs=(task, shared)
        )

    def submit(piece: Piece) -> Any:
        with _interrupts_blocked(), _safe_path():  # a process is started when there is work for it
            return pool.submit(_do, piece)

    try:
        yield submit
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def _safe_path() -> Iterator[None]:
    """Keep processes that start in the block from importing modules from the working folder.

    A data file there, or someone else's file, may have a module's name. Once such a process runs,
    it looks for modules where this one does.
    """
    before = os.environ.get(_SAFE_PATH)
    os.environ[_SAFE_PATH] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ[_SAFE_PATH]
        else:
            os.environ[_SAFE_PATH] = before


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Delay Ctrl-C until the block is done, and longer for processes that start in it."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _begin(task: Callable[[Any, Any], Any], shared: Any) -> None:
    """In a new worker process: keep the task, ignore Ctrl-C, and end when the parent does."""
    global _kept
    _kept = (task, shared)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _do(piece: Any) -> Any:
    task, shared = _kept
    # Ctrl-C ends a worker at once, except while it sends a result: the pool would wait for the
    # rest of it forever.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        return task(shared, piece)
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
