"""A team night: what everybody sees, what each captain sees, and what they and the director do."""

from __future__ import annotations

import asyncio
import hmac
from collections.abc import Callable, Sequence
from datetime import datetime
from typing import Any

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.team_night import (
    cap_words,
    chance_words,
    history_words,
    last_words,
    needed_words,
    night_words,
    waiting_words,
)
from evenbreak.files.team_night_store import add_team_events
from evenbreak.teams.advice import Advice
from evenbreak.teams.evening import moves
from evenbreak.teams.evening.events import Event, Pick, Undone, What
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.teams.sealed import SealedNight
from evenbreak.web.forms import Form, form_of
from evenbreak.web.page import done, language, page, site_of
from evenbreak.web.pages.desk import BY
from evenbreak.web.refusals import RefusalError
from evenbreak.web.sessions import check_director, check_tries, is_director, phone_of, wrong_pin
from evenbreak.web.team_night import TeamNow
from evenbreak.web.team_view import (
    advised_line_ups,
    advised_options,
    drawn,
    drawn_line_up,
    pick_value,
    plain_options,
    set_views,
)
from evenbreak.web.words import say

_CAPTAIN = "captain"
_DIRECTOR = "director"
_MOST_PLAYERS = 2

Decide = Callable[[TeamEvening], list[What]]


async def team(request: Request) -> Response:
    """Show the night: to everybody the sets and the chances, to a captain the advice too."""
    teams = site_of(request).teams
    now = await teams.now()
    if now is None:
        return page(request, "team_none.html")
    captain = captain_of(request, now.state)
    shown = await seen_values(request, now, captain)
    shown |= {
        "captain": captain,
        "mine": None if captain is None else await _for_captain(request, now, captain),
        "desk": _for_director(request, now) if is_director(request) else None,
        "once": f"{phone_of(request)}.{len(now.events)}",
    }
    return page(request, "team.html", live=True, **shown)


async def seen_values(request: Request, now: TeamNow, viewer: int | None) -> dict[str, Any]:
    """Return what a reader may see of a night: a captain (0 or 1), or `EVERYBODY`."""
    chances = await site_of(request).teams.chances(now)
    seen = now.state.seen_by(viewer)
    return {
        "state": seen,
        "sets": set_views(seen),
        "played": night_words(seen),
        "needed": needed_words(seen, chances),
        "chances": chances,
        "chance_words": chance_words(seen, chances) if chances else "",
        "waiting": waiting_words(seen),
        "due": now.state.due,
    }


async def _for_captain(request: Request, now: TeamNow, captain: int) -> dict[str, Any]:
    """Return what only this captain may see."""
    state = now.state.seen_by(captain)
    line = state.to_name
    found = await site_of(request).teams.advised(now, captain) if line else None
    own = line.picks[captain] if line else ()
    handed_in = bool(own) and line is not None and state.unseen(line.number)
    may_pick = line is not None and (captain in now.state.due or handed_in)
    options = []
    if found and isinstance(found.found, SealedNight):
        options = advised_line_ups(found.found)
    elif found and may_pick and isinstance(found.found, Advice):
        options = advised_options(state, captain, found.found)
    elif may_pick:
        options = plain_options(state, captain)
    chosen, line_up = pick_value(state, captain, own), _line_up(state, captain)
    lot = site_of(request).captain_lot(state.began, captain, line.number if line else 0)
    lots = drawn(options, lot) if may_pick and not state.sealed else None
    if found and isinstance(found.found, SealedNight) and not own:
        line_up = drawn_line_up(found.found, state.plan.teams[captain].players, lot)
    elif not own and options:
        chosen = (lots or options[0]).value
    return {
        "line": line,
        "may_pick": may_pick,
        "handed_in": handed_in,
        "named": bool(own),
        "chosen": chosen,
        "lots": lots,
        "options": options,
        "words": found.answer.sentences[0] if found else "",
        "working": line is not None and bool(now.state.due) and found is None,
        "caps": cap_words(state, captain),
        "line_up": line_up,
        "squad": state.plan.teams[captain].players,
    }


def _line_up(state: TeamEvening, captain: int) -> list[str]:
    return [pick_value(state, captain, one.picks[captain]) for one in state.sets]


def _for_director(request: Request, now: TeamNow) -> dict[str, Any]:
    """Return what only the director may see; no pick that is still unseen, and no advice."""
    site, state = site_of(request), now.state
    line = state.to_name
    return {
        "pins": [(name, site.captain_pin(state.began, k)) for k, name in enumerate(state.teams)],
        "seen": len(now.events),
        "last": last_words(state),
        "number": line.number if line else 0,
        "options": {} if state.sealed else {k: plain_options(state, k) for k in state.due},
    }


def captain_of(request: Request, state: TeamEvening) -> int | None:
    """Return whose captain's PIN was entered in this session tonight; None: nobody's."""
    mark = request.session.get(_CAPTAIN)
    for side in (0, 1):
        own = site_of(request).captain_mark(state.began, side)
        if isinstance(mark, str) and hmac.compare_digest(mark.encode(), own.encode()):
            return side
    return None


async def enter_pin(request: Request) -> Response:
    """Let a captain in."""
    form = await form_of(request)
    site, now = site_of(request), await _now(request)
    check_tries(request)
    given = form.text("pin").encode()
    for side in (0, 1):
        if hmac.compare_digest(given, site.captain_pin(now.state.began, side).encode()):
            request.session[_CAPTAIN] = site.captain_mark(now.state.began, side)
            return done(request, "/team")
    raise wrong_pin(request)


async def leave(request: Request) -> Response:
    """Let a captain out."""
    await form_of(request)
    request.session.pop(_CAPTAIN, None)
    return done(request, "/team")


