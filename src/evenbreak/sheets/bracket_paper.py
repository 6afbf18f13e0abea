"""A bracket on paper, and as a picture: full names, a box for each score, numbers at the left.

The night can be completed on it by hand: the small /4 in a score box is the games that the player
needs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from evenbreak.answers.tournament.bracket_view import Box, Line, Panel
from evenbreak.sheets.bracket_drawing import BOX_HIGH, BOX_WIDE, Drawing, Placed, drawing, pages
from evenbreak.sheets.pdf_page import (
    PAPERS,
    POINTS,
    SMALLEST,
    Paper,
    fitted,
    pdf_bytes,
    width_of,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LARGEST = 13.0
"""The largest font size for names, in points."""

_MARGIN = 0.3
_HEAD, _FOOT = 0.62, 0.18  # above and below the bracket, in inches
_SCORE = 0.23  # the width of the box of a score
_EDGE = 0.04  # beside a name
_ONWARD = 0.2  # beside the page's last round, for the numbers of matches on others
_MOST_ROW, _MOST_COLUMN = 1.0, 2.9
_LINE = 0.955  # the height of a line of type, in sizes of its letters
_ON_ONE_LINE = 0.92  # of the height of a line of a match, the most that its letters are
_LEAST_ROW = SMALLEST / (
    _ON_ONE_LINE * 0.5 * BOX_HIGH * POINTS
)  # of a match whose names are on one line
_TWO_LINES = 2.0 * _LINE * SMALLEST / (0.97 * 0.5 * BOX_HIGH * POINTS)  # of one with two


class Sheet(NamedTuple):
    """What surrounds a bracket on paper.

    `champion` is '' to leave a line for the name, or None for neither; `live` is the live page's
    address, shown as a QR code.
    """

    title: str
    about: str = ""
    foot: str = ""
    champion: str | None = ""
    live: str = ""


def bracket_pdf(panels: Sequence[Panel], sheet: Sheet, *, paper: str = "a4") -> bytes:
    """Return the bracket as a PDF, on one page if its names are readable there, else on more.

    No name is cut or shortened: names are written smaller, down to 8 points, or on two lines, and
    otherwise the bracket takes more pages. The paper is 'a4' or 'letter'.
    """
    return pdf_bytes(bracket_pages(panels, sheet, paper), sheet.title)


def bracket_pages(panels: Sequence[Panel], sheet: Sheet, paper: str = "a4") -> list[Figure]:
    """Return the pages for `bracket_pdf`."""
    wide, high = PAPERS[paper]
    room_wide, room_high = wide - 2 * _MARGIN, high - 2 * _MARGIN - _HEAD - _FOOT
    parts = _parts(panels, room_wide, room_high)
    made = []
    for number, part in enumerate(parts, 1):
        page = Paper((wide, high))
        drawn = drawing(part)
        scale = _Scale(
            _MARGIN,
            _MARGIN + _HEAD,
            min(_MOST_COLUMN, (room_wide - _onward(drawn)) / drawn.wide),
            min(_MOST_ROW, room_high / drawn.high),
        )
        _around(page, sheet, f"{number}/{len(parts)}" if len(parts) > 1 else "")
        _draw(page, drawn, scale)
        made.append(page.figure)
    return made


def bracket_figure(panels: Sequence[Panel], sheet: Sheet) -> Figure:
    """Return the whole bracket as one picture, as large as it needs to be."""
    drawn = drawing(panels)
    needed = max((width_of(one.text, LARGEST, bold=True) for one in _lines(panels)), default=1.0)
    column = min(6.0, max(2.2, (needed / 0.97 + _SCORE + 2 * _EDGE) / BOX_WIDE))
    scale = _Scale(_MARGIN, _MARGIN + _HEAD, column, 0.52)
    wide = max(7.0, drawn.wide * column + _onward(drawn) + 2 * _MARGIN)
    page = Paper((wide, drawn.high * scale.row + 2 * _MARGIN + _HEAD + _FOOT))
    _around(page, sheet, "")
    _draw(page, drawn, scale)
    return page.figure


def _onward(drawn: Drawing) -> float:
    """Return the width taken by the numbers of matches elsewhere, next to the last round."""
    return _ONWARD if any(number for *_, number in drawn.onward) else 0.0


def _lines(panels: Sequence[Panel]) -> Iterator[Line]:
    return (one for panel in panels for box in panel.boxes for one in box.lines if one.text)


def _parts(panels: Sequence[Panel], wide: float, high: float) -> list[list[Panel]]:
    """Return the parts for each page, using few pages and keeping all names readable."""
    names = {one.text for one in _lines(panels)}
    best: list[list[Panel]] = []
    whole = max(len(panel.rounds) for panel in panels)
    for across in range(whole, 0, -1):
        onward = _ONWARD if across < whole else 0.0
        room = min(_MOST_COLUMN, (wide - onward) / across) * BOX_WIDE - _SCORE - 2 * _EDGE
        one_line = all(width_of(name, SMALLEST, bold=True) <= 0.98 * room for name in names)
        two_lines = all(
            max(width_of(half, SMALLEST, bold=True) for half in _halves(name)) <= 0.98 * room
            for name in names
        )
        if not one_line and not two_lines and across > 1:
            continue
        rows = high / (_LEAST_ROW if one_line else _TWO_LINES)
        found = pages(panels, rows, across)
        if len(found) == 1 and across < whole:  # no line has to come back from the right
            found = [part for panel in panels for part in pages([panel], rows, across)]
        if not best or len(found) < len(best):
            best = found
        if len(best) == 1:
            break
    return best


@lru_cache(maxsize=1024)
def _halves(name: str) -> tuple[str, str]:
    """Return a name on two lines of similar width, divided after a space or a hyphen."""
    cuts = [match.end() for match in re.finditer(r"[\s-]+", name) if match.end() < len(name)]
    both = [(name[:cut].rstrip(), name[cut:]) for cut in cuts]
    return min(both, key=lambda one: max(len(one[0]), len(one[1])), default=(name, ""))


class _Scale(NamedTuple):
    """Where a drawing starts, a round's width and a match's height, in inches."""

    left: float
    top: float
    column: float
    row: float

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Return the drawing's position on paper, cutting off the space at its left."""
        return self.left + x * self.column, self.top + y * self.row


