"""Programs that may make entries: the director creates and revokes their tokens."""

from __future__ import annotations

import asyncio

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.tournament.programs import scope_in, scope_words, scopes
from evenbreak.files.store.tokens import create_token, kept_tokens, revoke_token
from evenbreak.web.forms import LONGEST, directors_form
from evenbreak.web.page import done, page, site_of
from evenbreak.web.sessions import check_director
from evenbreak.web.site import begun
from evenbreak.words import say

_PAGE = "/desk/programs"
_CREATED = "created"


async def programs(request: Request) -> Response:
    """Show the programs with a token; a newly created token is shown only this once."""
    check_director(request)
    site = site_of(request)
    state = await asyncio.to_thread(begun(site.night).state)
    there = await asyncio.to_thread(kept_tokens, site.path, used=True)
    rows = [(one, scope_words(one, state.plan)) for one in there.values()]
    created, may = request.session.pop(_CREATED, ""), scopes(state.plan)
    return page(
        request, "programs.html", rows=rows, created=created, may=may, address=site.address, event=1
    )


async def create(request: Request) -> Response:
    """Create a token for a program."""
    form = await directors_form(request)
    site = site_of(request)
    plan = (await asyncio.to_thread(site.night.state)).plan
    name, scope = form.text("name"), scope_in(form.text("may"), plan)
    request.session[_CREATED] = await asyncio.to_thread(
        create_token, site.path, name, scope, site.clock()
    )
    return done(request, _PAGE)


async def revoke(request: Request) -> Response:
    """Revoke a program's token."""
    form = await directors_form(request)
    name = form.text("name", longest=LONGEST)
    await asyncio.to_thread(revoke_token, site_of(request).path, name)
    return done(request, _PAGE, say("{name} can no longer enter anything.", name=name))


ROUTES = [
    Route(_PAGE, programs),
    Route(f"{_PAGE}/create", create, methods=["POST"]),
    Route(f"{_PAGE}/revoke", revoke, methods=["POST"]),
]
