"""Tonight: what is on the tables, who plays next, the odds, the finish."""

from __future__ import annotations

import asyncio

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.web.evening_view import view_of
from evenbreak.web.forms import form_of
from evenbreak.web.page import choose_language, done, page, site_of
from evenbreak.web.sessions import DIRECTOR, check_tries, let_in, let_out, wrong_pin


async def tonight(request: Request) -> Response:
    """Show the evening, or how one begins."""
    night = site_of(request).night
    if not night.exists:
        if await site_of(request).teams.now() is not None:
            return RedirectResponse("/team", status_code=303)
        return page(request, "begin.html")
    known = await night.outlook()
    state = night.state()
    view = view_of(state, known)
    return page(request, "tonight.html", live=True, view=view, prizes=night.prizes())


async def ask_pin(request: Request) -> Response:
    """Ask for the director's PIN."""
    return page(request, "pin.html")


async def enter_pin(request: Request) -> Response:
    """Let the director in."""
    form = await form_of(request)
    site = site_of(request)
    check_tries(request)
    if not site.is_pin(form.text("pin")):
        raise wrong_pin(request)
    let_in(request, DIRECTOR, site.director_mark)
    return done(request, "/")


async def leave(request: Request) -> Response:
    """Let the director out."""
    await form_of(request)
    await asyncio.to_thread(let_out, request, DIRECTOR)
    return done(request, "/")


async def speak(request: Request) -> Response:
    """Choose the language."""
    form = await form_of(request)
    choose_language(request, form.text("language"))
    back = form.text("back")
    return done(request, back if back.startswith("/") and not back.startswith("//") else "/")


ROUTES = [
    Route("/", tonight),
    Route("/pin", ask_pin, methods=["GET"]),
    Route("/pin", enter_pin, methods=["POST"]),
    Route("/leave", leave, methods=["POST"]),
    Route("/language", speak, methods=["POST"]),
]
