"""What else a director looks up: when it ends, who entered what, the QR codes; and copies."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from datetime import datetime

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.tournament.moves import history_words
from evenbreak.answers.tournament.night import played_words
from evenbreak.answers.tournament.under_way import time_under_way
from evenbreak.files.store.desk import ENTERED, back_up, phone_entries
from evenbreak.files.store.tournament import read_events
from evenbreak.tournaments.evening.fold import evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.web.forms import form_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import answer_shown, done, page, site_of
from evenbreak.web.pages.me import phone_label, phone_words
from evenbreak.web.sessions import DIRECTOR, author_words, check_director, let_in
from evenbreak.words import say


async def save(request: Request) -> Response:
    """Write a copy of the file."""
    await form_of(request)
    check_director(request)
    copy = await asyncio.to_thread(back_up, site_of(request).path, datetime.now())
    return done(
        request, "/desk", say("Saved as {name}, next to the tournament's file.", name=copy.name)
    )


async def change_pin(request: Request) -> Response:
    """Draw another PIN; the other phones of directors have to enter it."""
    await form_of(request)
    check_director(request)
    site = site_of(request)
    await asyncio.to_thread(site.change_pin)
    let_in(request, DIRECTOR, site.director_mark)
    return done(
        request,
        "/desk",
        say(
            "The director's PIN is now {pin}. Other phones have to enter it before they "
            "can change anything.",
            pin=site.pin,
        ),
    )


async def time(request: Request) -> Response:
    """Show when it ends, and what would change that."""
    check_director(request)
    site = site_of(request)
    if not site.night.exists:
        raise RefusalError("No tournament is running yet.", status=404)
    state = await asyncio.to_thread(site.night.state)
    if not state.drawn:
        raise RefusalError("There is no draw yet.", status=409)

    def work() -> Answer:
        answer = time_under_way(Outlook(state, site.clock()))
        return replace(answer, heading=played_words(state))

    answer = await site.night.beside.run(work)
    return page(request, "time.html", answer=answer_shown(request, answer))


async def history(request: Request) -> Response:
    """Show who entered what, and when."""
    check_director(request)
    path = site_of(request).path
    if not path.exists():
        raise RefusalError("No tournament is running yet.", status=404)
    found = await asyncio.to_thread(read_events, path)
    state = evening(found)
    rows: list[tuple[str, int | str, str, str]] = [
        (one.at, k, what, author_words(one.by))
        for k, (one, what) in enumerate(zip(found, history_words(found, state), strict=True), 1)
    ]
    gone = set(state.undone)
    rows += [
        (one.at, "", phone_words(one, state), phone_label(one))
        for one in await asyncio.to_thread(phone_entries, path)
        if one.kind != ENTERED  # it is among the events
    ]
    rows.sort(key=lambda row: row[0])
    shown = [
        (number, f"{datetime.fromisoformat(at):%H:%M:%S}", *row) for at, number, *row in rows[::-1]
    ]
    return page(request, "history.html", rows=shown, gone=gone)


ROUTES = [
    Route("/desk/time", time),
    Route("/desk/history", history),
    Route("/desk/save", save, methods=["POST"]),
    Route("/desk/pin", change_pin, methods=["POST"]),
]
