"""The director's desk: call, enter, correct, forfeit, late, drop, undo; each one event."""

from __future__ import annotations

import asyncio
from typing import Any

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.answers.tournament.bracket_view import group_words
from evenbreak.answers.tournament.moves import (
    event_words,
)
from evenbreak.answers.tournament.night import bracket_table
from evenbreak.tournaments.evening.events import Result
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.later_draws import can_draw
from evenbreak.tournaments.evening.plan import FORMATS, FORMATS_WITH
from evenbreak.tournaments.evening.settling import tied_groups
from evenbreak.tournaments.evening.undoing import undoable
from evenbreak.web.evening_view import view_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import page, site_of
from evenbreak.web.sessions import check_director
from evenbreak.words import Sentence, say

RACES_TO_CHANGE = ("race", "losers_race", "final_race")
"""The races that can be changed."""


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
        "undoable": [
            (n, event_words(e.what, state), e.by_phones) for n, e in undoable(state).items()
        ],
    }
    if state.drawn:
        entered = [one.what.match for one in state.events if isinstance(one.what, Result)]
        shown["decided"] = [one for one in dict.fromkeys(entered[::-1]) if one in state.counted]
        phones = await asyncio.to_thread(site.night.phones)
        sides = (phones.sides(name, state.pair(name)) for name in state.standing.to_play)
        shown["sides"] = {one.match: one for one in sides if one.proposed}
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


ROUTES = [Route("/desk", desk)]
