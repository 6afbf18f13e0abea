"""Who is in an evening: entered, here, late, replacing someone, or gone home."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from evenbreak.errors import InputError
from evenbreak.tournaments.evening.events import (
    Called,
    CalledBack,
    CheckedIn,
    Declined,
    Drawn,
    Dropped,
    Edited,
    Entrant,
    Late,
    Ranked,
    Registered,
    Result,
    Scored,
    Substituted,
    Swapped,
    Waits,
    What,
)

DrawnUp: TypeAlias = tuple[tuple[str, ...], tuple[int | None, ...] | None]


class People:
    """Who is in and in what order, who has checked in and paid, and who would like to play."""

    def __init__(self, entrants: Sequence[Entrant]) -> None:
        self.entrants = {one.name: one for one in entrants}
        self.order: list[str] = []
        self.lines: list[int | None] | None = None
        self.dropped: list[str] = []
        self.arrived: set[str] = set()
        self.paid: set[str] = set()
        self.registered: dict[str, float | None] = {}

    @property
    def drawn_up(self) -> DrawnUp:
        """The players in seed order, and the player on each first-round line."""
        return tuple(self.order), None if self.lines is None else tuple(self.lines)

    def take(self, what: What, *, in_pairs: bool = False) -> None:
        """Apply an entry; with `in_pairs` (a Swiss round), its pairs aren't seeds.

        Raises InputError for a player who hasn't entered, as in a damaged file.
        """
        for name in _names_in(what):
            if name not in self.entrants:
                raise InputError("{player} hasn't entered", player=name)
        match what:
            case Drawn():
                self.draw(what)
            case Late(entrant=late):
                self.let_in(late, what.line)
            case Edited(name=name, entrant=now) | Substituted(name=name, entrant=now):
                self.put(name, now)
                self.tick(name, to=now.name if isinstance(what, Edited) else "")
            case Swapped(one=one, other=other) if not in_pairs:
                trade = {one: other, other: one}
                self.order = [trade.get(name, name) for name in self.order]
            case CheckedIn():
                self.check_in(what)
            case Registered(name=name, rating=rating):
                self.registered[name] = rating
            case Declined(name=name):
                self.registered.pop(name, None)
            case Dropped(name=name):
                self.drop(name)

    def draw(self, draw: Drawn) -> None:
        """Draw players; anyone left out may be added late."""
        if len({*draw.order}) < len(draw.order):
            raise InputError("a player is in the draw twice")
        self.order = list(draw.order)
        self.lines = None if draw.lines is None else list(draw.lines)
        absent = [one for name, one in self.entrants.items() if name not in self.order]
        self.registered |= {one.name: None if one.provisional else one.rating for one in absent}
        for one in absent:
            del self.entrants[one.name]

    def let_in(self, late: Entrant, line: int | None) -> None:
        """Add a player: after the draw, at the end or on a bye's line."""
        if late.name in self.entrants:
            raise InputError("{player} has already entered", player=late.name)
        self.registered.pop(late.name, None)
        self.entrants[late.name] = late
        if self.order:
            if line is not None and self.lines is not None:
                self.lines[line] = len(self.order)
            self.order.append(late.name)

    def put(self, name: str, now: Entrant) -> None:
        """Replace a player with an entrant."""
        if now.name != name and now.name in self.entrants:
            raise InputError("{player} has already entered", player=now.name)
        self.registered.pop(now.name, None)
        self.entrants = dict(
            (now.name, now) if n == name else (n, one) for n, one in self.entrants.items()
        )
        self.order = [now.name if n == name else n for n in self.order]
        self.dropped = [n for n in self.dropped if n != name]  # somebody is here again

    def check_in(self, entry: CheckedIn) -> None:
        """Record that a player has come, or paid, or not."""
        for who, is_in in ((self.arrived, entry.arrived), (self.paid, entry.paid)):
            if is_in is not None:
                (who.add if is_in else who.discard)(entry.name)

    def drop(self, name: str) -> None:
        """Let a player go home."""
        if self.order:
            self.dropped.append(name)
        else:
            del self.entrants[name]
            self.tick(name)

    def tick(self, name: str, to: str = "") -> None:
        """Forget that a player has checked in and paid, or move that to another name."""
        for who in (self.arrived, self.paid):
            if name in who:
                who.remove(name)
                who |= {to} - {""}


def _names_in(what: What) -> tuple[str, ...]:
    """Return the players in an entry who must have entered before it."""
    match what:
        case Called(players=names) | CalledBack(players=names) | Scored(players=names):
            return names
        case Result(players=names, winner=winner):
            if winner not in names:
                raise InputError("{player} won a match they aren't in", player=winner)
            return names
        case Waits(players=names) | Ranked(order=names) | Drawn(order=names):
            return names
        case Swapped(one=one, other=other):
            return one, other
        case Dropped(name=name) | Edited(name=name) | CheckedIn(name=name):
            return (name,)
        case Substituted(name=name):
            return (name,)
    return ()
