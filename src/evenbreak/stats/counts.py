"""Laws on the whole numbers 0, 1, 2, ...: games won, balls run, points scored."""

from __future__ import annotations

from abc import ABC, abstractmethod
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from evenbreak.errors import InputError
from evenbreak.stats.exact import exact

if TYPE_CHECKING:
    from numpy.typing import NDArray

_HALF = Fraction(1, 2)

_NEAR = 1e-9
"""Tails that come nearer to the one wanted than this, relatively, leave the decision to
fractions."""


class CountLaw(ABC):
    """A probability law on 0, 1, 2, ...; its median and quantiles are decided exactly.

    A law says its `mean`, `sd` and `mode`, its `probability` of a count and the two sums
    `cumulative` and `at_least`, each with a small relative error where it is small. The rest
    follows.
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
        """The most probable count, the smallest of them where several are."""

    @abstractmethod
    def probability(self, n: Any) -> Any:
        """Return P(count = n); a float for a number, an array for an array."""

    @abstractmethod
    def cumulative(self, n: Any) -> Any:
        """Return P(count <= n); a float for a number, an array for an array."""

    @abstractmethod
    def at_least(self, n: Any) -> Any:
        """Return P(count >= n); a float for a number, an array for an array."""

    @abstractmethod
    def exact_cumulative(self, n: int) -> Fraction:
        """Return P(count <= n) without rounding."""

    def between(self, low: Any, high: Any) -> Any:
        """Return P(low <= count <= high), both ends included; 0 where high is below low.

        A float for numbers, an array for arrays.

        Raises
        ------
        InputError
            if an end is not a whole number.
        """
        import numpy as np

        # Two sums of the smaller tail are subtracted, so that a rare span keeps its digits.
        low, high = whole_counts(low, "low"), whole_counts(high, "high")
        below = self.cumulative(high) - self.cumulative(low - 1)
        above = self.at_least(low) - self.at_least(high + 1)
        inside = np.where(self.cumulative(high) < 0.5, below, above)
        found = np.where(high < low, 0.0, np.maximum(inside, 0.0))
        return found if found.ndim else float(found)

    def quantile(self, q: Any) -> int:
        """Return the smallest count n with P(count <= n) >= q, decided without rounding.

        Raises
        ------
        InputError
            if q is not a number from 0 to 1, or is 1 and no count is the largest.
        """
        wanted = exact(q, "q")
        most = self.most
        if wanted == 0:
            return 0
        if wanted == 1:
            if most is None:
                raise InputError("q is 1, and no count is the largest; give a q below 1")
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
        """The largest count that can occur; None where there is none."""
        return None

    @property
    def median(self) -> int:
        """The smallest count n with P(count <= n) >= 1/2."""
        return self.quantile(_HALF)

    def _reaches(self, n: int, wanted: Fraction) -> bool:
        """Whether P(count <= n) >= wanted; the smaller tail knows best."""
        if wanted < _HALF:
            found, tail = self.cumulative(n), float(wanted)
        else:
            found, tail = -self.at_least(n + 1), -float(1 - wanted)
        if abs(found - tail) > _NEAR * abs(tail):
            return bool(found > tail)
        return self.exact_cumulative(n) >= wanted


def whole_counts(n: Any, name: str = "n", *, at_least: int | None = None) -> NDArray[Any]:
    """Return counts as a float array of whole numbers, of no dimension for a number.

    Parameters
    ----------
    n
        a whole number or an array of them.
    name
        what the value is called where the caller wrote it.
    at_least
        the smallest that is allowed; None: negative ones ask for a probability of 0 or 1.

    Raises
    ------
    InputError
        if one is not a whole number, or is too small.

    >>> whole_counts([1, 2.0])
    array([1., 2.])
    """
    import numpy as np

    try:
        counts = np.asarray(n)
        if counts.dtype.kind in "SUc":
            raise ValueError
        counts = counts.astype(float)
        right = bool(np.all(counts == np.floor(counts)) and np.all(np.isfinite(counts)))
    except (TypeError, ValueError):
        right = False
    if not right or (at_least is not None and bool(np.any(counts < at_least))):
        smallest = "" if at_least is None else f", {at_least} or more"
        raise InputError(f"{name} is {n!r}; give whole numbers{smallest}")
    return counts
