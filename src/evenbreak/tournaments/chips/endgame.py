"""The end of a chip tournament, exactly: heads-up, and the last players at one table.

Heads-up, with a and b chips, player 1 wins by taking b racks before losing a: a race, with the
chance W(p; b, a). With three or more players, the winner stays, and the loser pays a chip and goes
to the end of the line: a Markov chain over the line's order and everyone's chips. Chips are only
ever lost, so the chain has no cycles.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import factorial, prod
from typing import TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import number_probability, whole
from evenbreak.errors import InputError
from evenbreak.matches.win import race_win_probability
from evenbreak.tournaments.chips.play import checked_racks

State: TypeAlias = tuple[tuple[int, ...], tuple[int, ...]]
"""The line (who stays at the table, the challenger, who is waiting), and everyone's chips."""

_MOST_STATES = 400_000


def heads_up(p: float, chips: int, other_chips: int) -> float:
    """Return player 1's chance when two players are left.

    Parameters
    ----------
    p
        P(player 1 wins a rack).

    >>> round(heads_up(0.5, 2, 1), 3)
    0.75
    """
    mine = whole(chips, "chips", at_least=1)
    others = whole(other_chips, "other_chips", at_least=1)
    return float(race_win_probability(number_probability(p, "p"), others, mine))


@dataclass(frozen=True)
class LastPlayers:
    """A chip tournament's last players at one table, as a walkable game.

    `line` has the player at the table, the challenger, then the players waiting; racks[i][j] = P(i,
    at the table, beats the challenger j).
    """

    chips: tuple[int, ...]
    line: tuple[int, ...]
    racks: tuple[tuple[float, ...], ...]

    @property
    def start(self) -> State:
        """The current line and chips."""
        return self.line, self.chips

    def moves(self, state: State) -> dict[State, float]:
        """Return each next state's chance; none when one player is left."""
        line, chips = state
        if len(line) < 2:
            return {}
        stays, challenger, *waiting = line
        p = self.racks[stays][challenger]
        law: dict[State, float] = {}
        for won, lost, chance in ((stays, challenger, p), (challenger, stays, 1.0 - p)):
            left = tuple(c - (player == lost) for player, c in enumerate(chips))
            after = (won, *waiting, lost) if left[lost] else (won, *waiting)
            law[after, left] = law.get((after, left), 0.0) + chance
        return law

    def winner(self, state: State) -> int | None:
        """Return who has won, counting from 1, or None."""
        line, _ = state
        return line[0] + 1 if len(line) == 1 else None


@own_arrays
@dataclass(frozen=True, eq=False)
class EndgameOdds:
    """Who finishes where.

    Parameters
    ----------
    p_place
        p_place[i, k] = P(player i finishes in place k + 1).
    racks_mean
        the expected number of racks still to be played.
    """

    p_place: Floats
    racks_mean: float

    @property
    def title(self) -> Floats:
        """P(each player wins)."""
        return self.p_place[:, 0]


def last_players(
    chips: Sequence[int], racks: ArrayLike, line: Sequence[int] | None = None
) -> EndgameOdds:
    """Return who finishes where among the last players at one table, exactly.

    Parameters
    ----------
    chips
        everyone's chips: at least two players, usually up to four.
    racks
        racks[i, j] = P(i, who stays at the table, beats the challenger j).
    line
        the players' order, by position: who stays, the challenger, then who is waiting; None: as
        listed.

    Raises
    ------
    InputError
        if a parameter has an invalid value, or there would be too many states.

    >>> last_players([2, 1, 1], np.full((3, 3), 0.5)).title
    array([0.625, 0.125, 0.25 ])
    """
    from evenbreak.chains.absorption import visits_from
    from evenbreak.chains.explore import chain_of

    counts = tuple(whole(count, "chips", at_least=1) for count in chips)
    table = checked_racks(racks, len(counts))
    order = tuple(range(len(counts))) if line is None else tuple(int(k) for k in line)
    if len(counts) < 2 or sorted(order) != list(range(len(counts))):
        raise InputError(
            "{line} is {value!r}. Give each of {n_counts} players once; there must be at least "
            "two.",
            value=line,
            n_counts=len(counts),
        )
    if prod(counts) * factorial(len(counts)) > _MOST_STATES:
        raise InputError(
            "{chips} is {value!r}, which means too many states for an exact answer. Simulate "
            "with play_chips.",
            value=chips,
        )
    game = LastPlayers(counts, order, tuple(map(tuple, table.tolist())))
    chain = chain_of(game)
    visits = visits_from(chain)
    law = np.zeros((len(counts), len(counts)))
    racks_mean = 0.0
    states = cast(Sequence[State], chain.states)
    for state, visited in zip(states, visits.tolist(), strict=True):
        before = len(state[0])
        if before < 2:
            continue
        racks_mean += visited
        for (after, _), chance in game.moves(state).items():
            if len(after) < before:
                (out,) = set(state[0]) - set(after)
                law[out, before - 1] += visited * chance
    law[:, 0] = 1.0 - law[:, 1:].sum(axis=1)
    return EndgameOdds(law, racks_mean)
