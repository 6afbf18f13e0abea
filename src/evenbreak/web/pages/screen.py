"""The screen on the wall: tables now and next, the odds, the finish; no controls."""

from __future__ import annotations

import asyncio

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.web.evening_view import view_of
from evenbreak.web.page import page, site_of


async def screen(request: Request) -> Response:
    """Show what everybody in the room wants to see, in letters for eight metres."""
    night = site_of(request).night
    view = None
    if night.exists:
        known = await night.outlook()
        _, state = await asyncio.to_thread(night.state)
        view = view_of(state, known)
    return page(request, "screen.html", live=True, view=view)


ROUTES = [Route("/screen", screen)]
