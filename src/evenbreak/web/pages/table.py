"""A table's own page, which follows the matches called to it.

If the director has assigned a tablet to the table, it can enter games for both players. Any other
phone sees the score and can say whose phone it is; a player's phone goes to the player's own page.
"""

from __future__ import annotations

import asyncio
import urllib.parse
from collections.abc import Sequence
from datetime import datetime
from typing import Any

import segno
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.files.store.desk import NO_TABLET, OBJECTED, TABLET, Act, Phones, objected
from evenbreak.tournaments.evening.events import Result
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web import taps
from evenbreak.web.forms import directors_form, form_of
from evenbreak.web.guard import MovedOnError, RefusalError
from evenbreak.web.my_night import chances, match_at
from evenbreak.web.night import Night
from evenbreak.web.page import done, page, reason, site_of
from evenbreak.web.sessions import (
    DIRECTOR,
    DIRECTORS_PAGE,
    check_director,
    is_director,
    let_out,
    phone_of,
    tablet_of,
)
from evenbreak.web.site import begun_nights, drawn_state, night_of
from evenbreak.words import say

_JUST_NOW = 60.0  # seconds in which "That's wrong" stays in reach, whatever comes next
_moment = datetime.fromisoformat


async def table(request: Request) -> Response:
    """Show a table."""
    return await _shown(request)


async def _shown(request: Request, why: RefusalError | None = None) -> Response:
    """Return a table's current page, and why a tap was rejected."""
    nights = await _nights(request)
    house = await asyncio.to_thread(nights[0].state)
    number = house.plan.table_number(request.path_params["table"])
    night = await asyncio.to_thread(_night_at, nights, number)
    await night.outlook()
    state = await asyncio.to_thread(night.state)
    phones = await asyncio.to_thread(night.phones)
    on = [name for name, one in state.on_tables.items() if one.call.table == number]
    name, phone = (on or [""])[0], phone_of(request)
    if name and phones.of(phone) in state.pair(name) and not is_director(request):
        return RedirectResponse("/me", status_code=303)
    one = match_at(state, name) if name else None
    tablet = phones.table_of(phone) == number
    told = await asyncio.to_thread(_last_at, nights, number)
    last, at = last_on(told.state(), number)
    now = site_of(request).clock()
    begun = why or request.query_params.get("play") == name or state.plan.form == "chips"
    shown: dict[str, Any] = {
        "event": night.event,
        "state": state,
        "at": f"/table/{number}",
        "label": state.plan.table_name(number),
        "one": one,
        "odds": chances(state, one, night.means) if one else None,
        "tablet": tablet,
        "others": bool(phones.tablets_of(number)) and not tablet,
        "playing": one is not None and bool(begun or any(one.score)),
        "phones": phones,
        "sides": phones.sides(name, one.pair) if one and one.pair else None,
        "next": _next_on(nights, number),
        "last": last,
        "just_now": bool(at) and (_moment(now) - _moment(at)).total_seconds() < _JUST_NOW,
        "last_event": told.event,
        "objected": last is not None and last.match in objected(told.state(), told.phones()),
        "now": now[11:16],
        "why": reason(request, why) if why else "",
    }
    return page(request, "table.html", live=True, status=why.status if why else 200, **shown)


def _night_at(nights: Sequence[Night], number: int) -> Night:
    """Return the event whose match is on a table, or else the last match's event."""
    for night in nights:
        if number in {on.call.table for on in night.state().on_tables.values()}:
            return night
    return _last_at(nights, number)


def _last_at(nights: Sequence[Night], number: int) -> Night:
    """Return the event whose match was the last to end on a table; the first event if none has."""
    return max(nights, key=lambda night: last_on(night.state(), number)[1])


def _next_on(nights: Sequence[Night], number: int) -> list[tuple[str, str]]:
    """Return who plays next on a table, as far as that is calculated."""
    return [
        night.known.of.pair(match)
        for night in nights
        if night.known and night.known.of is night.state()
        for table, match in night.known.calls
        if table == number
    ]


def last_on(state: Evening, number: int) -> tuple[Result | None, str]:
    """Return the result of a table's last match, and when it came in."""
    found: tuple[Result | None, str] = None, ""
    for event in state.events:
        what = event.what
        if not isinstance(what, Result) or state.counted.get(what.match) != what:
            continue
        on = state.calls.get((what.match, frozenset(what.players)))
        if on is not None and on.call.table == number:
            found = what, event.at
    return found


