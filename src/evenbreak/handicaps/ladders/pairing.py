r"""Outcome of a match at each rating error, against a given distribution of opponents.

Let the player's skill be 0, the rating error e, and the form on the night f. An opponent with
rating r, error j and form g has the skill r - j, so the two are

    x = e - r           apart by their ratings: the race and the moves
    d = f - r + j - g   apart in truth: the chance of a game

and P(move | e, f) is the sum over the opponents of P(move | x, d). If the skill s is given,
r = s + j: then x depends on e - j and d on f - g, and the sum over (j, g) is a convolution over
(e, f). If the rating is given, only j - g counts, and the sum is a convolution over d. Form that
changes from match to match is averaged out beforehand.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfftn, next_fast_len, rfftn

from evenbreak.arrays import Floats, Ints
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.ladders.form import averages
from evenbreak.handicaps.ladders.opponents import Opponents, farthest
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.handicaps.systems.match_table import MatchTable, known_table

_FEW = 1 << 20
"""Number of products up to which a sum is faster than a Fourier transform."""


class Pairing(ABC):
    """Matches of a player with skill 0 on a line of errors.

    `table` has all outcomes of a match at the rating differences that occur; `blur` is the
    distribution of the difference of the two players' match-to-match form, over -k, ..., k; `days`
    are the player's possible forms for the night, evenly spaced and symmetric.
    """

    def __init__(
        self,
        table: MatchTable,
        widest: int,
        opponents: Opponents,
        blur: Floats,
        days: Ints,
    ) -> None:
        self.table = table
        self.errors = np.arange(-widest, widest + 1)
        self.days = days
        self.blur = blur
        self.farthest = opponents.farthest
        self.spread = np.array(opponents.spread.values, dtype=np.int64)
        self.chance = np.array(opponents.spread.probability, dtype=float)
        real = table.games[..., 0] >= 0
        self.steps = np.unique(table.moves[..., 0][real])
        first, self._race = table.races
        self._races = replace(
            table,
            needs=table.needs[first],
            games=table.games[first],
            moves=table.moves[first],
            won=table.won[first],
        )
        self._prepare()

    @abstractmethod
    def _prepare(self) -> None:
        """Precompute what does not depend on the opponents' errors."""

    @abstractmethod
    def moves(self, law: Floats) -> Floats:
        """Return P(move | error, form) for each step, with P(win | error, form) last.

        `law` is the joint distribution of the opponents' errors and forms, shape (errors, days);
        the result has shape (steps + 1, errors, days).
        """

    def scores(self, low: int, high: int) -> Floats:
        """Return P(final score | race, skill difference), for differences from low to high.

        The chances are averaged over the blur; shape (races, outcomes, high - low + 1).
        """
        far = len(self.blur) // 2
        apart = np.arange(low - far, high + far + 1).astype(float)
        chances = self._races.chances(self.table.system.scale.win_probability(apart))
        return averages(chances, self.blur)

    def add(
        self,
        total: Floats,
        ratings: Ints,
        scores: Floats,
        weight: float,
    ) -> None:
        """Add P(move) and P(win), `weight` times, to a total of shape (steps + 1, x, days).

        `x` are rating differences; `scores` are P(final score) by race, shape (races, outcomes,
        days).
        """
        place = np.clip(ratings, -self.table.widest, self.table.widest) + self.table.widest
        chances = weight * scores[self._race[place]]
        which = np.searchsorted(self.steps, self.table.moves[place, :, 0])
        # The padding has no moves, and no chance of one either.
        which = np.minimum(which, len(self.steps) - 1)
        row = np.arange(len(place))
        for outcome in range(chances.shape[1]):
            total[which[:, outcome], row] += chances[:, outcome]
        total[-1] += np.einsum("xod,xo->xd", chances, self.table.won[place])


class SkillGiven(Pairing):
    """Opponents whose skill is given."""

    def _prepare(self) -> None:
        widest, days = int(self.errors[-1]), self.days
        # The table is as wide as the player's error, the opponent's, and the spread together.
        self._reach = reach = self.table.widest - widest - self.farthest
        # All differences of two errors, and of two forms.
        apart = np.arange(-widest - reach, widest + reach + 1)
        unit = int(days[1] - days[0]) if len(days) > 1 else 1
        between = unit * np.arange(-(len(days) - 1), len(days))
        self._by_difference = np.zeros((len(self.steps) + 1, len(apart), len(between)))
        far = int(self.farthest + between.max())
        scores = self.scores(-far, far)
        for skill, chance in zip(self.spread.tolist(), self.chance.tolist(), strict=True):
            here = scores[:, :, between - skill + far]
            self.add(self._by_difference, apart - skill, here, chance)
        self._size = tuple(next_fast_len(n, real=True) for n in self._by_difference.shape[1:])
        self._spectrum: NDArray[np.complex128] | None = None

    def moves(self, law: Floats) -> Floats:
        """Return the convolution of P(move | differences) with the opponents' distribution."""
        middle = len(law) // 2
        law = law[middle - self._reach : middle + self._reach + 1]
        if law.size == 1:
            return np.asarray(self._by_difference * law[0, 0])
        if len(self.errors) * law.size * len(self._by_difference) * len(self.days) <= _FEW:
            windows = np.lib.stride_tricks.sliding_window_view(
                self._by_difference, law.shape, axis=(1, 2)
            )
            return np.asarray(np.tensordot(windows, law[::-1, ::-1], 2))
        if self._spectrum is None:
            self._spectrum = np.asarray(rfftn(self._by_difference, self._size, axes=(1, 2)))
        product = self._spectrum * rfftn(law, self._size)
        whole = irfftn(product, self._size, axes=(1, 2))
        kept = whole[
            :,
            len(law) - 1 : self._by_difference.shape[1],
            law.shape[1] - 1 : self._by_difference.shape[2],
        ]
        return np.asarray(np.clip(kept, 0.0, 1.0))


class RatingGiven(Pairing):
    """Opponents whose rating is given."""

    def _prepare(self) -> None:
        days = self.days
        # The player's form less the opponent's rating, and the opponent's j - g.
        self._far = int(days[-1] + self.farthest)
        self._hidden = int(self.errors[-1] + days[-1])
        reach = self._far + self._hidden
        self._scores = self.scores(-reach, reach)
        self._place = (self.errors[:, None] - days + self._hidden).ravel()

    def moves(self, law: Floats) -> Floats:
        """Return P(move), averaged over the opponents' skill on the night."""
        hidden = np.bincount(self._place, law.ravel(), 2 * self._hidden + 1)
        scores = averages(self._scores, hidden.astype(float))
        total = np.zeros((len(self.steps) + 1, *law.shape))
        for rating, chance in zip(self.spread.tolist(), self.chance.tolist(), strict=True):
            here = scores[:, :, self.days - rating + self._far]
            self.add(total, self.errors - rating, here, chance)
        return np.clip(total, 0.0, 1.0)


def pairing_of(
    system: StepSystem,
    chart: Chart,
    widest: int,
    opponents: Opponents,
    blur: Floats,
    days: Ints,
) -> Pairing:
    """Return a player's matches against these opponents."""
    apart = widest + opponents.farthest
    if opponents.given == "rating":
        table = known_table(system, chart, widest=apart)
        return RatingGiven(table, widest, opponents, blur, days)
    reach = widest if opponents.error is None else min(farthest(opponents.error), widest)
    table = known_table(system, chart, widest=apart + reach)
    return SkillGiven(table, widest, opponents, blur, days)
