"""A bracket: matches with two slots each, and where winners and losers go next.

A slot either has a player from the start or is filled from an earlier match or group. A player with
no next match has finished and takes a place. Byes are resolved when a bracket is built, so every
match in it has two players.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from evenbreak.errors import InputError

if TYPE_CHECKING:
    import networkx as nx


class Place(NamedTuple):
    """A finishing place, or several that aren't played off: 5-6 is `Place(5, 6)`.

    >>> str(Place(1, 1)), str(Place(5, 6)), str(Place(1, 1, "consolation"))
    ('1', '5-6', 'consolation 1')
    """

    first: int
    last: int
    event: str = ""

    def __str__(self) -> str:
        span = f"{self.first}" if self.first == self.last else f"{self.first}-{self.last}"
        return f"{self.event} {span}".lstrip()


class Source(NamedTuple):
    """Where a slot's player comes from.

    Parameters
    ----------
    outcome
        'winner' or 'loser' of that match, or the rank in that group, with 1 for its winner.
    via
        1 or 2: the player comes only if they were in that slot of the earlier match, and the
        slot stays empty otherwise. None: either slot.
    """

    match: str
    outcome: str | int
    via: int | None = None


Slot: TypeAlias = int | Source
"""A player, by position in the bracket's list (from 0), or the source of a later player."""


@dataclass(frozen=True)
class Match:
    """A match in a bracket.

    Parameters
    ----------
    name
        'W1.1' is the first match of round 1 on the winners' side.
    side
        the part of the bracket: 'winners', 'losers', 'final', 'group A'.
    round
        the round on that side, counting from 1.
    winner_place, loser_place
        the place of a winner or loser with no next match; None if there is always a next match.
    """

    name: str
    side: str
    round: int
    slots: tuple[Slot, Slot]
    winner_place: Place | None = None
    loser_place: Place | None = None


@dataclass(frozen=True)
class Group:
    """A group in which everyone plays everyone.

    Players are ranked by matches won. Ties are broken by matches won among the tied players,
    repeatedly among those still tied, and finally by lot.

    Parameters
    ----------
    members
        by position.
    matches
        their names.
    pairs
        the two players of each match, by position.
    places
        each rank's place, best first; None for a rank that qualifies.
    """

    name: str
    members: tuple[int, ...]
    matches: tuple[str, ...]
    pairs: tuple[tuple[int, int], ...]
    places: tuple[Place | None, ...]


@dataclass(frozen=True)
class RunnersUp:
    """The players with one rank in all groups, of whom the best advance.

    They are compared by the share of matches won, which counts alike in groups of any size. Ties
    are broken by lot.

    Parameters
    ----------
    rank
        the rank, counting from 1.
    weights
        how much a match won in each group counts, by group name, so that equal shares are equal.
    places
        each player's place, best first; None for those who advance.
    settled
        in a tournament in progress: the player with this rank in each finished group, and the
        weight of their matches won.
    """

    rank: int
    weights: tuple[tuple[str, int], ...]
    places: tuple[Place | None, ...]
    settled: tuple[tuple[str, int, int], ...] = ()

    @property
    def name(self) -> str:
        """Their name in a source: the rank. Groups are named with letters."""
        return str(self.rank)

    @property
    def going_on(self) -> int:
        """How many of them advance."""
        return self.places.count(None)


class GoesOn(NamedTuple):
    """Whether a match's winner and loser have a next match, by the slot they come from."""

    winner: tuple[bool, bool]
    loser: tuple[bool, bool]


