"""Games won out of a number of games: the binomial distribution, exact and approximated."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from evenbreak.checks import (
    floats,
    number_probability,
    plain,
    probability,
    together,
    whole,
    whole_numbers,
)
from evenbreak.errors import InputError
from evenbreak.stats.beta_tail import beta_tail
from evenbreak.stats.counts import CountLaw, exact

if TYPE_CHECKING:
    from evenbreak.arrays import FloatOrArray, Floats


_NEAR = 1e-9
"""Distance from the wanted coverage below which the chance of the scores outside the range decides;
if that is relatively just as close, fractions decide."""


def score_probability(p: FloatOrArray, m: FloatOrArray, n: FloatOrArray) -> FloatOrArray:
    """Return P(p; m, n), the chance that the score is m:n after m + n games.

    Parameters
    ----------
    p
        P(player 1 wins a game), the same for every game and independent of the others.
    m, n
        games won by player 1 and by player 2: whole numbers, or arrays of them. p, m and n
        are broadcast together.

    Returns
    -------
    float, fractions.Fraction or numpy.ndarray
        a Fraction for a Fraction p with plain m and n, a float for other plain numbers,
        otherwise an array.

    Raises
    ------
    InputError
        if p is not a probability, m or n is not a whole number from 0 up, or their shapes do
        not broadcast.

    Notes
    -----
    All m + n games are played; there is no race to end earlier. Source: problems P5.3 (in
    how many orders), P5.4 and P5.6.

    >>> score_probability(Fraction(2, 3), 3, 1)
    Fraction(32, 81)
    >>> import numpy as np
    >>> games = np.arange(3)
    >>> score_probability(0.5, games[:, None], games)[2]
    array([0.25 , 0.375, 0.375])
    """
    if isinstance(p, Fraction) and not hasattr(m, "__len__") and not hasattr(n, "__len__"):
        p, m, n = exact(p), whole(m, "m"), whole(n, "n")
        return math.comb(m + n, m) * p**m * (1 - p) ** n
    from scipy.stats import binom

    p = probability(p, "p")
    m, n = whole_numbers(m, "m", at_least=0), whole_numbers(n, "n", at_least=0)
    together(p=p, m=m, n=n)
    return plain(binom.pmf(m, m + n, p))


class ScoreRange(NamedTuple):
    """The scores from `low` to `high`, both included, with P(low <= score <= high)."""

    low: int
    high: int
    probability: float


@dataclass(frozen=True)
class GamesWon(CountLaw):
    """Distribution of the number of games that player 1 wins.

    Parameters
    ----------
    p
        P(player 1 wins a game), the same for every game and independent of the others. A float
        stands for the decimal that it prints; a `fractions.Fraction` is used unchanged.

    Raises
    ------
    InputError
        if games is not a whole number from 0 up, or p is not a number from 0 to 1.

    Notes
    -----
    Source: problems P5.9 and P5.10. If there are two modes, the text's formula gives the smaller
    one; its words, read strictly, give the larger one. `modes` has both.

    >>> law = GamesWon(120, 0.52)
    >>> law.mean, round(law.sd, 2), law.mode, law.median
    (62.4, 5.47, 62, 62)
    >>> round(law.between(59, 66), 3)
    0.535
    """

    games: int
    p: float | Fraction

    def __post_init__(self) -> None:
        object.__setattr__(self, "games", whole(self.games, "games"))
        exact(self.p)
        object.__setattr__(self, "p", self.p if isinstance(self.p, Fraction) else float(self.p))

    @property
    def mean(self) -> float:
        """The mean, games times p."""
        return float(self.games * exact(self.p))

    @property
    def sd(self) -> float:
        """The standard deviation, the square root of games times p times 1 - p."""
        p = exact(self.p)
        return math.sqrt(self.games * p * (1 - p))

    @property
    def mode(self) -> int:
        """The most probable score, games p - (1 - p) rounded up; the smaller one of two."""
        return self.modes[0]

    @property
    def modes(self) -> tuple[int, ...]:
        """The most probable scores: one, or two consecutive scores with equal probability."""
        p = exact(self.p)
        # P(score = n) >= P(score = n - 1) as long as n <= (games + 1) p.
        peak = (self.games + 1) * p
        last = min(math.floor(peak), self.games)
        return (last - 1, last) if last == peak and 0 < p < 1 else (last,)

    @property
    def most(self) -> int:
        """The largest possible score: all games, or none if p is 0."""
        return self.games if self.p > 0 else 0

    def _probability(self, n: Floats) -> Floats:
        from scipy.stats import binom

        return binom.pmf(n, self.games, float(self.p))

    def _cumulative(self, n: Floats) -> Floats:
        # The games that are lost are a score too: each is lost with chance 1 - p.
        return self._upper_tail(self.games - n, 1 - exact(self.p))

    def _at_least(self, n: Floats) -> Floats:
        return self._upper_tail(n, exact(self.p))

    def _upper_tail(self, n: Floats, p: Fraction) -> Floats:
        import numpy as np

        inside = np.clip(n, 1, max(self.games, 1))
        tail = beta_tail(inside, self.games - inside + 1.0, float(p))
        return np.where(n <= 0, 1.0, np.where(n > self.games, 0.0, tail))

    def exact_cumulative(self, n: int) -> Fraction:
        """Return P(score <= n) as a fraction, without rounding."""
        if n >= self.games:
            return Fraction(1)
        if n < 0:
            return Fraction(0)
        p = exact(self.p)
        if 2 * n + 1 == self.games and p == Fraction(1, 2):
            return p  # for any number of games, where the sum would be long
        if 2 * n >= self.games:
            return 1 - _lower_sum(self.games, self.games - n - 1, 1 - p)
        return _lower_sum(self.games, n, p)

    def normal_range(self, coverage: float) -> ScoreRange:
        """Return a range of scores from the normal distribution with the same mean and sd.

        The ends mean -+ z sd, with z = `critical_value(coverage)`, are rounded to the
        nearest score and kept within 0 and `games`.

        Parameters
        ----------
        coverage
            P(the score is in the range), by the normal distribution: from 0 to below 1.

        Returns
        -------
        ScoreRange
            its `probability` is the exact probability of the range.

        Raises
        ------
        InputError
            if the coverage is not a number from 0 to below 1.

        Notes
        -----
        Source: problem P5.10. For 95% the text starts its range at 51, the whole part of
        51.67; the nearest score is 52.

        >>> GamesWon(120, 0.52).normal_range(0.5)
        ScoreRange(low=59, high=66, probability=0.5349508426730065)
        """
        reach = critical_value(number_probability(coverage, "coverage")) * self.sd
        low, high = (
            min(max(math.floor(end + 0.5), 0), self.games)
            for end in (self.mean - reach, self.mean + reach)
        )
        return ScoreRange(low, high, float(self.between(low, high)))

    def exact_range(self, coverage: float) -> ScoreRange:
        """Return the shortest range of scores that has at least a given probability.

        If several ranges are equally short, it is the most probable one, and the lowest of equally
        probable ones. Whether a range has the probability is decided without rounding.

        Parameters
        ----------
        coverage
            the least probability of the range, from 0 to 1.

        Raises
        ------
        InputError
            if the coverage is not a number from 0 to 1.

        >>> GamesWon(120, 0.52).exact_range(0.5)[:2]
        (59, 66)
        """
        wanted = exact(coverage, "coverage")
        if wanted == 1:
            return ScoreRange(0 if self.p < 1 else self.games, self.most, 1.0)
        for low, high, inside in self._widening():
            if self._holds(low, high, inside, wanted):
                break
        return ScoreRange(low, high, float(self.between(low, high)))

    def _widening(self) -> Iterator[tuple[int, int, float]]:
        """Yield ranges that start at the mode and grow by the more probable neighbor each time.

        The distribution has one peak, so each is the most probable range of its length.
        """
        import numpy as np

        low = high = self.mode
        # Beyond this distance from the mode (Bernstein's inequality) a float chance is 0.
        reach = 500 + math.ceil(40 * self.sd)
        near = np.arange(max(low - reach, 0), min(low + reach, self.games) + 1)
        chance = dict(zip(near.tolist(), self.probability(near).tolist(), strict=True))
        inside = chance[low]
        yield low, high, inside
        while high - low < self.games:
            below, above = chance.get(low - 1, 0.0), chance.get(high + 1, 0.0)
            # Equal chances, as with p = 1/2, differ only by rounding.
            if low > 0 and (high == self.games or below >= above * (1 - 1e-12)):
                low -= 1
                inside += below
            else:
                high += 1
                inside += above
            yield low, high, inside

    def _holds(self, low: int, high: int, inside: float, wanted: Fraction) -> bool:
        """Return whether P(low <= score <= high), about `inside`, is at least `wanted`."""
        distance = inside - float(wanted)
        if abs(distance) > _NEAR:
            return distance > 0
        outside, rest = self.cumulative(low - 1) + self.at_least(high + 1), float(1 - wanted)
        if abs(outside - rest) > _NEAR * rest:
            return bool(outside < rest)
        return self.exact_cumulative(high) - self.exact_cumulative(low - 1) >= wanted


def critical_value(coverage: FloatOrArray) -> FloatOrArray:
    """Return the z for which P(-z <= Z <= z) = coverage, for a standard normal Z.

    Parameters
    ----------
    coverage
        a probability below 1, or an array of them.

    Raises
    ------
    InputError
        if a coverage is not a number from 0 to below 1.

    Notes
    -----
    Source: Table 5.1. `coverage_within` is the inverse.

    >>> critical_value([0.95, 0.5]).round(4)
    array([1.96  , 0.6745])
    """
    import numpy as np
    from scipy.special import erfinv

    checked = probability(coverage, "coverage")
    if np.any(np.equal(checked, 1.0)):
        raise InputError("coverage must be below 1, because no z covers everything")
    return plain(math.sqrt(2) * erfinv(checked))


def coverage_within(z: FloatOrArray) -> FloatOrArray:
    """Return P(-z <= Z <= z) for a standard normal Z: the share within z standard deviations.

    Parameters
    ----------
    z
        a number of standard deviations, 0 or more, or an array of them.

    Raises
    ------
    InputError
        if z is negative or not a number.

    >>> coverage_within([1, 2, 3]).round(4)
    array([0.6827, 0.9545, 0.9973])
    """
    from scipy.special import erf

    checked = floats(z, "z", low=0.0, wanted="a number of standard deviations, 0 or more")
    return plain(erf(checked / math.sqrt(2)))


def _lower_sum(games: int, n: int, p: Fraction) -> Fraction:
    """Return P(score <= n), by Horner's rule in whole numbers."""
    won, lost = p.numerator, p.denominator - p.numerator
    total, ways, power = 0, 1, 1
    for k in range(n + 1):
        total = total * lost + ways * power
        ways = ways * (games - k) // (k + 1)
        power *= won
    return Fraction(total * lost ** (games - n), p.denominator**games)
