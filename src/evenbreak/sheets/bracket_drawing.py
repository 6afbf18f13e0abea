"""A bracket as a drawing: on pages for the wall, or as one picture.

Winners are bold, and a match that is being played has a thick frame and its table beside it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from evenbreak.answers.bracket_view import Box, Line, Panel
from evenbreak.sheets.pdf_page import MARGIN, POINTS, Paper, pdf_bytes, shortened

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZES = ((11.69, 8.27), (16.54, 11.69), (23.39, 16.54), (33.11, 23.39))
"""A4, A3, A2 and A1, landscape, in inches."""

ROW, COLUMN = 0.6, 2.3
"""How high a match is, and how wide, in a picture and at the most on paper, in inches."""

LOWEST = 0.34
"""The least height of a match on paper, in inches."""

_TITLE = 0.62  # above the bracket
_SIDE = 0.42  # of the heading of a side
_BOX = 0.86  # the part of a column that is the box


class _Area(NamedTuple):
    """Where a side of the bracket is drawn."""

    left: float
    top: float
    column: float
    row: float


def bracket_pdf(panels: Sequence[Panel], heading: Sequence[str], title: str) -> bytes:
    """Return the bracket as a PDF: one page if it fits, else a page for each side.

    The pages are A4 unless that is too small to read; then A3 and so on.

    Parameters
    ----------
    panels
        the sides of the bracket.
    heading
        the lines above it.
    title
        of the document.
    """
    together = sum(_rows(panel) for panel in panels)
    parts = [tuple(panels)] if together * LOWEST <= _room(SIZES[0]) else [(one,) for one in panels]
    pages = []
    for part in parts:
        rows = sum(_rows(panel) for panel in part)
        columns = max(len(panel.rounds) for panel in part)
        size = next((one for one in SIZES if rows * LOWEST <= _room(one)), SIZES[-1])
        row = min(ROW, _room(size) / rows)
        column = min(COLUMN, (size[0] - 2 * MARGIN) / columns)
        pages.append(_page(part, heading, size, row, column))
    return pdf_bytes(pages, title)


def bracket_figure(panels: Sequence[Panel], heading: Sequence[str]) -> Figure:
    """Return the whole bracket as one picture, as large as it needs to be."""
    rows = sum(_rows(panel) for panel in panels)
    columns = max(len(panel.rounds) for panel in panels)
    size = columns * COLUMN + 2 * MARGIN, rows * ROW + 2 * MARGIN + _TITLE
    return _page(panels, heading, size, ROW, COLUMN)


def _rows(panel: Panel) -> float:
    """Return how many matches high a side is, with its heading."""
    return panel.most + _SIDE / ROW


def _room(size: tuple[float, float]) -> float:
    return size[1] - 2 * MARGIN - _TITLE


def _page(
    panels: Sequence[Panel],
    heading: Sequence[str],
    size: tuple[float, float],
    row: float,
    column: float,
) -> Figure:
    page = Paper(*size)
    width = size[0] - 2 * MARGIN
    page.text(MARGIN, MARGIN + 0.2, shortened(heading[0], 15, width), size=15, bold=True)
    for k, line in enumerate(heading[1:2]):
        page.text(MARGIN, MARGIN + 0.42 + 0.18 * k, shortened(line, 9, width), size=9)
    top = MARGIN + _TITLE
    for panel in panels:
        _side(page, panel, _Area(MARGIN, top, column, row))
        top += _rows(panel) * row
    return page.figure


def _side(page: Paper, panel: Panel, area: _Area) -> None:
    """Draw one side: its headings, its boxes, and the lines between them."""
    headings = area.top + 0.5 * _SIDE * area.row / ROW
    if panel.title:
        page.text(area.left, headings - 0.12, panel.title, size=10, bold=True)
    for k, title in enumerate(panel.rounds):
        size = _size(area)
        text = shortened(title, size, _BOX * area.column)
        page.text(area.left + k * area.column, headings + 0.1, text, size=size, color="0.35")
    places = {box.match: _place(box, panel, area) for box in panel.boxes}
    for box in panel.boxes:
        x, y = places[box.match]
        _box(page, box, x, y, area)
        if box.to and box.column < _column_of(panel, box.to):
            other_x, other_y = places[box.to]
            right = x + _BOX * area.column
            middle = 0.5 * (right + other_x)
            page.line((right, middle, middle, other_x), (y, y, other_y, other_y), lw=0.6)


def _column_of(panel: Panel, match: str) -> int:
    return next(box.column for box in panel.boxes if box.match == match)


def _place(box: Box, panel: Panel, area: _Area) -> tuple[float, float]:
    """Return the left end and the middle of a box."""
    top = area.top + _SIDE * area.row / ROW
    return area.left + box.column * area.column, top + box.height * panel.most * area.row


def _size(area: _Area) -> float:
    """Return the size of the names, in points."""
    return min(9.0, 0.3 * area.row * POINTS)


def _box(page: Paper, box: Box, x: float, y: float, area: _Area) -> None:
    width, half = _BOX * area.column, 0.35 * area.row
    playing = box.state == "playing"
    if box.state == "ready" or playing:
        page.band(x, y - half, width, 2.0 * half, grey="0.93")
    page.frame(x, y - half, width, 2.0 * half, thick=1.8 if playing else 0.6)
    page.line((x, x + width), (y, y), lw=0.3)
    for k, line in enumerate(box.lines):
        _line(page, line, x, y + (k - 0.5) * half, width, area)
    size = 0.62 * _size(area)
    note = box.match if box.table is None else f"{box.match}  table {box.table}"
    page.text(x, y - half - 0.02, note, size=size, color="0.35", bold=playing)
    needs = [line.needs for line in box.lines]
    if box.state != "over" and None not in needs:
        race = f"{needs[0]}:{needs[1]}"
        page.text(x + width, y - half - 0.02, race, size=size, color="0.35", ha="right")


def _line(page: Paper, line: Line, x: float, y: float, width: float, area: _Area) -> None:
    """Write a player of a box, with seed and score."""
    size = _size(area)
    room, left = width - 0.1, x + 0.05
    if line.seed is not None and line.known:
        page.centred(left + 0.09, y, str(line.seed), size=0.7 * size, color="0.35")
        left, room = left + 0.22, room - 0.22
    if line.score:
        score = line.score if line.score.isdigit() else "w/o"
        page.centred(x + width - 0.05, y, score, size=size, bold=line.won, ha="right")
        room -= 0.3
    text = shortened(line.text, size, max(room, 0.2))
    color = "black" if line.known else "0.45"
    page.centred(left, y, text, size=size, bold=line.won, ha="left", color=color)
