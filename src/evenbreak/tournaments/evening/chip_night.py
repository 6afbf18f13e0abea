"""A chip night's line: who is at which table, who is waiting, and everyone's remaining chips.

A rack's winner stays at the table. The loser pays a chip and goes to the end of the line, and the
first player in line comes to the table. Tables close as the field gets smaller, so that someone is
always waiting until two are left.

A correction gives the chip back and takes one from the other player. Racks played since then count
as they were played, unless one of the two had no chips left by then: such a rack is set aside. No
one who is playing is called away, except a player whose chips are gone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Group, Match, Place
from evenbreak.tournaments.chips.play import tables_in_use
from evenbreak.tournaments.evening.events import (
    Changed,
    Drawn,
    Dropped,
    Edited,
    Entrant,
    Event,
    Late,
    Opened,
    Plan,
    Result,
    Substituted,
)
from evenbreak.words import Parameter


class Rack(NamedTuple):
    """A rack that is or was being played, named R1, R2, ... in starting order.

    `after` is the rack on this table whose winner stays; None for the first rack.
    """

    name: str
    table: int
    players: tuple[str, str]
    since: str
    after: str | None = None


@dataclass(frozen=True)
class ChipNight:
    """A chip night at one moment.

    `chips` are those left, in draw order; `line` has the players waiting, next to play first;
    `gone` are players who are out or went home, in order.
    """

    racks: Mapping[str, Rack]
    chips: Mapping[str, int]
    tables: Mapping[int, str]
    line: tuple[str, ...]
    gone: tuple[str, ...]

    @property
    def playing(self) -> list[Rack]:
        """The racks in play, by table."""
        return [self.racks[name] for _, name in sorted(self.tables.items())]

    @property
    def order(self) -> list[str]:
        """Who is still in: the players at the tables, then the line."""
        return [name for rack in self.playing for name in rack.players] + list(self.line)

    @property
    def bracket(self) -> Bracket:
        """The racks as matches in a bracket."""
        seat = {name: k for k, name in enumerate(self.chips)}
        matches = [
            Match(rack.name, "Chips", 1, (seat[rack.players[0]], seat[rack.players[1]]))
            for rack in self.racks.values()
        ]
        return rack_bracket(tuple(seat), matches)


def rack_bracket(players: tuple[str, ...], racks: Sequence[Match] = ()) -> Bracket:
    """Return a bracket of racks, in which everyone gets a separate place."""
    members = tuple(range(len(players)))
    ranks = Group("Chips", members, (), (), tuple(Place(k + 1, k + 1) for k in members))
    return Bracket("chip tournament", players, tuple(racks), (ranks,))


def chips_of(plan: Plan, entrant: Entrant) -> int:
    """Return an entrant's starting chips."""
    if plan.chips is None:
        raise InputError(
            "a chip tournament needs a chip chart. Choose one with {chips}.",
            chips=Parameter("chips"),
        )
    return int(plan.chips.chips([entrant.rating])[0])


def chip_night(events: Sequence[Event]) -> ChipNight:
    """Return a chip night's state after events, none of which has been undone.

    >>> from evenbreak.tournaments import CHIP_CHARTS
    >>> players = tuple(Entrant(name, 620.0) for name in ("Ann", "Bo", "Cy"))
    >>> plan = Plan("chips", 1, chips=CHIP_CHARTS["hoboken"], scale="fargo")
    >>> happened = [Opened(plan, players), Drawn(("Ann", "Bo", "Cy"), None)]
    >>> happened += [Result("R1", ("Ann", "Bo"), (0, 1), "Bo")]
    >>> now = chip_night([Event("2025-03-01T19:30:00", what) for what in happened])
    >>> now.chips, now.playing[0].players, now.line
    ({'Ann': 3, 'Bo': 4, 'Cy': 4}, ('Bo', 'Cy'), ('Ann',))
    """
    if not events or not isinstance(opened := events[0].what, Opened):
        raise InputError("the first entry doesn't start a tournament")
    walk = _Walk(opened.plan)
    entrants = {one.name: one for one in opened.entrants}
    for event in events[1:]:
        match event.what:
            case Late(entrant=late) if not walk.start:
                entrants[late.name] = late
            case Edited(entrant=now) | Substituted(entrant=now):
                entrants[now.name] = now
            case Drawn(order=order):
                for name in order:
                    walk.enter(entrants[name])
            case Late(entrant=late):
                walk.enter(late)
            case Dropped(name=name) if name in walk.start:
                walk.leave(name)
                walk.dropped.add(name)
            case Changed(tables=int() as tables):
                walk.most = tables
            case Result() as result:
                walk.result(result, event.at)
        walk.fill(event.at)
    counted = {name: rack for name, rack in walk.racks.items() if name not in walk.aside}
    return ChipNight(counted, walk.chips, walk.tables, tuple(walk.line), tuple(walk.gone))


