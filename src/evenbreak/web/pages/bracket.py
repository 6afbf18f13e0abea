"""The bracket: one round at a time on a phone, whole on a laptop, and as a PDF to print."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.tournament.bracket_view import Box, Panel, bracket_panels
from evenbreak.answers.tournament.night import swiss_table
from evenbreak.answers.tournament.printed import onward_words, paper_words, score_cards
from evenbreak.answers.tournament.time import time_of_day
from evenbreak.sheets.bracket_page import bracket_both
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.desk_view import progress
from evenbreak.web.guard import RefusalError
from evenbreak.web.night import Known, match_chances
from evenbreak.web.page import answer_shown, as_file, language, page, page_face, site_of
from evenbreak.web.pages.desk import sheet_values
from evenbreak.web.sessions import is_director
from evenbreak.web.site import drawn_state, event_of, night_of, of_event
from evenbreak.words import Sentence, in_face


class Chosen(NamedTuple):
    """A tapped match: its name, its round, where its players go, its start."""

    box: Box
    words: Sentence | str
    round: str
    onward: Sequence[str]
    starts: str


async def bracket(request: Request) -> Response:
    """Show the bracket, and the match that was tapped."""
    state = await drawn_state(request)
    known = await night_of(request).outlook()
    panels = bracket_panels(state, match_chances(state, known))
    asked = request.query_params.get("match", "")
    chosen = _chosen(state, panels, asked, known) if asked else None
    words = partial(in_face, face=page_face(language(request)))
    event = event_of(request)

    def link(box: Box) -> str:
        return of_event(f"/bracket?match={box.number}", event)

    played, matches = progress(state)
    standings = swiss_table(state) if state.plan.form == "swiss" else []
    return page(
        request,
        "bracket.html",
        live=True,
        drawn=bracket_both(
            panels, words=words, link=link, chosen=chosen.box.match if chosen else ""
        ),
        chosen=chosen,
        played=played,
        matches=matches,
        clock=night_of(request).clock()[11:16],
        standings=[answer_shown(request, Answer("", [one])) for one in standings],
        state=state,
        **sheet_values(request, state),
    )


def _chosen(
    state: Evening, panels: Sequence[Panel], asked: str, known: Known | None
) -> Chosen | None:
    """Return the tapped match; None if there is no longer one with that number."""
    for panel in panels:
        for box in panel.boxes:
            if str(box.number) != asked:
                continue
            starts = ""
            if known and known.of is state and box.state == "ready":
                at = [
                    known.next_starts[one.text][1]
                    for one in box.lines
                    if one.text in known.next_starts
                ]
                starts = time_of_day(known.start + max(at)) if at else ""
            title = box.title or panel.rounds[box.column].title
            onward = [text for text in (onward_words(state, box.match),) if text]
            return Chosen(box, state.match_words(box.match), title, onward, starts)
    return None


async def bracket_on_paper(request: Request) -> Response:
    """Return the bracket as a PDF."""
    from evenbreak.sheets.bracket_paper import Sheet, bracket_pdf

    state = await drawn_state(request)
    live = f"{site_of(request).address}/bracket"
    about, foot, champion = paper_words(state, live)
    sheet = Sheet(state.plan.name or site_of(request).path.stem, about, foot, champion, live)
    paper = _paper(request)
    make = partial(bracket_pdf, bracket_panels(state), sheet, paper=paper)
    return await _pdf(request, f"bracket-{paper}.pdf", state, make)


def _paper(request: Request) -> str:
    """Return the requested paper size, or else this computer's regional standard."""
    from evenbreak.sheets.pdf_page import PAPERS, usual_paper

    asked = request.query_params.get("paper", "")
    return asked if asked in PAPERS else usual_paper()


async def cards_on_paper(request: Request) -> Response:
    """Return the score cards as a PDF."""
    from evenbreak.sheets.paper_pages import score_cards_pdf

    state = await drawn_state(request)
    cards = score_cards(state, None)
    if not cards:
        raise RefusalError(
            "No match is left to play, so there's no score card to print.", status=404
        )
    name = state.plan.name or site_of(request).path.stem
    paper, claims = _paper(request), is_director(request)  # a code is its player's secret
    make = partial(
        score_cards_pdf,
        cards,
        name,
        paper=paper,
        codes=site_of(request).player_codes() if claims else {},
        address=f"{site_of(request).address}/c/",
    )
    return await _pdf(request, f"cards-{paper}{'-codes' if claims else ''}.pdf", state, make)


async def _pdf(request: Request, name: str, state: Evening, make: Callable[[], bytes]) -> Response:
    content = await site_of(request).made.file(name, state, make)
    return as_file(content, name, "inline")


ROUTES = [
    Route("/bracket", bracket),
    Route("/bracket.pdf", bracket_on_paper),
    Route("/cards.pdf", cards_on_paper),
]
