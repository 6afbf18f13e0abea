"""Each form is taken once, and only in the tournament whose page it was on.

A second tap on its button adds nothing, and is answered as the first: a double tap from memory;
what comes in later, or after a restart, is known by the number that the file keeps with the entry,
and is told that it was taken before.
"""

from __future__ import annotations

import asyncio
import time
from collections import OrderedDict
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.files.store.tournament import TakenBeforeError
from evenbreak.web.forms import form_of
from evenbreak.web.page import begun_at, done
from evenbreak.web.refusals import RefusalError
from evenbreak.web.sessions import form_token
from evenbreak.words import say

_DOUBLE_TAP = 10.0  # seconds
_MOST = 1000  # forms whose answers are remembered
OF_THE_SESSION = ("/pin", "/leave", "/language", "/m/{token}/me")


class _Answer(NamedTuple):
    """Where a form led, what it changed in the session, and when."""

    to: str
    session: dict[str, Any]
    at: float


_Answers: TypeAlias = OrderedDict[str, asyncio.Future[_Answer | None]]
"""By the key of a form; None: it was refused or asked back, and may come in again."""


def once_each(routes: Sequence[Route]) -> list[Route]:
    """Return routes whose forms are taken once each.

    Those that only change the session, such as the choice of a language, stay as they are, and
    those of a team night, which tell a second tap themselves by what the file keeps.
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
        found: Response = await route.endpoint(request)
        if isinstance(found, RedirectResponse):
            changed = {k: v for k, v in request.session.items() if before.get(k) != v}
            answer = _Answer(found.headers["location"], changed, time.monotonic())
        return found
    except TakenBeforeError:
        return _told(request, request.url.path.rpartition("/")[0] or "/desk")
    finally:
        waiting.set_result(answer)
        if answer is None:
            answers.pop(key, None)
        elif len(answers) > _MOST:
            answers.popitem(last=False)


def _again(request: Request, first: _Answer) -> Response:
    """Answer a form as it was answered the first time; much later, say that it was taken then."""
    if time.monotonic() - first.at > _DOUBLE_TAP:
        return _told(request, first.to)
    request.session.update(first.session)
    return RedirectResponse(first.to, status_code=303)


def _told(request: Request, to: str) -> Response:
    return done(request, to, say("You entered that before. Nothing was entered twice."))
