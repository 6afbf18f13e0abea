"""Summaries of values or of a distribution: mean, median, mode, spread, quantiles."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate, pairwise
from typing import Any

from evenbreak.checks import number, whole
from evenbreak.errors import InputError
from evenbreak.stats.counts import exact

Number = float | Fraction

_EQUAL = 1e-12
"""Tolerance for float probabilities: absolute for sums, relative to the largest otherwise."""

_SUM = 1e-9
"""Tolerance for the sum of float probabilities, which should be 1."""


@dataclass(frozen=True)
class Distribution:
    """Values in increasing order, each with its probability.

    Parameters
    ----------
    values
        finite numbers, each larger than the one before it.
    probability
        the probability of each; they sum to 1. Fractions sum to exactly 1, and make median, mode
        and quantiles exact. Floats sum to 1 to within 1e-9; a cumulative float probability within
        1e-12 below q counts as having reached q, and float probabilities within 1e-12 of the
        largest, relatively, count as equally large.

    Raises
    ------
    InputError
        if there is no value, a value is not a finite number, the values do not increase, or there
        is not exactly one probability from 0 to 1 for each value, with sum 1.

    Notes
    -----
    Source: P5.1, the mean, median, mode and standard deviation of section 5, with its
    convention for the median: the smallest value whose cumulative probability reaches 1/2,
    which is one of the values even if their number is even.

    >>> law = Distribution((0, 1, 4, 5), (0.2, 0.4, 0.2, 0.2))
    >>> round(law.mean, 3), law.median, law.mode, round(law.sd, 3)
    (2.2, 1, 1, 1.939)
    """

    values: tuple[Number, ...]
    probability: tuple[Number, ...]

    def __post_init__(self) -> None:
        values = _numbers(self.values, "values")
        if any(second <= first for first, second in pairwise(values)):
            raise InputError("values must increase; they don't. Sort them, or use Distribution.of.")
        object.__setattr__(self, "values", values)
        object.__setattr__(self, "probability", _probabilities(self.probability, len(values)))

    @classmethod
    def of(cls, values: Iterable[Any], weights: Iterable[Any] | None = None) -> Distribution:
        """Return the distribution of a sample, or of weighted values.

        Parameters
        ----------
        values
            finite numbers in any order; equal ones are combined.
        weights
            the weight of each value, in the same order; whole numbers are counts. None:
            each value counts once. Counts and Fractions give exact probabilities, other
            weights give floats. A value with weight 0 is left out.

        Raises
        ------
        InputError
            if there is no value, a value or weight is not a finite number, a weight is
            negative, all are 0, or there is not one weight for each value.

        >>> Distribution.of([4, 1, 0, 5, 1]).probability[:2]
        (Fraction(1, 5), Fraction(2, 5))
        >>> Distribution.of([10, 20, 30], weights=[1, 2, 5]).median
        30
        """
        listed = _numbers(values, "values")
        total: dict[Number, Number] = {}
        for value, weight in zip(listed, _weights(weights, len(listed)), strict=True):
            if weight > 0:
                total[value] = total.get(value, 0) + weight
        if not total:
            raise InputError("weights are all 0. Give at least one value a weight.")
        ordered = sorted(total.items())
        everything = sum(weight for _, weight in ordered)
        if everything == math.inf:
            raise InputError("the weights' sum is too large for a float. Scale them down.")
        return cls(
            tuple(value for value, _ in ordered),
            tuple(weight / everything for _, weight in ordered),
        )

    @property
    def exact(self) -> bool:
        """Whether the probabilities are Fractions, so that every tie is decided exactly."""
        return isinstance(self.probability[0], Fraction)

    @property
    def mean(self) -> float:
        """The mean: sum of value times probability."""
        pairs = zip(self.values, self.probability, strict=True)
        return math.fsum(float(value) * float(probability) for value, probability in pairs)

    @property
    def variance(self) -> float:
        """The population variance: the mean of the squared distance from the mean."""
        mean = self.mean
        pairs = zip(self.values, self.probability, strict=True)
        away = ((float(value) - mean, float(probability)) for value, probability in pairs)
        return math.fsum(probability * distance * distance for distance, probability in away)

    @property
    def sd(self) -> float:
        """The population standard deviation: the square root of the variance."""
        return math.sqrt(self.variance)

    @property
    def cumulative(self) -> tuple[Number, ...]:
        """P(value <= each of `values`); Fractions if the probabilities are."""
        return tuple(accumulate(self.probability))

    @property
    def median(self) -> Number:
        """The smallest value for which P(value <= it) >= 1/2."""
        return self.quantile(Fraction(1, 2))

    @property
    def quartiles(self) -> tuple[Number, Number, Number]:
        """The quantiles at 1/4, 1/2 and 3/4."""
        lower, middle, upper = (self.quantile(Fraction(i, 4)) for i in (1, 2, 3))
        return lower, middle, upper

    @property
    def mode(self) -> Number:
        """The most probable value; the smallest one if several are equally probable."""
        return self.modes[0]

    @property
    def modes(self) -> tuple[Number, ...]:
        """All the most probable values."""
        largest = max(self.probability)
        least = largest if self.exact else largest * (1 - _EQUAL)
        pairs = zip(self.values, self.probability, strict=True)
        return tuple(value for value, probability in pairs if probability >= least)

    def quantile(self, q: Any) -> Number:
        """Return the smallest value for which P(value <= it) >= q.

        q = .9 gives the 90th percentile, q = 0 the smallest possible value, q = 1 the
        largest.

        Raises
        ------
        InputError
            if q is not a number from 0 to 1.

        >>> Distribution.of([1, 2, 3, 4]).quantile(0.75)
        3
        """
        wanted = exact(q, "q")
        can = [i for i, probability in enumerate(self.probability) if probability > 0]
        sums = self.cumulative
        if wanted == 1:
            return self.values[can[-1]]
        least = wanted if self.exact else float(wanted) - _EQUAL
        reached = bisect_left(sums, least)
        return self.values[min(max(reached, can[0]), can[-1])]

    def between(self, low: float, high: float) -> float:
        """Return P(low <= value <= high), both ends included; an end may be infinite.

        >>> Distribution.of([0, 1, 1, 4, 5]).between(1, 4)
        0.6
        """
        if math.isnan(low) or math.isnan(high):
            raise InputError(
                "the ends must be two numbers; you gave {low!r} and {high!r}", low=low, high=high
            )
        pairs = zip(self.values, self.probability, strict=True)
        inside = [probability for value, probability in pairs if low <= value <= high]
        return float(sum(inside)) if self.exact else math.fsum(inside)

    def at_least(self, x: float) -> float:
        """Return P(value >= x)."""
        return self.between(x, math.inf)


@dataclass(frozen=True)
class Moments:
    """Number of values, with their mean and population standard deviation.

    Raises
    ------
    InputError
        if n is not a whole number from 1 up, or the mean or the standard deviation is not
        finite, or the latter is negative.

    >>> Moments.of([0, 1, 1, 4, 5]).mean
    2.2
    """

    n: int
    mean: float
    sd: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "n", whole(self.n, "n", at_least=1))
        object.__setattr__(self, "mean", number(self.mean, "mean"))
        object.__setattr__(self, "sd", number(self.sd, "sd", low=0.0))

    @classmethod
    def of(cls, values: Iterable[Any]) -> Moments:
        """Return the number, mean and standard deviation of a sample."""
        listed = _numbers(values, "values")
        law = Distribution.of(listed)
        return cls(len(listed), law.mean, law.sd)

    @property
    def variance(self) -> float:
        """The population variance, the standard deviation squared."""
        return self.sd * self.sd


def merge(parts: Iterable[Moments]) -> Moments:
    """Return the number, mean and standard deviation of several sets combined.

    The values themselves are not needed. The variance of the combined set is the mean of the parts'
    variances plus the variance of the parts' means, each part weighted by its size.

    Raises
    ------
    InputError
        if there is no part.

    Notes
    -----
    Source: problem P5.2.

    >>> whole = merge([Moments.of([0, 1, 1, 4, 5]), Moments.of([0, 1, 1, 8, 9])])
    >>> whole.n, whole.mean, round(whole.variance, 9)
    (10, 3.0, 10.0)
    """
    parts = list(parts)
    if not parts:
        raise InputError("parts must not be empty. Give at least one Moments.")
    n = sum(part.n for part in parts)
    mean = math.fsum(part.n * part.mean for part in parts) / n
    # hypot adds squares that alone would exceed the range of a float.
    spread = (math.sqrt(part.n / n) * math.hypot(part.sd, part.mean - mean) for part in parts)
    return Moments(n, mean, math.hypot(*spread))


def _numbers(
    values: Any, name: str, *, many: int | None = None, high: float = math.inf
) -> tuple[Number, ...]:
    """Return a list of finite numbers as ints, floats and Fractions.

    Probabilities and weights, for `many` values, are from 0 to `high`.
    """
    if not hasattr(values, "__iter__") or isinstance(values, str):
        raise InputError(
            "{name} must be a list of numbers; you gave {values!r}", name=name, values=values
        )
    low = -math.inf if many is None else 0.0
    listed = tuple(_plain(value, f"{name}[{i}]", low, high) for i, value in enumerate(values))
    if not listed:
        raise InputError("{name} must not be empty. Give at least one number.", name=name)
    if many not in (None, len(listed)):
        raise InputError(
            "{name} has {n_listed} entries for {many} values. Give one entry for each value.",
            name=name,
            n_listed=len(listed),
            many=many,
        )
    return listed


def _plain(value: Any, name: str, low: float, high: float) -> Number:
    if type(value) is float and low <= value <= high and math.isfinite(value):
        return value  # as `number` would, in a third of the time
    checked = number(value, name, low=low, high=high)
    if isinstance(value, Fraction):
        return value
    return int(value) if hasattr(value, "__index__") else checked


def _weights(weights: Iterable[Any] | None, many: int) -> list[Number]:
    """Return the weights, as Fractions if all are whole numbers or Fractions."""
    if weights is None:
        return [Fraction(1)] * many
    listed = _numbers(weights, "weights", many=many)
    if all(isinstance(weight, Fraction) or weight == int(weight) for weight in listed):
        return [Fraction(weight) for weight in listed]
    return [float(weight) for weight in listed]


def _probabilities(probability: Iterable[Any], many: int) -> tuple[Number, ...]:
    """Return `many` probabilities that sum to 1, either all Fractions or all floats."""
    listed = _numbers(probability, "probability", many=many, high=1.0)
    rational = all(isinstance(p, int | Fraction) for p in listed)
    if sum(listed) != 1 if rational else abs(math.fsum(listed) - 1) > _SUM:
        raise InputError(
            "probability must sum to 1; it sums to {listed!r}", listed=math.fsum(listed)
        )
    if rational:
        return tuple(Fraction(p) for p in listed)
    return tuple(float(p) for p in listed)
