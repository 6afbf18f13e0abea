"""Overlays for a stream: the match on a table, and the bracket around it, over the video.

They are pages for a browser source, transparent except for their plates, and follow the night
automatically. Everyone at the venue may open them.
"""

from __future__ import annotations

import asyncio
import re
import urllib.parse
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from functools import partial
from typing import Any, NamedTuple

from markupsafe import Markup
from starlette.datastructures import QueryParams
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route

from evenbreak.answers.tournament.bracket_view import Box, Panel, round_names
from evenbreak.answers.tournament.short_names import rough_width
from evenbreak.errors import EvenbreakError
from evenbreak.sheets.bracket_drawing import drawing
from evenbreak.sheets.bracket_page import COLUMN, LETTERS, ROW, bracket_svg
from evenbreak.site.look import plate_style
from evenbreak.tournaments.evening.events import Result, race_words
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.guard import RefusalError
from evenbreak.web.my_night import chances, match_at
from evenbreak.web.night import Night
from evenbreak.web.page import language, page, page_face, reason, site_of
from evenbreak.web.pages.table import last_on
from evenbreak.web.pages.wall import view_for
from evenbreak.web.site import begun_nights
from evenbreak.web.wall_view import TableView, WallView
from evenbreak.words import Sentence, in_face

_WON = 20.0  # seconds that the winner is shown
_LONG, _LONGER = 13.5, 16.0  # widths of names, in letters as high, that are written smaller
_SIZE = 1664.0, 848.0  # of the bracket, in pixels of a picture 1920 wide
_READABLE = 24.0  # pixels of its letters
_MOST_CHIPS = 12
_COLORS = ("accent", "ink", "back")


class Plate(NamedTuple):
    """What an overlay shows for a table.

    The kind is playing, hill, called, two (the players disagree), next (to be called), won (just
    ended), champion, or idle. `pair` is the champion alone, or empty. `chance` is the first
    player's, and `band` is its range if a rating is based on little. `left` is the seconds until
    something else is shown; 0: until something happens.
    """

    kind: str
    pair: tuple[str, ...] = ()
    score: tuple[int, int] | None = None
    needs: tuple[int, int] | None = None
    chance: float | None = None
    band: tuple[float, float] | None = None
    round: Sentence | str = ""
    race: Sentence | str = ""
    winner: str = ""
    left: float = 0.0
    chips: tuple[int, ...] = ()

    @property
    def size(self) -> str:
        """The text size of the names, the same for both."""
        widest = max((rough_width(name, bold=True) for name in self.pair), default=0.0)
        return "" if widest <= _LONG else "long" if widest <= _LONGER else "longer"


async def table(request: Request) -> Response:
    """Show the match on a table."""
    now = site_of(request).clock()
    try:
        look = _look(request.query_params)
        nights = begun_nights(request)
        views = [(await view_for(request, night, now))[0] for night in nights]
        plan = views[0].state.plan
        number = plan.table_number(request.path_params["table"])
    except EvenbreakError as error:
        return _text(request, error)
    shown = await asyncio.to_thread(_plate, nights, views, number, now)
    older = any(view.state.drawn and view.view.older for view in views)
    return _page(
        request, look, plate=shown, older=older, label=plan.table_name(number), name=views[0].name
    )


def _plate(nights: Sequence[Night], views: Sequence[WallView], number: int, now: str) -> Plate:
    """Return what is shown for a table: its match, or who has just won there, or who is next."""
    at_table = [
        (night, view.state, one)
        for night, view in zip(nights, views, strict=True)
        for one in view.tables
        if one.match.table == number
    ]
    at_table.sort(key=lambda one: not one[2].match.since)
    last, state = max(
        ((last_on(view.state, number), view.state) for view in views), key=lambda one: one[0][1]
    )
    busy = at_table and at_table[0][2].match.since and at_table[0][2].state != "called"
    if last[0] is not None and not busy:
        left = _WON - (_seconds(now) - _seconds(last[1]))
        if 0.0 < left <= _WON:
            return _won(state, last[0], left)
    if at_table:
        return _match(*at_table[0])
    ended = [view for view in views if view.view.over and view.places]
    if len(ended) == len(views):
        return Plate("champion", (ended[0].places[0].name,), round=ended[0].final)
    return Plate("idle")


def _seconds(at: str) -> float:
    return datetime.fromisoformat(at).timestamp()


def _match(night: Night, state: Evening, one: TableView) -> Plate:
    kind = one.state if one.match.since else "next"
    rack = state.plan.form == "chips"
    match = match_at(state, one.match.name)
    now, _, band = chances(state, match, night.means)
    return Plate(
        kind,
        one.match.players,
        None if rack or kind in ("next", "called", "two") else one.score or (0, 0),
        None if rack else one.match.needs,
        None if kind == "two" else now,
        None if kind == "two" else band,
        match.number if rack else round_names(state).get(one.match.name, ""),
        "" if rack else race_words(one.match.needs),
        chips=tuple(state.chip_night.chips[name] for name in one.match.players) if rack else (),
    )


def _won(state: Evening, last: Result, left: float) -> Plate:
    rack = state.plan.form == "chips"
    needs = last.race or state.needed(last.match, last.players)
    plain = rack or last.forfeit
    return Plate(
        "won",
        last.players,
        None if plain else last.score,
        None if plain else needs,
        round="" if rack else round_names(state).get(last.match, ""),
        race="" if plain else race_words(needs),
        winner=last.winner,
        left=left,
    )


