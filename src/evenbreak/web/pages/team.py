"""A team night as seen by everyone, by each captain, and by the director.

Each entry is one event, and each form is accepted once.
"""

from __future__ import annotations

import asyncio
import hmac
from collections.abc import Callable, Sequence
from datetime import datetime
from functools import partial
from typing import Any

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.team.night import (
    chance_words,
    decided,
    history_words,
    last_words,
    needed_words,
    night_words,
    waiting_words,
)
from evenbreak.errors import EvenbreakError
from evenbreak.files.store.team_night import add_team_events
from evenbreak.handicaps.charts.chart_of import EVERY_CHART
from evenbreak.questions.teams import ORDERS, Lineup, OnTables
from evenbreak.ratings.scale import NAMES
from evenbreak.teams.evening import moves
from evenbreak.teams.evening.events import Event, Pick, Undone, What, check_plan
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.web.defaults import of_league
from evenbreak.web.forms import RACES, Form, directors_form, form_fields, form_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import asked_again, done, page, site_of
from evenbreak.web.sessions import (
    CAPTAIN,
    DIRECTOR,
    DIRECTORS_PAGE,
    author_words,
    captain_of,
    captain_of_team,
    check_director,
    check_tries,
    is_director,
    let_in,
    let_out,
    wrong_pin,
)
from evenbreak.web.site import Site
from evenbreak.web.team_form import FIELDS, TIMES, plan_of
from evenbreak.web.team_night import TeamNow, night_on
from evenbreak.web.team_view import captain_values, plain_options, set_views
from evenbreak.words import Sentence, say

_MOST_PLAYERS = 2

Decide = Callable[[TeamEvening], list[What]]


async def team(request: Request) -> Response:
    """Show the night: the sets and the chances for everyone, and advice for a captain."""
    teams = site_of(request).teams
    now = await teams.now()
    if now is None:
        return page(request, "team_none.html")
    captain = captain_of(request, now.state.began)
    shown = await seen_values(request, now, captain)
    shown |= {
        "captain": captain,
        "mine": None if captain is None else await _for_captain(request, now, captain),
        "desk": (
            await asyncio.to_thread(_for_director, request, now) if is_director(request) else None
        ),
    }
    return page(request, "team.html", live=True, **shown)


async def seen_values(request: Request, now: TeamNow, viewer: int | None) -> dict[str, Any]:
    """Return what a reader may see of a night: as a captain (0 or 1), or `EVERYBODY`."""
    site, seen = site_of(request), now.state.seen_by(viewer)
    chances = await site.teams.chances(now)
    is_over = decided(seen, chances)
    return {
        "state": seen,
        "sets": set_views(seen),
        "played": night_words(seen),
        "needed": needed_words(seen, chances),
        "chances": chances,
        "decided": is_over,
        "times": [] if is_over else await site.teams.times(now, site.clock()),
        "chance_words": chance_words(seen, chances) if chances else "",
        "waiting": waiting_words(seen),
        "due": now.state.due,
    }


async def _for_captain(request: Request, now: TeamNow, captain: int) -> dict[str, Any]:
    """Return what only this captain may see."""
    site = site_of(request)
    found = await site.teams.advised(now, captain)
    line = now.state.to_name
    lot = site.captain_lot(now.state.began, captain, line.number if line else 0)
    return await asyncio.to_thread(captain_values, now.state, captain, found, lot)


def _for_director(request: Request, now: TeamNow) -> dict[str, Any]:
    """Return what only the director may see, without unseen picks or advice."""
    site, state = site_of(request), now.state
    line = state.to_name
    return {
        "pins": [(name, site.captain_pin(state.began, k)) for k, name in enumerate(state.teams)],
        "seen": len(now.events),
        "by": DIRECTORS_PAGE,
        "last": state.last,
        "last_by": author_words(state.last.by),
        "said": last_words(state),
        "number": line.number if line else 0,
        "options": {} if state.sealed else {k: plain_options(state, k) for k in state.due},
    }


