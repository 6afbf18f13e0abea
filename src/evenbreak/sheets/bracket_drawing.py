"""A bracket as a drawing: on pages for the wall, or as one picture.

Winners are bold, and a match that is being played has a thick frame and its table beside it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from evenbreak.answers.tournament.bracket_view import Box, Line, Panel, short_names
from evenbreak.sheets.pdf_page import MARGIN, PAPERS, POINTS, Paper, fitted, pdf_bytes, width_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZES = {
    "a4": (PAPERS["a4"], (16.54, 11.69), (23.39, 16.54), (33.11, 23.39)),
    "letter": (PAPERS["letter"], (17.0, 11.0), (22.0, 17.0), (34.0, 22.0)),
}
"""A4, A3, A2 and A1; letter, tabloid, ANSI C and D: landscape, in inches."""

ROW, COLUMN = 0.6, 2.3
"""How high a match is, and how wide, in a picture and at the most on paper, in inches."""

LOWEST = 0.34
"""The least height of a match on paper, in inches."""

WIDEST = 4.0
"""How wide a match is in a picture at the most, so that names are written in full."""

READABLE = 5.0
"""The least size of a name, in points, for which a larger paper is not tried."""

_TITLE = 0.62  # above the bracket
_SIDE = 0.48  # of the heading of a side
_BOX = 0.86  # the part of a column that is the box
_EDGE, _SEED = 0.05, 0.22  # beside a name: what is left free, and where its seed is


class _Area(NamedTuple):
    """Where a side of the bracket is drawn, and the short forms of names."""

    left: float
    top: float
    column: float
    row: float
    short: Mapping[str, str]


def bracket_pdf(
    panels: Sequence[Panel], heading: Sequence[str], title: str, *, paper: str = "a4"
) -> bytes:
    """Return the bracket as a PDF: one page if it can be read there, else a page for each side.

    The pages are A4 (or letter) unless that is too small to read; then A3 (tabloid) and so on. A
    name for which there is no room is written in its short form (see `short_names`), and smaller,
    but never cut.

    Parameters
    ----------
    panels
        the sides of the bracket.
    heading
        the lines above it.
    title
        of the document.
    paper
        'a4' or 'letter'.
    """
    return pdf_bytes(bracket_pages(panels, heading, paper), title)


def bracket_pages(
    panels: Sequence[Panel], heading: Sequence[str], paper: str = "a4"
) -> list[Figure]:
    """Return the pages of `bracket_pdf`; no name on them is cut."""
    short = short_names(_players(panels))
    one_page, page_each = [list(panels)], [[panel] for panel in panels]
    tried = [
        (size, [(part, _area(part, size, short)) for part in parts])
        for size in SIZES[paper]
        for parts in (one_page, page_each)
    ]
    readable = (one for one in tried if all(_is_readable(*page) for page in one[1]))
    size, pages = next(readable, tried[-1])
    return [_page(part, heading, size, area) for part, area in pages]


def bracket_figure(panels: Sequence[Panel], heading: Sequence[str]) -> Figure:
    """Return the whole bracket as one picture, as large as it needs to be."""
    columns = max(len(panel.rounds) for panel in panels)
    area = _Area(MARGIN, 0.0, COLUMN, ROW, short_names(_players(panels)))
    needed = max(_needed(line, area) for line in _lines(panels))
    column = min(WIDEST, max(COLUMN, needed / _BOX))
    high = sum(panel.rows for panel in panels) * ROW + len(panels) * _SIDE
    size = columns * column + 2 * MARGIN, high + 2 * MARGIN + _TITLE
    return _page(panels, heading, size, area._replace(column=column))


def _players(panels: Sequence[Panel]) -> set[str]:
    return {line.text for line in _lines(panels) if line.known}


def _lines(panels: Sequence[Panel]) -> Iterator[Line]:
    return (line for panel in panels for box in panel.boxes for line in box.lines)


def _area(panels: Sequence[Panel], size: tuple[float, float], short: Mapping[str, str]) -> _Area:
    """Return how large matches are on a paper of a size."""
    rows, columns = sum(p.rows for p in panels), max(len(panel.rounds) for panel in panels)
    row = (size[1] - 2 * MARGIN - _TITLE - len(panels) * _SIDE) / rows
    column = (size[0] - 2 * MARGIN) / columns
    return _Area(MARGIN, 0.0, min(COLUMN, column), min(ROW, row), short)


def _is_readable(panels: Sequence[Panel], area: _Area) -> bool:
    """Return whether matches are high enough, and names large enough, to be read."""
    sizes = (_name(line, area)[1] for line in _lines(panels))
    return area.row >= LOWEST and min(sizes, default=READABLE) >= READABLE


def _page(
    panels: Sequence[Panel], heading: Sequence[str], size: tuple[float, float], area: _Area
) -> Figure:
    page = Paper(size)
    width = size[0] - 2 * MARGIN
    for line, y, points in zip(heading, (0.2, 0.42), (15.0, 9.0), strict=False):
        bold = points > 9.0
        text, fitting = fitted(line, points, width, bold=bold)
        page.text(MARGIN, MARGIN + y, text, size=fitting, bold=bold)
    top = MARGIN + _TITLE
    for panel in panels:
        _side(page, panel, area._replace(top=top))
        top += panel.rows * area.row + _SIDE
    return page.figure


def _side(page: Paper, panel: Panel, area: _Area) -> None:
    """Draw one side: its headings, its boxes, and the lines between them."""
    if panel.title:
        page.text(area.left, area.top + 0.12, panel.title, size=10, bold=True)
    for k, title in enumerate(panel.rounds):
        text, size = fitted(title, _size(area), _BOX * area.column)
        left = area.left + k * area.column
        page.text(left, area.top + 0.34, text, size=size, color="0.35")
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
    y = area.top + _SIDE + panel.row(box) * area.row
    return area.left + box.column * area.column, y


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
        _line(page, line, x, y + (k - 0.5) * half, area)
    size = 0.62 * _size(area)
    if box.race:
        page.text(x + width, y - half - 0.02, box.race, size=size, color="0.35", ha="right")
    note = box.match if box.table is None else f"{box.match}  table {box.table}"
    room = width - (width_of(box.race, size) + _EDGE if box.race else 0.0)
    note, size = fitted(note, size, room, bold=playing)
    page.text(x, y - half - 0.02, note, size=size, color="0.35", bold=playing)


def _line(page: Paper, line: Line, x: float, y: float, area: _Area) -> None:
    """Write a player of a box, with seed and score."""
    size, left = _size(area), x + _EDGE
    if _has_seed(line):
        seed, points = fitted(str(line.seed), 0.7 * size, 0.9 * _SEED)
        page.centred(left + 0.4 * _SEED, y, seed, size=points, color="0.35")
        left += _SEED
    if line.score:
        right = x + _BOX * area.column - _EDGE
        page.centred(right, y, _score(line), size=size, bold=line.won, ha="right")
    text, size = _name(line, area)
    color = "black" if line.known else "0.45"
    page.centred(left, y, text, size=size, bold=line.won, ha="left", color=color)


def _has_seed(line: Line) -> bool:
    return line.seed is not None and line.known


def _score(line: Line) -> str:
    return line.score if line.score.isdigit() or not line.score else "w/o"


def _beside(line: Line, size: float) -> float:
    """Return the width that seed, score and edges take from a name."""
    score = width_of(_score(line), size, bold=line.won) + 2 * _EDGE if line.score else 0.0
    return 2 * _EDGE + (_SEED if _has_seed(line) else 0.0) + score


def _name(line: Line, area: _Area) -> tuple[str, float]:
    """Return what is written for a player, and its size in points."""
    size = _size(area)
    room = _BOX * area.column - _beside(line, size)
    short = area.short.get(line.text, "")
    return fitted(line.text, size, max(room, 0.1), short=short, bold=line.won)


def _needed(line: Line, area: _Area) -> float:
    """Return how wide a box has to be for a name in full."""
    size = _size(area)
    return width_of(line.text, size, bold=line.won) / 0.98 + _beside(line, size)
