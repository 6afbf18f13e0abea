"""Tonight: what is on the tables, who plays next, the odds, the finish time.

The wall shows the same thing in large letters. Also the stream that tells pages when the tournament
has changed.
"""

from __future__ import annotations

import asyncio

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.web.forms import form_of
from evenbreak.web.page import asked_again, choose_language, done, page, site_of
from evenbreak.web.pages.wall import view_for
from evenbreak.web.sessions import (
    DIRECTOR,
    check_tries,
    is_here,
    let_in,
    let_out,
    wrong_pin,
)
from evenbreak.web.site import night_of
from evenbreak.web.watch import Watch, stream_of


async def tonight(request: Request) -> Response:
    """Show the evening, or how to start one."""
    night = night_of(request)
    if not night.exists:
        if await site_of(request).teams.now() is not None:
            return RedirectResponse("/team", status_code=303)
        return page(request, "begin.html")
    site = site_of(request)
    wall, state = await view_for(request, night, site.clock())
    of = (state, night.known or "", wall.marks)
    return page(request, "tonight.html", live=True, of=of, wall=wall)


async def ask_pin(request: Request) -> Response:
    """Ask for the director's PIN; the program's own browser has a ticket instead."""
    ticket = request.query_params.get("ticket", "")
    good = is_here(request) and site_of(request).ticket.is_good(ticket)
    late = bool(ticket) and not good
    return page(request, "pin.html", ticket=ticket if good else "", late=late, why="")


async def enter_pin(request: Request) -> Response:
    """Log the director in."""
    form = await form_of(request)
    site = site_of(request)
    check_tries(request)
    ticket = form.text("ticket")
    if not (
        is_here(request) and site.ticket.take(ticket) if ticket else site.is_pin(form.text("pin"))
    ):
        why = wrong_pin(request)
        return asked_again(request, "pin.html", form, why, why.status, ticket="", late=bool(ticket))
    let_in(request, DIRECTOR, site.director_mark)
    return done(request, "/desk" if site.night.exists else "/")


async def leave(request: Request) -> Response:
    """Log the director out."""
    await form_of(request)
    await asyncio.to_thread(let_out, request, DIRECTOR)
    return done(request, "/")


async def speak(request: Request) -> Response:
    """Choose the language."""
    form = await form_of(request)
    choose_language(request, form.text("language"))
    back = form.text("back")
    return done(request, back if back.startswith("/") and not back.startswith("//") else "/")


async def events(request: Request) -> Response:
    """Stream the last entry's key whenever there is a new entry."""
    watch: Watch = request.app.state.watch

    async def told(_: str | None) -> bytes:
        return f"data: {watch.last}\n\n".encode()

    return stream_of(request, told)


ROUTES = [
    Route("/", tonight),
    Route("/pin", ask_pin, methods=["GET"]),
    Route("/pin", enter_pin, methods=["POST"]),
    Route("/leave", leave, methods=["POST"]),
    Route("/language", speak, methods=["POST"]),
    Route("/events", events),
]