async def put(request: Request) -> Response:
    """Put somebody up."""
    form = await form_of(request)
    now = await _now(request)
    by, side = _author(request, now.state, form)
    number = form.whole("number", 1, len(now.state.sets))
    pick = _pick(form, "pick", now.state, side)

    def decide(state: TeamEvening) -> list[What]:
        if by == BY:
            _refuse_unseen(state, side, number)
        return moves.put_up(state, side, number, pick)

    _, added = await _add(request, form, by, decide)
    return _taken(request, added, "team_put", name=" + ".join(pick), n=number)


async def hand(request: Request) -> Response:
    """Hand in a whole line-up."""
    form = await form_of(request)
    now = await _now(request)
    by, side = _author(request, now.state, form)
    picks = tuple(_pick(form, f"pick{line.number}", now.state, side) for line in now.state.sets)

    def decide(state: TeamEvening) -> list[What]:
        if by == BY:
            _refuse_unseen(state, side, 1)
        return moves.hand_in(state, side, picks)

    _, added = await _add(request, form, by, decide)
    return _taken(request, added, "team_handed")


async def result(request: Request) -> Response:
    """Take the result of a set: a captain proposes it, the director enters it."""
    form = await form_of(request)
    now = await _now(request)
    number = form.whole("number", 1, len(now.state.sets))
    score = form.whole("a", 0, 999), form.whole("b", 0, 999)
    if form.text("by") == _DIRECTOR:
        check_director(request)
        _, added = await _add(request, form, BY, lambda state: moves.result(state, number, score))
        return _taken(request, added, "team_result", n=number)
    by, side = _author(request, now.state, form)
    state, added = await _add(
        request, form, by, lambda state: moves.propose(state, side, number, score)
    )
    line, other = state.sets[number - 1], state.teams[1 - side]
    if line.score:
        return _taken(request, added, "team_agreed", n=number)
    if line.said[1 - side] not in (None, score):
        return _taken(request, added, "team_differ", name=other)
    return _taken(request, added, "team_proposed", name=other)


async def undo(request: Request) -> Response:
    """Take back what happened last, if nothing has come in since the page was made."""
    form = await form_of(request)
    check_director(request)
    seen = form.whole("seen", 0, 10**7)

    def decide(events: list[Event], _: TeamEvening | None) -> Sequence[What]:
        if len(events) != seen:
            raise RefusalError("refused_changed", status=409)
        return [Undone()]

    await asyncio.to_thread(_write, request, decide, form, BY)
    return done(request, "/team", say(language(request), "undone"))


async def history(request: Request) -> Response:
    """Show who entered what, and when."""
    check_director(request)
    now = await _now(request)
    words = history_words(now.events, now.state)
    rows = [
        (number, f"{datetime.fromisoformat(one.at):%H:%M:%S}", said, one.by)
        for number, (one, said) in enumerate(zip(now.events, words, strict=True), 1)
    ]
    return page(request, "history.html", rows=rows[::-1])


async def _now(request: Request) -> TeamNow:
    now = await site_of(request).teams.now()
    if now is None:
        raise RefusalError("refused_no_night", status=404)
    return now


def _author(request: Request, state: TeamEvening, form: Form) -> tuple[str, int]:
    """Return who enters something, and for which team; refuse whoever may not."""
    if form.text("by") == _DIRECTOR:
        check_director(request)
        return BY, form.whole("team", 0, 1)
    side = captain_of(request, state)
    if side is None or form.text("by") != str(side):
        raise RefusalError("refused_captain", status=403)
    return f"captain of {state.teams[side]}", side


def _refuse_unseen(state: TeamEvening, side: int, number: int) -> None:
    """Refuse to let the director find out by guessing what a captain has handed in unseen."""
    if not state.open(number) and state.sets[number - 1].picks[side]:
        raise RefusalError("refused_handed_in", status=409, name=state.teams[side])


def _pick(form: Form, field: str, state: TeamEvening, side: int) -> Pick:
    """Return the players that a field names by their places in the squad."""
    squad = state.plan.teams[side].players
    text = form.text(field, longest=12)
    places = [int(part) for part in text.split(",") if part.isascii() and part.isdigit()]
    if not 1 <= len(places) <= _MOST_PLAYERS or max(places) >= len(squad):
        raise RefusalError("refused_nobody_chosen")
    return tuple(squad[place] for place in places)


async def _add(request: Request, form: Form, by: str, decide: Decide) -> tuple[TeamEvening, bool]:
    """Add what is decided to the night that the form was made for."""
    night = form.whole("night", 1, 10**7)

    def decided(_: list[Event], state: TeamEvening | None) -> Sequence[What]:
        if state is None or state.began != night:
            raise RefusalError("refused_other_night", status=409)
        return decide(state)

    state, added = await asyncio.to_thread(_write, request, decided, form, by)
    if state is None:
        raise RefusalError("refused_no_night", status=404)
    return state, added


def _write(request: Request, decide: Any, form: Form, by: str) -> tuple[TeamEvening | None, bool]:
    site = site_of(request)
    return add_team_events(
        site.path, decide, at=site.clock(), by=by, form=form.key(request.url.path)
    )


def _taken(request: Request, added: bool, key: str, **values: object) -> Response:
    """Return to the night, and say what was taken, or that it was there already."""
    code = language(request)
    return done(request, "/team", say(code, key if added else "team_there", **values))


ROUTES = [
    Route("/team", team),
    Route("/team/pin", enter_pin, methods=["POST"]),
    Route("/team/leave", leave, methods=["POST"]),
    Route("/team/put", put, methods=["POST"]),
    Route("/team/hand", hand, methods=["POST"]),
    Route("/team/result", result, methods=["POST"]),
    Route("/team/undo", undo, methods=["POST"]),
    Route("/team/history", history),
]
