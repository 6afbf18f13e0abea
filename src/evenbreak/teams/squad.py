"""A squad: who may be put up, how often, and within which caps."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Ints
from evenbreak.checks import names, number, whole
from evenbreak.errors import InputError
from evenbreak.words import Sentence, listed, say

MOST_STATES = 20_000
"""The most groups of players used up after a set; more would take minutes."""

Counts = tuple[int, ...]
"""How often each player on a squad has been put up."""


@dataclass(frozen=True)
class Cap:
    """A limit on a lineup: the sum of `weights` over the sets that each player plays.

    Parameters
    ----------
    weights
        the weight of each player per set played, in the order of the squad: a skill level, a
        rating, or 1 for players of a limited number.
    most
        the largest sum allowed.
    name
        the limited quantity, for messages, such as 'the sum of the levels'.

    Notes
    -----
    APA's 23-rule is `Cap(levels, 23)`, and its limit of two players at level 6 or above is
    `Cap([level >= 6 for level in levels], 2)`. BCA Pool League's caps are on the sum of five Fargo
    ratings: 2,750, 3,000 or 3,250.
    """

    weights: tuple[float, ...]
    most: float
    name: str = say("the cap")

    def __post_init__(self) -> None:
        given = tuple(number(value, "weights") for value in self.weights)
        object.__setattr__(self, "weights", given)
        number(self.most, "most")

    def total(self, counts: Counts) -> float:
        """Return the sum over the sets played."""
        return sum(w * count for w, count in zip(self.weights, counts, strict=True))


def caps_of(
    weights: Sequence[float], most: float | None, at_most: tuple[int, float] | None
) -> tuple[Cap, ...]:
    """Return the caps on a lineup.

    Parameters
    ----------
    most
        the largest sum of the levels; None: no limit.
    at_most
        how many players of this level or above may play; None: any number.

    >>> [(cap.weights, cap.most) for cap in caps_of((7, 5, 3), 13, (1, 5))]
    [((7.0, 5.0, 3.0), 13), ((1.0, 1.0, 0.0), 1)]
    """
    found = []
    if most is not None:
        found.append(Cap(tuple(weights), most, say("the sum of the levels")))
    if at_most is not None:
        many, high = at_most
        above = tuple(float(level >= high) for level in weights)
        found.append(
            Cap(above, many, say("the number of players at level {level:g} or above", level=high))
        )
    return tuple(found)


@dataclass(frozen=True)
class Squad:
    """A team's players on a night.

    Parameters
    ----------
    names
        each once.
    caps
        the limits for the whole lineup. A player may not be put up if that makes it impossible to
        fill the remaining sets within the caps.
    times
        how often a player may be put up.

    Raises
    ------
    InputError
        if a name appears twice, or a cap does not have a weight for each player.
    """

    names: tuple[str, ...]
    caps: tuple[Cap, ...] = ()
    times: int = 1

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", names(self.names, "names"))
        object.__setattr__(self, "caps", tuple(self.caps))
        whole(self.times, "times", at_least=1)
        for cap in self.caps:
            if len(cap.weights) != len(self.names):
                raise InputError(
                    "{cap} has {weights} weights for {players} players; there must be one for each",
                    cap=cap.name,
                    weights=len(cap.weights),
                    players=len(self.names),
                )

    def place(self, name: str) -> int:
        """Return the position of a player, counted from 0.

        Raises
        ------
        InputError
            if the squad has no such player.
        """
        try:
            return self.names.index(name)
        except ValueError:
            raise InputError(
                "{player!r} isn't in the squad; its players are {squad}",
                player=name,
                squad=", ".join(self.names),
            ) from None


class LineUps(NamedTuple):
    """All lineups of a squad within its caps, set by set.

    `picks` are positions, one or a pair, by set; used[k] the possible counts of the players after k
    sets; after[k][state, pick] the state after set k, -1 if not allowed; moves[k][pick] the states
    in which the pick is allowed, and those after it.
    """

    picks: list[list[tuple[int, ...]]]
    used: list[list[Counts]]
    after: list[Ints]
    moves: list[list[tuple[Ints, Ints]]]


def line_ups(squad: Squad, sizes: Sequence[int]) -> LineUps:
    """Return a squad's lineups for sets with these numbers of players per side.

    Raises InputError if the squad has too few or too many players, or no lineup keeps its caps.

    >>> found = line_ups(Squad(("Ann", "Bo", "Cy"), (Cap((7, 5, 3), 10),)), (1, 1))
    >>> found.used[2]
    [(1, 0, 1), (0, 1, 1)]
    """
    count = len(squad.names)
    picks = [list(itertools.combinations(range(count), size)) for size in sizes]
    used: list[list[Counts]] = [[(0,) * count]]
    for here in picks:
        each = (_with(squad, counts, pick) for counts in used[-1] for pick in here)
        used.append(list(dict.fromkeys(filter(None, each))))
        if len(used[-1]) > MOST_STATES:
            raise InputError(
                "{players} players allow too many lineups of {sets} sets. Leave out "
                "those who won't play tonight.",
                players=count,
                sets=len(sizes),
            )
    if not used[-1]:
        raise InputError(
            "{players} can't fill {sets} sets. Add players, or let them play more than once.",
            players=", ".join(squad.names),
            sets=len(sizes),
        )
    used[-1] = [
        counts for counts in used[-1] if all(cap.total(counts) <= cap.most for cap in squad.caps)
    ]
    if not used[-1]:
        raise InputError(
            "no lineup of {players} for {sets} sets keeps {caps}. Raise the limit, or add "
            "players who count for less.",
            players=", ".join(squad.names),
            sets=len(sizes),
            caps=_asked(squad),
        )
    after: list[Ints] = []
    for k in reversed(range(len(sizes))):
        places = {counts: place for place, counts in enumerate(used[k + 1])}
        table = np.array(
            [
                [places.get(_with(squad, counts, pick), -1) for pick in picks[k]]
                for counts in used[k]
            ],
            dtype=np.int64,
        )
        kept = np.flatnonzero((table >= 0).any(axis=1))
        used[k] = [used[k][state] for state in kept]
        after.append(table[kept])
    after.reverse()
    moves = [[_move(column) for column in table.T] for table in after]
    return LineUps(picks, used, after, moves)


def _move(after: Ints) -> tuple[Ints, Ints]:
    allowed = np.flatnonzero(after >= 0)
    return allowed, after[allowed]


def _with(squad: Squad, counts: Counts, pick: Sequence[int]) -> Counts:
    """Return the counts after a pick; () if a player would play too often."""
    more = list(counts)
    for player in pick:
        more[player] += 1
        if more[player] > squad.times:
            return ()
    return tuple(more)


def _asked(squad: Squad) -> Sentence:
    return listed(
        [say("{cap} to {most:g} or less", cap=cap.name, most=cap.most) for cap in squad.caps]
    )
