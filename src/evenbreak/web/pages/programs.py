"""The programs that may enter something: the director draws their tokens, and takes them back."""

from __future__ import annotations

import asyncio

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.tournament.programs import scope_in, scope_words, scopes
from evenbreak.files.store.tokens import draw_token, kept_tokens, take_back
from evenbreak.web.forms import LONGEST, directors_form
from evenbreak.web.page import done, page, site_of
from evenbreak.web.sessions import check_director
from evenbreak.web.site import begun
from evenbreak.words import say

_PAGE = "/desk/programs"
_DRAWN = "drawn"


async def programs(request: Request) -> Response:
    """Show the programs with a token; the one that was just drawn is shown this once."""
    check_director(request)
    site = site_of(request)
    state = await asyncio.to_thread(begun(site.night).state)
    there = await asyncio.to_thread(kept_tokens, site.path)
    rows = [(one, scope_words(one, state.plan)) for one in there.values()]
    drawn, may = request.session.pop(_DRAWN, ""), scopes(state.plan)
    return page(
        request, "programs.html", rows=rows, drawn=drawn, may=may, address=site.address, event=1
    )


async def draw(request: Request) -> Response:
    """Draw a token for a program."""
    form = await directors_form(request)
    site = site_of(request)
    plan = (await asyncio.to_thread(site.night.state)).plan
    name, scope = form.text("name"), scope_in(form.text("may"), plan)
    request.session[_DRAWN] = await asyncio.to_thread(
        draw_token, site.path, name, scope, site.clock()
    )
    return done(request, _PAGE)


async def back(request: Request) -> Response:
    """Take the token of a program back."""
    form = await directors_form(request)
    name = form.text("name", longest=LONGEST)
    await asyncio.to_thread(take_back, site_of(request).path, name)
    return done(request, _PAGE, say("{name} can no longer enter anything.", name=name))


ROUTES = [
    Route(_PAGE, programs),
    Route(f"{_PAGE}/draw", draw, methods=["POST"]),
    Route(f"{_PAGE}/take-back", back, methods=["POST"]),
]
