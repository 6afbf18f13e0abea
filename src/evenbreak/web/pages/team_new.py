"""A team night begun: two teams, typed, pasted or uploaded, and what they play."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from functools import partial
from typing import Any

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.errors import EvenbreakError
from evenbreak.files.store.team_night import add_team_events
from evenbreak.handicaps.charts.chart import CHARTS
from evenbreak.questions.teams import ORDERS
from evenbreak.ratings.scale import NAMES
from evenbreak.teams.evening import moves
from evenbreak.teams.evening.events import Event, What
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.teams.evening.plan import check_plan
from evenbreak.web.asked import form_fields
from evenbreak.web.authors import DIRECTOR
from evenbreak.web.forms import RACES, form_of
from evenbreak.web.page import asked_again, done, page, site_of
from evenbreak.web.refusals import RefusalError
from evenbreak.web.sessions import check_director
from evenbreak.web.site import Site
from evenbreak.web.team_form import FIELDS, plan_of


async def ask(request: Request) -> Response:
    """Show the form that begins a team night."""
    check_director(request)
    return page(request, "team_new.html", entered={}, why="", **await _choices(site_of(request)))


async def _choices(site: Site) -> dict[str, Any]:
    """Return what there is to choose from, and what the page warns of."""
    return {
        "on": await site.teams.now(),
        "fields": {one.name: one for one in form_fields(FIELDS)},
        "orders": ORDERS,
        "races": RACES,
        "charts": CHARTS,
        "scales": NAMES,
    }


async def begin(request: Request) -> Response:
    """Begin a team night; a form that is refused comes back as it was filled in."""
    site = site_of(request)
    form = await form_of(request)
    check_director(request)
    try:
        plan, warnings = await asyncio.to_thread(plan_of, form, site.league)
        await site.night.beside.run(partial(check_plan, plan))
    except (RefusalError, EvenbreakError) as error:
        return asked_again(request, "team_new.html", form, error, **await _choices(site))

    def decide(_: list[Event], state: TeamEvening | None) -> Sequence[What]:
        return moves.begin(state, plan)

    at, key = site.clock(), form.key("/team/new", repr(plan))
    await asyncio.to_thread(add_team_events, site.path, decide, at=at, by=DIRECTOR, form=key)
    site.keep_secrets()
    return done(request, "/team", *warnings)


ROUTES = [
    Route("/team/new", ask, methods=["GET"]),
    Route("/team/new", begin, methods=["POST"]),
]
