"""Check-in before the draw: who is here, who has paid, who asks to play."""

from __future__ import annotations

import asyncio

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.files.store.prizes import kept_prizes
from evenbreak.files.store.tournament import add_events
from evenbreak.tournaments.evening import roster
from evenbreak.tournaments.evening.events import Event
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.forms import entered_name, entered_rating, form_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import done, page, site_of
from evenbreak.web.sessions import check_director, phone_of
from evenbreak.web.site import begun, night_of

_ASKED = "asked to play"


async def check_in(request: Request) -> Response:
    """Show who is here and who has paid."""
    check_director(request)
    night = begun(night_of(request))
    state = await asyncio.to_thread(night.state)
    money = await asyncio.to_thread(kept_prizes, night.path, night.event)
    names = list(state.entrants)  # in one order, so that no tap moves a row from under a finger
    # Where nobody is ticked off, everybody plays: a house that needs no check-in just draws.
    drawn = [name for name in names if name in state.arrived] or names
    return page(
        request,
        "check_in.html",
        live=True,
        state=state,
        names=names,
        money=money,
        pot=money.pot(len(state.paid)) if money else 0.0,
        drawn=len(drawn),
        absent=[name for name in names if name not in drawn],
        unpaid=sum(name not in state.paid for name in drawn) if money and money.fee else 0,
        clock=site_of(request).clock()[11:16],
    )


async def play(request: Request) -> Response:
    """Show a phone how to register, and its registration's status."""
    state = await asyncio.to_thread(begun(night_of(request)).state)
    name = str(request.session.get(_ASKED, ""))
    if name and name in state.entrants:
        return RedirectResponse("/", status_code=303)
    return page(request, "play.html", live=name in state.registered, state=state, asked=name)


async def register(request: Request) -> Response:
    """Let a phone ask to play; the director accepts or declines."""
    form, night = await form_of(request), night_of(request)
    name, rating = entered_name(form), entered_rating(form)
    if not name:
        raise RefusalError("Enter your name.")

    def decide(state: Evening) -> list[Event]:
        if len(state.registered) >= _MOST_ASKING:
            raise RefusalError(
                "Too many people are waiting to be let in. Ask the director.", status=429
            )
        return [Event(night.clock(), roster.register(state, name, rating))]

    key = form.key(request.url.path)
    by = f"phone {phone_of(request)[:8]}"
    await asyncio.to_thread(add_events, night.path, decide, by=by, form=key)
    request.session[_ASKED] = name
    return done(request, "/play")


_MOST_ASKING = 64

ROUTES = [
    Route("/desk/check-in", check_in, methods=["GET"]),
    Route("/play", play, methods=["GET"]),
    Route("/play", register, methods=["POST"]),
]
