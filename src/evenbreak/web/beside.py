"""A thread beside the pages, for what takes long."""

from __future__ import annotations

import asyncio
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
    """One thread that works things out, one after another; the end of the program ends it too.

    It is always the same thread: each new one would keep memory of its own. After long work it
    rests as long, for a page waits whenever it is the thread's turn.
    """

    def __init__(self) -> None:
        self._asked: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._thread: threading.Thread | None = None

    async def run(self, work: Callable[[], Found]) -> Found:
        """Return what a function returns, or raise what it raises."""
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
        return await done

    def _serve(self) -> None:
        while True:
            job = self._asked.get()
            begun = time.monotonic()
            job()
            if (took := time.monotonic() - begun) > _LONG:
                time.sleep(min(took, _MOST_REST))


class Made:
    """Files that take long to make, each made once of what it shows, one after another."""

    def __init__(self) -> None:
        self._beside = Beside()
        self._made: dict[str, tuple[object, asyncio.Future[bytes]]] = {}

    async def file(self, name: str, of: object, make: Callable[[], bytes]) -> bytes:
        """Return a file, which is made again only when it is to show something else.

        Parameters
        ----------
        name
            of the file.
        of
            what it shows; another object when that has changed.
        make
            makes it.
        """
        made = self._made.get(name)
        if made is None or made[0] is not of:
            made = self._made[name] = of, asyncio.ensure_future(self._beside.run(make))
        try:
            return await asyncio.shield(made[1])  # others wait for it, if this reader goes
        except Exception:
            self._made.pop(name, None)
            raise
