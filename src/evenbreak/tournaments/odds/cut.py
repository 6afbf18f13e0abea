"""A bracket cut in two: early rounds that are sampled, later rounds calculated exactly."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

from evenbreak.tournaments.brackets.bracket import Bracket, Slot, Source
from evenbreak.tournaments.odds.group_odds import MOST_MATCHES
from evenbreak.tournaments.odds.planning import elimination_order


class Cut(NamedTuple):
    """A bracket cut in two: the players of `rest` are slots filled by the early matches.

    `entrants` has what fills each: a source or a player.
    """

    early: frozenset[str]
    rest: Bracket
    entrants: tuple[Slot, ...]


def cut_before(bracket: Bracket, most_states: float) -> Cut:
    """Return the bracket cut as early as the work on its later part allows.

    The cut is by the largest number of matches that can still follow a match. Groups are always
    early.

    >>> from evenbreak.tournaments import double_elimination
    >>> cut = cut_before(double_elimination(16), 1000)
    >>> sorted({name[:2] for name in cut.early}), len(cut.entrants)
    (['L1', 'L2', 'W1', 'W2'], 8)
    """
    to_come = _to_come(bracket)
    for height in range(max(to_come.values(), default=0) - 1, 0, -1):
        cut = _cut_at(bracket, to_come, height)
        if elimination_order(cut.rest).states <= most_states:
            return cut
    return _cut_at(bracket, to_come, 0)


def exact_starts(bracket: Bracket, early: frozenset[str], most_states: float) -> Iterator[Bracket]:
    """Yield the early rounds that can be calculated exactly, the most first, then fewer.

    First matches alone are left out, because evenly spread samples have no error there.
    """
    to_come = _to_come(bracket)
    large = {group.name for group in bracket.groups if len(group.matches) > MOST_MATCHES}
    for height in sorted({to_come[name] for name in early}):
        names = {name for name in early if to_come[name] >= height}
        start = replace(
            bracket,
            matches=tuple(match for match in bracket.matches if match.name in names),
            groups=tuple(group for group in bracket.groups if group.name in names),
            runners_up=None,
        )
        first_only = all(isinstance(slot, int) for m in start.matches for slot in m.slots)
        if large & names or (first_only and not start.groups):
            continue
        if elimination_order(start).states <= most_states:
            yield start


def _to_come(bracket: Bracket) -> dict[str, int]:
    """Return how many matches each match's players can still have, including that match."""
    grouped = {name for group in bracket.groups for name in group.matches}
    longest: dict[str, int] = {}
    for match in reversed(bracket.matches):
        longest[match.name] = 1 + longest.get(match.name, 0)
        for slot in match.slots:
            if isinstance(slot, Source):
                longest[slot.match] = max(longest.get(slot.match, 0), longest[match.name])
    top = max(longest.values(), default=0) + 1
    first = [*grouped, *(group.name for group in bracket.groups)]
    first += [bracket.runners_up.name] if bracket.runners_up else []
    return longest | dict.fromkeys(first, top)


def _cut_at(bracket: Bracket, to_come: Mapping[str, int], height: int) -> Cut:
    early = frozenset(name for name, count in to_come.items() if count > height)
    number: dict[Slot, int] = {}

    def seat(slot: Slot) -> Slot:
        if (isinstance(slot, Source) and slot.match not in early) or slot == -1:
            return slot
        return number.setdefault(slot, len(number))

    later = tuple(
        replace(match, slots=(seat(match.slots[0]), seat(match.slots[1])))
        for match in bracket.matches
        if match.name not in early
    )
    rest = Bracket(bracket.format, tuple(map(str, range(len(number)))), later)
    return Cut(early, rest, tuple(number))
