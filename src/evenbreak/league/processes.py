"""Worker processes of our own, which keep what all pieces share and end with their parent.

They are spawned, not forked: a fork copies locks that other threads hold (numpy's, dask's), and
is not to be had everywhere. So each worker is sent what is shared once, as it starts.

Ctrl-C on a terminal reaches the workers too. They leave it to the parent, which closes its end of
a pipe; a worker whose pipe is closed ends, in the middle of a piece if need be, but not in the
middle of a result: the parent would wait for the rest of it. The pipe closes also where the parent
is killed, so that no worker outlives it.
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
from threading import Lock, Thread
from typing import Any

__all__ = ["worker_processes"]

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
            with _interrupts_held():  # a process starts as there is work for it
                return pool.submit(_do, piece)

        try:
            yield submit
        except BaseException:
            hold.close()
            raise
        finally:
            pool.shutdown(cancel_futures=True)


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """Let an interrupt wait: a process that starts meanwhile never takes one."""
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
