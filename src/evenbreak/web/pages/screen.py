"""The screen on the wall: tables now and next, the odds, the finish; no controls."""

from __future__ import annotations

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.teams.evening.fold import EVERYBODY
from evenbreak.web.evening_view import view_of
from evenbreak.web.page import page, site_of
from evenbreak.web.pages.team import seen_values


async def screen(request: Request) -> Response:
    """Show what everybody in the room wants to see, in letters for eight metres."""
    night = site_of(request).night
    view, prizes = None, []
    teams = None if night.exists else await site_of(request).teams.now()
    if teams is not None:
        shown = await seen_values(request, teams, EVERYBODY)
        return page(request, "team_screen.html", live=True, **shown)
    if night.exists:
        known = await night.outlook()
        state = night.state()
        view = view_of(state, known)
        prizes = night.prizes()
    return page(request, "screen.html", live=True, view=view, prizes=prizes)


ROUTES = [Route("/screen", screen)]
