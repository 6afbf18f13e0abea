"""The night to take home: one page, a picture, a table."""

from __future__ import annotations

import asyncio

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.tournament.printed import paper_words
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.money.payouts import with_prizes
from evenbreak.web.evening_view import view_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import as_file, language, page, page_face, site_of
from evenbreak.web.pages.league import matches_csv
from evenbreak.web.site import night_of


async def share(request: Request) -> Response:
    """Show the end of the night, and what can be downloaded."""
    state, places = await _finished(request)
    return page(request, "share.html", live=True, state=state, places=places)


async def as_page(request: Request) -> Response:
    """Return the night as one self-contained file."""
    from evenbreak.sheets.html_page import OF_DRAWINGS
    from evenbreak.sheets.night_page import night_html
    from evenbreak.tournaments.evening.story import story_of

    state, places = await _finished(request)
    face, name = page_face(language(request)), site_of(request).path.stem

    told = await night_of(request).story()
    story = await asyncio.to_thread(story_of, state, told, within=_PATIENCE)

    def make() -> bytes:
        return night_html(state, places, story if story.whole else None, name, face)

    file = f"night-{language(request)}-{len(places)}-{story.whole}.html"
    content = await site_of(request).made.file(file, state, make)
    answer = _file(request, content, "html")
    answer.headers["content-security-policy"] = f"{OF_DRAWINGS}; frame-ancestors 'none'"
    return answer


async def as_picture(request: Request) -> Response:
    """Return the bracket as a picture."""
    from evenbreak.answers.tournament.bracket_view import bracket_panels
    from evenbreak.plots.picture import image_bytes
    from evenbreak.sheets.bracket_paper import Sheet, bracket_figure

    state, _ = await _finished(request)
    if state.plan.form == "chips":
        raise RefusalError("A chip tournament has no bracket to draw.", status=404)
    about, _, champion = paper_words(state)
    sheet = Sheet(state.plan.name or site_of(request).path.stem, about, "", champion)

    def make() -> bytes:
        return image_bytes(bracket_figure(bracket_panels(state), sheet), "png")

    content = await site_of(request).made.file("night.png", state, make)
    return _file(request, content, "png")


async def as_table(request: Request) -> Response:
    """Return the matches as CSV that can be rated with the league's."""
    state, _ = await _finished(request)
    content = matches_csv(state, state.plan.name or site_of(request).path.stem)
    return _file(request, content, "csv")


def _file(request: Request, content: bytes, ending: str) -> Response:
    how = "attachment" if request.query_params.get("save") else "inline"
    return as_file(content, f"night.{ending}", how)


async def _finished(request: Request) -> tuple[Evening, list[tuple[str, str, float]]]:
    """Return a night after its draw, and who finished where for how much, as far as decided."""
    night = night_of(request)
    state = await asyncio.to_thread(night.state) if night.exists else None
    if state is None or not state.drawn:
        raise RefusalError("The draw hasn't been made yet.", status=404)
    known = await night.outlook()
    places = view_of(state, known).places if known and known.of is state else []
    prizes = await asyncio.to_thread(night.prizes)
    return state, with_prizes(places, prizes, night.unit)


_PATIENCE = 20.0  # seconds for the story of a large bracket

ROUTES = [
    Route("/share", share),
    Route("/share.html", as_page),
    Route("/share.png", as_picture),
    Route("/share.csv", as_table),
]