async def history(request: Request) -> Response:
    """Show who entered what, and when."""
    check_director(request)
    now = await night_on(request)
    words = history_words(now.events, now.state)
    rows = [
        (number, f"{datetime.fromisoformat(one.at):%H:%M}", said, author_words(one.by), "")
        for number, (one, said) in enumerate(zip(now.events, words, strict=True), 1)
    ]
    return page(request, "history.html", rows=rows[::-1], again=(), undo=False)


async def ask(request: Request) -> Response:
    """Show the form that starts a team night."""
    check_director(request)
    return page(request, "team_new.html", entered={}, why="", **await _choices(site_of(request)))


async def _choices(site: Site) -> dict[str, Any]:
    """Return the choices available, and the page's warnings."""
    return {
        "on": await site.teams.now(),
        "fields": {one.name: one for one in form_fields([*FIELDS, *TIMES])},
        "orders": ORDERS,
        "races": RACES,
        "charts": EVERY_CHART,
        "of_league": of_league(OnTables, site.rules, charts=EVERY_CHART)
        | of_league(Lineup, site.rules, charts=EVERY_CHART, orders=ORDERS),
        "scales": NAMES,
    }


async def begin(request: Request) -> Response:
    """Start a team night; a rejected form comes back as it was filled in."""
    site = site_of(request)
    form = await directors_form(request)
    try:
        plan, warnings = await asyncio.to_thread(plan_of, form, site.league, site.rules)
        await site.night.beside.run(partial(check_plan, plan))
    except (RefusalError, EvenbreakError) as error:
        return asked_again(request, "team_new.html", form, error, **await _choices(site))

    def decide(_: list[Event], state: TeamEvening | None) -> Sequence[What]:
        return moves.begin(state, plan)

    at, key = site.clock(), form.key("/team/new", repr(plan))
    await asyncio.to_thread(add_team_events, site.path, decide, at=at, by=DIRECTORS_PAGE, form=key)
    site.keep_secrets()
    return done(request, "/team", *warnings)


async def enter_pin(request: Request) -> Response:
    """Log a captain in."""
    form = await form_of(request)
    site, now = site_of(request), await night_on(request)
    check_tries(request)
    given = form.text("pin").encode()
    for side in (0, 1):
        if hmac.compare_digest(given, site.captain_pin(now.state.began, side).encode()):
            let_in(request, CAPTAIN, site.captain_mark(now.state.began, side))
            return done(request, "/team")
    raise wrong_pin(request)


async def leave(request: Request) -> Response:
    """Log a captain out."""
    await form_of(request)
    await asyncio.to_thread(let_out, request, CAPTAIN)
    return done(request, "/team")


async def put(request: Request) -> Response:
    """Put someone up."""
    form = await form_of(request)
    now = await night_on(request)
    by, side = _author(request, now.state, form)
    number = form.whole("number", 1, len(now.state.sets))
    pick = _pick(form, "pick", now.state, side)

    def decide(state: TeamEvening) -> list[What]:
        if by == DIRECTORS_PAGE:
            _refuse_unseen(state, side, number)
        return moves.put_up(state, side, number, pick)

    _, added = await _add(request, form, by, decide)
    return _taken(request, added, say("{name} plays set {n}.", name=" + ".join(pick), n=number))


async def hand(request: Request) -> Response:
    """Submit a whole lineup."""
    form = await form_of(request)
    now = await night_on(request)
    by, side = _author(request, now.state, form)
    picks = tuple(_pick(form, f"pick{line.number}", now.state, side) for line in now.state.sets)

    def decide(state: TeamEvening) -> list[What]:
        if by == DIRECTORS_PAGE:
            _refuse_unseen(state, side, 1)
        return moves.hand_in(state, side, picks)

    _, added = await _add(request, form, by, decide)
    return _taken(request, added, say("The lineup is handed in."))


