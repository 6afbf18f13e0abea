"""Other things a director looks up or sets: an overview, the history, QR codes, copies."""

from __future__ import annotations

import asyncio
import urllib.parse
from collections.abc import Iterator
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
from evenbreak.tournaments.evening.edition import tables_text
from evenbreak.tournaments.evening.events import Plan, Scored
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.format import names_text
from evenbreak.tournaments.evening.later_draws import can_draw
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.plan import FORMATS, FORMATS_WITH
from evenbreak.tournaments.evening.undoing import free_entries, redoable
from evenbreak.web.forms import directors_form
from evenbreak.web.guard import RefusalError
from evenbreak.web.night import Night
from evenbreak.web.page import answer_shown, done, page, site_of
from evenbreak.web.pages.me import phone_label, phone_words
from evenbreak.web.sessions import DIRECTOR, author_words, check_director, let_in
from evenbreak.web.site import begun, event_of, night_of, of_event
from evenbreak.words import say, tally

RACES = {
    "race": say("Race to"),
    "losers_race": say("Race on the losers' side"),
    "final_race": say("Race in the final"),
}
"""The races that can be changed."""
_MOST_SCORES = 30


async def more(request: Request) -> Response:
    """Show what isn't on the desk itself: settings, lists, printouts."""
    check_director(request)
    site, night = site_of(request), begun(night_of(request))
    state = await asyncio.to_thread(night.state)
    plan = state.plan
    return page(
        request,
        "more.html",
        state=state,
        over=state.drawn and not state.standing.to_play and not can_draw(state),
        still_in=[name for name in state.entrants if name not in state.dropped],
        tables=tables_text(plan),
        reserved=names_text([plan.table_name(n) for n in plan.reserved]),
        streamed=names_text([plan.table_name(n) for n in plan.streamed]),
        races=_races(plan),
        overlays=overlay_paths(plan),
        calls_itself=site.calls_itself,
    )


def overlay_paths(plan: Plan) -> list[str]:
    """Return the addresses of the overlays: for streamed tables, or all tables, and the bracket.

    >>> overlay_paths(Plan("double", 5, tables=3, labels=("1", "2", "TV"), streamed=(3,)))
    ['/overlay/TV', '/overlay/bracket']
    """
    tables = plan.streamed or range(1, plan.tables + 1)
    names = [urllib.parse.quote(plan.table_name(table), safe="") for table in tables]
    return [f"/overlay/{name}" for name in (*names, "bracket")]


def _races(plan: Plan) -> dict[str, tuple[str, int]]:
    """Return the races that can be changed, and their current values."""
    if plan.chart is not None or plan.form == "chips":
        return {}
    now = {"race": plan.race, "losers_race": plan.losers_race, "final_race": plan.final_race}
    return {
        name: (words, now[name] or plan.race)
        for name, words in RACES.items()
        if plan.form in FORMATS_WITH.get(name, FORMATS)
    }


async def calling(request: Request) -> Response:
    """Store whether a result automatically calls the next match to the freed table."""
    form = await directors_form(request)
    itself = bool(form.text("itself"))
    await asyncio.to_thread(site_of(request).let_call, itself)
    said = (
        say("The next match is now called automatically when a result comes in.")
        if itself
        else say("You now call each match yourself.")
    )
    return done(request, of_event("/desk/more", event_of(request)), said)


async def save(request: Request) -> Response:
    """Write a copy of the file."""
    await directors_form(request)
    copy = await asyncio.to_thread(back_up, site_of(request).path, datetime.now())
    return done(
        request,
        of_event("/desk/more", event_of(request)),
        say("Saved as {name}, next to the tournament's file.", name=copy.name),
    )


async def change_pin(request: Request) -> Response:
    """Generate a new PIN; directors' other phones must enter it."""
    await directors_form(request)
    site = site_of(request)
    await asyncio.to_thread(site.change_pin)
    let_in(request, DIRECTOR, site.director_mark)
    return done(
        request,
        of_event("/desk/more", event_of(request)),
        say(
            "The director's PIN is now {pin}. Other phones have to enter it before they "
            "can change anything.",
            pin=site.pin,
        ),
    )


