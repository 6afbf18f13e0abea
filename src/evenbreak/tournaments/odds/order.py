"""The order in which matches are processed, so that few joint states are open at a time.

A slot is *open* from the match that fills it to the match that it belongs to. Open slots that
depend on each other have a joint distribution, and the number of its states is the cost. The
order is greedy: the next match is the one that needs the fewest states.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass, field
from typing import NamedTuple

from evenbreak.tournaments.brackets.bracket import Bracket, Group, Match, Source


class Order(NamedTuple):
    """The order in which matches and groups are processed.

    Parameters
    ----------
    names
        the matches and groups.
    states
        an estimate of the joint states of all steps together, on the high side.
    """

    names: tuple[str, ...]
    states: float


@dataclass
class _Part:
    """Open slots that depend on each other: about how many states, and who can be in each slot."""

    size: float
    slots: dict[Source, int] = field(default_factory=dict)


class _Cost(NamedTuple):
    parts: list[_Part]
    joined: float
    after: _Part


def elimination_order(bracket: Bracket) -> Order:
    """Return a cheap order in which to process the matches of a bracket.

    >>> from evenbreak.tournaments import single_elimination
    >>> elimination_order(single_elimination(4))
    Order(names=('W1.1', 'W1.2', 'F'), states=11.0)
    """
    search = _Search(bracket)
    for name in search.items:
        search.offer(name)
    while search.heap:
        search.step()
    return Order(tuple(search.done), search.states)


class _Search:
    def __init__(self, bracket: Bracket) -> None:
        in_group = {name for group in bracket.groups for name in group.matches}
        self.items: dict[str, Match | Group] = {group.name: group for group in bracket.groups}
        self.items |= {match.name: match for match in bracket.matches if match.name not in in_group}
        self.rank = {name: k for k, name in enumerate(self.items)}
        self.home: dict[Source, _Part] = {}
        self.nobody = 1 << len(bracket.players)
        self.outlets: dict[str, list[Source]] = {name: [] for name in self.items}
        self.feeds: dict[Source, str] = {}
        for match in bracket.matches:
            for slot in match.slots:
                if isinstance(slot, Source):
                    self.outlets[slot.match].append(slot)
                    self.feeds[slot] = match.name
        self.heap: list[tuple[float, int, str, int]] = []
        self.version = dict.fromkeys(self.items, 0)
        self.done: list[str] = []
        self.states = 0.0

    def offer(self, name: str) -> None:
        """Put a match on the heap if both its slots are open, in place of its earlier entry."""
        item = self.items[name]
        if isinstance(item, Match) and not all(
            isinstance(slot, int) or slot in self.home for slot in item.slots
        ):
            return
        cost = self.cost(item)
        self.version[name] += 1
        entry = cost.joined + cost.after.size, self.rank[name], name, self.version[name]
        heapq.heappush(self.heap, entry)

    def step(self) -> None:
        """Take the cheapest match."""
        total, _, name, version = heapq.heappop(self.heap)
        if version != self.version[name]:
            return
        cost = self.cost(self.items[name])
        self.version[name] += 1
        self.states += total
        self.done.append(name)
        item = self.items[name]
        for taken in item.slots if isinstance(item, Match) else ():
            if isinstance(taken, Source):
                del self.home[taken]
        waiting = set()
        for slot in cost.after.slots:
            self.home[slot] = cost.after
            waiting.add(self.feeds[slot])
        for other in sorted(waiting, key=self.rank.__getitem__):
            self.offer(other)

    def cost(self, item: Match | Group) -> _Cost:
        """Return the cost of a match if it came next."""
        if isinstance(item, Group):
            return self._group_cost(item)
        parts: list[_Part] = []
        can_sit = []
        for slot in item.slots:
            if isinstance(slot, Source):
                part = self.home[slot]
                if not any(part is other for other in parts):
                    parts.append(part)
                can_sit.append(part.slots[slot])
            else:
                can_sit.append(1 << slot if slot >= 0 else self.nobody)
        joined = 1.0
        slots: dict[Source, int] = {}
        for part in parts:
            joined *= part.size
            slots |= part.slots
        for taken in item.slots:
            if isinstance(taken, Source):
                del slots[taken]
        both = can_sit[0] | can_sit[1]
        for outlet in self.outlets[item.name]:
            slots[outlet] = both if outlet.via is None else can_sit[outlet.via - 1] | self.nobody
        return _Cost(parts, joined, _Part(min(2.0 * joined, _ways(list(slots.values()))), slots))

    def _group_cost(self, group: Group) -> _Cost:
        members = sum(1 << player for player in group.members)
        slots = dict.fromkeys(self.outlets[group.name], members)
        return _Cost([], 1.0, _Part(_ways(list(slots.values())), slots))


def _ways(can_sit: list[int]) -> float:
    """Return the number of ways to fill the slots with different players.

    `can_sit` holds a bit mask of players for each slot. The number is exact if the players of
    any two slots are nested or disjoint, and about right otherwise.
    """
    ways = 1.0
    ordered = sorted(can_sit, key=int.bit_count)
    for k, players in enumerate(ordered):
        taken = sum(1 for other in ordered[:k] if other & players == other)
        ways *= max(1, players.bit_count() - taken)
    return ways
