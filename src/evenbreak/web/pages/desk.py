"""The director's desk as it is seen: what is urgent first, and a match with all its acts."""

from __future__ import annotations

import asyncio
from datetime import datetime
from typing import Any

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.answers.tournament.bracket_view import group_words
from evenbreak.answers.tournament.time import time_of_day
from evenbreak.files.store.desk import Sides, objected
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.calling import (
    proposed_calls,
    ready_matches,
    tables_to_give,
)
from evenbreak.tournaments.evening.events import Result, score_words
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.format import names_text
from evenbreak.tournaments.evening.later_draws import can_draw
from evenbreak.tournaments.evening.settling import tied_groups
from evenbreak.tournaments.evening.undoing import is_free, own_last, undoable
from evenbreak.web.desk_view import (
    DeskMatch,
    chance,
    desk_match,
    last_act,
    next_words,
    progress,
    soon,
    undo_words,
    waiting,
    waits_words,
)
from evenbreak.web.evening_view import view_of
from evenbreak.web.forms import form_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.night import Known
from evenbreak.web.page import page, site_of
from evenbreak.web.sessions import check_director, is_director
from evenbreak.web.site import night_of
from evenbreak.words import say

_READ = "read"


async def desk(request: Request) -> Response:
    """Show all that the director can do now, what is urgent first."""
    check_director(request)
    site = site_of(request)
    if not site.night.exists:
        if await site.teams.now() is not None:
            return RedirectResponse("/team", status_code=303)
        raise RefusalError("No tournament is running yet.", status=404)
    night = night_of(request)
    known = await night.outlook()
    state = await asyncio.to_thread(night.state)
    shown = await asyncio.to_thread(_desk_values, request, state, known)
    return page(request, "desk.html", live=True, **shown)


def _next(state: Evening, known: Known | None) -> list[tuple[str, int]]:
    """Return the matches to call, each with a table: of several events, as the night goes on."""
    every = {state.event: state}
    return [
        (one.match, one.table) for _, one in proposed_calls(every, known.queue if known else ())
    ]


def _desk_values(request: Request, state: Evening, known: Known | None) -> dict[str, Any]:
    """Return what the desk shows."""
    site = site_of(request)
    now, order = site.clock(), known.order if known else ()
    over, played = progress(state)
    view = view_of(state, known)
    read = request.session.get(_READ)
    shown: dict[str, Any] = {
        "state": state,
        "name": state.plan.name or say("Tonight"),
        "clock": _clock(now),
        "nights": [one.event for one in site.nights],
        "over": over,
        "all": played,
        "finish": view.finish[1] if view.finish and not view.over else "",
        "last": last_act(state, read if isinstance(read, int) else 0),
        "newest": state.numbers[-1],
        "mine": own_act(state),
        "over_now": view.over,
        "places": view.places,
        "warnings": _warnings(known),
    }
    lists = "calls disputes sent late aside tables soon still ready tied objected"
    shown |= {name: [] for name in lists.split()} | {"waits": {}, "drawable": False}
    shown |= {"next_call": None, "next_table": 0, "free_table": None, "answers": {}}
    shown |= sheet_values(request, state)
    if not state.drawn:
        return shown
    sides, phones = sides_now(request, state), night_of(request).phones()
    on = sorted(state.on_tables, key=lambda name: state.on_tables[name].call.table)
    tables = [desk_match(state, name, now, sides) for name in on]
    off = [name for name in sides if name not in on]
    both = [*tables, *(desk_match(state, name, now, sides) for name in off)]
    calls = [(desk_match(state, name, now), table) for name, table in _next(state, known)]
    free = tables_to_give(state)
    called = [one.name for one, _ in calls]
    late, still = waiting(state, now)
    nexts = [one for one in soon(state, now, order) if one.name not in called]
    return shown | {
        "disputes": [one for one in both if one.state == "two"],
        "sent": [one for one in both if one.state == "sent"],
        "answers": {
            name: [(who, phones.answer(who, name, on.at)) for who in on.call.players]
            for name, on in state.on_tables.items()
        },
        "tables": [one for one in tables if one.state not in ("two", "sent")],
        "calls": calls,
        "next_call": calls[0][0] if len(calls) == 1 else None,
        "next_table": calls[0][1] if calls else 0,
        "free_table": free[len(calls)] if len(free) > len(calls) else None,
        "ready": [desk_match(state, name, now) for name in ready_matches(state, order)],
        "soon": nexts,
        "waits": {one.name: waits_words(state, one) for one in nexts if not one.sides},
        "objected": [desk_match(state, name, now) for name in objected(state, phones)],
        "late": late,
        "still": still,
        "aside": [
            (one.result.match, state.number_of(one.result.match), score_words(one.result))
            for one in state.aside
            if one.result.match in state.standing.seats
        ],
        "tied": [group_words(name) for name in tied_groups(state)],
        "drawable": can_draw(state),
    }