def _around(page: Paper, sheet: Sheet, number: str) -> None:
    """Write what surrounds the bracket."""
    right = page.wide - _MARGIN
    if sheet.live:
        page.code(right - 0.62, _MARGIN - 0.08, 0.62, sheet.live)
        right -= 0.8
    if sheet.champion is not None:
        page.text(right - 2.0, _MARGIN + 0.12, "Champion", size=8, bold=True)
        page.line((right - 2.0, right), (_MARGIN + 0.5, _MARGIN + 0.5), lw=0.8)
        if sheet.champion:
            name, size = fitted(sheet.champion, 13, 1.95, bold=True)
            page.text(right - 2.0, _MARGIN + 0.44, name, size=size, bold=True)
        right -= 2.2
    room = right - _MARGIN
    title, size = fitted(sheet.title, 16, room, bold=True)
    page.text(_MARGIN, _MARGIN + 0.16, title, size=size, bold=True)
    about, size = fitted(sheet.about, 10, room)
    page.text(_MARGIN, _MARGIN + 0.4, about, size=max(size, SMALLEST))
    foot = "  ".join(filter(None, (sheet.foot, number)))
    page.text(_MARGIN, page.high - 0.24, foot, size=SMALLEST, color="0.3")


def _draw(page: Paper, drawn: Drawing, scale: _Scale) -> None:
    """Draw a bracket, or a part of one."""
    for corners in drawn.lines:
        at = [scale.at(*corner) for corner in corners]
        page.line([x for x, _ in at], [y for _, y in at], lw=0.7)
    for x, y, number in drawn.onward:
        at_x, at_y = scale.at(x, y)
        page.line((at_x, at_x + 0.06), (at_y, at_y), lw=0.7)
        if number:
            page.text(at_x + 0.02, at_y - 0.04, f"to {number}", size=SMALLEST, color="0.3")
    for one in drawn.headings:
        x, y = scale.at(one.x, one.y)
        text, size = fitted(one.text, 12 if one.large else 10, scale.column * BOX_WIDE, bold=True)
        page.text(x, y, text, size=max(size, SMALLEST), bold=True)
    for placed in drawn.boxes:
        _box(page, placed, scale)


def _box(page: Paper, placed: Placed, scale: _Scale) -> None:
    box: Box = placed.box
    x, y = scale.at(placed.x, placed.y)
    wide, half = BOX_WIDE * scale.column, 0.5 * BOX_HIGH * scale.row
    page.frame(x, y - half, wide, 2.0 * half, thick=0.8)
    page.line((x, x + wide), (y, y), lw=0.4)
    page.line((x + wide - _SCORE,) * 2, (y - half, y + half), lw=0.4)
    page.text(x - 0.04, y - 0.03, str(box.number), size=SMALLEST, bold=True, ha="right")
    for k, line in enumerate(box.lines):
        over = box.state in ("done", "forfeit")  # else a pen writes the score
        shown = line if over else line._replace(score="")
        _line(page, shown, x, y + (k - 0.5) * half, wide, half)


def _line(page: Paper, line: Line, x: float, y: float, wide: float, high: float) -> None:
    """Write a match's player, with the score or the games needed."""
    middle = x + wide - 0.5 * _SCORE
    if line.score:
        score = "w/o" if line.score == "forfeit" else line.score
        size = min(LARGEST, _ON_ONE_LINE * high * POINTS) if score.isdigit() else SMALLEST
        page.centered(middle, y, score, size=size, bold=line.won)
    elif line.needs:
        at = y + 0.5 * high - 0.03
        page.text(x + wide - 0.02, at, f"/{line.needs}", size=SMALLEST, color="0.45", ha="right")
    color = "black" if line.known else "0.35"
    for text, offset, size in written(line, wide - _SCORE - 2 * _EDGE, high):
        page.centered(x + _EDGE, y + offset, text, size=size, bold=line.won, ha="left", color=color)


def written(line: Line, room: float, high: float) -> list[tuple[str, float, float]]:
    """Return a name fitted to a space (inches): lines with offsets from the middle, and size."""
    largest = min(LARGEST if line.known else 9.0, _ON_ONE_LINE * high * POINTS)
    text, size = fitted(line.text, largest, room, bold=line.won)
    halves = _halves(line.text)
    if size >= min(SMALLEST, largest) or not halves[1]:
        return [(text, 0.0, size)]
    most = min(largest, 0.97 * high * POINTS / (2 * _LINE))
    two = min(fitted(half, most, room, bold=line.won)[1] for half in halves)
    if two <= size:
        return [(text, 0.0, size)]
    apart = 0.5 * _LINE * two / POINTS
    return [(halves[0], -apart, two), (halves[1], apart, two)]
