"""A bracket as a page: whole on a laptop or a screen on the wall, a round at a time on a phone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from evenbreak.answers.bracket_view import Box, Panel
from evenbreak.sheets.answer_page import Section
from evenbreak.sheets.html_page import drawn, html_page
from evenbreak.sheets.pdf_page import POINTS, shortened

COLUMN, ROW, WIDE, HIGH = 250.0, 66.0, 214.0, 46.0
"""The distance of columns and of rows, and the size of a box, in units of the drawing."""

_HEADINGS = 34.0
_LETTERS = 13.0  # their size in the drawing


class _Drawn(NamedTuple):
    """A box in the drawing: its left end and its middle, and its two lines, shortened."""

    box: Box
    x: float
    y: float
    names: tuple[str, str]
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
        sections.append(Section(name, title, drawn("bracket", panel, _drawing(panel), name)))
    return html_page(
        heading=list(heading),
        links=links if len(links) > 1 else [],
        sections=sections,
        below="",
        made_of="",
    )


def _drawing(panel: Panel) -> dict[str, object]:
    """Return what the drawing of a side needs."""
    height = _HEADINGS + panel.most * ROW
    places = {
        box.match: (box.column * COLUMN + 1.0, _HEADINGS + box.height * panel.most * ROW)
        for box in panel.boxes
    }
    column = {box.match: box.column for box in panel.boxes}
    boxes = []
    for box in panel.boxes:
        x, y = places[box.match]
        path = ""
        if box.to and column[box.to] > box.column:
            other_x, other_y = places[box.to]
            middle = 0.5 * (x + WIDE + other_x)
            path = f"M{x + WIDE:g} {y:g}H{middle:g}V{other_y:g}H{other_x:g}"
        boxes.append(_Drawn(box, x, y, _names(box), path))
    return {
        "width": len(panel.rounds) * COLUMN - (COLUMN - WIDE) + 2.0,
        "height": height,
        "boxes": boxes,
        "wide": WIDE,
        "high": HIGH,
        "column": COLUMN,
    }


def _names(box: Box) -> tuple[str, str]:
    room = (WIDE - 60.0) / POINTS
    one, other = (shortened(line.text, 0.96 * _LETTERS, room) for line in box.lines)
    return one, other
