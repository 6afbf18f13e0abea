"""The director's desk: urgent things first, and a match with all its actions."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.answers.tournament.bracket_view import group_words
from evenbreak.answers.tournament.moves import event_name, event_words
from evenbreak.answers.tournament.time import time_of_day
from evenbreak.files.store.desk import Phones, Sides, objected
from evenbreak.tournaments.evening.beside import out
from evenbreak.tournaments.evening.calling import (
    night_queue,
    proposed_calls,
)
from evenbreak.tournaments.evening.events import BY_ITSELF, Result, Undone
from evenbreak.tournaments.evening.fold import ELIMINATIONS, Evening
from evenbreak.tournaments.evening.format import MOST_TABLES, names_text
from evenbreak.tournaments.evening.later_draws import can_draw
from evenbreak.tournaments.evening.settling import tied_groups
from evenbreak.tournaments.evening.undoing import is_free, own_last, redoable, undoable
from evenbreak.web.desk_view import (
    DeskMatch,
    chance,
    desk_match,
    last_act,
    next_words,
    progress,
    shouts,
    soon,
    undo_words,
    waiting,
    waits_words,
)
from evenbreak.web.evening_view import EveningView, view_of
from evenbreak.web.forms import directors_form
from evenbreak.web.night import Known, Night
from evenbreak.web.page import page, site_of
from evenbreak.web.sessions import check_director, is_director
from evenbreak.web.site import begun, night_of
from evenbreak.words import say

_READ = "read"
_SECOND_CHANCE = 4  # players out, from which one is offered


async def desk(request: Request) -> Response:
    """Show everything the director can do now, urgent things first."""
    check_director(request)
    site = site_of(request)
    if not site.night.exists and await site.teams.now() is not None:
        return RedirectResponse("/team", status_code=303)
    begun(site.night)
    event, nights = night_of(request).event, site.nights
    knowns = [await night.outlook() for night in nights]
    states = {night.event: await asyncio.to_thread(night.state) for night in nights}
    shown = await asyncio.to_thread(_desk_values, request, event, states, knowns)
    return page(request, "desk.html", live=True, **shown)


def _desk_values(
    request: Request, event: int, states: Mapping[int, Evening], knowns: Sequence[Known | None]
) -> dict[str, Any]:
    """Return what the desk shows for all the night's events."""
    site, state = site_of(request), states[event]
    now, queue, read = site.clock(), site.queue, _read_of(request)
    views = [view_of(*pair) for pair in zip(states.values(), knowns, strict=True)]
    ends = [view.finish[1] for view in views if view.finish and not view.over]
    acts = [act for n, one in states.items() if (act := last_act(one, read.get(n, 0)))]
    last = max(acts, key=lambda one: (one.at, one.event == event)) if acts else None
    drawn = {n: one for n, one in states.items() if one.drawn}
    each = [
        _event_values(night, states[night.event], now)
        for night in site.nights
        if night.event in drawn
    ]
    both = [match for one in each for match in one["both"]]
    tables = sorted((one for one in both if one.table), key=lambda one: one.table or 0)
    called = proposed_calls(drawn, queue) if drawn else []
    calls = [(desk_match(states[n], one.match, now), one.table) for n, one in called]
    free = drawn[min(drawn)].free_tables if drawn else []
    keys = {one.key for one, _ in calls}
    nexts = [one for one in soon(drawn, now, queue) if one.key not in keys]
    late, still = ([one for its in each for one in its[name]] for name in ("late", "still"))
    return {
        "state": state,
        "name": say("Tonight") if len(states) > 1 else state.plan.name or say("Tonight"),
        "clock": _clock(now),
        "drawn": bool(drawn),
        "over": sum(progress(one)[0] for one in states.values()),
        "all": sum(progress(one)[1] for one in states.values()),
        "finish": ends[0] if ends else "",
        "last": last,
        "again": _undone_last(states[event]),
        "shouts": shouts(states, read, last),
        "newest": {n: one.numbers[-1] for n, one in states.items()},
        "mine": own_act(states, event),
        "events": [_event_row(one, view) for one, view in zip(states.values(), views, strict=True)],
        "each": each,
        "warnings": list(dict.fromkeys(line for one in knowns for line in _warnings(one))),
        "disputes": [one for one in both if one.state == "two"],
        "sent": [one for one in both if one.state == "sent"],
        "answers": {key: one for its in each for key, one in its["answers"].items()},
        "tables": [one for one in tables if one.state not in ("two", "sent")],
        "calls": calls,
        "free_table": free[len(calls)] if len(free) > len(calls) else None,
        "ready": [desk_match(states[n], name, now) for n, name in night_queue(drawn, queue)],
        "soon": nexts,
        "waits": {one.key: waits_words(states[one.event], one) for one in nexts if not one.sides},
        "objected": [one for its in each for one in its["objected"]],
        "late": late,
        "still": still,
        **sheet_values(request, state),
    }


def _event_row(state: Evening, view: EveningView) -> dict[str, Any]:
    """Return what an event shows separately on the desk: its draw, its ties, its end."""
    return {
        "event": state.event,
        "tag": event_name(state) if state.beside else "",
        "state": state,
        "progress": progress(state),
        "over": view.over,
        "places": view.places,
        "tied": [group_words(name) for name in tied_groups(state)] if state.drawn else [],
        "drawable": state.drawn and can_draw(state),
        "out": _out(state),
    }


