"""A team night begun: two teams, typed, pasted or uploaded, and what they play."""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Sequence
from functools import partial

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.files.team_night_store import add_team_events
from evenbreak.handicaps.charts.chart import CHARTS
from evenbreak.ratings.scale import SCALES
from evenbreak.teams.evening import moves
from evenbreak.teams.evening.events import Event, What
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.teams.evening.plan import check_plan
from evenbreak.web.forms import Form, form_of
from evenbreak.web.page import done, page, site_of
from evenbreak.web.pages.desk import BY
from evenbreak.web.sessions import check_director
from evenbreak.web.team_form import COUNT_WORDS, ORDERS, RACES, plan_of


async def ask(request: Request) -> Response:
    """Show the form that begins a team night."""
    check_director(request)
    return page(
        request,
        "team_new.html",
        on=await site_of(request).teams.now(),
        orders=ORDERS,
        races=RACES,
        charts=CHARTS,
        counts=COUNT_WORDS,
        scales=list(SCALES),
        once=secrets.token_urlsafe(9),
    )


async def begin(request: Request) -> Response:
    """Begin a team night."""
    site = site_of(request)
    async with request.form(max_files=2, max_fields=40) as fields:
        await form_of(request)
        check_director(request)
        form = Form(fields)
        plan, warnings = await plan_of(form, site.league)
    await site.night.beside.run(partial(check_plan, plan))

    def decide(_: list[Event], state: TeamEvening | None) -> Sequence[What]:
        return moves.begin(state, plan)

    at, key = site.clock(), form.key("/team/new", repr(plan))
    await asyncio.to_thread(add_team_events, site.path, decide, at=at, by=BY, form=key)
    site.keep_secrets()
    return done(request, "/team", *warnings)


ROUTES = [
    Route("/team/new", ask, methods=["GET"]),
    Route("/team/new", begin, methods=["POST"]),
]
