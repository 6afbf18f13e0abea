"""The odds of a blind draw by a program over sets of players.

A block of a bracket is a number of its lines and some of its matches; its open slots lead to
the rest. Every set S of as many players as it has lines is equally likely to be drawn to it.
With f(S, s) the chance that players s are in the open slots, given that S was drawn to the
block, a match that joins the blocks A and B finds the chances

    f(S, (s, t)) = mean over all splits of S into sets A and B of f(A, s) f(B, t).

From there on matches are played as in a bracket whose lines are known. Blocks of one shape
share their f, and the draws are never written out. It is cheap where blocks with few open
slots are joined: in single elimination, and where losers drop straight down.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import combinations
from math import comb
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.tournaments.brackets.bracket import Bracket, Match, Source
from evenbreak.tournaments.odds.chances import Chances
from evenbreak.tournaments.odds.forward import passed_on
from evenbreak.tournaments.odds.meetings import Meeting
from evenbreak.tournaments.odds.order import elimination_order
from evenbreak.tournaments.odds.plan import MatchStep, Players
from evenbreak.tournaments.odds.planning import Table, match_step

_MOST_WORK = 2.5e8
"""The largest number of products of two chances for one block; takes some seconds."""

_MOST_CODES = 2_000_000
"""The largest number of ways to fill the open slots of two blocks."""

_CELLS = 500_000
"""The largest number of states times sets of players that are processed at once."""


def meetings_before_the_draw(bracket: Bracket, chances: Chances) -> dict[str, Meeting] | None:
    """Return who meets whom, before a blind draw; None if it would take too long.

    >>> from evenbreak.tournaments import single_elimination, standing
    >>> from evenbreak.tournaments.odds.chances import chances_of
    >>> bracket = single_elimination(3)
    >>> chances = chances_of(standing(bracket), np.full((3, 3), 0.5))
    >>> meetings_before_the_draw(bracket, chances)["F"].probability.round(3)
    array([0.167, 0.167, 0.167, 0.167, 0.167, 0.167])
    """
    if bracket.groups:
        return None
    search = _Blocks(bracket, chances)
    for name in elimination_order(bracket).names:
        if not search.add(bracket.by_name[name]):
            return None
    found: dict[str, Meeting] = {}
    program = _Program(len(bracket.players))
    for draft in search.drafts:
        block = search.block(draft)
        if block is None:
            return None
        found |= zip(draft.names, program.meetings(block), strict=True)
    return found


@dataclass(frozen=True, eq=False)
class _Block:
    """A block, with players as positions in the set that was drawn to it.

    Parameters
    ----------
    lines
        how many lines it has.
    halves
        the blocks that its first match joins: one or two; none if the block is one line.
    codes
        the joint states of these, each as one number.
    steps, wins
        its matches, and the chances of each.
    columns
        the position of the player in each open slot, for each state after the last match.
    """

    lines: int
    halves: tuple[_Block, ...]
    codes: Ints
    steps: tuple[MatchStep, ...]
    wins: tuple[Floats, ...]
    columns: tuple[Players, ...]

    @property
    def states(self) -> int:
        """The number of states after the last match."""
        return self.steps[-1].size if self.steps else 1

    @cached_property
    def place_of(self) -> Ints:
        """The place of each code among the codes."""
        place = np.zeros(int(self.codes[-1]) + 1, dtype=np.int64)
        place[self.codes] = np.arange(len(self.codes))
        return place


_LINE = _Block(1, (), np.zeros(1, dtype=np.int64), (), (), (np.zeros(1, dtype=np.int16),))


@dataclass
class _Draft:
    """A block of the bracket that is being put together.

    Its slots have names of their own, so that blocks of one shape have one description.
    """

    halves: tuple[_Block, ...]
    open: dict[Source, Source]
    names: list[str] = field(default_factory=list)
    matches: list[tuple[Match, tuple[Source, ...]]] = field(default_factory=list)
    wins: list[Floats] = field(default_factory=list)


class _Blocks:
    """The blocks of a bracket, put together match by match."""

    def __init__(self, bracket: Bracket, chances: Chances) -> None:
        self.chances = chances
        self.players = len(bracket.players)
        self.drafts: list[_Draft] = []
        self.home: dict[Source, _Draft] = {}
        self.made: dict[Hashable, _Block | None] = {}
        self.outlets: dict[str, list[Source]] = {}
        for match in bracket.matches:
            for slot in match.slots:
                if isinstance(slot, Source):
                    self.outlets.setdefault(slot.match, []).append(slot)

    def add(self, match: Match) -> bool:
        """Add a match; return whether the blocks that it joins are small enough."""
        before: list[_Draft | None] = []
        for slot in match.slots:
            draft = self.home[slot] if isinstance(slot, Source) else None
            if draft is None or draft not in before:
                before.append(draft)
        if len(before) == 1 and before[0] is not None:
            draft = before[0]
        else:
            halves, opened = [], {}
            for k, half in enumerate(before):
                block = _LINE if half is None else self.block(half)
                if block is None:
                    return False
                halves.append(block)
                for j, slot in enumerate([] if half is None else self._slots(half, block)):
                    opened[slot] = Source(f"{k}", j)
            draft = _Draft(tuple(halves), opened)
            self.drafts.append(draft)
        self._play(draft, match, before)
        return True

    def block(self, draft: _Draft) -> _Block | None:
        """Return the block of a draft that is complete; None if it is too large."""
        key = (
            tuple(map(id, draft.halves)),
            tuple((match.slots, outlets) for match, outlets in draft.matches),
            tuple(map(id, draft.wins)),
        )
        if key not in self.made:
            self.made[key] = _built(draft, self.players)
        return self.made[key]

    def _slots(self, draft: _Draft, block: _Block) -> list[Source]:
        """Return the open slots of a draft in the order of the block's columns."""
        named = {own: slot for slot, own in draft.open.items()}
        return [named[own] for own in block.steps[-1].slots]

    def _play(self, draft: _Draft, match: Match, before: list[_Draft | None]) -> None:
        slots: Any = tuple(
            draft.open.pop(slot) if isinstance(slot, Source) else Source(f"{k}", 0)
            for slot, k in zip(match.slots, _lines(match, before), strict=True)
        )
        number = f"m{len(draft.matches)}"
        outlets = sorted(self.outlets.get(match.name, []), key=lambda s: (s.outcome, s.via or 0))
        draft.open |= {slot: slot._replace(match=number) for slot in outlets}
        own = Match(number, "", 0, slots)
        draft.matches.append((own, tuple(draft.open[slot] for slot in outlets)))
        draft.wins.append(self.chances.of(match.name))
        draft.names.append(match.name)
        for slot in draft.open:
            self.home[slot] = draft