class _Walk:
    """A chip night as it progresses from event to event."""

    def __init__(self, plan: Plan) -> None:
        self.plan, self.most = plan, plan.tables
        self.start: dict[str, int] = {}  # chips
        self.chips: dict[str, int] = {}
        self.racks: dict[str, Rack] = {}
        self.won: dict[str, str] = {}  # by whom, in the order in which they were played
        self.aside: set[str] = set()
        self.tables: dict[int, str] = {}
        self.line: list[str] = []
        self.gone: list[str] = []
        self.dropped: set[str] = set()
        self.begun = 0

    @property
    def left(self) -> int:
        """How many are still in."""
        return len(self.chips) - len(self.gone)

    def enter(self, entrant: Entrant) -> None:
        """Let a player in, at the end of the line."""
        self.start[entrant.name] = self.chips[entrant.name] = chips_of(self.plan, entrant)
        self.line.append(entrant.name)

    def fill(self, at: str) -> None:
        """Bring the first players in line to free tables."""
        while self.left > 1 and len(self.tables) < tables_in_use(self.left, self.most):
            table = next(k for k in range(1, self.most + 1) if k not in self.tables)
            self.seat(table, (self.line.pop(0), self.line.pop(0)), at)

    def seat(self, table: int, players: tuple[str, str], at: str, after: str | None = None) -> None:
        """Start a rack."""
        self.begun += 1
        rack = Rack(f"R{self.begun}", table, players, at, after)
        self.racks[rack.name], self.tables[table] = rack, rack.name

    def result(self, result: Result, at: str) -> None:
        """Enter or correct a rack's result."""
        rack = self.racks.get(result.match)
        if rack is None or {result.winner, result.loser} != set(rack.players):
            players = " and ".join(result.players)
            raise InputError(
                "{match} isn't a rack between {players}", match=result.match, players=players
            )
        if rack.name in self.won:
            self.correct(rack, result.winner)
            return
        self.won[rack.name] = result.winner
        self.chips[result.loser] -= 1
        (self.line if self.chips[result.loser] else self.gone).append(result.loser)
        if self.closes(rack.table):
            del self.tables[rack.table]
            self.line.append(result.winner)
        else:
            self.seat(rack.table, (result.winner, self.line.pop(0)), at, rack.name)

    def correct(self, rack: Rack, winner: str) -> None:
        """Give a rack to the other player."""
        before, self.won[rack.name] = self.won[rack.name], winner
        self.count()
        now = self.racks.get(self.tables.get(rack.table, ""))
        if now is not None and now.after == rack.name:
            self.swap(now, before, winner)
        for name, chips in self.chips.items():
            if chips and name in self.gone and name not in self.dropped:
                self.gone.remove(name)
                self.line.append(name)
        for name in [name for name, chips in self.chips.items() if not chips]:
            if name not in self.gone:
                self.leave(name)

    def count(self) -> None:
        """Count the chips; a rack credited to a player who had none left is set aside."""
        self.chips, self.aside = dict(self.start), set()
        for name, winner in self.won.items():
            one, other = self.racks[name].players
            if self.chips[one] and self.chips[other]:
                self.chips[other if winner == one else one] -= 1
            else:
                self.aside.add(name)

    def swap(self, rack: Rack, wrong: str, right: str) -> None:
        """Keep the right player at a table whose next rack has just started."""
        if wrong == right or wrong not in rack.players:
            return
        if right in rack.players:
            self.racks[rack.name] = rack._replace(players=(right, wrong))
            return
        if right in self.line:
            self.line[self.line.index(right)] = wrong
        elif right in self.gone and right not in self.dropped:
            self.gone.remove(right)
            self.line.append(wrong)
        else:
            return  # went home, or is playing elsewhere by now
        players = tuple(right if name == wrong else name for name in rack.players)
        self.racks[rack.name] = rack._replace(players=(players[0], players[1]))

    def leave(self, name: str) -> None:
        """Let a player go: their opponent stays, and the next in line comes to the table."""
        if name in self.gone:
            return
        self.gone.append(name)
        if name in self.line:
            self.line.remove(name)
            return
        rack = next(self.racks[k] for k in self.tables.values() if name in self.racks[k].players)
        other = rack.players[name == rack.players[0]]
        if self.closes(rack.table):
            del self.tables[rack.table], self.racks[rack.name]
            self.line.insert(0, other)
        else:
            self.racks[rack.name] = rack._replace(players=(other, self.line.pop(0)))

    def closes(self, table: int) -> bool:
        """Return whether to close a table whose rack is over."""
        in_use = tables_in_use(self.left, self.most)
        return self.left < 2 or table > self.most or in_use < len(self.tables)
