"""A table's own page: it follows what is called to it.

A tablet that the director has made the table's own taps games for both players. Any other phone
sees the score and says whose it is; a player's phone goes to the player's own page.
"""

from __future__ import annotations

import asyncio
import urllib.parse
from typing import Any

import segno
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.files.store.desk import NO_TABLET, OBJECTED, TABLET, Entry, Phones, enter, objected
from evenbreak.tournaments.evening.events import Result
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web import taps
from evenbreak.web.forms import form_of
from evenbreak.web.guard import MovedOnError, RefusalError
from evenbreak.web.my_night import chances, match_at
from evenbreak.web.page import done, page, reason, site_of
from evenbreak.web.sessions import (
    DIRECTOR,
    address_of,
    check_director,
    is_director,
    let_out,
    phone_of,
    tablet_of,
)
from evenbreak.words import say


async def table(request: Request) -> Response:
    """Show a table."""
    return await _shown(request)


async def _shown(request: Request, why: RefusalError | None = None) -> Response:
    """Return the page of a table as it is now, and why a tap was refused."""
    state, number = await _table(request)
    night = site_of(request).night
    known = await night.outlook()
    phones = await asyncio.to_thread(night.phones)
    on = [name for name, one in state.on_tables.items() if one.call.table == number]
    name, phone = (on or [""])[0], phone_of(request)
    if name and phones.of(phone) in state.pair(name) and not is_director(request):
        return RedirectResponse("/me", status_code=303)
    one = match_at(state, name) if name else None
    tablet = phones.table_of(phone) == number
    calls = known.calls if known and known.of is state else []
    last = _last_on(state, number)
    begun = why or request.query_params.get("play") == name or state.plan.form == "chips"
    shown: dict[str, Any] = {
        "state": state,
        "at": f"/table/{number}",
        "label": state.plan.table_name(number),
        "one": one,
        "odds": chances(state, one) if one else None,
        "tablet": tablet,
        "others": bool(phones.tablets_of(number)) and not tablet,
        "playing": one is not None and bool(begun or any(one.score)),
        "phones": phones,
        "sides": phones.sides(name, one.pair) if one and one.pair else None,
        "next": [state.pair(match) for table, match in calls if table == number],
        "last": last,
        "objected": last is not None and last.match in objected(state, phones),
        "now": site_of(request).clock()[11:16],
        "why": reason(request, why) if why else "",
    }
    return page(request, "table.html", live=True, status=why.status if why else 200, **shown)


def _last_on(state: Evening, number: int) -> Result | None:
    """Return the result of the last match that was played on a table."""
    found = None
    for event in state.events:
        what = event.what
        if not isinstance(what, Result) or state.counted.get(what.match) != what:
            continue
        on = state.calls.get((what.match, frozenset(what.players)))
        if on is not None and on.call.table == number:
            found = what
    return found


async def tap(request: Request) -> Response:
    """Take the score of the match on a table from its tablet; a full score is the result."""
    form = await form_of(request)
    state, number = await _table(request)

    def check(now: Evening) -> None:
        if site_of(request).night.phones().table_of(phone_of(request)) != number:
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
    """Keep that the last result of a table is wrong, for the director to see."""
    form = await form_of(request)
    state, number = await _table(request)
    site, phone, match = site_of(request), phone_of(request), form.text("match")
    result = state.counted.get(match)
    if result is None:
        raise MovedOnError("Your match has moved on. Open your page again.", status=409)

    def decide(phones: Phones) -> Entry | None:
        if phones.table_of(phone) != number and phones.of(phone) not in result.players:
            raise RefusalError("This is no longer the table's tablet.", status=403)
        if match in objected(state, phones):
            return None
        address = address_of(request)
        return Entry(site.clock(), match, OBJECTED, str(number), result.games, phone, address)

    await asyncio.to_thread(enter, site.path, state, decide)
    return done(request, f"/table/{number}")


async def tablet(request: Request) -> Response:
    """Make this the table's tablet, or take the table from every tablet that has it."""
    form = await form_of(request)
    check_director(request)
    state, number = await _table(request)
    site, phone = site_of(request), phone_of(request)
    give = form.one_of("give", ("yes", "no")) == "yes"

    def work() -> None:
        def decide(phones: Phones) -> Entry | None:
            at, address = site.clock(), address_of(request)
            if give:
                return Entry(at, "", TABLET, str(number), {}, phone, address)
            held = phones.tablets_of(number)
            return Entry(at, "", NO_TABLET, str(number), {}, held[0]) if held else None

        while enter(site.path, state, decide).tablets_of(number) and not give:
            pass

    await asyncio.to_thread(work)
    if not give:
        return done(request, f"/table/{number}")
    await asyncio.to_thread(let_out, request, DIRECTOR)
    label = state.plan.table_name(number)
    words = say("This is the tablet of table {table} now, signed out as the director.", table=label)
    return done(request, f"/table/{number}", words)


async def codes(request: Request) -> Response:
    """Show the QR codes to print, of the page and of each table, and whose phone is whose."""
    check_director(request)
    site = site_of(request)
    to: list[tuple[str, str]] = [(say("Tonight"), site.address)]
    shown: dict[str, Any] = {"players": {}, "claims": {}}
    if site.night.exists:
        state = await asyncio.to_thread(site.night.state)
        names = [state.plan.table_name(k) for k in range(1, state.plan.tables + 1)]
        to += [
            (say("Table {n}", n=name), f"{site.address}/table/{urllib.parse.quote(name, safe='')}")
            for name in names
        ]
        phones = await asyncio.to_thread(site.night.phones)
        shown = {"players": site.player_codes(), "claims": phones.claims}

    def work() -> list[tuple[str, str, str]]:
        return [(words, address, _code(address)) for words, address in to]

    return page(request, "codes.html", codes=await asyncio.to_thread(work), **shown)


def _code(text: str) -> str:
    svg: str = segno.make(text, error="m").svg_inline(scale=4, border=2, dark="#000", light="#fff")
    return svg


async def _table(request: Request) -> tuple[Evening, int]:
    night = site_of(request).night
    if not night.exists:
        raise RefusalError("No tournament is running yet.", status=404)
    state = await asyncio.to_thread(night.state)
    if not state.drawn:
        raise RefusalError("The draw has not been made yet.", status=404)
    return state, state.plan.table_number(request.path_params["table"])


ROUTES = [
    Route("/desk/codes", codes),
    Route("/table/{table}", table, methods=["GET"]),
    Route("/table/{table}/score", table, methods=["GET"]),  # the page of a tap that was refused
    Route("/table/{table}/score", tap, methods=["POST"]),
    Route("/table/{table}/wrong", wrong, methods=["POST"]),
    Route("/table/{table}/tablet", tablet, methods=["POST"]),
]
