"""A background thread for work that takes long."""

from __future__ import annotations

import asyncio
import ctypes
import queue
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any, TypeVar

Found = TypeVar("Found")
_LONG = 0.25  # seconds of work after which the pages have as long to themselves
_MOST_REST = 3.0  # seconds


class Beside:
    """A thread that does one calculation after another; it ends with the program.

    It is always the same thread, because each new thread would keep its own memory. After long work
    it rests just as long, because pages wait while the thread runs.
    """

    def __init__(self) -> None:
        self.waiting: list[str] = []  # who waits for it, or for what it works on
        self._asked: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._thread: threading.Thread | None = None

    async def run(self, work: Callable[[], Found], by: str = "") -> Found:
        """Return what a function returns, or raise what it raises; `by` is who is waiting."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._serve, daemon=True)
            self._thread.start()
        loop = asyncio.get_running_loop()
        done: asyncio.Future[Found] = loop.create_future()

        def settle(how: Callable[[Any], None], value: Any) -> None:
            if not done.done():
                how(value)

        def job() -> None:
            try:
                outcome: tuple[Callable[[Any], None], Any] = done.set_result, work()
            except Exception as error:
                outcome = done.set_exception, error
            with suppress(RuntimeError):  # the loop has ended meanwhile
                loop.call_soon_threadsafe(settle, *outcome)

        self._asked.put(job)
        self.waiting.append(by)
        try:
            return await done
        finally:
            self.waiting.remove(by)

    def _serve(self) -> None:
        while True:
            job = self._asked.get()
            begun = time.monotonic()
            with suppress(_StopError):
                job()
            if (took := time.monotonic() - begun) > _LONG:
                time.sleep(min(took, _MOST_REST))


class _StopError(BaseException):
    """Raised in a thread from outside, between two Python steps; nothing there expects it."""


class Limited:
    """Work limited to some seconds of processor time (clock time if threads have none).

    A TimeoutError ends it wherever it is, but only after the current step in C, such as solving one
    system of equations.

    >>> Limited(lambda: 7, 1.0)()
    7
    """

    def __init__(self, work: Callable[[], Found], seconds: float) -> None:
        self._work, self._seconds = work, seconds
        self._done, self._lock = threading.Event(), threading.Lock()

    def __call__(self) -> Any:
        """Return the work's result."""
        self._thread = threading.get_ident()
        self._begun = self._now()
        threading.Thread(target=self._watch, daemon=True).start()
        try:
            return self._work()
        except _StopError:
            raise TimeoutError from None
        finally:
            self._end()

    def _now(self) -> float:
        if hasattr(time, "pthread_getcpuclockid"):
            return time.clock_gettime(time.pthread_getcpuclockid(self._thread))
        return time.monotonic()

    def _watch(self) -> None:
        left = self._seconds
        while not self._done.wait(max(left, 0.1)):
            with self._lock:
                if self._done.is_set():
                    return
                left = self._seconds - (self._now() - self._begun)
                if left <= 0.0:  # again, if an import has swallowed the first
                    _raise_in(self._thread, _StopError)

    def _end(self) -> None:
        while not self._done.is_set():
            with suppress(_StopError), self._lock:
                self._done.set()
                _raise_in(self._thread, None)  # one that is on its way


def _raise_in(thread: int, error: type[BaseException] | None) -> None:
    """Raise an error in a thread at its next Python step; None cancels a pending error."""
    what = None if error is None else ctypes.py_object(error)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), what)


class Made:
    """Files that take long to make, made one at a time and once for each state they show."""

    def __init__(self) -> None:
        self._beside = Beside()
        self._made: dict[str, tuple[object, asyncio.Future[bytes]]] = {}

    async def file(self, name: str, of: object, make: Callable[[], bytes]) -> bytes:
        """Return a file, remaking it only if the object `of` is a different one."""
        made = self._made.get(name)
        if made is None or made[0] is not of:
            made = self._made[name] = of, asyncio.ensure_future(self._beside.run(make))
        try:
            return await asyncio.shield(made[1])  # others wait for it, if this reader goes
        except Exception:
            self._made.pop(name, None)
            raise
