"""The application: its routes, and its responses to errors.

Each form is accepted once, and only for the tournament whose page it was on. A second tap on its
button adds nothing. A double tap gets the first tap's response from memory; a form that comes in
later, or after a restart, is recognized by the number that the file stores with the entry, and the
user is told that it was accepted before.
"""

from __future__ import annotations

import asyncio
import hashlib
import logging
import time
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from http import HTTPStatus
from typing import Any, NamedTuple, TypeAlias

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.middleware.gzip import GZipMiddleware
from starlette.middleware.sessions import SessionMiddleware
from starlette.requests import Request
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route

from evenbreak.errors import EvenbreakError
from evenbreak.files.store.log import TakenBeforeError
from evenbreak.web import api
from evenbreak.web.api.origins import Origins
from evenbreak.web.api.problem import is_asked, problem
from evenbreak.web.forms import form_of
from evenbreak.web.guard import Guard, RefusalError
from evenbreak.web.page import begun_at, done, refused, script_hash, site_of, style
from evenbreak.web.pages import (
    bracket,
    check_in,
    desk,
    desk_extras,
    entry,
    fair,
    home,
    league,
    me,
    moves,
    overlay,
    players,
    programs,
    room,
    share,
    table,
    team,
    wall,
)
from evenbreak.web.sessions import form_token
from evenbreak.web.site import Site
from evenbreak.web.watch import Waking, Watch
from evenbreak.words import say

_LOG = logging.getLogger(__name__)
_COOKIE_DAYS = 3
_DOUBLE_TAP = 10.0  # seconds
_MOST = 1000  # forms whose answers are remembered
OF_THE_SESSION = ("/pin", "/leave", "/language", "/desk/read")
_HTTP = {
    400: say("The form could not be read. Open the page again."),
    404: say("There is no such page."),
}


