"""The wall: what everyone at the venue wants to see, readable from eight meters.

It rotates through the tables, the bracket and the story of each of the night's events, and shows
the tables immediately when a match is called; at the end, it shows the champion. Without a script,
it reloads at each turn. Keeping a screen awake from a page needs https, so the computer's own
settings must do that.
"""

from __future__ import annotations

import asyncio
import re
from collections.abc import Sequence
from dataclasses import replace
from functools import cache, partial
from typing import Any

import segno
from markupsafe import Markup
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.tournament.bracket_view import Panel
from evenbreak.answers.tournament.story import clock_words, remarks
from evenbreak.files.store.desk import disputes
from evenbreak.sheets.bracket_page import bracket_svg
from evenbreak.sheets.story_drawing import story_svg
from evenbreak.teams.evening.fold import EVERYBODY
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.story import Story
from evenbreak.web.night import Night, mark_of
from evenbreak.web.page import language, page, page_face, site_of
from evenbreak.web.pages.team import seen_values
from evenbreak.web.site import Site
from evenbreak.web.wall_view import (
    WallView,
    just_called,
    pictures_of,
    turn_at,
    wall_view,
    whole_night,
)
from evenbreak.words import in_face

_WHOLE = 32  # players whose whole bracket can be read on the wall
_ROOM, _HIGH = 114.0, 52.0  # the width of the bracket, and its height with the strip below
PICTURES = ("tables", "bracket", "story", "end", "check-in")


async def screen(request: Request) -> Response:
    """Show the wall's current picture, or the one requested."""
    site = site_of(request)
    if not site.night.exists:
        teams = await site.teams.now()
        if teams is None:
            return page(request, "screen.html", live=True, picture="", wall=None, code=_code(site))
        shown = await seen_values(request, teams, EVERYBODY)
        clock = site.clock()[11:16]
        return page(request, "team_screen.html", live=True, clock=clock, **shown)
    now = site.clock()
    only = request.query_params.get("only", "")
    views = [(await view_for(request, night, now))[0] for night in site.nights]
    stories = [await night.story() for night in site.nights]
    whole, turns = whole_night(views), list[tuple[WallView, Story | None, str]]()
    for view, story in zip(views, stories, strict=True):
        pictures = pictures_of(view, told=len(story.steps) if story else 0)
        for one in [only] if only in PICTURES else pictures:
            turns.append((whole if one == "tables" else view, story, one))
    if any(just_called(view.state, now) for view in views) and not only:
        turns = [(whole, None, "tables")]
    turn, left = turn_at(now)
    view, story, picture = turns[turn % len(turns)]
    shown = _picture(request, view, picture, story, turn)
    known = [one for night in site.nights for one in (night.state(), night.known or "")]
    of = (*known, story or "", picture, view.marks, str(turn))
    return page(request, "screen.html", live=True, of=of, left=left, only=only, **shown)


def _picture(
    request: Request, view: WallView, picture: str, story: Story | None, turn: int
) -> dict[str, Any]:
    site, face = site_of(request), page_face(language(request))
    values: dict[str, Any] = {"picture": picture, "wall": view, "code": _code(site)}
    values |= {"drawn": "", "remarks": [], "since": "", "until": view.clock}
    if picture == "bracket":
        panels = view.panels
        rows = -(-len(view.tables) // 4)
        room = _ROOM / (_HIGH - (8.0 * rows if rows < 3 else 0.0))
        if len(view.state.order) > _WHOLE:
            panels = (_open_part(panels, turn),)
        values["drawn"] = bracket_svg(panels, words=partial(in_face, face=face), within=room)
    if picture == "end" and story and not (story.whole and story.over):
        story = None  # the last matches are still being added to it
    if story and picture in ("story", "end"):
        size = (1140, 430) if picture == "story" else (880, 380)
        values["drawn"] = Markup(story_svg(story, face, size=size, alone=False))  # noqa: S704 - escaped there
        values["remarks"] = [
            (one.kind, unbroken(in_face(one.what, face)), one.why)
            for one in (remarks(story) if story.whole else ())
        ]
        values["since"] = clock_words(story.steps[0].at)
        values["until"] = clock_words(story.steps[-1].at)
    return values


def _open_part(panels: Sequence[Panel], turn: int) -> Panel:
    """Return a part of a bracket that is too large for the wall, from its first open round."""
    parts = [one for one in panels if any(box.state != "done" for box in one.boxes)]
    part = (parts or panels)[turn // 2 % len(parts or panels)]
    first = min(
        (box.column for box in part.boxes if box.state not in ("done", "forfeit")), default=0
    )
    boxes = [replace(box, column=box.column - first) for box in part.boxes if box.column >= first]
    return replace(part, rounds=part.rounds[first:], boxes=tuple(boxes))


def unbroken(text: str) -> str:
    r"""Return text in which no line breaks within a score.

    >>> unbroken("Ann 5-4 Jean-Luc") == "Ann 5\u20114 Jean-Luc"
    True
    """
    return re.sub(r"(?<=\d)-(?=\d)", "\u2011", text)


async def view_for(request: Request, night: Night, now: str) -> tuple[WallView, Evening]:
    """Return what everyone sees of one of the night's events, and its state.

    It is calculated once for everyone, until something happens or the minute is over.
    """
    known = await night.outlook()
    views, prizes = request.app.state.__dict__.setdefault("walls", {}), night.prizes()
    key = (mark_of(night.path), now[:16], tuple(prizes), night.unit)
    kept = views.get(id(night))
    if kept is None or kept[0] != key or kept[1] is not known:

        def work() -> tuple[WallView, Evening]:
            state = night.state()
            found = {one.match for one in disputes(state, night.phones())} if state.drawn else set()
            asked: Any = {"name": night.path.stem, "now": now, "prizes": prizes}
            asked["unit"] = night.unit
            return wall_view(state, known, disputed=found, **asked), state

        kept = views[id(night)] = key, known, await asyncio.to_thread(work)
    found: tuple[WallView, Evening] = kept[2]
    return found


def _code(site: Site) -> Markup:
    """Return the page's QR code; nothing while no phone can open it."""
    return code(site.address) if site.for_phones else Markup()


@cache
def code(address: str) -> Markup:
    """Return an address's QR code, as a piece of a page."""
    drawn = segno.make(address, error="m").svg_inline(
        border=2, dark="#000", light="#fff", omitsize=True
    )
    return Markup(drawn)  # noqa: S704 - it holds no text


ROUTES = [Route("/screen", screen)]