def _lines(match: Match, before: list[_Draft | None]) -> list[int]:
    """Return which half a line in each slot is, if it is a line."""
    lines = iter([k for k, draft in enumerate(before) if draft is None])
    return [-1 if isinstance(slot, Source) else next(lines) for slot in match.slots]


def _built(draft: _Draft, players: int) -> _Block | None:
    halves = draft.halves
    lines = sum(half.lines for half in halves)
    each = comb(lines, halves[0].lines) * np.prod([half.states for half in halves])
    slots = [Source(f"{k}", j) for k, half in enumerate(halves) for j in range(len(half.columns))]
    base = lines + 1
    if comb(players, lines) * each > _MOST_WORK or base ** len(slots) > _MOST_CODES:
        return None
    there = np.zeros(base ** len(slots), dtype=bool)
    for _, _, code in _splits(halves, lines):
        there[code] = True
    codes = np.flatnonzero(there)
    columns = [(codes // base**k % base).astype(np.int16) for k in range(len(slots))]
    table = Table(0, len(codes), dict(zip(slots, columns, strict=True)))
    steps: list[MatchStep] = []
    for match, outlets in draft.matches:
        steps.append(match_step(match, [table], list(outlets), lines))
        open_now = dict(zip(steps[-1].slots, steps[-1].columns, strict=True))
        table = Table(0, steps[-1].size, open_now)
    return _Block(lines, halves, codes, tuple(steps), tuple(draft.wins), steps[-1].columns)


def _splits(halves: tuple[_Block, ...], lines: int) -> Iterator[tuple[Ints, Ints, Ints]]:
    """Yield ways to split the players, some at a time, and the codes of all joint states.

    The positions in the first half and in the second, shape (ways, lines of the half), and the
    codes, shape (ways, joint states).
    """
    base = lines + 1
    states = int(np.prod([half.states for half in halves]))
    at_once = max(1, _CELLS // states)
    drawn = _subsets(lines, halves[0].lines)
    rest = _subsets(lines, lines - halves[0].lines)[::-1]  # of each way what is left
    for start in range(0, len(drawn), at_once):
        parts = drawn[start : start + at_once], rest[start : start + at_once]
        code = np.zeros((len(parts[0]), 1), dtype=np.int64)
        power = 1
        for half, part in zip(halves, parts, strict=False):
            nobody = np.full((len(part), 1), lines)  # whoever is nobody stays nobody
            where = np.concatenate([part, nobody], axis=1)
            own = np.zeros((len(part), half.states), dtype=np.int64)
            for column in half.columns:
                own += where[:, column] * power
                power *= base
            code = (code[:, :, None] + own[:, None, :]).reshape(len(part), -1)
        yield *parts, code


class _Program:
    """The chances of the states of each block, for every set of players."""

    def __init__(self, players: int) -> None:
        self.players = players
        self.tables: dict[_Block, Floats] = {_LINE: np.ones((1, players))}
        self.found: dict[_Block, list[Meeting]] = {}

    def meetings(self, block: _Block) -> list[Meeting]:
        """Return who meets whom in each match of a block whose halves were done before."""
        if block not in self.found:
            self.found[block] = self._run(block)
        return self.found[block]

    def _run(self, block: _Block) -> list[Meeting]:
        sets = _subsets(self.players, block.lines)
        joint = np.zeros((len(block.steps), 2, self.players**2))
        table = np.zeros((block.states, len(sets)))
        at_once = max(1, _CELLS // len(block.codes))
        for start in range(0, len(sets), at_once):
            members = sets[start : start + at_once]
            mass = self._joined(block, members)
            for k, (step, win) in enumerate(zip(block.steps, block.wins, strict=True)):
                who = np.concatenate([members.T, np.full((1, len(members)), self.players)])
                first, second = who[step.first], who[step.second]
                p = win[first, second]
                met = mass if step.meeting is None else step.meeting @ mass
                there = (step.first < block.lines) & (step.second < block.lines)
                pair = (first * self.players + second)[there].ravel()
                for row, weight in zip(joint[k], (met, met * p), strict=True):
                    row += np.bincount(pair, weight[there].ravel(), self.players**2)
                mass = passed_on(step, mass, p)
            table[:, start : start + at_once] = mass
        self.tables[block] = table
        return [_meeting(row / len(sets), self.players) for row in joint]

    def _joined(self, block: _Block, members: Ints) -> Floats:
        """Return the chance of each joint state before the first match, for some sets."""
        bits = 1 << members
        mass = np.zeros((len(block.codes), len(members)))
        for *parts, code in _splits(block.halves, block.lines):
            if len(members) == 1:  # all ways at once
                product = np.ones((len(code), 1))
                for half, part in zip(block.halves, parts, strict=False):
                    law = self._laws(half, bits[0, part].sum(axis=1)).T
                    product = (product[:, :, None] * law[:, None, :]).reshape(len(code), -1)
                sums = np.bincount(code.ravel(), product.ravel(), len(block.place_of))
                mass[:, 0] += sums[block.codes]
                continue
            for way, states in enumerate(code):
                product = np.ones((1, len(members)))
                for half, part in zip(block.halves, parts, strict=False):
                    law = self._laws(half, bits[:, part[way]].sum(axis=1))
                    product = (product[:, None] * law).reshape(-1, len(members))
                mass[block.place_of[states]] += product
        return mass / comb(block.lines, block.halves[0].lines)

    def _laws(self, half: _Block, drawn: Ints) -> Floats:
        """Return the chances of the states of a block for sets given by their bits."""
        law: Floats = self.tables[half][:, _place_of(self.players, half.lines)[drawn]]
        return law


def _meeting(joint: Floats, players: int) -> Meeting:
    pairs = np.flatnonzero(joint[0])
    first, second = np.divmod(pairs.astype(np.int16), players)
    meet, won = joint[:, pairs]
    return Meeting(first, second, meet, won / meet)


@cache
def _subsets(players: int, size: int) -> Ints:
    """Return all sets of so many players, a row each, ascending."""
    found = np.array(list(combinations(range(players), size)), dtype=np.int64)
    return found.reshape(-1, size)


@cache
def _place_of(players: int, size: int) -> Ints:
    """Return the place of a set of so many players among all such sets, by its bits."""
    place = np.zeros(1 << players, dtype=np.int32)
    sets = _subsets(players, size)
    place[(1 << sets).sum(axis=1)] = np.arange(len(sets))
    return place.astype(np.int64)