async def time(request: Request) -> Response:
    """Show when the night ends, and what would change that."""
    check_director(request)
    site, night = site_of(request), begun(night_of(request))
    state = await asyncio.to_thread(night.state)
    if not state.drawn:
        raise RefusalError("There is no draw yet.", status=409)

    def work() -> Answer:
        answer = time_under_way(Outlook(state, site.clock()))
        return replace(answer, heading=played_words(state))

    answer = await night.beside.run(work)
    return page(request, "time.html", answer=answer_shown(request, answer))


async def history(request: Request) -> Response:
    """Show who entered what, and when; anything that nothing depends on can be taken back there."""
    check_director(request)
    night = begun(night_of(request))
    rows, again = await asyncio.to_thread(_entries, night)
    return page(request, "history.html", rows=rows, again=again, undo=True)


def _entries(night: Night) -> tuple[list[tuple[int, str, str, str, str]], set[int]]:
    """Return the entries, last first, and which ones can be redone.

    Each has its number (0: from a phone), when, what, by whom, and 'free' if it can be taken back,
    or 'gone' if it has been. A match's consecutive scores by one author are one row.
    """
    state = night.state()
    found = state.log
    free = free_entries(state)
    rows: list[tuple[str, int, str, str, str]] = [
        (
            one.at,
            k,
            what,
            author_words(one.by),
            "free" if k in free else "gone" if k in state.undone else "",
        )
        for k, (one, what) in enumerate(zip(found, history_words(found, state), strict=True), 1)
        if not isinstance(one.what, Scored)
    ]
    rows += [
        (found[k - 1].at, k, what, author_words(found[k - 1].by), how)
        for k, what, how in _scores(state)
    ]
    rows += [
        (one.at, 0, phone_words(one, state), phone_label(one), "")
        for one in phone_entries(night.path)
        if one.kind != ENTERED  # it is among the events
        and (one.what.event == state.event or not one.what.match)
    ]
    rows.sort(key=lambda row: row[0])
    redo = redoable(state)
    shown = [
        (number, f"{datetime.fromisoformat(at):%H:%M}", what, by, how)
        for at, number, what, by, how in rows[::-1]
    ]
    return shown, set() if redo is None else {redo}


def _scores(state: Evening) -> Iterator[tuple[int, str, str]]:
    """Yield a match's consecutive scores by one author, as one row.

    Each row has the last one's number, what, and 'gone' if they have been undone.
    """
    open_rows: dict[str, tuple[tuple[str, bool], list[int]]] = {}
    rows = []
    for k, one in enumerate(state.log, 1):
        if isinstance(one.what, Scored):
            whose = one.by, k in state.undone
            if whose != open_rows.get(one.what.match, ("", []))[0]:
                open_rows[one.what.match] = whose, []
                rows.append(open_rows[one.what.match])
            open_rows[one.what.match][1].append(k)
        elif match := getattr(one.what, "match", ""):
            open_rows.pop(match, None)
    for (_, undone), entries in rows:
        whats = [what for k in entries if isinstance(what := state.log[k - 1].what, Scored)]
        scores = [tally(what.score) for what in whats]
        told = scores if len(scores) <= _MOST_SCORES else ["…", *scores[-_MOST_SCORES:]]
        match = state.match_words(whats[0].match) if state.drawn else whats[0].match
        words = say("score {scores} in {match}", scores=", ".join(told), match=match)
        yield entries[-1], words, "gone" if undone else ""


ROUTES = [
    Route("/desk/more", more),
    Route("/desk/calling", calling, methods=["POST"]),
    Route("/desk/time", time),
    Route("/desk/history", history),
    Route("/desk/save", save, methods=["POST"]),
    Route("/desk/pin", change_pin, methods=["POST"]),
]
