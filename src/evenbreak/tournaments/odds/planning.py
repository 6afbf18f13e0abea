"""Building a plan: the states that can be reached, match by match.

A state says who is in each open slot. A match that joins two parts of the bracket has all
pairs of their states; after it, states that agree in the slots that are still open become
one.
"""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Hashable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.tournaments.brackets.bracket import Bracket, Group, Match, Source
from evenbreak.tournaments.odds.group_odds import MOST_MATCHES, rank_states
from evenbreak.tournaments.odds.order import elimination_order
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
"""The largest number of joint states of one match; takes some hundred megabytes."""

_PESSIMISM = 30.0  # the estimate can be this many times too high
_MOST_KEPT = 4_000_000  # numbers of all plans that are kept for later
_SPARE = 8  # keys are looked up in a table if it is not this many times longer than the keys


class Table(NamedTuple):
    """The joint states of a part of the bracket: the player in each open slot."""

    step: int
    size: int
    columns: dict[Source, Players]


def plan_of(bracket: Bracket, assumed: tuple[tuple[str, int], ...] = ()) -> Plan:
    """Return the plan of a bracket, however large.

    Parameters
    ----------
    bracket
        the matches still to be played, with the known players in their slots.
    assumed
        what-if results of matches whose players are not known yet.

    >>> from evenbreak.tournaments import double_elimination
    >>> plan = plan_of(double_elimination(4))
    >>> [(step.name, step.size) for step in plan.steps]
    [('W1.1', 2), ('W1.2', 2), ('L1.1', 8), ('W2.1', 16), ('L2.1', 12), ('F', 13), ('F2', 1)]
    """
    plan = exact_plan(bracket, assumed, math.inf)
    assert plan is not None  # noqa: S101 - nothing is too many
    return plan


_KEPT: OrderedDict[Hashable, Plan | None] = OrderedDict()


def exact_plan(
    bracket: Bracket,
    assumed: tuple[tuple[str, int], ...] = (),
    most_states: float = MOST_STATES,
) -> Plan | None:
    """Return the plan of a bracket, or None if it would be too large.

    It is too large if one match would have more than `most_states` joint states, or all
    matches together three times as many. Where the estimate is far beyond that, nothing is
    built; otherwise building stops before the first match that is too large. Plans are cached.

    Parameters
    ----------
    bracket, assumed
        as in `plan_of`.
    most_states
        the largest number of joint states of one match.
    """
    question = bracket, assumed, most_states
    if question not in _KEPT:
        _KEPT[question] = _built(bracket, assumed, most_states)
        while len(_KEPT) > 1 and (len(_KEPT) > 64 or _kept_numbers() > _MOST_KEPT):
            _KEPT.popitem(last=False)
    _KEPT.move_to_end(question)
    return _KEPT[question]


def _kept_numbers() -> int:
    return sum(plan.numbers for plan in _KEPT.values() if plan)


def _built(
    bracket: Bracket, assumed: tuple[tuple[str, int], ...], most_states: float
) -> Plan | None:
    if any(len(group.matches) > MOST_MATCHES for group in bracket.groups):
        return None
    order = elimination_order(bracket)
    if order.states > _PESSIMISM * most_states:
        return None
    outlets: dict[str, list[Source]] = {}
    for match in bracket.matches:
        for slot in match.slots:
            if isinstance(slot, Source):
                outlets.setdefault(slot.match, []).append(slot)
    groups = {group.name: group for group in bracket.groups}
    results = dict(assumed)
    nobody = len(bracket.players)
    steps: list[Step] = []
    home: dict[Source, Table] = {}
    total = 0
    for name in order.names:
        step: Step
        if name in groups:
            step = _group_step(groups[name], outlets.get(name, []))
        else:
            match = bracket.by_name[name]
            tables = _tables(match, home)
            states = math.prod(table.size for table in tables)
            total += states
            if states > most_states or total > 3.0 * most_states:
                return None
            step = match_step(match, tables, outlets.get(name, []), nobody, results.get(name))
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
    """Return the step of one match.

    Parameters
    ----------
    match
        the match.
    tables
        the states of the parts that it joins.
    outlets
        the slots that its winner and loser go to.
    nobody
        what stands for nobody: the number of players.
    result
        its winner, if that is assumed.
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
    """Return the joint states of up to two parts: all pairs of their states."""
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
    """Return a key for each state of each branch, equal for equal states, and an upper bound."""
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
    """Return the distinct keys, ascending, and the position of each given key among them."""
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
    """Return the states after a match, numbered as they first come up, and where they do."""
    every = np.concatenate(to)
    first = np.empty(states, dtype=np.int64)
    first[every[::-1]] = np.arange(len(every))[::-1]
    new = np.zeros(len(every), dtype=bool)
    new[first] = True
    number = np.cumsum(new, dtype=np.int32) - 1
    return [number[first[part]] for part in to], np.flatnonzero(new)