@dataclass(frozen=True)
class Bracket:
    """A tournament: its matches, and where winners and losers go.

    Parameters
    ----------
    format
        the type of tournament, in words.
    players
        the names, in seed order.
    matches
        the matches; each comes after the matches that feed it.
    byes
        (match, player) for each first match that is a bye, for the printed sheet.
    runners_up
        the players with one rank in the groups, if only the best of them advance.

    >>> from evenbreak.tournaments import single_elimination
    >>> bracket = single_elimination(["Ann", "Bo", "Cy"])
    >>> bracket.match("F").slots
    (0, Source(match='W1.2', outcome='winner', via=None))
    >>> bracket.byes, [str(place) for place in bracket.places]
    ((('W1.1', 0),), ['1', '2', '3'])
    >>> list(bracket.graph.edges(data=True))
    [('W1.2', 'F', {'winner': 2})]
    """

    format: str
    players: tuple[str, ...]
    matches: tuple[Match, ...]
    groups: tuple[Group, ...] = ()
    byes: tuple[tuple[str, int], ...] = field(default=(), compare=False)
    runners_up: RunnersUp | None = None

    @cached_property
    def places(self) -> tuple[Place, ...]:
        """All finishing places, best first; a consolation event's places come last."""
        found = {match.winner_place for match in self.matches}
        found |= {match.loser_place for match in self.matches}
        found |= {place for group in self.groups for place in group.places}
        found |= {*(self.runners_up.places if self.runners_up else ())}
        return tuple(
            sorted((place for place in found if place), key=lambda p: (p.event, p.first, p.last))
        )

    @cached_property
    def graph(self) -> nx.DiGraph[str]:
        """The matches as a frozen directed graph.

        A node is a match (with `side`, `round` and `slots`) or a group. An arc gives the slot that
        the winner or the loser goes to (`winner=2`, `loser=1`), or the slot for each rank in a
        group (`ranks={1: 2}`). A node named after a rank stands for the runners-up.
        """
        import networkx as nx

        graph: nx.DiGraph[str] = nx.DiGraph()
        for group in self.groups:
            graph.add_node(group.name, side="group", round=0, slots=group.members)
        for match in self.matches:
            graph.add_node(match.name, side=match.side, round=match.round, slots=match.slots)
        for group in self.groups:
            graph.add_edges_from((name, group.name) for name in group.matches)
        if self.runners_up:
            name = self.runners_up.name
            graph.add_node(name, side="group", round=0, slots=())
            graph.add_edges_from((group.name, name) for group in self.groups)
        for match in self.matches:
            for number, slot in enumerate(match.slots, 1):
                if isinstance(slot, int):
                    continue
                graph.add_edge(slot.match, match.name)
                arc = graph.edges[slot.match, match.name]
                if isinstance(slot.outcome, str):
                    arc[slot.outcome] = number
                else:
                    arc.setdefault("ranks", {})[slot.outcome] = number
        frozen: nx.DiGraph[str] = nx.freeze(graph)
        return frozen

    @cached_property
    def outlets(self) -> dict[str, list[Source]]:
        """The slots waiting for someone from a match, a group or the runners-up, by its name."""
        found: dict[str, list[Source]] = {}
        for match in self.matches:
            for slot in match.slots:
                if isinstance(slot, Source):
                    found.setdefault(slot.match, []).append(slot)
        return found

    @cached_property
    def by_name(self) -> dict[str, Match]:
        """The matches by name."""
        return {match.name: match for match in self.matches}

    @cached_property
    def going(self) -> dict[str, GoesOn]:
        """Whether each match's winner and loser have a next match."""
        slots = [slot for match in self.matches for slot in match.slots]
        waiting = {slot for slot in slots if isinstance(slot, Source)}

        def waited(name: str, outcome: str, sat: int) -> bool:
            return Source(name, outcome) in waiting or Source(name, outcome, sat) in waiting

        return {
            match.name: GoesOn(
                (waited(match.name, "winner", 1), waited(match.name, "winner", 2)),
                (waited(match.name, "loser", 1), waited(match.name, "loser", 2)),
            )
            for match in self.matches
        }

    def match(self, name: str) -> Match:
        """Return a match by name.

        Raises
        ------
        InputError
            if the bracket has no match with this name.
        """
        if name not in self.by_name:
            raise InputError(
                "match must be one of {by_name}; you gave {name!r}",
                name=name,
                by_name=some_of(list(self.by_name)),
            )
        return self.by_name[name]

    def player(self, name: str) -> int:
        """Return a player's position.

        Raises
        ------
        InputError
            if no one in the bracket has this name.
        """
        if name not in self.players:
            raise InputError(
                "player must be one of {players}; you gave {name!r}",
                name=name,
                players=some_of(self.players),
            )
        return self.players.index(name)


def some_of(names: list[str] | tuple[str, ...]) -> str:
    """Return names for an error message, shortened if there are many.

    >>> some_of([str(n) for n in range(100)])
    '0, 1, 2, 3, 4, 5, ... 99'
    """
    if len(names) <= 20:
        return ", ".join(names)
    return ", ".join([*names[:6], f"... {names[-1]}"])