def _clock(at: str) -> str:
    moment = datetime.fromisoformat(at)
    return time_of_day(60 * moment.hour + moment.minute)


def _warnings(known: Known | None) -> list[str]:
    if known and known.problem:
        return [say("Odds and finish time can't be calculated: {why}", why=known.problem)]
    return known.data.get("warnings", []) if known else []


def sides_now(request: Request, state: Evening) -> dict[str, Sides]:
    """Return what phones sent for the matches that can be played."""
    phones = site_of(request).night.phones()
    sides = (phones.sides(name, state.pair(name)) for name in state.standing.to_play)
    return {one.match: one for one in sides if one.proposed}


def sheet_values(request: Request, state: Evening) -> dict[str, Any]:
    """Return what a director's sheet shows of the match that an address names by its number."""
    number = request.query_params.get("match", "")
    none: dict[str, Any] = {"one_match": None, "its": {}}
    if not (number and state.drawn and is_director(request)):
        return none
    match = next((n for n in state.bracket.by_name if str(state.number_of(n)) == number), None)
    if match is None:
        return none
    now = site_of(request).clock()
    one = desk_match(state, match, now, sides_now(request, state))
    to_play = match in state.standing.to_play
    tables = [*dict.fromkeys([*tables_to_give(state), *moves.free_tables(state)])]
    return {
        "one_match": one,
        "its": {
            "chance": chance(state, one) if to_play else None,
            "nexts": next_words(state, match),
            "waits": "" if one.sides else waits_words(state, one),
            "tables": tables,
            "other_tables": tables if one.table else tables[1:],
            "swaps": [
                desk_match(state, name, now)
                for name in state.on_tables
                if one.table and name != match
            ],
            "undo": _undo_of(state, one),
            "open": _tables_without(state, one.table),
        },
    }


def _tables_without(state: Evening, table: int | None) -> str:
    """Return the tables that stay open when one closes, as they are typed; "" for the last."""
    plan = state.plan
    names = [plan.table_name(k) for k in range(1, plan.tables + 1) if k != table]
    lone = len(names) == 1 and names[0].isdecimal() and names[0] != "1"
    return "" if table is None or state.event > 1 or lone or not names else names_text(names)


def _undo_of(state: Evening, one: DeskMatch) -> dict[str, Any] | None:
    """Return how the result of a match is taken back, if nothing follows from it."""
    for number, event in reversed(list(zip(state.numbers, state.events, strict=True))):
        if isinstance(event.what, Result) and event.what.match == one.name:
            can = number in undoable(state) or is_free(state, number)
            return {"entry": number, "words": undo_words(state, event)} if can else None
    return None


def own_act(state: Evening) -> dict[str, Any] | None:
    """Return the director's last act, and what its undo says."""
    number = own_last(state)
    if number is None:
        return None
    event = state.events[state.numbers.index(number)]
    return {"number": number, "undo": undo_words(state, event)}


async def read(request: Request) -> Response:
    """Keep that the director has read what was entered last."""
    form = await form_of(request)
    check_director(request)
    request.session[_READ] = form.whole("entry", 0, 10**7)
    return RedirectResponse("/desk", status_code=303)


ROUTES = [
    Route("/desk", desk),
    Route("/desk/read", read, methods=["POST"]),
]
