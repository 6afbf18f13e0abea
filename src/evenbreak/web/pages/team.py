"""A team night as everybody sees it, as each captain does, and as the director does."""

from __future__ import annotations

import asyncio
from datetime import datetime
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
from evenbreak.web.authors import DIRECTOR, author_words
from evenbreak.web.page import page, site_of
from evenbreak.web.sessions import captain_of, check_director, is_director
from evenbreak.web.team_captain import captain_values
from evenbreak.web.team_night import TeamNow, night_on
from evenbreak.web.team_view import plain_options, set_views


async def team(request: Request) -> Response:
    """Show the night: to everybody the sets and the chances, to a captain the advice too."""
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
    """Return what a reader may see of a night: a captain (0 or 1), or `EVERYBODY`."""
    chances = await site_of(request).teams.chances(now)
    seen = now.state.seen_by(viewer)
    return {
        "state": seen,
        "sets": set_views(seen),
        "played": night_words(seen),
        "needed": needed_words(seen, chances),
        "chances": chances,
        "decided": decided(seen, chances),
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
    """Return what only the director may see; no pick that is still unseen, and no advice."""
    site, state = site_of(request), now.state
    line = state.to_name
    return {
        "pins": [(name, site.captain_pin(state.began, k)) for k, name in enumerate(state.teams)],
        "seen": len(now.events),
        "by": DIRECTOR,
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
        (number, f"{datetime.fromisoformat(one.at):%H:%M:%S}", said, author_words(one.by))
        for number, (one, said) in enumerate(zip(now.events, words, strict=True), 1)
    ]
    return page(request, "history.html", rows=rows[::-1], gone=())


ROUTES = [Route("/team", team), Route("/team/history", history)]
