"""The director's desk: call, enter, correct, forfeit, late, drop, undo; each one event."""

from __future__ import annotations

import asyncio
import hashlib
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.answers.tournament.bracket_view import group_words
from evenbreak.answers.tournament.moves import (
    draw_words,
    event_words,
    forfeited,
    happened,
    lost_words,
    reopened,
    settled_words,
    tie_words,
    undone_words,
)
from evenbreak.answers.tournament.night import bracket_table
from evenbreak.answers.tournament.tournament import races_words
from evenbreak.files.store.desk import phone_entries, sides_between
from evenbreak.files.store.tournament import add_events
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Event, Result, What
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.later_draws import can_draw
from evenbreak.tournaments.evening.plan import FORMATS, FORMATS_WITH
from evenbreak.tournaments.evening.settling import TieBreak, break_ties, stand, tied_groups
from evenbreak.tournaments.evening.undoing import losses, matches_of, undoable
from evenbreak.tournaments.evening.undoing import undo as take_back
from evenbreak.web.evening_view import view_of
from evenbreak.web.forms import Form, entered_name, entered_rating, form_of, rating_doubts, whole
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import done, in_words, page, site_of
from evenbreak.web.sessions import DIRECTORS_PAGE, check_director
from evenbreak.words import Sentence, say

RACES_TO_CHANGE = ("race", "losers_race", "final_race")
"""The races that can be changed."""

Decide = Callable[[Evening], Sequence[What]]
Said = Callable[[Evening, Evening], Sequence[str]]


async def desk(request: Request) -> Response:
    """Show all that the director can do now."""
    check_director(request)
    site = site_of(request)
    if not site.night.exists:
        if await site.teams.now() is not None:
            return RedirectResponse("/team", status_code=303)
        raise RefusalError("No tournament is running yet.", status=404)
    known = await site.night.outlook()
    state = await asyncio.to_thread(site.night.state)
    shown: dict[str, Any] = {
        "view": view_of(state, known),
        "decided": [],
        "sides": {},
        "warnings": [],
        "tied": [],
        "drawable": False,
        "changeable": _changeable(state),
        "undoable": [(n, event_words(e.what), e.by_phones) for n, e in undoable(state).items()],
    }
    if state.drawn:
        entered = [one.what.match for one in state.events if isinstance(one.what, Result)]
        shown["decided"] = [one for one in dict.fromkeys(entered[::-1]) if one in state.counted]
        sent = await asyncio.to_thread(phone_entries, site.path)
        shown["sides"] = {
            name: sides_between((one for one in sent if one.match == name), state.pair(name))
            for name in dict.fromkeys(one.match for one in sent)
            if name in state.standing.to_play
        }
        shown["tied"] = [group_words(name) for name in tied_groups(state)]
        shown["drawable"] = can_draw(state)
        shown["rows"] = bracket_table(state).rows
        shown["warnings"] = known.data.get("warnings", []) if known else []
        if known and known.problem:
            why = known.problem
            shown["warnings"] = [say("Odds and finish time can't be calculated: {why}", why=why)]
    return page(request, "desk.html", live=True, **shown)


def _changeable(state: Evening) -> dict[str, Sentence]:
    """Return what can be changed under way, with what it is now: the tables, and the races."""
    plan = state.plan
    tables = {"tables": say("Tables (now {now})", now=plan.tables)}
    if plan.chart is not None or plan.form == "chips":
        return tables
    losers, final = plan.losers_race or plan.race, plan.final_race or plan.race
    races = {
        "race": say("Race to (now {now})", now=plan.race),
        "losers_race": say("Race on the losers' side (now {now})", now=losers),
        "final_race": say("Race in the final (now {now})", now=final),
    }
    return tables | {
        name: races[name]
        for name in RACES_TO_CHANGE
        if plan.form in FORMATS_WITH.get(name, FORMATS)
    }


class _AskError(Exception):
    """What is entered takes something away, or is to be asked about in any case."""

    def __init__(self, before: Evening, after: Evening) -> None:
        self.before, self.after = before, after


