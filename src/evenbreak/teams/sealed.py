"""Lineups handed in before the night: each captain writes down who plays in which set.

If all sets are alike, a random order is as good as any: against it, every order of the other team
has the same value, the mean over all pairings. The remaining choice is who plays, and that is a
matrix game.

Source: Jin, Tang and Chen, arXiv 1602.02063, for teams that play everyone.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.teams.matrix_games import matrix_game
from evenbreak.teams.night import TeamNight
from evenbreak.teams.squad import Counts, Squad

MOST_PAIRS = 250_000
"""The most pairs of lineups; beyond this, an error is raised."""


class SealedLineUp(NamedTuple):
    """Who plays.

    Parameters
    ----------
    names
        the players' names in the squad's order; twice for two sets.
    worth
        the night's value to us with these players against the other team's best mixture.
    mix
        the probability of handing in this lineup.
    """

    names: tuple[str, ...]
    worth: float
    mix: float


class SealedNight(NamedTuple):
    """Solution of a night whose lineups are handed in unseen, each in random order.

    Parameters
    ----------
    worth
        the value of the night to us; see `SolvedNight`.
    ours, theirs
        each team's lineups, best first.
    """

    worth: float
    ours: tuple[SealedLineUp, ...]
    theirs: tuple[SealedLineUp, ...]

    def mirrored(self) -> SealedNight:
        """Return the same night from the other team's point of view."""
        ours, theirs = (
            tuple(one._replace(worth=1.0 - one.worth) for one in side)
            for side in (self.theirs, self.ours)
        )
        return SealedNight(1.0 - self.worth, ours, theirs)


def sealed(night: TeamNight) -> SealedNight:
    """Return the value of a night whose lineups are both handed in before it.

    Parameters
    ----------
    night
        the night; its order of nomination does not matter.

    Raises
    ------
    InputError
        if the sets are not all alike with one player per side, or there are too many lineups.

    >>> from evenbreak.teams import Squad
    >>> law = np.zeros((2, 2, 2, 3))
    >>> law[..., 0, 2] = [[0.5, 0.8], [0.4, 0.7]]
    >>> law[..., 1, 0] = 1.0 - law[..., 0, 2]
    >>> night = TeamNight(Squad(("Ann", "Bo")), Squad(("Cy", "Di")), law, sets=2)
    >>> round(sealed(night).worth, 12)
    0.6
    """
    if set(night.sizes) != {1} or any(law is not night.laws[0] for law in night.laws):
        raise InputError(
            "lineups can only be sealed if all sets are alike, with one player per side"
        )
    ours, theirs = night.our_line_ups.used[-1], night.their_line_ups.used[-1]
    if len(ours) * len(theirs) > MOST_PAIRS:
        raise InputError("there are too many lineups. Leave out those who won't play tonight.")
    games = _mean_over_pairings(night, ours, theirs)
    solution = matrix_game(games)
    return SealedNight(
        float(solution.value),
        _ranked(night.ours, ours, games @ solution.columns, solution.rows, 1.0),
        _ranked(night.theirs, theirs, solution.rows @ games, solution.columns, -1.0),
    )


def _ranked(
    squad: Squad, line_ups: list[Counts], worth: Floats, mix: Floats, sign: float
) -> tuple[SealedLineUp, ...]:
    found = [
        SealedLineUp(tuple(squad.names[player] for player in _players(counts)), float(w), float(x))
        for counts, w, x in zip(line_ups, worth, mix, strict=True)
    ]
    return tuple(sorted(found, key=lambda one: (-round(sign * one.worth, 9), -one.mix)))


def _players(counts: Counts) -> list[int]:
    return [player for player, many in enumerate(counts) for _ in range(many)]


def _mean_over_pairings(night: TeamNight, ours: list[Counts], theirs: list[Counts]) -> Floats:
    """Return the value of each of our lineups against each of theirs, averaged over all pairings.

    Our players are paired one by one with a remaining player of theirs, all equally likely; the
    distribution of the lead is kept for each subset of those who have played.
    """
    sets, reach = night.sets, night.reach
    law = night.laws[0].sum(axis=2)
    own = law.shape[2] // 2
    mine = np.array([_players(counts) for counts in ours])
    others = np.array([_players(counts) for counts in theirs])
    wide = 2 * sets * reach + 1
    after: dict[int, Floats] = {0: np.zeros((len(mine), len(others), wide))}
    after[0][:, :, sets * reach] = 1.0
    for k in range(sets):
        before, after = after, {}
        for taken, leads in before.items():
            for place in range(sets):
                if taken & 1 << place:
                    continue
                chances = law[mine[:, k, None], others[None, :, place]] / (sets - k)
                moved = after.setdefault(taken | 1 << place, np.zeros_like(leads))
                for d in np.flatnonzero(chances.any(axis=(0, 1))) - own:
                    part = leads[:, :, max(0, -d) : wide - max(0, d)]
                    moved[:, :, max(0, d) : wide - max(0, -d)] += (
                        chances[:, :, own + d, None] * part
                    )
    (final,) = after.values()
    return np.asarray(final @ night.payoff(np.arange(-sets * reach, sets * reach + 1)))
