"""Distributions on the whole numbers 0, 1, 2, ...: games won, balls run, points scored.

Probabilities are the decimals that people write: .9 is nine tenths. Ties do occur: with p = .5, the
chance of a score of 7 or less after 8 innings is exactly one half, and ceil((2 x .9 - 1) / (1 -
.9)) is 8, but 9 in floats. So whenever floats come close to a tie, modes, medians and quantiles are
decided in rational arithmetic.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

from evenbreak.checks import number_probability, plain, whole_numbers
from evenbreak.errors import InputError

if TYPE_CHECKING:
    from evenbreak.arrays import FloatOrArray, Floats


_HALF = Fraction(1, 2)

_NEAR = 1e-9
"""Relative distance between a tail and the wanted level below which fractions decide."""


class FairLine(NamedTuple):
    """Lines at which a bet on a score is fair, for three kinds of bet.

    `mean`: the bet pays an amount for every point above the line and costs as much for every point
    below it.

    `median`: the bet wins if the score is over the line and loses otherwise; the median is the
    smallest number that the score does not exceed at least half of the time.

    `mode`: everyone names a score, and whoever names it exactly wins; the mode is the best score to
    name.
    """

    mean: float
    median: int
    mode: int


class CountLaw(ABC):
    """Probability distribution on 0, 1, 2, ... whose median and quantiles are exact.

    A subclass has `mean`, `sd` and `mode`, the exact sum `exact_cumulative`, and three
    functions of arrays of counts: `_probability`, `_cumulative` and `_at_least`, each with a
    small relative error where it is small. Everything else follows from these.
    """

    @property
    @abstractmethod
    def mean(self) -> float:
        """The mean."""

    @property
    @abstractmethod
    def sd(self) -> float:
        """The standard deviation."""

    @property
    @abstractmethod
    def mode(self) -> int:
        """The most probable count; the smallest one if several are equally probable."""

    @abstractmethod
    def exact_cumulative(self, n: int) -> Fraction:
        """Return P(count <= n) as a fraction, without rounding."""

    @abstractmethod
    def _probability(self, n: Floats) -> Floats:
        """Return P(count = n), elementwise."""

    @abstractmethod
    def _cumulative(self, n: Floats) -> Floats:
        """Return P(count <= n), elementwise."""

    @abstractmethod
    def _at_least(self, n: Floats) -> Floats:
        """Return P(count >= n), elementwise."""

    def probability(self, n: FloatOrArray) -> FloatOrArray:
        """Return P(count = n); a float for a number, an array for an array."""
        return plain(self._probability(whole_numbers(n, "n")))

    def cumulative(self, n: FloatOrArray) -> FloatOrArray:
        """Return P(count <= n); a float for a number, an array for an array."""
        return plain(self._cumulative(whole_numbers(n, "n")))

    def at_least(self, n: FloatOrArray) -> FloatOrArray:
        """Return P(count >= n); a float for a number, an array for an array."""
        return plain(self._at_least(whole_numbers(n, "n")))

    def between(self, low: FloatOrArray, high: FloatOrArray) -> FloatOrArray:
        """Return P(low <= count <= high), both ends included; 0 if high is below low.

        A float for numbers, an array for arrays.

        Raises
        ------
        InputError
            if an end is not a whole number.
        """
        import numpy as np

        # The smaller tails are subtracted, so that an unlikely range keeps its digits.
        low, high = whole_numbers(low, "low"), whole_numbers(high, "high")
        below = self._cumulative(high) - self._cumulative(low - 1)
        above = self._at_least(low) - self._at_least(high + 1)
        inside = np.where(self._cumulative(high) < 0.5, below, above)
        return plain(np.where(high < low, 0.0, np.maximum(inside, 0.0)))

    def quantile(self, q: Any) -> int:
        """Return the smallest count n for which P(count <= n) >= q, decided without rounding.

        Raises
        ------
        InputError
            if q is not a number from 0 to 1, or is 1 and there is no largest count.
        """
        wanted = exact(q, "q")
        most = self.most
        if wanted == 0:
            return 0
        if wanted == 1:
            if most is None:
                raise InputError("q must be below 1; at 1 there's no largest count")
            return most
        low, high = -1, 1
        while not self._reaches(high, wanted):
            low, high = high, 2 * high
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if self._reaches(middle, wanted) else (middle, high)
        return high

    @property
    def most(self) -> int | None:
        """The largest possible count; None if there is none."""
        return None

    @property
    def median(self) -> int:
        """The smallest count n for which P(count <= n) >= 1/2."""
        return self.quantile(_HALF)

    @property
    def relative_sd(self) -> float | None:
        """The standard deviation divided by the mean; None if the mean is 0."""
        return self.sd / self.mean if self.mean else None

    @property
    def fair_line(self) -> FairLine:
        """The lines of fair bets on the count (P5.14, P5.17)."""
        return FairLine(self.mean, self.median, self.mode)

    def _reaches(self, n: int, wanted: Fraction) -> bool:
        """Return whether P(count <= n) >= wanted; the smaller tail is more precise."""
        if wanted < _HALF:
            reached, tail = self.cumulative(n), float(wanted)
        else:
            reached, tail = -self.at_least(n + 1), -float(1 - wanted)
        if abs(reached - tail) > _NEAR * abs(tail):
            return bool(reached > tail)
        return self.exact_cumulative(n) >= wanted


def exact(p: Any, name: str = "p") -> Fraction:
    """Return a probability as the fraction that its decimal stands for.

    Parameters
    ----------
    p
        a `Fraction` or an int from 0 to 1 is used unchanged, a float as the shortest decimal that
        gives the same float, so that .9 is 9/10.
    name
        the value's name in the error.

    Raises
    ------
    InputError
        if p is not a number from 0 to 1.

    >>> exact(0.9), exact(Fraction(24, 25)), exact(1)
    (Fraction(9, 10), Fraction(24, 25), Fraction(1, 1))
    """
    if isinstance(p, Fraction) and 0 <= p <= 1:
        return p
    return Fraction(repr(number_probability(p, name)))