async def result(request: Request) -> Response:
    """Accept a set's result: a captain proposes it, or the director enters it."""
    form = await form_of(request)
    now = await night_on(request)
    number = form.whole("number", 1, len(now.state.sets))
    score = form.whole("a", 0, 999), form.whole("b", 0, 999)
    if form.text("by") == DIRECTOR:
        check_director(request)
        _, added = await _add(
            request, form, DIRECTORS_PAGE, lambda state: moves.result(state, number, score)
        )
        return _taken(request, added, say("The result of set {n} is in.", n=number))
    by, side = _author(request, now.state, form)
    state, added = await _add(
        request, form, by, lambda state: moves.propose(state, side, number, score)
    )
    line, other = state.sets[number - 1], state.teams[1 - side]
    if line.score:
        return _taken(
            request, added, say("Both captains agree. The result of set {n} is in.", n=number)
        )
    if line.said[1 - side] not in (None, score):
        return _taken(
            request,
            added,
            say(
                "{name} entered a different result. Please agree, or go to the director.",
                name=other,
            ),
        )
    return _taken(
        request, added, say("Sent. It counts once {name} or the director confirms it.", name=other)
    )


async def undo(request: Request) -> Response:
    """Take back the last entry, if nothing has come in since the page was made."""
    form = await directors_form(request)
    seen = form.whole("seen", 0, 10**7)

    def decide(events: list[Event], _: TeamEvening | None) -> Sequence[What]:
        if len(events) != seen:
            raise RefusalError(
                "Something was entered after you opened this page. Check it before you undo.",
                status=409,
            )
        return [Undone()]

    await asyncio.to_thread(_write, request, decide, form, DIRECTORS_PAGE)
    return done(request, "/team", say("The last entry has been undone."))


def _author(request: Request, state: TeamEvening, form: Form) -> tuple[str, int]:
    """Return who is entering something, and for which team; reject anyone not allowed to."""
    if form.text("by") == DIRECTOR:
        check_director(request)
        return DIRECTORS_PAGE, form.whole("team", 0, 1)
    side = captain_of(request, state.began)
    if side is None or form.text("by") != str(side):
        raise RefusalError(
            "Only that team's captain can do that. Enter the captain's PIN first.", status=403
        )
    return captain_of_team(state.teams[side]), side


def _refuse_unseen(state: TeamEvening, side: int, number: int) -> None:
    """Keep the director from finding out by guessing what a captain has submitted unseen."""
    if not state.open(number) and state.sets[number - 1].picks[side]:
        raise RefusalError(
            "{name} has already handed in a pick for this set. Undo that first, or let the "
            "captain change it.",
            status=409,
            name=state.teams[side],
        )


def _pick(form: Form, field: str, state: TeamEvening, side: int) -> Pick:
    """Return the players that a field names by their places in the squad."""
    squad = state.plan.teams[side].players
    text = form.text(field, longest=12)
    places = [int(part) for part in text.split(",") if part.isascii() and part.isdigit()]
    if not 1 <= len(places) <= _MOST_PLAYERS or max(places) >= len(squad):
        raise RefusalError("Choose a player first.")
    return tuple(squad[place] for place in places)


async def _add(request: Request, form: Form, by: str, decide: Decide) -> tuple[TeamEvening, bool]:
    """Add a decision to the night that the form was made for."""
    night = form.whole("night", 1, 10**7)

    def decided(_: list[Event], state: TeamEvening | None) -> Sequence[What]:
        if state is None or state.began != night:
            raise RefusalError(
                "Another team night was started in the meantime. Open the page again.", status=409
            )
        return decide(state)

    state, added = await asyncio.to_thread(_write, request, decided, form, by)
    if state is None:
        raise RefusalError("No team night is running yet.", status=404)
    return state, added


def _write(request: Request, decide: Any, form: Form, by: str) -> tuple[TeamEvening | None, bool]:
    site = site_of(request)
    return add_team_events(
        site.path, decide, at=site.clock(), by=by, form=form.key(request.url.path)
    )


def _taken(request: Request, added: bool, words: Sentence) -> Response:
    """Return to the night, and say what was accepted, or that it was already there."""
    return done(request, "/team", words if added else say("That has already been entered."))


ROUTES = [
    Route("/team", team),
    Route("/team/history", history),
    Route("/team/new", ask, methods=["GET"]),
    Route("/team/new", begin, methods=["POST"]),
    Route("/team/pin", enter_pin, methods=["POST"]),
    Route("/team/leave", leave, methods=["POST"]),
    Route("/team/put", put, methods=["POST"]),
    Route("/team/hand", hand, methods=["POST"]),
    Route("/team/result", result, methods=["POST"]),
    Route("/team/undo", undo, methods=["POST"]),
]