async def _enter(
    request: Request, form: Form, decide: Decide, said: Said, *, always: bool = False
) -> Response:
    """Enter what is decided; if it takes something away, ask first, and name it.

    The answer is for what was named: if that has changed by then, it is asked again.
    """
    site = site_of(request)
    at, key = site.clock(), form.key(request.url.path)
    named, sure = form.text("named"), form.text("sure")

    def check(before: Evening, after: Evening) -> None:
        found = losses(before, after)
        meant = sure and named in ("", _name_of(before, after))
        if (found or always) and not meant:
            raise _AskError(before, after)

    def work() -> tuple[Evening, Evening]:
        def events(state: Evening) -> list[Event]:
            return [Event(at, what) for what in decide(state)]

        return add_events(site.path, events, by=DIRECTORS_PAGE, form=key, check=check)

    try:
        before, after = await asyncio.to_thread(work)
    except _AskError as asked:
        return _ask(request, form, said, asked)
    return done(request, "/desk", *said(before, after))


def _ask(request: Request, form: Form, said: Said, asked: _AskError) -> Response:
    """Ask whether it is meant, with the same number, so that two answers enter it once."""
    fields = dict(form.fields) | {"named": _name_of(asked.before, asked.after)}
    for name in ("csrf", "sure"):
        fields.pop(name, None)
    lost = lost_words(asked.before, asked.after)
    lines = [in_words(request, one) for one in (*lost, *said(asked.before, asked.after))]
    return page(request, "sure.html", fields=fields, lines=lines, lost=lost)


def _name_of(before: Evening, after: Evening) -> str:
    """Return what a question is known by: the matches that it is about, and those in play."""
    lost = sorted((one.match, *sorted(one.players)) for one in losses(before, after))
    text = repr((sorted(matches_of(before, after)), lost))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


async def _form(request: Request) -> Form:
    form = await form_of(request)
    check_director(request)
    return form


async def draw(request: Request) -> Response:
    """Make the draw, or what is drawn next."""
    form = await _form(request)
    rng = np.random.default_rng()
    return await _enter(
        request,
        form,
        lambda state: moves.draw_next(state, rng),
        lambda before, after: [draw_words(before, after)],
    )


async def call(request: Request) -> Response:
    """Call matches to tables."""
    form = await _form(request)
    matches, tables = form.texts("match"), form.texts("table")
    if len(matches) != len(tables):
        raise RefusalError("A match has no table, or a table has no match. Open the page again.")
    calls = {
        name: whole("table", table, 1, 1000) for name, table in zip(matches, tables, strict=True)
    }

    def decide(state: Evening) -> list[What]:
        called: list[What] = []
        for match, table in calls.items():
            on = state.on_tables.get(match)
            if on is None or on.call.table != table:  # else it is the same tap again
                called.append(moves.call(state, match, table))
                state = evening([*state.events, Event(site_of(request).clock(), called[-1])])
        return called

    def said(_: Evening, after: Evening) -> list[str]:
        found = [after.on_tables[moves.known_match(after, match)].call for match in calls]
        return [
            say(
                "Table {table}: {match}, {names}.",
                match=one.match,
                names=" – ".join(one.players),
                table=one.table,
            )
            for one in found
        ]

    return await _enter(request, form, decide, said)


async def result(request: Request) -> Response:
    """Enter the result of a match, or correct it."""
    form = await _form(request)
    match = form.text("match")
    score = form.whole("a", 0, 999), form.whole("b", 0, 999)
    correct = form.one_of("how", ("new", "correct")) == "correct"

    def decide(state: Evening) -> list[What]:
        there = state.counted.get(match)
        if there is not None and not there.forfeit:
            pair = state.pair(match)
            if (there.games[pair[0]], there.games[pair[1]]) == score:
                return []  # the same tap again
        return [
            moves.correct(state, match, score) if correct else moves.result(state, match, score)
        ]

    def said(before: Evening, after: Evening) -> Sequence[str]:
        if len(before.events) == len(after.events):
            return [say("That result has already been entered.")]
        return happened(before, after, after.events[-1])

    return await _enter(request, form, decide, said)


