"""Pages that follow what happens: a stream that says when the tournament has changed."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

from starlette.requests import Request
from starlette.responses import Response, StreamingResponse

from evenbreak.web.night import version_of
from evenbreak.web.page import site_of

_LOOK = 0.7  # seconds between two looks at the file
_ALIVE = 20.0  # seconds after which something is sent in any case
_MOST = 500  # streams at once


class Watch:
    """One look at the file for all who follow it."""

    def __init__(self) -> None:
        self.version = -1
        self.looked = 0.0
        self.followers = 0

    async def look(self, request: Request) -> int:
        """Return the number of events; the file is asked at most once in a while."""
        now = asyncio.get_running_loop().time()
        if now - self.looked >= 0.9 * _LOOK:
            self.looked = now
            self.version = await asyncio.to_thread(version_of, site_of(request).path)
        return self.version


_WATCH = Watch()


async def events(request: Request) -> Response:
    """Stream the number of events whenever it changes."""
    if _WATCH.followers >= _MOST:  # the phone asks again by itself
        return Response("retry: 30000\n\n", media_type="text/event-stream")

    async def stream() -> AsyncIterator[bytes]:
        _WATCH.followers += 1
        try:
            seen, quiet = await _WATCH.look(request), 0.0
            yield f"retry: 2000\ndata: {seen}\n\n".encode()
            state = request.app.state
            while not (state.closing or await request.is_disconnected()):
                await asyncio.sleep(_LOOK)
                quiet += _LOOK
                version = await _WATCH.look(request)
                if version != seen or quiet > _ALIVE:
                    seen, quiet = version, 0.0
                    yield f"data: {seen}\n\n".encode()
        finally:
            _WATCH.followers -= 1

    return StreamingResponse(
        stream(), media_type="text/event-stream", headers={"cache-control": "no-store"}
    )
