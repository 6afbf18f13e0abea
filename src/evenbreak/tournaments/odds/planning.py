"""Building a plan: the reachable states, match by match.

A state says who is in each open slot. A match that joins two parts of the bracket has all pairs of
their states; after it, states that agree in the slots still open are merged.
"""

from __future__ import annotations

import heapq
import math
from collections import OrderedDict
from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.tournaments.brackets.bracket import Bracket, Group, Match, Source
from evenbreak.tournaments.odds.group_odds import MOST_MATCHES, rank_states
from evenbreak.tournaments.odds.plan import (
    Branch,
    GroupStep,
    Index,
    MatchStep,
    Plan,
    Players,
    Step,
)

MOST_STATES = 1e7
"""The largest number of joint states in one match; takes some hundred megabytes."""

_PESSIMISM = 30.0  # the estimate can be this many times too high
_MOST_KEPT = 4_000_000  # numbers of all plans that are kept for later
_SPARE = 8  # keys are looked up in a table if it is not this many times longer than the keys


class Table(NamedTuple):
    """The joint states of a part of the bracket: the player in each open slot."""

    step: int
    size: int
    columns: dict[Source, Players]


def plan_of(bracket: Bracket, assumed: tuple[tuple[str, int], ...] = ()) -> Plan:
    """Return a bracket's plan, however large, with what-if results for remaining matches."""
    plan = exact_plan(bracket, assumed, math.inf)
    assert plan is not None  # noqa: S101 - nothing is too many
    return plan


_KEPT: OrderedDict[Hashable, Plan | None] = OrderedDict()


def exact_plan(
    bracket: Bracket,
    assumed: tuple[tuple[str, int], ...] = (),
    most_states: float = MOST_STATES,
) -> Plan | None:
    """Return a bracket's plan, or None if it would be too large.

    It is too large if one match would have more than `most_states` joint states, or all matches
    together three times as many. If the estimate is far beyond that, nothing is built; otherwise,
    building stops before the first match that is too large. Plans are cached.
    """
    question = bracket, assumed, most_states
    if question not in _KEPT:
        _KEPT[question] = _built(bracket, assumed, most_states)
        while len(_KEPT) > 1 and (
            len(_KEPT) > 64 or sum(plan.numbers for plan in _KEPT.values() if plan) > _MOST_KEPT
        ):
            _KEPT.popitem(last=False)
    _KEPT.move_to_end(question)
    return _KEPT[question]


def _built(
    bracket: Bracket, assumed: tuple[tuple[str, int], ...], most_states: float
) -> Plan | None:
    if any(len(group.matches) > MOST_MATCHES for group in bracket.groups):
        return None
    if bracket.runners_up is not None:  # they join all groups: far too many states
        return None
    order = elimination_order(bracket)
    if order.states > _PESSIMISM * most_states:
        return None
    groups = {group.name: group for group in bracket.groups}
    results = dict(assumed)
    nobody = len(bracket.players)
    steps: list[Step] = []
    home: dict[Source, Table] = {}
    total = 0
    for name in order.names:
        step: Step
        if name in groups:
            step = _group_step(groups[name], bracket.outlets.get(name, []))
        else:
            match = bracket.by_name[name]
            tables = _tables(match, home)
            states = math.prod(table.size for table in tables)
            total += states
            if states > most_states or total > 3.0 * most_states:
                return None
            outlets = bracket.outlets.get(name, [])
            step = match_step(match, tables, outlets, nobody, results.get(name))
        table = Table(len(steps), step.size, dict(zip(step.slots, step.columns, strict=True)))
        home.update(dict.fromkeys(step.slots, table))
        steps.append(step)
    return Plan(bracket, tuple(steps))


def _tables(match: Match, home: dict[Source, Table]) -> list[Table]:
    found: dict[int, Table] = {}
    for slot in match.slots:
        if isinstance(slot, Source):
            found[home[slot].step] = home[slot]
    return list(found.values())