def _out(state: Evening) -> list[str]:
    """Return who could play a second-chance event: at least four players, unless one is on."""
    if not state.drawn or state.plan.form not in ELIMINATIONS or state.event > 1:
        return []
    found = out(state)
    begun = any({*one.entrants} & {*found} for one in state.beside)
    return [] if begun or len(found) < _SECOND_CHANCE else found


def _event_values(night: Night, state: Evening, now: str) -> dict[str, Any]:
    """Return what the desk shows for the matches of an event that has been drawn."""
    phones = night.phones()
    sides = sides_now(phones, state)
    late, still = waiting(state, now)
    matches = {name: desk_match(state, name, now, sides) for name in {*state.on_tables, *sides}}
    return {
        "both": sorted(matches.values(), key=lambda one: (one.table or MOST_TABLES, one.number)),
        "answers": {
            matches[name].key: [(who, phones.answer(who, name, on.at)) for who in on.call.players]
            for name, on in state.on_tables.items()
        },
        "objected": [desk_match(state, name, now) for name in objected(state, phones)],
        "late": late,
        "still": still,
        "event": state.event,
        "aside": [
            (one.result.match, state.number_of(one.result.match), state.result_words(one.result))
            for one in state.aside
            if one.result.match in state.standing.seats
        ],
    }


def _clock(at: str) -> str:
    moment = datetime.fromisoformat(at)
    return time_of_day(60 * moment.hour + moment.minute)


def _warnings(known: Known | None) -> list[str]:
    if known and known.problem:
        return [say("Odds and finish time can't be calculated: {why}", why=known.problem)]
    return known.data.get("warnings", []) if known else []


def sides_now(phones: Phones, state: Evening) -> dict[str, Sides]:
    """Return what phones sent for the playable matches."""
    sides = (phones.sides(name, state.pair(name)) for name in state.standing.to_play)
    return {one.match: one for one in sides if one.proposed}


def sheet_values(request: Request, state: Evening) -> dict[str, Any]:
    """Return a director's sheet for the match whose number is in the address."""
    number = request.query_params.get("match", "")
    none: dict[str, Any] = {"one_match": None, "its": {}}
    if not (number and state.drawn and is_director(request)):
        return none
    match = next((n for n in state.bracket.by_name if str(state.number_of(n)) == number), None)
    if match is None:
        return none
    now = site_of(request).clock()
    one = desk_match(state, match, now, sides_now(night_of(request).phones(), state))
    to_play = match in state.standing.to_play
    waits = waiting(state, now)
    tables = [*state.free_tables, *state.kept_tables]
    return {
        "one_match": one,
        "its": {
            "chance": chance(state, one, night_of(request).means) if to_play else None,
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
            "let": next(
                (late for late in (*waits[0], *waits[1]) if late.match.name == match), None
            ),
            "open": _tables_without(state, one.table),
        },
    }


def _tables_without(state: Evening, table: int | None) -> str:
    """Return the tables that stay open when one closes, in typed form; "" for the last one."""
    plan = state.plan
    names = [plan.table_name(k) for k in range(1, plan.tables + 1) if k != table]
    lone = len(names) == 1 and names[0].isdecimal() and names[0] != "1"
    return "" if table is None or state.event > 1 or lone or not names else names_text(names)


def _undo_of(state: Evening, one: DeskMatch) -> dict[str, Any] | None:
    """Return how to take back a match's result, if nothing follows from it."""
    for number, event in reversed(list(zip(state.numbers, state.events, strict=True))):
        if isinstance(event.what, Result) and event.what.match == one.name:
            can = number in undoable(state) or is_free(state, number)
            return {"entry": number, "words": undo_words(state, event)} if can else None
    return None


def own_act(states: Mapping[int, Evening], event: int) -> dict[str, Any] | None:
    """Return the director's last action in any event, and what undoing it says.

    If several happened at the same time, `event` takes precedence.
    """
    found = [
        (one.events[one.numbers.index(number)], n, number)
        for n, one in states.items()
        if (number := own_last(one)) is not None
    ]
    if not found:
        return None
    act, n, number = max(found, key=lambda one: (one[0].at, one[1] == event))
    return {"number": number, "event": n, "undo": undo_words(states[n], act)}


def _read_of(request: Request) -> dict[int, int]:
    """Return each event's last entry that the director has read."""
    kept = request.session.get(_READ)
    found = kept if isinstance(kept, dict) else {}
    return {int(event): n for event, n in found.items() if str(event).isdecimal()}


def _undone_last(state: Evening) -> dict[str, Any] | None:
    """Return what was last undone, if nothing has been entered since."""
    last = next((one for one in reversed(state.log) if not one.by.startswith(BY_ITSELF)), None)
    number = redoable(state)
    if last is None or number is None or not isinstance(last.what, Undone):
        return None
    return {
        "event": state.event,
        "number": number,
        "what": event_words(state.undone[number].event.what, state),
    }


async def read(request: Request) -> Response:
    """Store that the director has read the last entry."""
    form = await directors_form(request)
    entries = [text.partition(".") for text in form.texts("entry")]
    numbers = [(event, rest) if rest else ("1", event) for event, _, rest in entries]
    request.session[_READ] = {
        event: int(n) for event, n in numbers if n.isdecimal() and len(n) < 8 and len(event) < 3
    }
    return RedirectResponse("/desk", status_code=303)


ROUTES = [
    Route("/desk", desk),
    Route("/desk/read", read, methods=["POST"]),
]
