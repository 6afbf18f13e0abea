"""Who is in: entered, late, corrected or gone home."""

from __future__ import annotations

from collections.abc import Mapping

from evenbreak.errors import InputError
from evenbreak.tournaments.evening.events import (
    Called,
    CalledBack,
    Drawn,
    Dropped,
    Edited,
    Entrant,
    Late,
    Ranked,
    Result,
    Scored,
    What,
)


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


def refuse_strangers(what: What, entrants: Mapping[str, Entrant]) -> None:
    """Refuse an event with a player who has not entered, as only a damaged file holds it."""
    match what:
        case Called(players=names) | CalledBack(players=names) | Scored(players=names):
            pass
        case Ranked(order=names):
            pass
        case Result(players=names, winner=winner):
            if winner not in names:
                raise InputError("{player} won a match they are not in", player=winner)
        case Drawn(order=names):
            if sorted(names) != sorted(entrants):
                raise InputError("the draw does not match the players who have entered")
        case Dropped(name=name) | Edited(name=name):
            names = (name,)
        case Late(entrant=entrant) if entrant.name in entrants:
            raise InputError("{player} has already entered", player=entrant.name)
        case _:
            return
    for name in names:
        if name not in entrants:
            raise InputError("{player} has not entered", player=name)
