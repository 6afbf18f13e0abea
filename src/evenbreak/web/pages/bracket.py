"""The bracket: a round at a time on a phone, whole on a laptop; and as a PDF to print."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from functools import partial

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.tournament.bracket_view import bracket_panels
from evenbreak.answers.tournament.night import swiss_table
from evenbreak.answers.tournament.printed import score_cards
from evenbreak.answers.tournament.tournament import races_words
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import answer_shown, page, site_of


async def bracket(request: Request) -> Response:
    """Show the bracket."""
    state = await _drawn(request)
    standings = (
        [answer_shown(request, Answer("", [one])) for one in swiss_table(state)]
        if state.plan.form == "swiss"
        else []
    )
    return page(
        request, "bracket.html", live=True, panels=bracket_panels(state), standings=standings
    )


async def bracket_on_paper(request: Request) -> Response:
    """Return the bracket as a PDF."""
    from evenbreak.sheets.bracket_drawing import bracket_pdf
    from evenbreak.sheets.pdf_page import usual_paper

    state = await _drawn(request)
    name = site_of(request).path.stem
    heading = [name, races_words(state.races)]
    make = partial(bracket_pdf, bracket_panels(state), heading, name, paper=usual_paper())
    return await _pdf(request, "bracket.pdf", state, make)


async def cards_on_paper(request: Request) -> Response:
    """Return the score cards as a PDF."""
    from evenbreak.sheets.paper_pages import score_cards_pdf
    from evenbreak.sheets.pdf_page import usual_paper

    state = await _drawn(request)
    cards = score_cards(state, None)
    if not cards:
        raise RefusalError(
            "No match is left to play, so there is no score card to print.", status=404
        )
    name = site_of(request).path.stem
    make = partial(score_cards_pdf, cards, name, per_page=4, paper=usual_paper())
    return await _pdf(request, "cards.pdf", state, make)


async def _drawn(request: Request) -> Evening:
    night = site_of(request).night
    if not night.exists:
        raise RefusalError("No tournament is running yet.", status=404)
    state = await asyncio.to_thread(night.state)
    if not state.drawn:
        raise RefusalError("The draw has not been made yet.", status=404)
    return state


async def _pdf(request: Request, name: str, state: Evening, make: Callable[[], bytes]) -> Response:
    content = await site_of(request).made.file(name, state, make)
    shown = {"content-disposition": f'inline; filename="{name}"'}
    return Response(content, media_type="application/pdf", headers=shown)


ROUTES = [
    Route("/bracket", bracket),
    Route("/bracket.pdf", bracket_on_paper),
    Route("/cards.pdf", cards_on_paper),
]
