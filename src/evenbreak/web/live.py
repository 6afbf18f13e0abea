"""Pages that follow what happens: a stream that says when the tournament has changed."""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import AsyncIterator

from starlette.requests import Request
from starlette.responses import Response, StreamingResponse

from evenbreak.web.night import version_of
from evenbreak.web.page import site_of
from evenbreak.web.sessions import address_of

_LOOK = 0.7  # seconds between two looks at the file
_ALIVE = 20.0  # seconds after which something is sent in any case


class Watch:
    """One look at the file for all who follow it.

    Parameters
    ----------
    most
        how many may follow it at once; an address may have half of that.
    """

    def __init__(self, most: int) -> None:
        self.most = most
        self.version = -1
        self.looked = 0.0
        self.followers: Counter[str] = Counter()

    def is_full(self, address: str) -> bool:
        """Return whether no more can follow from an address."""
        return self.followers.total() >= self.most or self.followers[address] >= self.most // 2

    async def look(self, request: Request) -> int:
        """Return the number of events; the file is asked at most once in a while."""
        now = asyncio.get_running_loop().time()
        if now - self.looked >= 0.9 * _LOOK:
            self.looked = now
            self.version = await asyncio.to_thread(version_of, site_of(request).path)
        return self.version


async def events(request: Request) -> Response:
    """Stream the number of events whenever it changes."""
    watch, here = request.app.state.watch, address_of(request)
    if watch.is_full(here):  # the phone asks again by itself
        return Response("retry: 30000\n\n", media_type="text/event-stream")

    async def stream() -> AsyncIterator[bytes]:
        watch.followers[here] += 1
        try:
            seen, quiet = await watch.look(request), 0.0
            yield f"retry: 2000\ndata: {seen}\n\n".encode()
            state = request.app.state
            while not (state.closing or await request.is_disconnected()):
                await asyncio.sleep(_LOOK)
                quiet += _LOOK
                version = await watch.look(request)
                if version != seen or quiet > _ALIVE:
                    seen, quiet = version, 0.0
                    yield f"data: {seen}\n\n".encode()
        finally:
            watch.followers -= Counter([here])  # which forgets an address that has none

    return StreamingResponse(
        stream(), media_type="text/event-stream", headers={"cache-control": "no-store"}
    )