def make_app(site: Site, *, streams: int = 500) -> Starlette:
    """Return the application that serves a site, with a limit on simultaneous streams."""
    watch = Watch(site.path, streams)
    app = Starlette(
        routes=[
            *api.ROUTES,
            *once_each(
                [
                    Route("/evenbreak.css", _style),
                    *home.ROUTES,
                    *fair.ROUTES,
                    *bracket.ROUTES,
                    *players.ROUTES,
                    *league.ROUTES,
                    *me.ROUTES,
                    *table.ROUTES,
                    *desk.ROUTES,
                    *moves.ROUTES,
                    *desk_extras.ROUTES,
                    *entry.ROUTES,
                    *check_in.ROUTES,
                    *programs.ROUTES,
                    *share.ROUTES,
                    *room.ROUTES,
                    *team.ROUTES,
                    *wall.ROUTES,
                    *overlay.ROUTES,
                ]
            ),
        ],
        middleware=[
            Middleware(Waking, watch=watch),
            Middleware(Guard, hosts=site.asked_as, script_hash=script_hash()),
            Middleware(Origins, origins=site.origins),
            # A third of the bytes over a bar's Wi-Fi; the stream of events it leaves alone.
            Middleware(GZipMiddleware, minimum_size=5000, compresslevel=4),
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
    app.state.watch = watch
    return app


def cookie_name(site: Site) -> str:
    """Return the name of the session cookie, different for each file.

    Cookies ignore ports, so two pages on one computer would overwrite each other's sessions.
    """
    return f"evenbreak-{hashlib.sha256(site.cookie_key.encode()).hexdigest()[:8]}"


async def _style(request: Request) -> Response:
    kept = {"cache-control": "max-age=31536000, immutable"}  # another style has another address
    whose = next(
        (one for one in ("guest", "wall", "overlay") if one in request.query_params), "director"
    )
    text = style(site_of(request).color, whose)
    return PlainTextResponse(text, media_type="text/css", headers=kept)


def _shown(
    request: Request, why: Exception, status: int, headers: Mapping[str, str] | None = None
) -> Response:
    """Return why something is rejected: as a page, or for a program as a problem."""
    if is_asked(request):
        return problem(request, why, status, headers)
    return refused(request, why, status)


async def _refused(request: Request, error: Exception) -> Response:
    assert isinstance(error, RefusalError)  # noqa: S101
    return _shown(request, error, error.status)


async def _wrong(request: Request, error: Exception) -> Response:
    return _shown(request, error, 400)


async def _http(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)  # noqa: S101
    words = _HTTP.get(error.status_code, say("You can't do that here."))
    if is_asked(request) and error.status_code == HTTPStatus.NOT_FOUND:
        words = say("There is no such address.")
    elif is_asked(request) and error.status_code == HTTPStatus.METHOD_NOT_ALLOWED:
        allowed = (error.headers or {}).get("Allow", "")
        words = say(
            "{method} can't be used at this address; {allowed} can.",
            method=request.method,
            allowed=allowed,
        )
    return _shown(request, RefusalError(words), error.status_code, error.headers)


async def _disk(request: Request, error: Exception) -> Response:
    """Say that the disk is full or failing; only this computer is told where."""
    if not isinstance(error, OSError) or isinstance(error, TimeoutError | ConnectionError):
        raise error
    _LOG.error("%s: %s", request.url.path, error)
    return _shown(
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
    if is_asked(request):
        return problem(request, RefusalError("That failed; nothing was changed."), 500)
    return PlainTextResponse("This page failed; nothing was changed.\n", status_code=500)


class _Answer(NamedTuple):
    """Where a form led, what it changed in the session, and when."""

    to: str
    session: dict[str, Any]
    at: float


_Answers: TypeAlias = OrderedDict[str, asyncio.Future[_Answer | None]]
"""By form key; None means the form was rejected or needs confirming, and may come in again."""


def once_each(routes: Sequence[Route]) -> list[Route]:
    """Return routes whose forms are each accepted once.

    Routes that only change the session, such as choosing a language, are left alone, and so are a
    team night's, which recognize a second tap themselves from the file.
    """
    answers: _Answers = OrderedDict()

    def guarded(route: Route) -> Route:
        own = route.path in OF_THE_SESSION or route.path.startswith("/team/")
        if own or "POST" not in (route.methods or ()):
            return route

        async def taken(request: Request) -> Response:
            return await _taken(request, route, answers)

        return Route(route.path, taken, methods=["POST"])

    return [guarded(route) for route in routes]


async def _taken(request: Request, route: Route, answers: _Answers) -> Response:
    form = await form_of(request)
    key = form.key(request.url.path, form_token(request))
    while key in answers:
        if (first := await asyncio.shield(answers[key])) is not None:
            return _again(request, first)
    waiting = answers[key] = asyncio.get_running_loop().create_future()
    before, answer = dict(request.session), None
    try:
        if form.text("begun") != await asyncio.to_thread(begun_at, request):
            raise RefusalError(
                "Another tournament was started in the meantime. Open the page again.", status=409
            )
        response: Response = await route.endpoint(request)
        if isinstance(response, RedirectResponse):
            changed = {k: v for k, v in request.session.items() if before.get(k) != v}
            answer = _Answer(response.headers["location"], changed, time.monotonic())
        return response
    except TakenBeforeError:
        return _told(request, request.url.path.rpartition("/")[0] or "/desk")
    finally:
        waiting.set_result(answer)
        if answer is None:
            answers.pop(key, None)
        elif len(answers) > _MOST:
            answers.popitem(last=False)


def _again(request: Request, first: _Answer) -> Response:
    """Answer a form as it was the first time; much later, say that it was accepted then."""
    if time.monotonic() - first.at > _DOUBLE_TAP:
        return _told(request, first.to)
    request.session.update(first.session)
    return RedirectResponse(first.to, status_code=303)


def _told(request: Request, to: str) -> Response:
    return done(request, to, say("You entered that before. Nothing was entered twice."))
