"""One look at the file for all who follow it: pages, overlays and other programs.

While somebody follows, the file is looked at five times a second by what the system says of it, and
read only if that has changed. What is entered on a page of this process is seen at once.
"""

from __future__ import annotations

import asyncio
import logging
from collections import Counter, deque
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from pathlib import Path

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from evenbreak.errors import DataError
from evenbreak.files.store.changes import CLEARED, Row, rows_from
from evenbreak.web.night import mark_of

MOST = 1000
"""Entries that are kept for those who come back; who missed more reads everything anew."""

ALIVE = 20.0
"""Seconds after which something is sent in any case."""

_LOOK = 0.2  # seconds between two looks
_LOG = logging.getLogger(__name__)


class Watch:
    """What was entered last, and who waits for more.

    Parameters
    ----------
    path
        the file.
    most
        how many may follow it at once; an address may have half of that.
    """

    def __init__(self, path: Path, most: int) -> None:
        self.path = path
        self.most = most
        self.followers: Counter[str] = Counter()
        self.rows: deque[Row] = deque(maxlen=MOST)
        self.files = 0  # how many files have been under this name
        self.closing = False
        self._mark: tuple[int, int, int] | None = None
        self._task: asyncio.Task[None] | None = None
        self._reading = asyncio.Lock()
        self._woken, self._changed = asyncio.Event(), asyncio.Event()

    @property
    def last(self) -> int:
        """The id of the last entry; 0 if there is none."""
        return self.rows[-1].id if self.rows else 0

    @property
    def first(self) -> int:
        """The id after which all entries are known."""
        if not self.rows:
            return 0
        return self.rows[0].id - (self.rows[0].strand != CLEARED)

    def is_full(self, address: str) -> bool:
        """Return whether no more can follow from an address."""
        return self.followers.total() >= self.most or self.followers[address] >= self.most // 2

    def wake(self) -> None:
        """Look at once: something may have been entered."""
        self._woken.set()

    def close(self) -> None:
        """Let all who follow go."""
        self.closing = True
        self._changed.set()

    @asynccontextmanager
    async def following(self, address: str) -> AsyncIterator[None]:
        """Follow from an address, beginning with what there is now."""
        self.followers[address] += 1
        try:
            await self._look()
            if not self.closing and (self._task is None or self._task.done()):
                self._task = asyncio.create_task(self._look_on())
            yield
        finally:
            self.followers -= Counter([address])  # which forgets an address that has none
            if self._task and not self.followers:
                self._task.cancel()
                self._task = None

    async def after(self, seen: tuple[int, int]) -> tuple[int, int]:
        """Wait until there is something else, but no longer than `ALIVE`.

        Parameters
        ----------
        seen
            the file and the id of its last entry, as they were.
        """
        if self.now == seen and not self.closing:
            with suppress(TimeoutError):
                await asyncio.wait_for(self._changed.wait(), ALIVE)
        return self.now

    @property
    def now(self) -> tuple[int, int]:
        """Which file it is by now, and the id of its last entry."""
        return self.files, self.last

    async def _look_on(self) -> None:
        while self.followers and not self.closing:
            with suppress(TimeoutError):
                await asyncio.wait_for(self._woken.wait(), _LOOK)
            self._woken.clear()
            try:
                await self._look()
            except Exception as error:  # the next look may fare better
                _LOG.exception("the file could not be looked at", exc_info=error)

    async def _look(self) -> None:
        async with self._reading:
            mark, before = mark_of(self.path), self.now
            if mark == self._mark:
                return
            try:
                rows = await asyncio.to_thread(rows_from, self.path, self.last, MOST)
                if another := self.rows and rows[:1] != [self.rows[-1]]:  # or too much at once
                    rows = await asyncio.to_thread(rows_from, self.path, 0, MOST)
            except DataError:  # the next look may fare better; the pages say why
                return
            if another:
                self.files += 1
                self.rows.clear()
            for row in rows[bool(self.rows) :]:
                if row.strand == CLEARED:
                    self.rows.clear()
                self.rows.append(row)
            self._mark = mark
        if self.now != before:
            self._changed.set()
            self._changed = asyncio.Event()


class Waking:
    """Wakes those who follow as soon as something was entered by whoever is answered.

    Parameters
    ----------
    app
        what answers.
    watch
        whom to wake.
    """

    def __init__(self, app: ASGIApp, *, watch: Watch) -> None:
        self.app = app
        self.watch = watch

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, and wake before the answer is sent."""

        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start":
                self.watch.wake()
            await send(message)

        enters = scope.get("method") not in ("GET", "HEAD")
        await self.app(scope, receive, answer if enters else send)
