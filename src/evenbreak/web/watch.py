"""One check of the file for everyone who follows it: pages, overlays and other programs.

While someone is following, the file's metadata is checked five times a second, and the file is read
only if that has changed. Entries made on this process's own pages are seen at once.
"""

from __future__ import annotations

import asyncio
import logging
from collections import Counter, deque
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager, suppress
from itertools import islice
from pathlib import Path

from starlette.requests import Request
from starlette.responses import Response, StreamingResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from evenbreak.errors import DataError
from evenbreak.files.store.changes import CLEARED, Row, rows_from
from evenbreak.web.night import mark_of
from evenbreak.web.sessions import address_of

MOST = 1000
"""How many entries are kept for clients that reconnect; if more were missed, all is read anew."""

ALIVE = 20.0
"""How many seconds until something is sent in any case."""

_LOOK = 0.2  # seconds between two looks
_LOG = logging.getLogger(__name__)


class Watch:
    """The last entry and its followers; one address may have half of the `most` followers."""

    def __init__(self, path: Path, most: int) -> None:
        self.path = path
        self.most = most
        self.followers: Counter[str] = Counter()
        self.rows: deque[Row] = deque(maxlen=MOST)
        self.closing = False
        self._mark: tuple[int, int, int] | None = None
        self._task: asyncio.Task[None] | None = None
        self._reading = asyncio.Lock()
        self._woken, self._changed = asyncio.Event(), asyncio.Event()

    @property
    def last(self) -> str:
        """The last entry's key; "0" if there is none."""
        return self.rows[-1].mark if self.rows else "0"

    def since(self, last: str) -> list[Row] | None:
        """Return the entries after a given one; None if it isn't in this file, or too long ago."""
        if last == "0" and (not self.rows or self.rows[0].id == 1):
            return list(self.rows)
        number = last.partition("-")[0]
        known = [k for k, row in enumerate(self.rows) if str(row.id) == number and row.mark == last]
        return [*islice(self.rows, known[0] + 1, None)] if known else None

    def is_full(self, address: str) -> bool:
        """Return whether no more followers are allowed from an address."""
        return self.followers.total() >= self.most or self.followers[address] >= self.most // 2

    def wake(self) -> None:
        """Check at once: something may have been entered."""
        self._woken.set()

    def close(self) -> None:
        """Release all followers."""
        self.closing = True
        self._changed.set()

    @asynccontextmanager
    async def following(self, address: str) -> AsyncIterator[None]:
        """Follow from an address, starting with the current state."""
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

    async def after(self, last: str) -> None:
        """Wait until there is a new last entry, but no longer than `ALIVE`."""
        if self.last == last and not self.closing:
            with suppress(TimeoutError):
                await asyncio.wait_for(self._changed.wait(), ALIVE)

    async def _look_on(self) -> None:
        while self.followers and not self.closing:
            with suppress(TimeoutError):
                await asyncio.wait_for(self._woken.wait(), _LOOK)
            self._woken.clear()
            try:
                await self._look()
            except Exception as error:  # the next look may fare better
                _LOG.exception("the file could not be checked", exc_info=error)

    async def _look(self) -> None:
        async with self._reading:
            mark, before = mark_of(self.path), self.last
            if mark == self._mark:
                return
            try:
                first = self.rows[-1].id if self.rows else 0
                rows = await asyncio.to_thread(rows_from, self.path, first, MOST)
                if another := self.rows and rows[:1] != [self.rows[-1]]:  # or too much at once
                    rows = await asyncio.to_thread(rows_from, self.path, 0, MOST)
            except DataError:  # the next look may fare better; the pages say why
                return
            if another:
                self.rows.clear()
            for row in rows[bool(self.rows) :]:
                if row.strand == CLEARED:
                    self.rows.clear()
                self.rows.append(row)
            self._mark = mark
        if self.last != before:
            self._changed.set()
            self._changed = asyncio.Event()


def stream_of(
    request: Request, told: Callable[[str | None], Awaitable[bytes]], last: str | None = None
) -> Response:
    """Stream server-sent events: one immediately, and another after each entry.

    `told` returns the next event, given its name for the last entry sent; it considers everything
    after that.
    """
    watch: Watch = request.app.state.watch
    here = address_of(request)
    kind = "text/event-stream"
    if request.method == "HEAD" or watch.is_full(here):  # whoever it is asks again by itself
        return Response("retry: 30000\n\n", media_type=kind)

    async def stream() -> AsyncIterator[bytes]:
        async with watch.following(here):
            seen, first = last, b"retry: 2000\n"
            while first or not watch.closing:
                new = await told(seen)
                seen = watch.last
                yield first + new
                first = b""
                await watch.after(seen)

    return StreamingResponse(stream(), media_type=kind, headers={"cache-control": "no-store"})


class Waking:
    """Wakes followers as soon as a request has entered something."""

    def __init__(self, app: ASGIApp, *, watch: Watch) -> None:
        self.app = app
        self.watch = watch

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, and wake followers before the answer is sent."""

        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start":
                self.watch.wake()
            await send(message)

        enters = scope.get("method") not in ("GET", "HEAD")
        await self.app(scope, receive, answer if enters else send)
