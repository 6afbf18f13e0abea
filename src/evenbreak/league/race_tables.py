"""Scores of races between players of any skill, looked up by their skill gap."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from scipy.special import gammaln, xlog1py, xlogy

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.errors import InputError

CLOSE = 0.25
"""A race is right if it makes up for the skill difference to within this many doublings.

The chance in a race to 5 is then at most 60%; but whether a race is right does not depend on its
length.
"""

STEPS = 128
"""Grid steps per doubling: a chance of winning a game is off by at most .0007."""

WIDEST = 6
"""Limit on skill gaps, in doublings; wider ones are treated as equal to it."""

_GAPS = np.arange(-WIDEST * STEPS, WIDEST * STEPS + 1) / STEPS
_MOST = 128
"""Every race is to fewer games than this."""


class RaceTables:
    """The chances of all requested races, by race number and skill gap.

    `form` is the standard deviation of a player's form, in doublings: chances given the true skills
    are means over the form of both.

    >>> tables = RaceTables(0.0)
    >>> place = tables.places(np.array([5, 5]), np.array([5, 4]), np.array([0.0, 0.0]))
    >>> tables.chances.take(place).round(3)
    array([0.5  , 0.363])
    >>> tables.scores(place, np.array([5, 5]), np.array([5, 4]), np.array([0.01, 0.99]))
    (array([5, 0]), array([0, 4]))
    """

    def __init__(self, form: float) -> None:
        self.form = form
        self.number = np.full(_MOST * _MOST, -1, dtype=np.int64)
        self.chances: Floats = np.zeros(0)
        self.fair: Floats = np.zeros(0)
        self.worth: Floats = np.zeros(0)
        self.reached = np.zeros((0, 32), dtype=np.float32)
        self.races: list[tuple[int, int]] = []

    def places(self, m: Ints, n: Ints, gap: Floats) -> Ints:
        """Return the positions in the tables of races m:n between players this far apart."""
        if max(m.max(initial=0), n.max(initial=0)) >= _MOST:
            raise InputError(
                "a race is to {games} games; in a league, the limit is {most}",
                games=max(m.max(), n.max()),
                most=_MOST - 1,
            )
        code = m * _MOST + n
        number = self.number.take(code)
        if (number < 0).any():
            for new in np.unique(code[number < 0]).tolist():
                self.number[new] = len(self.races)
                self.races.append(divmod(new, _MOST))
            self._extend()
            number = self.number.take(code)
        at = np.clip(np.rint(gap * STEPS), -WIDEST * STEPS, WIDEST * STEPS).astype(np.int64)
        place: Ints = number * len(_GAPS) + at + WIDEST * STEPS
        return place

    def numbers(self, place: Ints) -> Ints:
        """Return which race each position belongs to, as an index in `fair` and `worth`.

        `fair` is the skill gap at which a race is even, in doublings; `worth` is the chance of
        winning for a player who is a doubling better than that.
        """
        return np.asarray(place // len(_GAPS))

    def right(self, number: Ints, gap: Floats) -> Bools:
        """Return which races make up for the skill gaps at which they are played."""
        return np.asarray(np.abs(gap - self.fair.take(number)) <= CLOSE + 1e-9)

    def scores(
        self, place: Ints, m: Ints, n: Ints, luck: NDArray[np.floating[Any]]
    ) -> tuple[Ints, Ints]:
        """Return the final scores determined by each match's luck and chances.

        The better player a's luck, the better their score, from m:0 down to 0:n, so the same luck
        has the same effect in races of different lengths.
        """
        width = self.reached.shape[1]
        where, flat = place * width, self.reached.ravel()
        number = np.zeros(place.shape, dtype=np.int64)
        step = width // 2
        while step:
            number += step * (luck > flat.take(where + number + (step - 1)))
            step //= 2
        won = number < n
        return np.where(won, m, m + n - 1 - number), np.where(won, number, n)

    def _extend(self) -> None:
        done = len(self.chances) // len(_GAPS)
        width = 32
        while width < max(m + n for m, n in self.races):
            width *= 2
        if width > self.reached.shape[1]:
            more = width - self.reached.shape[1]
            self.reached = np.pad(self.reached, ((0, 0), (0, more)), constant_values=2.0)
        chances, reached = [self.chances], [self.reached]
        fair, worth = self.fair.tolist(), self.worth.tolist()
        for m, n in self.races[done:]:
            law = score_law(m, n, 1.0 / (1.0 + 2.0**-_GAPS))
            wins = law[:, :n].sum(axis=1)
            if self.form:
                wins = gaussian_filter1d(wins, np.sqrt(2.0) * self.form * STEPS, mode="nearest")
            chances.append(wins)
            fair.append(np.interp(0.5, wins, _GAPS))
            worth.append(np.interp(fair[-1] + 1.0, _GAPS, wins))
            table = np.full((len(_GAPS), width), 2.0, dtype=np.float32)
            table[:, : m + n - 1] = np.cumsum(law, axis=1)[:, :-1]
            reached.append(table)
        self.chances, self.reached = np.concatenate(chances), np.concatenate(reached)
        self.fair, self.worth = np.array(fair), np.array(worth)


@lru_cache(maxsize=1)
def known_tables(form: float) -> RaceTables:
    """Return the tables for a form, including the races requested earlier."""
    return RaceTables(form)


def score_law(m: int, n: int, p: Floats) -> Floats:
    """Return the chances of scores m:0, m:1, ..., m:n-1, m-1:n, ..., 0:n, with a row for each p.

    >>> score_law(2, 1, np.array([0.5]))
    array([[0.25, 0.25, 0.5 ]])
    """
    a = np.concatenate([np.full(n, m), np.arange(m - 1, -1, -1)])
    b = np.concatenate([np.arange(n), np.full(m, n)])
    winner, loser = np.where(a == m, m, n), np.where(a == m, b, a)
    orders = gammaln(winner + loser) - gammaln(winner) - gammaln(loser + 1)
    law: Floats = np.exp(orders + xlogy(a, p[:, None]) + xlog1py(b, -p[:, None]))
    return law
