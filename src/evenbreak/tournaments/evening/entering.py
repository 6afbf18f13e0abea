"""Who is in: entered, late, corrected or gone home."""

from __future__ import annotations

from collections.abc import Mapping

from evenbreak.tournaments.evening.events import Dropped, Edited, Entrant, Late


def listed(
    entrants: Mapping[str, Entrant], entry: Late | Edited | Dropped, *, drawn: bool
) -> dict[str, Entrant]:
    """Return the entrants after one has come, was corrected, or has gone."""
    match entry:
        case Late(entrant=late):
            return {**entrants, late.name: late}
        case Edited(name=name, entrant=now):
            return dict((now.name, now) if n == name else (n, e) for n, e in entrants.items())
        case Dropped(name=name):
            return {n: e for n, e in entrants.items() if drawn or n != name}


def let_in(late: Late, order: list[str], lines: list[int | None] | None) -> None:
    """Let a player in who comes after the draw."""
    if not order:
        return
    if late.line is not None and lines is not None:
        lines[late.line] = len(order)
    order.append(late.entrant.name)
