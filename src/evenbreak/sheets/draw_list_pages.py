"""The draw as a list to print: each player by name, with the first match, whom they meet, where."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from evenbreak.sheets.pdf_page import HEIGHT, MARGIN, WIDTH, Paper, fitted, pdf_bytes

_SIZE, _ROW = 11.0, 0.27
_TOP = MARGIN + 0.75


class FirstMatch(NamedTuple):
    """A player of the draw list.

    Parameters
    ----------
    name, seed
        the player.
    match, other
        the first match, and who is met there; '' if there is none.
    table
        where it is played; None: not called yet.
    """

    name: str
    seed: int
    match: str
    other: str
    table: int | None


def draw_list_pdf(players: Sequence[FirstMatch], event: str, about: str = "") -> bytes:
    """Return the draw as a PDF of A4 pages, upright, the players by name.

    Parameters
    ----------
    players
        everybody in the draw.
    event
        the name of the tournament.
    about
        what is played.

    >>> draw_list_pdf([FirstMatch("Ann", 1, "W1.1", "Bo", 3)], "Tuesday")[:5]
    b'%PDF-'
    """
    listed = sorted(players, key=lambda one: one.name.casefold())
    wide, high = HEIGHT, WIDTH
    most = int((high - MARGIN - _TOP) / _ROW)
    pages = []
    for start in range(0, max(1, len(listed)), most):
        page = Paper(wide, high)
        title, size = fitted(f"The draw: {event}", 16, wide - 2 * MARGIN, bold=True)
        page.text(MARGIN, MARGIN + 0.2, title, size=size, bold=True)
        line, size = fitted(about, 10, wide - 2 * MARGIN)
        page.text(MARGIN, MARGIN + 0.45, line, size=size)
        for k, one in enumerate(listed[start : start + most]):
            _row(page, one, _TOP + (k + 0.7) * _ROW, wide, grey=k % 2 == 0)
        pages.append(page.figure)
    return pdf_bytes(pages, f"The draw: {event}")


def _row(page: Paper, one: FirstMatch, y: float, wide: float, *, grey: bool) -> None:
    if grey:
        page.band(MARGIN, y - 0.7 * _ROW, wide - 2 * MARGIN, _ROW, grey="0.93")
    name, size = fitted(one.name, _SIZE, 2.6, bold=True)
    page.text(MARGIN + 0.05, y, name, size=size, bold=True)
    page.text(MARGIN + 2.75, y, f"seed {one.seed}", size=9, color="0.3")
    page.text(MARGIN + 3.45, y, one.match, size=_SIZE)
    against = f"against {one.other}" if one.other else ""
    against, size = fitted(against, _SIZE, 2.1)
    page.text(MARGIN + 4.3, y, against, size=size)
    if one.table is not None:
        page.text(wide - MARGIN - 0.05, y, f"table {one.table}", size=_SIZE, ha="right")
