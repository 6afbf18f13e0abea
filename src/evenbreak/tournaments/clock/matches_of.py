"""What a schedule needs to know of a bracket: which match waits for which others."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from evenbreak.arrays import Bools
from evenbreak.tournaments.brackets.bracket import Bracket, Match, Source


@dataclass(frozen=True, eq=False)
class Waiting:
    """Which matches wait for which.

    Parameters
    ----------
    names
        the matches still to be played, in the bracket's order.
    after
        after[i, j]: match j cannot begin before match i is over.
    shared
        shared[i, j]: a player of a group is in both, so that they cannot overlap.
    """

    names: tuple[str, ...]
    after: Bools
    shared: Bools


def waiting(bracket: Bracket, names: Collection[str], *, for_rounds: bool) -> Waiting:
    """Return which of some matches of a bracket wait for which.

    Parameters
    ----------
    bracket
        the whole bracket.
    names
        the matches that are not over.
    for_rounds
        whether a round begins only when all rounds that feed it, and the round before it in
        a group, are over.

    >>> from evenbreak.tournaments import single_elimination
    >>> bracket = single_elimination(8)
    >>> waits = waiting(bracket, [match.name for match in bracket.matches], for_rounds=True)
    >>> [waits.names[i] for i in np.flatnonzero(waits.after[:, waits.names.index("W2.1")])]
    ['W1.1', 'W1.2', 'W1.3', 'W1.4']
    """
    matches = [match for match in bracket.matches if match.name in names]
    place = {match.name: k for k, match in enumerate(matches)}
    groups = {group.name: group for group in bracket.groups}
    rounds: dict[tuple[str, int], list[str]] = {}
    for match in bracket.matches:
        rounds.setdefault((match.side, match.round), []).append(match.name)
    after = np.zeros((len(matches), len(matches)), dtype=bool)
    shared = np.zeros_like(after)
    for match in matches:
        feeds: set[str] = set()
        for slot in match.slots:
            if isinstance(slot, Source):
                feeds |= set(groups[slot.match].matches if slot.match in groups else [slot.match])
        if for_rounds:
            feeds |= _rounds_before(bracket, match, feeds, rounds)
        for name in feeds & set(place):
            after[place[name], place[match.name]] = True
    for group in bracket.groups:
        seats = [(name, set(pair)) for name, pair in zip(group.matches, group.pairs, strict=True)]
        for one, players in seats:
            for other, others in seats:
                if one != other and players & others and one in place and other in place:
                    shared[place[one], place[other]] = True
    return Waiting(tuple(place), after, shared)


def _rounds_before(
    bracket: Bracket, match: Match, feeds: set[str], rounds: dict[tuple[str, int], list[str]]
) -> set[str]:
    before: set[str] = set()
    for name in feeds:
        feeding = bracket.by_name[name]
        before |= set(rounds[feeding.side, feeding.round])
    if any(match.name in group.matches for group in bracket.groups):
        before |= set(rounds.get((match.side, match.round - 1), ()))
    return before
