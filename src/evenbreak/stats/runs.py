"""How many balls a player runs in one inning, with and without safety play.

Every shot is made with the same chance p, independently of the others, so a run of n balls
has chance p^n (1 - p). If the opponent plays safe, the first shot of the inning is harder: it is
made with chance alpha p, and P(run >= n) = alpha p^n for n >= 1. Fouls and their penalty points are
ignored.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.stats.counts import CountLaw, exact

_MOST = 100_000
"""The largest mean allowed; exact medians for larger ones would take minutes."""


@dataclass(frozen=True)
class RunLength(CountLaw):
    """Distribution of the number of balls that a player runs in one inning.

    Parameters
    ----------
    p
        P(the player makes a shot), the same for every shot but the first of the inning;
        below 1. A float stands for the decimal that it prints.
    safety
        alpha: P(the first shot of the inning is made) = alpha p. 1 is no safety play.

    Raises
    ------
    InputError
        if p or safety is not a number from 0 to 1, or the mean is above 100,000 balls (with
        p = 1 a run never ends).

    Notes
    -----
    `sd` and the far tails p^n keep nearly all their digits. Source: problems P5.11, P5.13 and
    P5.15, Table 5.2.

    >>> law = RunLength(0.96)
    >>> law.mean, law.median, law.mode, round(law.sd, 2)
    (24.0, 16, 0, 24.49)
    >>> round(law.between(50, 75), 3), round(law.at_least(100), 3)
    (0.085, 0.017)
    """

    p: float | Fraction
    safety: float | Fraction = 1

    def __post_init__(self) -> None:
        checked_shots(self.p, self.safety)

    @classmethod
    def of_mean(cls, mean: Any, safety: Any = 1) -> RunLength:
        """Return the distribution for a player who runs `mean` balls per inning on average.

        Parameters
        ----------
        mean
            balls per inning, 0 or more, against the safety play described by `safety`.
        safety
            as above, but not 0.

        Raises
        ------
        InputError
            if no player can have this average.

        >>> RunLength.of_mean(24)
        RunLength(p=Fraction(24, 25), safety=1)
        """
        return cls(shot_chance(mean, safety), safety)

    @property
    def mean(self) -> float:
        """The mean number of balls, alpha p / (1 - p)."""
        p, safety = exact(self.p), exact(self.safety)
        return float(safety * p / (1 - p))

    @property
    def sd(self) -> float:
        """The standard deviation; without safety play sqrt(p) / (1 - p)."""
        p, safety = exact(self.p), exact(self.safety)
        return math.sqrt(safety * p * (1 + p - safety * p)) / float(1 - p)

    @property
    def mode(self) -> int:
        """The most probable run: always 0."""
        return 0

    def _probability(self, n: Floats) -> Floats:
        p, safety = exact(self.p), exact(self.safety)
        one_or_more = np.exp(self._log_at_least(np.maximum(n, 1))) * float(1 - p)
        return np.where(n < 0, 0.0, np.where(n == 0, float(1 - safety * p), one_or_more))

    def _cumulative(self, n: Floats) -> Floats:
        shares = -np.expm1(self._log_at_least(np.maximum(n, 0) + 1))
        return np.where(n < 0, 0.0, shares)

    def _at_least(self, n: Floats) -> Floats:
        return np.where(n <= 0, 1.0, np.exp(self._log_at_least(np.maximum(n, 1))))

    def exact_cumulative(self, n: int) -> Fraction:
        """Return P(run <= n) = 1 - alpha p^(n + 1) as a fraction, without rounding."""
        if n < 0:
            return Fraction(0)
        return 1 - exact(self.safety) * exact(self.p) ** (n + 1)

    @property
    def median_bound(self) -> float:
        """The bound -(log(2 alpha) / log p + 1) on the median.

        The median is the smallest whole number not below it, or 0 if it is negative.
        """
        p, safety = exact(self.p), exact(self.safety)
        if safety == 0:
            return -math.inf
        halvings = _log(2 * safety) / -_log(p) if p > 0 else 0.0
        return halvings - 1.0

    @property
    def median_ratio(self) -> float | None:
        """The median divided by the mean; None if the mean is 0."""
        p, safety = exact(self.p), exact(self.safety)
        return float(self.median * (1 - p) / (safety * p)) if safety * p else None

    @property
    def median_estimate(self) -> float:
        """The text's estimate of the median, the mean times `median_ratio_limit`."""
        return self.mean * median_ratio_limit(self.safety)

    def _log_at_least(self, n: Floats) -> Floats:
        """Return log P(run >= n) for n >= 1."""
        p, safety = exact(self.p), exact(self.safety)
        return n * _log(p) + _log(safety)


def median_ratio_limit(safety: Any = 1) -> float:
    """Return the limit of median / mean for long runs, ln(2 alpha) / alpha.

    Parameters
    ----------
    safety
        alpha, as in `RunLength`. Up to 1/2 the median is 0, however large the mean.

    Raises
    ------
    InputError
        if safety is not a number from 0 to 1.

    Notes
    -----
    Source: problems P5.12 and P5.15.

    >>> round(median_ratio_limit(), 3), round(median_ratio_limit(0.8), 2)
    (0.693, 0.59)
    """
    alpha = exact(safety, "safety")
    return math.log(2 * alpha) / float(alpha) if alpha > Fraction(1, 2) else 0.0


def shot_chance(mean: Any, safety: Any = 1) -> Fraction:
    """Return the p of a player who averages `mean` balls per inning, mean / (mean + alpha).

    Parameters
    ----------
    mean
        balls per inning, 0 or more. A float stands for the decimal that it prints.
    safety
        alpha, as in `RunLength`, but not 0.

    Raises
    ------
    InputError
        if mean is not a number from 0 up, or safety is not above 0 and at most 1.

    Notes
    -----
    Source: problem P5.11.

    >>> shot_chance(24), shot_chance(24, 0.5)
    (Fraction(24, 25), Fraction(48, 49))
    """
    alpha = exact(safety, "safety")
    if alpha == 0:
        raise InputError("safety must be greater than 0; at 0 every run is 0")
    try:
        balls = mean if isinstance(mean, Fraction) else Fraction(repr(float(mean)))
    except (TypeError, ValueError, OverflowError):
        balls = Fraction(-1)
    if balls < 0:
        raise InputError("mean must be a number of balls, 0 or more; you gave {mean!r}", mean=mean)
    return balls / (balls + alpha)


def checked_shots(p: Any, safety: Any, innings: int = 1) -> tuple[Fraction, Fraction]:
    """Return p and safety as fractions, if the mean score in this many innings is not too large.

    >>> checked_shots(1, 1)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: p must be below 1; at 1 a run never ends
    """
    chance, alpha = exact(p, "p"), exact(safety, "safety")
    if chance == 1:
        raise InputError("p must be below 1; at {p} a run never ends", p=p)
    mean = innings * alpha * chance / (1 - chance)
    if mean > _MOST:
        raise InputError(
            "p is {p}, which makes the mean {mean:,.0f} balls; the limit is {most:,}. Give a "
            "smaller p or fewer innings.",
            p=p,
            mean=float(mean),
            most=_MOST,
        )
    return chance, alpha


def _log(x: Fraction) -> float:
    if x == 0:
        return -math.inf
    # Near 1 the logarithm is taken from 1 - x, or the tails would lose their digits.
    return math.log1p(-float(1 - x)) if x > Fraction(1, 2) else math.log(x)