def _group_step(group: Group, outlets: list[Source]) -> GroupStep:
    seat = {player: k for k, player in enumerate(group.members)}
    pairs = tuple((seat[one], seat[other]) for one, other in group.pairs)
    outlets = sorted(outlets, key=lambda slot: slot.outcome)
    ranks = tuple(int(slot.outcome) - 1 for slot in outlets)
    states, _ = rank_states(len(seat), pairs, ranks)
    players = np.array(group.members, dtype=np.int16)[states]
    return GroupStep(group, pairs, ranks, len(states), tuple(outlets), tuple(players.T))


def match_step(
    match: Match,
    tables: list[Table],
    outlets: list[Source],
    nobody: int,
    result: int | None = None,
) -> MatchStep:
    """Return one match's step.

    `nobody` is the number that means no player, which equals the number of players; `result` is an
    assumed winner.
    """
    size, columns = _joined(tables)
    first, second = (
        columns.pop(slot)
        if isinstance(slot, Source)
        else np.full(size, slot if slot >= 0 else nobody, dtype=np.int16)
        for slot in match.slots
    )
    pair_keys = first.astype(np.int64) * (nobody + 1) + second
    if columns or size == 1:
        distinct, numbered = _numbered([pair_keys], (nobody + 1) ** 2)
        pair: Index | None = numbered[0]
    else:  # every state is a pair of its own
        distinct, pair = pair_keys, None
    rows = _branch_rows(first, second, nobody, result)
    sat = first, second
    after: list[dict[Source, Players]] = [{}, {}]
    for slot, column in columns.items():
        for k in (0, 1):
            after[k][slot] = _taken(column, rows[k])
    for slot in outlets:
        for k in (0, 1):
            seat = k if slot.outcome == "winner" else 1 - k
            comes = slot.via is None or slot.via == seat + 1
            column = sat[seat] if comes else np.full(size, nobody, dtype=np.int16)
            after[k][slot] = _taken(column, rows[k])
    keys, top = _keys(after, [size if part is None else len(part) for part in rows], nobody + 1)
    states, to = _numbered(keys, top)
    to, kept = _in_order(to, len(states))
    slots = tuple(after[0])
    return MatchStep(
        match.name,
        tuple(table.step for table in tables),
        tuple(table.size for table in tables),
        (distinct // (nobody + 1)).astype(np.int16),
        (distinct % (nobody + 1)).astype(np.int16),
        pair,
        (Branch(rows[0], to[0]), Branch(rows[1], to[1])),
        len(states),
        slots,
        tuple(np.concatenate([after[0][slot], after[1][slot]])[kept] for slot in slots),
    )


def _joined(tables: list[Table]) -> tuple[int, dict[Source, Players]]:
    """Return the joint states of at most two parts: all pairs of their states."""
    if not tables:
        return 1, {}
    if len(tables) == 1:
        return tables[0].size, dict(tables[0].columns)
    one, other = tables
    columns = {slot: np.repeat(column, other.size) for slot, column in one.columns.items()}
    columns |= {slot: np.tile(column, one.size) for slot, column in other.columns.items()}
    return one.size * other.size, columns


def _branch_rows(
    first: Players, second: Players, nobody: int, result: int | None
) -> tuple[Index | None, Index | None]:
    """Return the states in which slot 1's and slot 2's player can win, or None for all."""
    one_there, other_there = first != nobody, second != nobody
    can = [one_there | ~other_there, other_there]
    if result is not None:
        can = [can[0] & (first == result), can[1] & (second == result)]
    one, other = (
        None if allowed.all() else np.flatnonzero(allowed).astype(np.int32) for allowed in can
    )
    return one, other


def _taken(column: Players, rows: Index | None) -> Players:
    return column if rows is None else column[rows]


def _keys(
    after: list[dict[Source, Players]], lengths: list[int], base: int
) -> tuple[list[NDArray[np.int64]], int]:
    """Return a key for each state in each branch, equal for equal states, and an upper bound."""
    keys = [np.zeros(length, dtype=np.int64) for length in lengths]
    top = 1
    for slot in after[0]:
        columns = [part[slot] for part in after]
        there = np.zeros(base, dtype=bool)
        for column in columns:
            there[column] = True
        code = np.cumsum(there) - 1
        many = int(code[-1]) + 1
        if top * many >= 1 << 62:
            distinct, to = _numbered(keys, top)
            keys, top = [part.astype(np.int64) for part in to], len(distinct)
        keys = [key * many + code[column] for key, column in zip(keys, columns, strict=True)]
        top *= many
    return keys, top


def _numbered(
    keys: list[NDArray[np.int64]] | list[Index], top: int
) -> tuple[NDArray[np.int64], list[Index]]:
    """Return the distinct keys, ascending, and each given key's position among them."""
    if top <= _SPARE * sum(map(len, keys)) + 1000:
        there = np.zeros(top, dtype=bool)
        for part in keys:
            there[part] = True
        distinct = np.flatnonzero(there)
        place = np.empty(top, dtype=np.int32)
        place[distinct] = np.arange(len(distinct), dtype=np.int32)
        return distinct, [place[part] for part in keys]
    distinct, place = np.unique(np.concatenate(keys), return_inverse=True)
    cuts = np.cumsum([len(part) for part in keys])[:-1]
    return distinct, [part.astype(np.int32) for part in np.split(place, cuts)]


def _in_order(to: list[Index], states: int) -> tuple[list[Index], NDArray[np.int64]]:
    """Return the states after a match, in order of first appearance, and their positions."""
    every = np.concatenate(to)
    first = np.empty(states, dtype=np.int64)
    first[every[::-1]] = np.arange(len(every))[::-1]
    new = np.zeros(len(every), dtype=bool)
    new[first] = True
    number = np.cumsum(new, dtype=np.int32) - 1
    return [number[first[part]] for part in to], np.flatnonzero(new)


# The order in which matches are processed, so that few joint states are open at a time.
#
# A slot is *open* from the match that fills it to the match that it belongs to. Open slots that
# depend on each other have a joint distribution, and the number of its states is the cost. The
# order is greedy: the next match is the one that needs the fewest states.


class Order(NamedTuple):
    """The order in which matches and groups are processed.

    `states` is an estimate, on the high side, of the joint states of all steps together.
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
    """Return a cheap order for processing a bracket's matches.

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
        self.outlets = bracket.outlets
        self.feeds = {slot: match.name for match in bracket.matches for slot in match.slots}
        self.heap: list[tuple[float, int, str, int]] = []
        self.version = dict.fromkeys(self.items, 0)
        self.done: list[str] = []
        self.states = 0.0

    def offer(self, name: str) -> None:
        """Push a match onto the heap if both its slots are open, replacing its earlier entry."""
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
        """Pop the cheapest match."""
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
        """Return what a match would cost if it came next."""
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
        for outlet in self.outlets.get(item.name, []):
            slots[outlet] = both if outlet.via is None else can_sit[outlet.via - 1] | self.nobody
        return _Cost(parts, joined, _Part(min(2.0 * joined, _ways(list(slots.values()))), slots))

    def _group_cost(self, group: Group) -> _Cost:
        members = sum(1 << player for player in group.members)
        slots = dict.fromkeys(self.outlets.get(group.name, []), members)
        return _Cost([], 1.0, _Part(_ways(list(slots.values())), slots))


def _ways(can_sit: list[int]) -> float:
    """Return the number of ways to fill the slots with different players.

    `can_sit` holds a bit mask of players for each slot. The number is exact if any two slots' sets
    of players are nested or disjoint, and about right otherwise.
    """
    ways = 1.0
    ordered = sorted(can_sit, key=int.bit_count)
    for k, players in enumerate(ordered):
        taken = sum(1 for other in ordered[:k] if other & players == other)
        ways *= max(1, players.bit_count() - taken)
    return ways
