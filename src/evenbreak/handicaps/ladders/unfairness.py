"""How unfair matches are: the effect of wrong ratings on the chance of winning."""

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
from evenbreak.stats.summary import Distribution

CLEAR_FAVORITE = 0.6
"""A player with at least this chance of winning a match is the clear favorite."""

_DIGITS = 12


def unfairness(ladder: Ladder) -> Distribution:
    """Return the long-run distribution of P(the player wins) over matches.

    Each chance is conditional on both players' skills and ratings before the match and averaged
    over their form (`day_sd`, `match_sd`). Player and opponent are independent, and the player's
    error has the ladder's distribution.

    Notes
    -----
    A fair match has the chance 1/2; every match would, if ratings were right and the chart had no
    steps. The standard deviation shows how far a typical match is from that; `better_off` looks at
    the favorite in each match. Chances within 1e-12 of each other are merged. With several matches
    a night, the night's form is assumed to be independent of the error, which is not quite true
    later in the night.

    >>> from evenbreak.handicaps import EQUAL_SKILL, Ladder, chart
    >>> law = unfairness(Ladder("npl", chart("npl_10"), opponents=EQUAL_SKILL))
    >>> round(law.sd, 3), round(law.quantile(0.05), 6), round(law.between(0.4, 0.6), 3)
    (0.089, 0.363281, 0.62)
    """
    met = opponent_pairs_of(ladder)
    own = np.asarray(ladder.law().probability, dtype=float)
    chances = met.wins()
    # Many opponents lead to the same two differences: add up their chances before sorting.
    places = met.places() * chances.shape[1] + met.ahead
    often = np.bincount(places.ravel(), np.outer(own, met.chance).ravel(), chances.size)
    occurs = often > 0.0
    values, place = np.unique(np.round(chances.ravel()[occurs], _DIGITS), return_inverse=True)
    weight = np.bincount(place, often[occurs])
    return Distribution(tuple(values.tolist()), tuple((weight / weight.sum()).tolist()))


def better_off(unfair: Distribution) -> Distribution:
    """Return the distribution of the favorite's chance: the larger of W and 1 - W.

    Its mean minus 1/2 is the mean of `|W - 1/2|`; `at_least(0.6)` is the share of matches with a
    clear favorite.

    >>> better_off(Distribution((0.375, 0.5, 0.75), (0.25, 0.5, 0.25)))
    Distribution(values=(0.5, 0.625, 0.75), probability=(0.5, 0.25, 0.25))
    """
    chances = np.array(unfair.values, dtype=float)
    larger = np.round(np.maximum(chances, 1.0 - chances), _DIGITS)
    values, place = np.unique(larger, return_inverse=True)
    weight = np.bincount(place.ravel(), np.array(unfair.probability, dtype=float))
    return Distribution(tuple(values.tolist()), tuple(weight.tolist()))


# The pairs of player and opponent on a ladder, and what their matches come to.
#
# With the player's rating error i, the opponent's skill s or rating r less the player's skill, and
# the opponent's error e, the chart sees the difference
#
#     i - (s + e)    given the skill,        i - r    given the rating,
#
# and the games are decided by the difference of skill, -s or e - r, plus the difference of the two
# players' forms, over which all chances are averaged.


_RARE = 1e-18


@dataclass(frozen=True, eq=False)
class OpponentPairs:
    """Types of opponents on a ladder, as pairs of offsets, with their matches.

    `skills` are the differences in skill that occur, player's minus opponent's, in points. Each
    type has a chance, a position `ahead` in `skills`, and `apart`, the rating difference minus the
    player's error.
    """

    ladder: Ladder
    table: MatchTable
    skills: Ints
    apart: Ints
    ahead: Ints
    chance: Floats

    def wins(self) -> Floats:
        """Return P(win | rating difference, skill difference), shape (differences, skills)."""
        chances = np.zeros((2 * self.table.widest + 1, len(self.skills)))
        for p, weight in self._forms():
            chances += weight * self.table.wins(p)
        return chances

    def mean_of(self, worth: NDArray[Any]) -> Floats:
        """Return the mean value of a final score, given the player's error, shape (errors,).

        `worth` has shape (differences, outcomes), as in `MatchTable`.
        """
        by_pair = np.zeros((2 * self.table.widest + 1, len(self.skills)))
        for p, weight in self._forms():
            for place, game in enumerate(p.tolist()):
                by_pair[:, place] += weight * (self.table.chances(game) * worth).sum(axis=1)
        return np.asarray(by_pair[self.places(), self.ahead] @ self.chance)

    def places(self) -> Ints:
        """Return the position of each rating difference in the table, shape (errors, kinds)."""
        return self.ladder.errors[:, None] + self.apart + self.table.widest

    def _forms(self) -> Iterator[tuple[Floats, float]]:
        """Yield the chances of a game by skill difference, form by form, with weights."""
        scale = self.ladder.system.scale
        law = difference_law(self.ladder.day_sd, self.ladder.match_sd)
        forms, weights = deviation_grid(law, scale.points_per_doubling)
        for form, weight in zip(forms.tolist(), weights.tolist(), strict=True):
            yield scale.win_probability(self.skills + form), weight


@lru_cache(maxsize=1)
def opponent_pairs_of(ladder: Ladder) -> OpponentPairs:
    """Return the types of opponents that a ladder's player meets."""
    opponents, law = ladder.opponents, ladder.opponent_law
    values = np.array(opponents.spread.values, float), np.array(law.values, float)
    condition, error = np.meshgrid(*values, indexing="ij")
    chance = np.outer(
        np.asarray(opponents.spread.probability, float), np.asarray(law.probability, float)
    ).ravel()
    condition, error = condition.ravel().astype(np.int64), error.ravel().astype(np.int64)
    by_skill = opponents.given == "skill"
    offsets = np.column_stack(
        [
            -(condition + error) if by_skill else -condition,
            -condition if by_skill else error - condition,
        ]
    )
    kinds, kind = np.unique(offsets[chance > _RARE], axis=0, return_inverse=True)
    weight = np.bincount(kind.reshape(-1), chance[chance > _RARE])
    skills, ahead = np.unique(kinds[:, 1], return_inverse=True)
    widest = ladder.widest + int(np.abs(kinds[:, 0]).max())
    table = known_table(ladder.system, ladder.chart, widest=widest)
    return OpponentPairs(ladder, table, skills, kinds[:, 0], ahead, weight / weight.sum())
