"""A bracket as a page: whole on a laptop or a screen on the wall, a round at a time on a phone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from markupsafe import Markup

from evenbreak.answers.tournament.bracket_view import Box, Panel, short_names
from evenbreak.sheets.html_page import Section, drawn, html_page
from evenbreak.sheets.pdf_page import POINTS, fitted

COLUMN, ROW, WIDE, HIGH = 250.0, 66.0, 214.0, 46.0
"""The distance of columns and of rows, and the size of a box, in units of the drawing."""

_HEADINGS = 34.0
_LETTERS = 12.5  # the size of names in the drawing
_ROOM = WIDE - 60.0  # for a name


class _Drawn(NamedTuple):
    """A box in the drawing: its left end and its middle, and its two names.

    `squeezed` is the width that a name is squeezed into; 0 if it fits.
    """

    box: Box
    x: float
    y: float
    names: tuple[str, str]
    squeezed: tuple[float, float]
    path: str


def bracket_html(panels: Sequence[Panel], heading: Sequence[str]) -> bytes:
    """Return the bracket as a page of HTML in UTF-8.

    Parameters
    ----------
    panels
        the sides of the bracket.
    heading
        its name, and what else stands above it.

    >>> page = bracket_html([Panel("", ("Final",), ())], ["Tuesday"])
    >>> b"<h1>Tuesday</h1>" in page
    True
    """
    links, sections = [], []
    for number, panel in enumerate(panels, start=1):
        title = panel.title or "Bracket"
        name = f"side-{number}"
        links.append((name, title))
        sections.append(Section(name, title, drawn_panel(panel, name)))
    return html_page(
        heading=list(heading),
        links=links if len(links) > 1 else [],
        sections=sections,
        below="",
        made_of="",
    )


def drawn_panel(panel: Panel, name: str) -> Markup:
    """Return one side of a bracket, whose heading has the id `name`-title, for a page."""
    return drawn("bracket", panel, _drawing(panel), name)


def _drawing(panel: Panel) -> dict[str, object]:
    """Return what the drawing of a side needs."""
    height = _HEADINGS + panel.rows * ROW
    places = {
        box.match: (box.column * COLUMN + 1.0, _HEADINGS + panel.row(box) * ROW)
        for box in panel.boxes
    }
    column = {box.match: box.column for box in panel.boxes}
    short = short_names(line.text for box in panel.boxes for line in box.lines if line.known)
    room = _ROOM / POINTS
    boxes = []
    for box in panel.boxes:
        x, y = places[box.match]
        path = ""
        if box.to and column[box.to] > box.column:
            other_x, other_y = places[box.to]
            middle = 0.5 * (x + WIDE + other_x)
            path = f"M{x + WIDE:g} {y:g}H{middle:g}V{other_y:g}H{other_x:g}"
        names = [
            fitted(line.text, _LETTERS, room, short=short.get(line.text, "")) for line in box.lines
        ]
        squeezed = [_ROOM if size < _LETTERS else 0.0 for _, size in names]
        boxes.append(
            _Drawn(box, x, y, (names[0][0], names[1][0]), (squeezed[0], squeezed[1]), path)
        )
    return {
        "width": len(panel.rounds) * COLUMN - (COLUMN - WIDE) + 2.0,
        "height": height,
        "boxes": boxes,
        "wide": WIDE,
        "high": HIGH,
        "column": COLUMN,
    }
