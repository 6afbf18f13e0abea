"""Let phones in, and lock them out again."""

from __future__ import annotations

import asyncio

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.web.forms import directors_form
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import done, page, site_of
from evenbreak.web.pages.wall import code
from evenbreak.web.sessions import check_director, is_here
from evenbreak.words import say

_PHONES = "/desk/phones"


async def phones(request: Request) -> Response:
    """Show where phones find the page, or that they can't open it yet."""
    check_director(request)
    room = site_of(request).room
    places = [(one, code(one)) for one in room.places] if room else []
    here = room.here if room else site_of(request).address
    return page(request, "phones.html", places=places, here_now=is_here(request), own=here)


async def let(request: Request) -> Response:
    """Let phones in, or lock them out."""
    form = await directors_form(request)
    site = site_of(request)
    site.since_start.clear()
    if form.text("read"):
        return RedirectResponse("/desk", status_code=303)
    room = site.room
    if room is None or not is_here(request):
        raise RefusalError(
            "Do that on the computer that runs this page, at {here}.",
            status=409,
            here=room.here if room else site.address,
        )
    if form.text("open"):
        await room.open()
        await asyncio.to_thread(site.let_phones, True)
        return done(request, _PHONES, say("Phones can open the page now."))
    await room.close()
    await asyncio.to_thread(site.let_phones, False)
    return done(request, _PHONES, say("Only this computer can open the page now."))


ROUTES = [
    Route(_PHONES, phones, methods=["GET"]),
    Route(_PHONES, let, methods=["POST"]),
]
