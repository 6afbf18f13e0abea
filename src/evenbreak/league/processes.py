"""Worker processes of our own, which keep what all pieces share and end with their parent.

They are spawned, not forked: a fork copies locks that other threads hold (numpy's, dask's), and
is not to be had everywhere. So each worker is sent what is shared once, as it starts.

Ctrl-C on a terminal reaches the workers too. They leave it to the parent, which kills them: even
one that is still starting, which would complain at length that its parent has gone. A parent that
is killed itself closes its end of a pipe, and workers whose pipe is closed end, so that none
outlives it.

In the parent an interrupt waits while it is inside the pool: in the midst of `concurrent.futures`
it might leave a lock held, and then who waits for that lock would wait for ever.
"""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from multiprocessing.connection import Connection
from threading import Lock, Thread, current_thread, main_thread
from typing import Any

_kept: tuple[Callable[[Any, Any], Any], Any]
"""What a worker works with."""

_at_work = False
_door = Lock()
"""Held to leave work, and to end a worker that is at it."""

_GRACE = 3.0
"""Seconds in which an idle worker whose parent lets go hears of it as usual."""


@contextmanager
def worker_processes(
    jobs: int, task: Callable[[Any, Any], Any], shared: Any
) -> Iterator[Callable[[Any], Future[Any]]]:
    """Start worker processes, yield how to give them ``task(shared, piece)``, and end them.

    >>> with worker_processes(2, pow, 2) as submit:
    ...     [future.result() for future in map(submit, [3, 4])]
    [8, 16]
    """
    context = get_context("spawn")
    listen, hold = context.Pipe(duplex=False)
    with listen, hold:
        pool = ProcessPoolExecutor(
            jobs, mp_context=context, initializer=_begin, initargs=(listen, task, shared)
        )

        def submit(piece: Any) -> Future[Any]:
            with interrupts_wait(), _interrupts_blocked():  # a process starts as there is work
                return pool.submit(_do, piece)

        try:
            yield submit
        except BaseException:
            with interrupts_wait():
                _kill(pool)
            raise
        finally:
            with interrupts_wait():
                pool.shutdown(cancel_futures=True)


@contextmanager
def interrupts_wait() -> Iterator[None]:
    """Let an interrupt (Ctrl-C) wait until the block is done; other threads never get one."""
    before = signal.getsignal(signal.SIGINT)
    if current_thread() is not main_thread() or not callable(before):
        yield
        return
    came = False

    def note(*_: object) -> None:
        nonlocal came
        came = True

    # A mask would not do: the signal may be delivered to any thread, such as those of a BLAS.
    signal.signal(signal.SIGINT, note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if came:
            signal.raise_signal(signal.SIGINT)


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Block interrupts for the processes that start meanwhile: they never take one."""
    if not hasattr(signal, "pthread_sigmask"):  # not on Windows
        yield
        return
    from multiprocessing.resource_tracker import ensure_running

    ensure_running()  # its start would let interrupts through
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _kill(pool: ProcessPoolExecutor) -> None:
    """End the workers in the middle of whatever they do, so that the pool finds itself broken."""
    results = getattr(pool, "_result_queue", None)
    if results is not None:
        # Of a result that is cut off the pool would wait for the rest, as long as anybody might
        # still write it.
        results._writer.close()  # noqa: SLF001
    # A public way to do so comes with Python 3.14.
    for process in [*(getattr(pool, "_processes", None) or {}).values()]:
        process.kill()


def _begin(listen: Connection, task: Callable[[Any, Any], Any], shared: Any) -> None:
    """In a worker: keep what it works with, and end as soon as the parent lets go."""
    global _kept
    _kept = (task, shared)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, args=(listen,), daemon=True).start()


def _end_with_parent(listen: Connection) -> None:
    listen.poll(None)
    with _door:
        if _at_work:
            os._exit(1)
    time.sleep(_GRACE)
    os._exit(1)


def _do(piece: Any) -> Any:
    global _at_work
    task, shared = _kept
    _at_work = True
    try:
        return task(shared, piece)
    finally:
        with _door:
            _at_work = False