async def forfeit(request: Request) -> Response:
    """Let a player forfeit the match that they can play."""
    return await _leave(request, moves.forfeit)


async def drop(request: Request) -> Response:
    """Let a player go home."""
    return await _leave(request, moves.drop)


async def _leave(request: Request, move: Callable[[Evening, str], What]) -> Response:
    form = await _form(request)
    player = form.text("player")
    return await _enter(request, form, lambda state: [move(state, player)], forfeited, always=True)


async def entrant(request: Request) -> Response:
    """Correct a name or a rating before the draw."""
    form = await _form(request)
    player, name, stated = form.text("player"), entered_name(form), entered_rating(form)

    def decide(state: Evening) -> list[What]:
        if state.drawn:
            raise RefusalError("The draw has been made. Undo it to correct an entry.", status=409)
        return [moves.edit(state, player, name=name, rating=stated)]

    return await _enter(request, form, decide, lambda _, after: rating_doubts(after))


async def change(request: Request) -> Response:
    """Change the tables, or the races of the matches that have not begun."""
    form = await _form(request)
    tables = form.whole("tables", 0, 1000, default=0)
    races = {name: form.whole(name, 0, 100, default=0) for name in RACES_TO_CHANGE}

    def decide(state: Evening) -> list[What]:
        asked: dict[str, Any] = {n: k for n, k in ({"tables": tables} | races).items() if k}
        return [moves.change(state, **asked)]

    def said(_: Evening, after: Evening) -> list[str]:
        words = in_words(request, races_words(after.races))
        return [say("{tables} tables. {races}.", tables=after.plan.tables, races=words)]

    return await _enter(request, form, decide, said)


async def tiebreak(request: Request) -> Response:
    """Break the ties of a group whose matches are played."""
    form = await _form(request)
    rng = np.random.default_rng()
    found: list[TieBreak] = []

    def decide(state: Evening) -> list[What]:
        found.append(break_ties(state, rng))
        return [found[-1].ranked]

    return await _enter(request, form, decide, lambda _, __: tie_words(found[-1]))


async def let_stand(request: Request) -> Response:
    """Let a match stand that was played before a correction sent somebody else into it."""
    form = await _form(request)
    match = form.text("match")
    return await _enter(
        request,
        form,
        lambda state: stand(state, match),
        lambda before, after: [*settled_words(before, after), *reopened(before, after)],
    )


async def call_back(request: Request) -> Response:
    """Take a match off its table."""
    form = await _form(request)
    match = form.text("match")

    def said(before: Evening, _: Evening) -> list[str]:
        table = before.on_tables[moves.known_match(before, match)].call.table
        return [say("{match} is off table {table}.", match=match, table=table)]

    return await _enter(request, form, lambda state: [moves.call_back(state, match)], said)


async def undo(request: Request) -> Response:
    """Take back the entry that the page named, as long as it is the last of its kind."""
    form = await _form(request)
    entry = form.whole("entry", 2, 10**7)

    def decide(state: Evening) -> list[What]:
        if entry not in undoable(state):
            raise RefusalError(
                "Something was entered after you opened this page. Check it before you undo.",
                status=409,
            )
        return [take_back(state, entry)]

    def said(before: Evening, after: Evening) -> list[str]:
        gone = dict(zip(before.numbers, before.events, strict=True))[entry]
        return [undone_words(gone.what), *reopened(before, after)]

    return await _enter(request, form, decide, said)


ROUTES = [
    Route("/desk", desk),
    Route("/desk/stand", let_stand, methods=["POST"]),
    Route("/desk/back", call_back, methods=["POST"]),
    *(
        Route(f"/desk/{one.__name__}", one, methods=["POST"])
        for one in (draw, call, result, forfeit, drop, entrant, change, tiebreak, undo)
    ),
]
