"""A player's score in a number of innings.

The score is the sum of that many runs. An inning is blank with chance 1 - alpha p, so the number of
innings that score is binomial. If k innings score, they bring k balls plus the balls made before
the k-th miss. Comparing two binomial counts avoids the sum: the score after m innings is n or less
exactly if, of n shots each missed with chance 1 - p, at least as many are missed as innings score.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import whole
from evenbreak.stats.beta_tail import beta_tail
from evenbreak.stats.binomial import GamesWon, score_probability
from evenbreak.stats.counts import CountLaw, exact
from evenbreak.stats.runs import checked_shots

_NEAR = 1e-9
"""Relative difference between two chances below which fractions decide."""

_CELLS = 1_000_000
"""The largest number of chances held in memory at once."""


@dataclass(frozen=True)
class InningsScore(CountLaw):
    """Distribution of the number of balls that a player makes in a number of innings.

    Parameters
    ----------
    p
        P(the player makes a shot), the same for every shot but the first of an inning;
        below 1. A float stands for the decimal that it prints.
    innings
        how many complete innings are played, 1 or more.
    safety
        alpha: P(the first shot of an inning is made) = alpha p. 1 is no safety play.

    Raises
    ------
    InputError
        if a parameter has an invalid value, or the mean is above 100,000 balls.

    Notes
    -----
    Penalty points are ignored. Source: problems P5.16 and P5.17, Table 5.3; P5.15 for safety
    play.

    >>> law = InningsScore(0.96, 5)
    >>> law.mean, law.median, law.mode, round(law.sd, 1)
    (120.0, 112, 95, 54.8)
    >>> InningsScore(0.5, 8).median, InningsScore(0.9, 2).mode
    (7, 8)
    """

    p: float | Fraction
    innings: int
    safety: float | Fraction = 1

    def __post_init__(self) -> None:
        object.__setattr__(self, "innings", whole(self.innings, "innings", at_least=1))
        checked_shots(self.p, self.safety, self.innings)

    @property
    def mean(self) -> float:
        """The mean score: the number of innings times the mean run."""
        p, alpha = exact(self.p), exact(self.safety)
        return float(self.innings * alpha * p / (1 - p))

    @property
    def sd(self) -> float:
        """The standard deviation; without safety play sqrt(innings p) / (1 - p)."""
        p, alpha = exact(self.p), exact(self.safety)
        return math.sqrt(self.innings * alpha * p * (1 + p - alpha * p)) / float(1 - p)

    @property
    def mode(self) -> int:
        """The most probable score; the smallest one if several are equally probable."""
        p, alpha = exact(self.p), exact(self.safety)
        if alpha == 1:
            # P(score = n + 1) / P(score = n) = (n + innings) p / (n + 1)
            return max(0, math.ceil((self.innings * p - 1) / (1 - p)))
        if self.innings == 1 or alpha * p == 0:
            return 0
        peak = self._peak()
        return peak if self._rises(0, peak) else 0

    @property
    def median_estimate(self) -> float:
        """The text's estimate of the median, (2 mean + mode) / 3.

        Without safety play, it is good for 4 or more innings. With safety play, the mode may be 0
        (blank innings only), and then says nothing about the median.
        """
        return (2.0 * self.mean + self.mode) / 3.0

    def _probability(self, n: Floats) -> Floats:
        return np.where(n < 0, 0.0, self._mixed(np.maximum(n, 0), self._exactly))

    def _cumulative(self, n: Floats) -> Floats:
        return np.where(n < 0, 0.0, self._mixed(np.maximum(n, 0), self._at_most))

    def _at_least(self, n: Floats) -> Floats:
        return np.where(n <= 0, 1.0, self._mixed(np.maximum(n, 1), self._reached))

    def exact_cumulative(self, n: int) -> Fraction:
        """Return P(score <= n) as a fraction, without rounding."""
        if n < 0:
            return Fraction(0)
        p, alpha = exact(self.p), exact(self.safety)
        if alpha == 1:
            return 1 - GamesWon(n + self.innings, 1 - p).exact_cumulative(self.innings - 1)
        # Of n shots, at least as many are missed as innings score.
        fewer, total, whole_n = 0, 0, (1 - p).denominator ** n
        most = min(self.innings, n)
        for scoring, missed in zip(
            _terms(self.innings, alpha * p, most), _terms(n, 1 - p, most), strict=True
        ):
            total += scoring * (whole_n - fewer)
            fewer += missed
        return Fraction(total, whole_n * (alpha * p).denominator ** self.innings)

    def _mixed(self, n: Any, part: Any) -> Any:
        """Return the mean of `part` over the number of innings that score, for scores n >= 0."""
        p, alpha = exact(self.p), exact(self.safety)
        if alpha == 1:
            # All innings are alike: count the balls made before the last of so many misses.
            return part(n, self.innings)
        k = np.arange(self.innings + 1)
        weights = _binomial(alpha * p, k, self.innings - k)
        scores = n.reshape(-1, 1)
        rows = max(1, _CELLS // k.size)
        sums = [
            (part(scores[i : i + rows] - k, k) * weights).sum(axis=1)
            for i in range(0, len(scores), rows)
        ]
        return np.concatenate([*sums, []]).reshape(n.shape)

    # In these, k innings score and bring `extra` balls besides the first ball of each.

    def _exactly(self, extra: Any, k: Any) -> Any:
        p = exact(self.p)
        inside = _binomial(p, np.maximum(extra, 0), np.maximum(k, 1) - 1) * float(1 - p)
        return np.where(np.equal(k, 0), extra == 0, np.where(extra < 0, 0.0, inside))

    def _at_most(self, extra: Any, k: Any) -> Any:
        inside = _beta(np.maximum(k, 1), np.maximum(extra, 0) + 1, 1 - exact(self.p))
        return np.where(np.equal(k, 0), 1.0, np.where(extra < 0, 0.0, inside))

    def _reached(self, extra: Any, k: Any) -> Any:
        inside = _beta(np.maximum(extra, 1), np.maximum(k, 1), exact(self.p))
        return np.where(np.equal(k, 0), 0.0, np.where(extra <= 0, 1.0, inside))

    def _peak(self) -> int:
        """Return the most probable score from 1 up, if the distribution has a single peak."""
        low, high = 0, math.ceil(self.mean) + 1
        while self._rises(high, high + 1):
            low, high = high, 2 * high
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if self._rises(middle, middle + 1) else (low, middle)
        return high

    def _rises(self, n: int, later: int) -> bool:
        """Return whether the score `other` is more probable than n, decided without rounding."""
        first, second = self.probability([n, later]).tolist()
        if abs(second - first) > _NEAR * max(first, second):
            return bool(second > first)
        exactly = [
            self.exact_cumulative(score) - self.exact_cumulative(score - 1) for score in (n, later)
        ]
        return exactly[1] > exactly[0]


def _binomial(p: Fraction, made: Any, missed: Any) -> Any:
    """Return P(p; made, missed), from the smaller of p and 1 - p, which is more precise."""
    if p <= Fraction(1, 2):
        return score_probability(float(p), made, missed)
    return score_probability(float(1 - p), missed, made)


def _beta(a: Any, b: Any, x: Fraction) -> Any:
    """Return the regularized incomplete beta function I_x(a, b), a and b 1 or more."""
    from scipy.special import betaincc

    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    return beta_tail(a, b, float(x)) if 2 * x <= 1 else betaincc(b, a, float(1 - x))


def _terms(shots: int, p: Fraction, most: int) -> Iterator[int]:
    """Yield P(p; k, shots - k) for k = 0 to `most`, times the denominator of p^shots."""
    made, missed = p.numerator, p.denominator - p.numerator
    term = missed**shots
    for k in range(most + 1):
        yield term
        term = term * (shots - k) * made // ((k + 1) * missed) if missed else 0