async def bracket(request: Request) -> Response:
    """Show the bracket, or as much as is readable around the match on the streamed table."""
    now, asked = site_of(request).clock(), request.query_params.get("table", "")
    try:
        look = _look(request.query_params)
        views = [(await view_for(request, night, now))[0] for night in begun_nights(request)]
        plan = views[0].state.plan
        number = plan.table_number(asked) if asked else (*plan.streamed, 0)[0]
    except EvenbreakError as error:
        return _text(request, error)
    followed = [view for view in views if any(one.match.table == number for one in view.tables)]
    view = (followed or [one for one in views if not one.view.over] or views)[0]
    drawn = Markup("")
    if view.state.drawn and view.state.plan.form != "chips":
        words = partial(in_face, face=page_face(language(request)))
        match = _followed(view, number)
        panels = readable(view.panels, match)
        drawn = bracket_svg(panels, words=words, chosen=match, within=_SIZE[0] / _SIZE[1])
    older = view.state.drawn and view.view.older
    left = _chips(view.state)
    return _page(request, look, plate=None, older=older, drawn=drawn, chips=left, name=view.name)


def _chips(state: Evening) -> list[tuple[int, str]]:
    """Return the most chips that any player has, in a chip tournament."""
    if not state.drawn or state.plan.form != "chips":
        return []
    chips = state.chip_night.chips
    most = sorted(chips, key=lambda name: (-chips[name], name))[:_MOST_CHIPS]
    return [(chips[name], name) for name in most]


def _followed(view: WallView, table: int) -> str:
    """Return the match on a table, or the last one there, or any match in play; '' if none."""
    on = [one.match for one in view.tables if one.match.since]
    here = [one.name for one in on if one.table == table]
    last = last_on(view.state, table)[0]
    return (here or ([last.match] if last else []) or [one.name for one in on] or [""])[0]


def readable(panels: Sequence[Panel], match: str) -> tuple[Panel, ...]:
    """Return a bracket, or its largest part around a match in which names are readable."""
    panel = next((p for p in panels if any(b.match == match for b in p.boxes)), panels[-1])
    around = (_around(panel, match, rounds) for rounds in (4, 3, 2, 1))
    several: list[tuple[Panel, ...]] = [tuple(panels), (panel,), *((one,) for one in around)]
    return next((one for one in several if _letters(one) >= _READABLE), several[-1])


def _letters(panels: Sequence[Panel]) -> float:
    """Return the size of names in a picture, in pixels."""
    drawn = drawing(panels)
    wide, high = drawn.wide * COLUMN, drawn.high * ROW
    return LETTERS * min(_SIZE[0] / max(wide, 1.0), _SIZE[1] / max(high, 1.0))


def _around(panel: Panel, match: str, rounds: int) -> Panel:
    """Return the path to a match and this many rounds beyond, without rounds from long before."""
    boxes = {box.match: box for box in panel.boxes}
    own = boxes.get(match) or panel.boxes[0]
    first = max(0, own.column - 1)
    goal = own
    for _ in range(rounds if panel.linked else 0):
        goal = boxes.get(goal.to, goal)
    kept: Mapping[str, Box] = {
        name: box for name, box in boxes.items() if first <= box.column <= own.column + rounds
    }
    if panel.linked:
        kept = {name: box for name, box in kept.items() if _leads(boxes, box, goal)}
    last = max(box.column for box in kept.values())
    return replace(
        panel,
        rounds=panel.rounds[first : last + 1],
        boxes=tuple(replace(box, column=box.column - first) for box in kept.values()),
    )


def _leads(boxes: Mapping[str, Box], box: Box, goal: Box) -> bool:
    """Return whether a match's winner can reach another match."""
    while box.match != goal.match:
        if box.to not in boxes or boxes[box.to].column <= box.column:
            return False
        box = boxes[box.to]
    return True


def _look(query: QueryParams) -> str:
    """Return the colors requested in an address, as the style's query; '' for the defaults."""
    asked = {name: query[name].lower() for name in _COLORS if query.get(name)}
    for name, color in asked.items():
        if not re.fullmatch(r"[0-9a-f]{6}", color):
            raise RefusalError(
                "The color must be six hex digits, such as {name}=7a1f5c; you gave {color!r}.",
                name=name,
                color=color[:20],
            )
    return urllib.parse.urlencode(asked)


async def style(request: Request) -> Response:
    """Return the colors requested in an address, as a style."""
    try:
        asked = dict(urllib.parse.parse_qsl(_look(request.query_params)))
    except EvenbreakError as error:
        return _text(request, error)
    text = plate_style(**{name: f"#{color}" for name, color in asked.items()})
    return PlainTextResponse(text, media_type="text/css", headers={"cache-control": "max-age=3600"})


def _page(request: Request, look: str, **shown: Any) -> Response:
    return page(request, "overlay.html", live=True, look=look, **shown)


def _text(request: Request, why: EvenbreakError) -> Response:
    """Return why there is no overlay, as a line that is refreshed until there is one."""
    status = why.status if isinstance(why, RefusalError) else 404
    again = {"refresh": "5"}
    return PlainTextResponse(reason(request, why) + "\n", status_code=status, headers=again)


ROUTES = [
    Route("/overlay.css", style),
    Route("/overlay/bracket", bracket),
    Route("/overlay/{table}", table),
]
