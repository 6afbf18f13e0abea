"""Lists and cards to print: the draw, with each player's first match, and score cards."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeAlias

from evenbreak.answers.tournament.printed import Card
from evenbreak.sheets.pdf_page import MARGIN, PAPERS, Paper, fitted, pdf_bytes

_SIZE, _ROW = 11.0, 0.27
_MOST_ROW = 0.95  # of a list that is short
_TOP = MARGIN + 0.75


class FirstMatch(NamedTuple):
    """A player on the draw list; `match` is 0 without a first match, `table` '' before the call."""

    name: str
    seed: int
    match: int
    other: str
    table: str


def draw_list_pdf(
    players: Sequence[FirstMatch], event: str, about: str = "", *, paper: str = "a4"
) -> bytes:
    """Return the draw as a PDF of portrait pages ('a4' or 'letter'), players sorted by name.

    >>> draw_list_pdf([FirstMatch("Ann", 1, 1, "Bo", "3")], "Tuesday")[:5]
    b'%PDF-'
    """
    listed = sorted(players, key=lambda first_match: first_match.name.casefold())
    wide, high = PAPERS[paper].upright
    most = int((high - MARGIN - _TOP) / _ROW)
    row = min(_MOST_ROW, max(_ROW, (high - MARGIN - _TOP) / max(1, len(listed))))
    pages = []
    for start in range(0, max(1, len(listed)), most):
        page = Paper((wide, high))
        title, size = fitted(f"The draw: {event}", 16, wide - 2 * MARGIN, bold=True)
        page.text(MARGIN, MARGIN + 0.2, title, size=size, bold=True)
        line, size = fitted(about, 10, wide - 2 * MARGIN)
        page.text(MARGIN, MARGIN + 0.45, line, size=size)
        for k, first_match in enumerate(listed[start : start + most]):
            _row(page, first_match, _TOP + k * row, row, gray=k % 2 == 0)
        pages.append(page.figure)
    return pdf_bytes(pages, f"The draw: {event}")


def _row(page: Paper, first_match: FirstMatch, top: float, high: float, *, gray: bool) -> None:
    wide, y = page.wide, top + 0.5 * high + 0.054
    if gray:
        page.band(MARGIN, top, wide - 2 * MARGIN, high, gray="0.93")
    name, size = fitted(first_match.name, _SIZE * min(1.5, high / _ROW), 2.6, bold=True)
    page.text(MARGIN + 0.05, y, name, size=size, bold=True)
    page.text(MARGIN + 2.75, y, f"seed {first_match.seed}", size=9, color="0.3")
    number = f"match {first_match.match}" if first_match.match else ""
    page.text(MARGIN + 3.4, y, number, size=_SIZE)
    against = f"against {first_match.other}" if first_match.other else ""
    against, size = fitted(against, _SIZE, 2.35)
    page.text(MARGIN + 4.2, y, against, size=size)
    if first_match.table:
        page.text(wide - MARGIN - 0.05, y, f"table {first_match.table}", size=_SIZE, ha="right")


_GAP = 0.25
MOST_BOXES = 15
"""The most games with a box each to check; a longer race gets a field for the score."""


def score_cards_pdf(
    cards: Sequence[Card],
    event: str,
    *,
    per_page: int = 4,
    paper: str = "a4",
    codes: Mapping[str, str] | None = None,
    address: str = "",
) -> bytes:
    """Return score cards as a PDF, 1 or 4 per page ('a4' or 'letter').

    A player's code claims a phone for them; it follows `address`, such as
    'http://192.168.1.7:8000/c/'.

    >>> card = Card(1, "winners’ side, round 1", ("Ann", "Bo"), (7, 5), "3", "")
    >>> score_cards_pdf([card], "Tuesday")[:5]
    b'%PDF-'
    """
    pages = []
    claims = {name: (code, f"{address}{code}") for name, code in (codes or {}).items()}
    room_wide, room_high = (side - 2 * MARGIN for side in PAPERS[paper])
    for start in range(0, len(cards), per_page):
        page = Paper(PAPERS[paper])
        for k, card in enumerate(cards[start : start + per_page]):
            if per_page == 1:
                _card(page, card, event, claims, (MARGIN, MARGIN, room_wide, room_high))
                continue
            wide, high = (room_wide - _GAP) / 2, (room_high - _GAP) / 2
            left, top = MARGIN + (k % 2) * (wide + _GAP), MARGIN + (k // 2) * (high + _GAP)
            _card(page, card, event, claims, (left, top, wide, high))
        pages.append(page.figure)
    return pdf_bytes(pages, f"Score cards: {event}")


_Claims: TypeAlias = Mapping[str, tuple[str, str]]
"""Each player's code, and the address where it claims a phone."""


def _card(
    page: Paper, card: Card, event: str, claims: _Claims, place: tuple[float, float, float, float]
) -> None:
    """Draw a card in a rectangle."""
    left, top, wide, high = place
    unit = high / 3.5  # a card that fills the page has larger letters
    page.frame(left, top, wide, high, thick=0.8)
    inner, right = left + 0.15 * unit, left + wide - 0.15 * unit
    room = right - inner
    page.text(inner, top + 0.36 * unit, f"Match {card.number}", size=16 * unit, bold=True)
    table = f"table {card.table}" if card.table else "table ____"
    page.text(right, top + 0.36 * unit, table, size=16 * unit, bold=True, ha="right")
    about, size = fitted(f"{event} · {card.where}", 8 * unit, room)
    page.text(inner, top + 0.58 * unit, about, size=size, color="0.3")
    for k, (name, needs) in enumerate(zip(card.names, card.needs, strict=True)):
        y = top + (0.98 + 0.88 * k) * unit
        _player(page, (name, needs), claims.get(name), (inner, y, room), unit)
    y = top + 2.86 * unit
    page.text(inner, y, "Final score", size=9 * unit)
    page.line((inner + 0.85 * unit, inner + 1.9 * unit), (y, y))
    page.text(inner + 2.05 * unit, y, "Signed", size=9 * unit)
    page.line((inner + 2.55 * unit, right), (y, y))
    onward, size = fitted(str(card.onward), 8 * unit, room)
    page.text(inner, top + 3.3 * unit, onward, size=size)


def _player(
    page: Paper,
    player: tuple[str, int],
    claim: tuple[str, str] | None,
    place: tuple[float, float, float],
    unit: float,
) -> None:
    """Write a player's name and race, with a box for each game, and the code for their phone."""
    (name, needs), (left, y, room) = player, place
    if claim:
        code, address = claim
        side = 0.62 * unit
        page.code(left + room - side, y - 0.2 * unit, side, address)
        at = y + 0.54 * unit
        page.text(left + room - 0.5 * side, at, code, size=8 * unit, bold=True, ha="center")
        room -= side + 0.1 * unit
    text, size = fitted(name, 15 * unit, room - 0.8 * unit, bold=True)
    page.text(left, y, text, size=size, bold=True)
    page.text(left + room, y, f"needs {needs}", size=11 * unit, ha="right")
    if needs > MOST_BOXES:
        page.frame(left, y + 0.1 * unit, 1.2 * unit, 0.32 * unit)
        return
    step = min(0.4 * unit, room / needs)
    for game in range(needs):
        page.frame(left + game * step, y + 0.12 * unit, 0.8 * step, 0.8 * step)
