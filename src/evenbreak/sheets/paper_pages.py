"""Lists and cards to print: the draw, each player with their first match; and score cards."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from evenbreak.answers.tournament.printed import Card
from evenbreak.sheets.pdf_page import MARGIN, PAPERS, Paper, fitted, pdf_bytes

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


def draw_list_pdf(
    players: Sequence[FirstMatch], event: str, about: str = "", *, paper: str = "a4"
) -> bytes:
    """Return the draw as a PDF of upright pages, the players by name.

    Parameters
    ----------
    players
        everybody in the draw.
    event
        the name of the tournament.
    about
        what is played.
    paper
        'a4' or 'letter'.

    >>> draw_list_pdf([FirstMatch("Ann", 1, "W1.1", "Bo", 3)], "Tuesday")[:5]
    b'%PDF-'
    """
    listed = sorted(players, key=lambda first_match: first_match.name.casefold())
    wide, high = PAPERS[paper].upright
    most = int((high - MARGIN - _TOP) / _ROW)
    pages = []
    for start in range(0, max(1, len(listed)), most):
        page = Paper((wide, high))
        title, size = fitted(f"The draw: {event}", 16, wide - 2 * MARGIN, bold=True)
        page.text(MARGIN, MARGIN + 0.2, title, size=size, bold=True)
        line, size = fitted(about, 10, wide - 2 * MARGIN)
        page.text(MARGIN, MARGIN + 0.45, line, size=size)
        for k, first_match in enumerate(listed[start : start + most]):
            _row(page, first_match, _TOP + (k + 0.7) * _ROW, wide, grey=k % 2 == 0)
        pages.append(page.figure)
    return pdf_bytes(pages, f"The draw: {event}")


def _row(page: Paper, first_match: FirstMatch, y: float, wide: float, *, grey: bool) -> None:
    if grey:
        page.band(MARGIN, y - 0.7 * _ROW, wide - 2 * MARGIN, _ROW, grey="0.93")
    name, size = fitted(first_match.name, _SIZE, 2.6, bold=True)
    page.text(MARGIN + 0.05, y, name, size=size, bold=True)
    page.text(MARGIN + 2.75, y, f"seed {first_match.seed}", size=9, color="0.3")
    page.text(MARGIN + 3.45, y, first_match.match, size=_SIZE)
    against = f"against {first_match.other}" if first_match.other else ""
    against, size = fitted(against, _SIZE, 2.1)
    page.text(MARGIN + 4.3, y, against, size=size)
    if first_match.table is not None:
        page.text(wide - MARGIN - 0.05, y, f"table {first_match.table}", size=_SIZE, ha="right")


_GAP = 0.25
MOST_BOXES = 15
"""Games in boxes to tick; a longer race gets a field for the score."""


def score_cards_pdf(
    cards: Sequence[Card], event: str, *, per_page: int = 4, paper: str = "a4"
) -> bytes:
    """Return score cards as a PDF.

    Parameters
    ----------
    cards
        the cards.
    event
        the name of the tournament, on each card.
    per_page
        1 or 4.
    paper
        'a4' or 'letter'.

    >>> card = Card("W1.1", "winners' side, round 1", ("Ann", "Bo"), (7, 5), 3, ())
    >>> score_cards_pdf([card], "Tuesday")[:5]
    b'%PDF-'
    """
    pages = []
    room_wide, room_high = (side - 2 * MARGIN for side in PAPERS[paper])
    for start in range(0, len(cards), per_page):
        page = Paper(PAPERS[paper])
        for k, card in enumerate(cards[start : start + per_page]):
            if per_page == 1:
                _card(page, card, event, MARGIN, MARGIN, room_wide, room_high)
                continue
            wide, high = (room_wide - _GAP) / 2, (room_high - _GAP) / 2
            left, top = MARGIN + (k % 2) * (wide + _GAP), MARGIN + (k // 2) * (high + _GAP)
            _card(page, card, event, left, top, wide, high)
        pages.append(page.figure)
    return pdf_bytes(pages, f"Score cards: {event}")


def _card(
    page: Paper, card: Card, event: str, left: float, top: float, wide: float, high: float
) -> None:
    """Draw a card in a rectangle."""
    unit = high / 3.5  # a card that fills the page has larger letters
    page.frame(left, top, wide, high, thick=0.8)
    inner, right = left + 0.15 * unit, left + wide - 0.15 * unit
    room = right - inner
    title, size = fitted(event, 9 * unit, 0.6 * room)
    page.text(inner, top + 0.32 * unit, title, size=size)
    table = "table ____" if card.table is None else f"table {card.table}"
    page.text(right, top + 0.36 * unit, table, size=16 * unit, bold=True, ha="right")
    page.text(inner, top + 0.56 * unit, f"{card.match}: {card.where}", size=8 * unit, color="0.3")
    for k, (name, needs) in enumerate(zip(card.names, card.needs, strict=True)):
        y = top + (1.0 + 0.88 * k) * unit
        _player(page, name, needs, inner, y, room, unit)
    y = top + 2.82 * unit
    page.text(inner, y, "Final score", size=9 * unit)
    page.line((inner + 0.85 * unit, inner + 1.9 * unit), (y, y))
    page.text(inner + 2.05 * unit, y, "Signed", size=9 * unit)
    page.line((inner + 2.55 * unit, right), (y, y))
    onward = "  ".join(card.onward)
    onward, size = fitted(onward, 8 * unit, room)
    page.text(inner, top + 3.3 * unit, onward, size=size)


def _player(
    page: Paper, name: str, needs: int, left: float, y: float, room: float, unit: float
) -> None:
    """Write a player's name and race, with a box for each game."""
    text, size = fitted(name, 15 * unit, room - 1.1 * unit, bold=True)
    page.text(left, y, text, size=size, bold=True)
    page.text(left + room, y, f"needs {needs}", size=11 * unit, ha="right")
    if needs > MOST_BOXES:
        page.frame(left, y + 0.1 * unit, 1.2 * unit, 0.32 * unit)
        return
    step = min(0.4 * unit, room / needs)
    for game in range(needs):
        page.frame(left + game * step, y + 0.12 * unit, 0.8 * step, 0.8 * step)
