"""The application: its routes, and what is answered when something is refused or fails."""

from __future__ import annotations

import hashlib
import logging

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.middleware.sessions import SessionMiddleware
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route

from evenbreak.errors import EvenbreakError
from evenbreak.web.guard import Guard
from evenbreak.web.live import Watch, events
from evenbreak.web.once import once_each
from evenbreak.web.page import own_file, refused, script_hash
from evenbreak.web.pages import (
    bracket,
    desk,
    desk_extras,
    entry,
    fair,
    home,
    league,
    match,
    players,
    screen,
    team,
    team_moves,
    team_new,
)
from evenbreak.web.refusals import RefusalError
from evenbreak.web.site import Site
from evenbreak.words import say

_LOG = logging.getLogger(__name__)
_COOKIE_DAYS = 3
_HTTP = {
    400: say("The form could not be read. Open the page again."),
    404: say("There is no such page."),
}


def make_app(site: Site, *, streams: int = 500) -> Starlette:
    """Return the application that serves a site.

    Parameters
    ----------
    site
        the file, the addresses and the secrets.
    streams
        how many pages may follow what happens at once.
    """
    app = Starlette(
        routes=once_each(
            [
                Route("/evenbreak.css", _style),
                Route("/events", events),
                *home.ROUTES,
                *fair.ROUTES,
                *bracket.ROUTES,
                *players.ROUTES,
                *league.ROUTES,
                *screen.ROUTES,
                *match.ROUTES,
                *desk.ROUTES,
                *desk_extras.ROUTES,
                *entry.ROUTES,
                *team.ROUTES,
                *team_moves.ROUTES,
                *team_new.ROUTES,
            ]
        ),
        middleware=[
            Middleware(Guard, hosts=site.hosts, script_hash=script_hash()),
            Middleware(
                SessionMiddleware,
                secret_key=site.cookie_key,
                session_cookie=cookie_name(site),
                max_age=_COOKIE_DAYS * 86400,
                same_site="lax",
            ),
        ],
        exception_handlers={
            RefusalError: _refused,
            EvenbreakError: _wrong,
            HTTPException: _http,
            OSError: _disk,
            Exception: _failed,
        },
    )
    app.state.site = site
    app.state.closing = False
    app.state.watch = Watch(streams)
    return app


def cookie_name(site: Site) -> str:
    """Return the name of the sessions' cookie, another one for each file.

    Cookies know no ports: two pages on one computer would overwrite each other's sessions.
    """
    return f"evenbreak-{hashlib.sha256(site.cookie_key.encode()).hexdigest()[:8]}"


async def _style(_: Request) -> Response:
    kept = {"cache-control": "max-age=3600"}
    return PlainTextResponse(own_file("evenbreak.css"), media_type="text/css", headers=kept)


async def _refused(request: Request, error: Exception) -> Response:
    assert isinstance(error, RefusalError)  # noqa: S101
    return refused(request, error, error.status)


async def _wrong(request: Request, error: Exception) -> Response:
    return refused(request, error, 400)


async def _http(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)  # noqa: S101
    words = _HTTP.get(error.status_code, say("You can't do that here."))
    return refused(request, RefusalError(words), error.status_code)


async def _disk(request: Request, error: Exception) -> Response:
    """Say that the disk is full or fails; where, is said to whoever has the computer."""
    if not isinstance(error, OSError) or isinstance(error, TimeoutError | ConnectionError):
        raise error
    _LOG.error("%s: %s", request.url.path, error)
    return refused(
        request,
        RefusalError(
            "This computer can't do that right now ({why}). Tell the director: the disk "
            "may be full.",
            why=error.strerror or "",
        ),
        503,
    )


async def _failed(request: Request, error: Exception) -> Response:
    _LOG.exception("%s failed", request.url.path, exc_info=error)
    return PlainTextResponse("This page failed; nothing was changed by it.\n", status_code=500)
