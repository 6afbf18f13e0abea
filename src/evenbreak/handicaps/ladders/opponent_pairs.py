"""The pairs of player and opponent on a ladder, and what their matches come to.

With the player's rating error i, the opponent's skill s or rating r less the player's skill, and
the opponent's error e, the chart sees the difference

    i - (s + e)    given the skill,        i - r    given the rating,

and the games are decided by the difference of skill, -s or e - r, plus the difference of the two
players' forms, over which all chances are averaged.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats, Ints
from evenbreak.handicaps.ladders.form import deviation_grid, difference_law
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.systems.match_table import MatchTable, known_table

_RARE = 1e-18


@dataclass(frozen=True, eq=False)
class OpponentPairs:
    """The kinds of opponents on a ladder, as pairs of offsets, with their matches.

    Parameters
    ----------
    ladder
        the ladder.
    table
        the matches by rating difference, wide enough for all pairs.
    skills
        the differences of skill that occur, the player's less the opponent's, in points.
    apart
        for each kind of opponent: how much the rating difference exceeds the player's error.
    ahead
        for each kind of opponent: the place in `skills` of the difference of skill.
    chance
        of each kind of opponent.
    """

    ladder: Ladder
    table: MatchTable
    skills: Ints
    apart: Ints
    ahead: Ints
    chance: Floats

    def wins(self) -> Floats:
        """Return P(win | rating difference, difference of skill), shape (differences, skills)."""
        found = np.zeros((2 * self.table.widest + 1, len(self.skills)))
        for p, weight in self._forms():
            found += weight * self.table.wins(p)
        return found

    def mean_of(self, worth: NDArray[Any]) -> Floats:
        """Return the mean of what a final score is worth, given the player's error.

        Parameters
        ----------
        worth
            shape (differences, outcomes), as in `MatchTable`.

        Returns
        -------
        numpy.ndarray
            shape (errors,).
        """
        by_pair = np.zeros((2 * self.table.widest + 1, len(self.skills)))
        for p, weight in self._forms():
            for place, game in enumerate(p.tolist()):
                by_pair[:, place] += weight * (self.table.chances(game) * worth).sum(axis=1)
        return np.asarray(by_pair[self.places(), self.ahead] @ self.chance)

    def places(self) -> Ints:
        """Return where the table has each rating difference, shape (errors, kinds)."""
        return self.ladder.errors[:, None] + self.apart + self.table.widest

    def _forms(self) -> Iterator[tuple[Floats, float]]:
        """Yield the chances of a game by difference of skill, form by form, with weights."""
        scale = self.ladder.system.scale
        law = difference_law(self.ladder.day_sd, self.ladder.match_sd)
        forms, weights = deviation_grid(law, scale.points_per_doubling)
        for form, weight in zip(forms.tolist(), weights.tolist(), strict=True):
            yield scale.win_probability(self.skills + form), weight


@lru_cache(maxsize=1)
def opponent_pairs_of(ladder: Ladder) -> OpponentPairs:
    """Return the kinds of opponents that the player of a ladder meets."""
    opponents, law = ladder.opponents, ladder.opponent_law
    values = np.array(opponents.spread.values, float), np.array(law.values, float)
    given, error = np.meshgrid(*values, indexing="ij")
    chance = np.outer(
        np.asarray(opponents.spread.probability, float), np.asarray(law.probability, float)
    ).ravel()
    given, error = given.ravel().astype(np.int64), error.ravel().astype(np.int64)
    by_skill = opponents.given == "skill"
    offsets = np.column_stack(
        [-(given + error) if by_skill else -given, -given if by_skill else error - given]
    )
    kinds, kind = np.unique(offsets[chance > _RARE], axis=0, return_inverse=True)
    weight = np.bincount(kind.reshape(-1), chance[chance > _RARE])
    skills, ahead = np.unique(kinds[:, 1], return_inverse=True)
    widest = ladder.widest + int(np.abs(kinds[:, 0]).max())
    table = known_table(ladder.system, ladder.chart, widest=widest)
    return OpponentPairs(ladder, table, skills, kinds[:, 0], ahead, weight / weight.sum())