async def tap(request: Request) -> Response:
    """Accept a match's score from its table's tablet; a final score is the result."""
    form = await form_of(request)
    state, number = await _table(request)

    def check(now: Evening) -> None:
        if night_of(request).phones().table_of(phone_of(request)) != number:
            raise RefusalError("This is no longer the table's tablet.", status=403)
        on = now.on_tables.get(one.match)
        if on is None or on.call.table != number:
            raise MovedOnError("This match is on another table now.", status=409)

    try:
        one = taps.tap_in(request, form, state)
        enter_it = taps.result if one.ends(state) else taps.score
        by = tablet_of(state.plan.table_name(number))
        await asyncio.to_thread(enter_it, request, one, by, check)
    except MovedOnError as error:
        return await _shown(request, error)
    to = f"/table/{number}"
    return done(request, to if one.ends(state) else f"{to}?play={one.match}")


async def wrong(request: Request) -> Response:
    """Store that a table's last result is wrong, for the director to see."""
    form = await form_of(request)
    state, number = await _table(request)
    phone, match, key = phone_of(request), form.text("match"), form.key(request.url.path)
    result = state.counted.get(match)
    if result is None:
        raise MovedOnError("Your match has moved on. Open your page again.", status=409)

    def decide(phones: Phones) -> Act | None:
        if phones.table_of(phone) != number and phones.of(phone) not in result.players:
            raise RefusalError("This is no longer the table's tablet.", status=403)
        if match in objected(state, phones):
            return None
        return Act(OBJECTED, str(number), match, result.games)

    await asyncio.to_thread(taps.note, request, night_of(request), key, decide)
    return done(request, f"/table/{number}")


async def tablet(request: Request) -> Response:
    """Assign this tablet to the table, or take the table away from every tablet."""
    form = await directors_form(request)
    state, number = await _table(request)
    give, key = form.one_of("give", ("yes", "no")) == "yes", form.key(request.url.path)
    act, by = Act(TABLET if give else NO_TABLET, str(number)), "" if give else DIRECTORS_PAGE

    def decide(phones: Phones) -> Act | None:
        return act if give or phones.tablets_of(number) else None

    await asyncio.to_thread(taps.note, request, night_of(request), key, decide, by)
    if not give:
        return done(request, f"/table/{number}")
    await asyncio.to_thread(let_out, request, DIRECTOR)
    label = state.plan.table_name(number)
    words = say(
        "This is now the tablet for table {table}, and it's signed out as the director.",
        table=label,
    )
    return done(request, f"/table/{number}", words)


async def codes(request: Request) -> Response:
    """Show the QR codes to print, for the page and for each table, and whose phone is whose."""
    check_director(request)
    site = site_of(request)
    to: list[tuple[str, str]] = [(say("Tonight"), site.address)]
    shown: dict[str, Any] = {"players": {}, "claims": {}}
    if nights := site.begun:
        state = await asyncio.to_thread(nights[0].state)
        names = [state.plan.table_name(k) for k in range(1, state.plan.tables + 1)]
        to += [
            (say("Table {n}", n=name), f"{site.address}/table/{urllib.parse.quote(name, safe='')}")
            for name in names
        ]
        claims = {
            name: claim
            for night in nights
            for name, claim in (await asyncio.to_thread(night.phones)).claims.items()
        }
        shown = {"players": site.player_codes(), "claims": claims}

    def work() -> list[tuple[str, str, str]]:
        return [(words, address, _code(address)) for words, address in to]

    return page(request, "codes.html", codes=await asyncio.to_thread(work), **shown)


def _code(text: str) -> str:
    svg: str = segno.make(text, error="m").svg_inline(scale=4, border=2, dark="#000", light="#fff")
    return svg


async def _nights(request: Request) -> list[Night]:
    """Return the night's events that have been drawn; raise an error if none has."""
    begun = begun_nights(request)
    drawn = [night for night in begun if (await asyncio.to_thread(night.state)).drawn]
    if not drawn:
        raise RefusalError("The draw hasn't been made yet.", status=404)
    return drawn


async def _table(request: Request) -> tuple[Evening, int]:
    """Return the event that a form is about, and its table."""
    state = await drawn_state(request)
    return state, state.plan.table_number(request.path_params["table"])


ROUTES = [
    Route("/desk/codes", codes),
    Route("/table/{table}", table, methods=["GET"]),
    Route("/table/{table}/score", table, methods=["GET"]),  # the page of a tap that was refused
    Route("/table/{table}/score", tap, methods=["POST"]),
    Route("/table/{table}/wrong", wrong, methods=["POST"]),
    Route("/table/{table}/tablet", tablet, methods=["POST"]),
]
