"""Compare two lists of scores, before and after, to see whether they have changed.

The answer is based on one test, chosen beforehand: Welch's t test, which compares two means
without assuming equal spreads.

The others are included because they answer other questions or are often requested; don't pick the
most favorable one afterward.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.stats.binomial import critical_value
from evenbreak.stats.confidence import checked_scores, open_share, sd_of


class Scores(NamedTuple):
    """One list of scores: their number, mean and sample standard deviation (n - 1)."""

    n: int
    mean: float
    sd: float


class Significance(NamedTuple):
    """A test: its statistic, its degrees of freedom, and its two-sided p-value.

    `p_value` is the chance of a statistic at least this extreme if nothing has changed.
    `freedom` is empty if the test has none.
    """

    statistic: float
    freedom: tuple[float, ...]
    p_value: float


class Effect(NamedTuple):
    """The size of the difference, whether or not chance explains it.

    `g` is Hedges' g: the difference of the means in pooled standard deviations, corrected for
    the bias of few scores, with its interval from `low` to `high`; all three are None if neither
    list has any spread. `p_after_higher` is the share of all pairs, one score before and one after,
    in which the later one is higher; ties count half.
    """

    g: float | None
    low: float | None
    high: float | None
    p_after_higher: float


@dataclass(frozen=True)
class Comparison:
    """Two lists of scores, compared.

    Parameters
    ----------
    difference, low, high
        mean after minus mean before, and its interval by Welch; low and high are None if neither
        list has any spread.
    welch
        are the two means equal? The test that was chosen; the spreads may differ.
    student
        are the two means equal, if the spreads are?
    anova
        the same test by analysis of variance: F = t squared, with the same p-value.
    variances
        are the two variances equal? F is the variance after over the variance before.
    mann_whitney
        is a score after as often above a score before as below it? By ranks, for scores with any
        distribution; approximate where there are `ties`.
    chi_squared
        is one list more often above the median of all scores than the other? Scores equal to
        that median are left out; without Yates' correction.
    counts
        the counts used by chi-squared: (below, above) before, (below, above) after.
    effect
        the size of the difference.

    Notes
    -----
    A test is None if the lists do not allow it (no spread, all scores the same).
    """

    before: Scores
    after: Scores
    difference: float
    low: float | None
    high: float | None
    confidence: float
    welch: Significance | None
    student: Significance | None
    anova: Significance | None
    variances: Significance | None
    mann_whitney: Significance | None
    chi_squared: Significance | None
    counts: tuple[tuple[int, int], tuple[int, int]]
    ties: bool
    effect: Effect


def compare(before: Any, after: Any, *, confidence: float = 0.95) -> Comparison:
    """Return tests for a change between two lists of scores.

    Parameters
    ----------
    before, after
        two or more finite numbers each: independent scores in one drill, without leaving out bad
        ones. For a single score after, see `was_it_luck`.
    confidence
        of the intervals, between 0 and 1.

    Raises
    ------
    InputError
        if a list does not hold two finite numbers or more, or confidence is not between 0
        and 1.

    Notes
    -----
    No test can say what caused the change: a new stroke, more practice or a different table. The
    end of P5.19 names these tests. Welch (1947); Mann & Whitney (1947), exact for short lists
    without ties; Mood's median test; Hedges & Olkin (1985) for g and its interval, g +- z sqrt((m +
    n)/(m n) + g^2 / (2 (m + n))) for m and n scores.

    >>> found = compare([50, 44, 46, 52, 47, 51, 49, 45, 48, 50], [53, 49, 52, 54, 50, 51])
    >>> round(found.difference, 2), round(found.low, 2), round(found.high, 2)
    (3.3, 0.85, 5.75)
    >>> round(found.welch.p_value, 4), round(found.effect.p_after_higher, 2)
    (0.0119, 0.84)
    """
    old, new = checked_scores(before, "before"), checked_scores(after, "after")
    share = open_share(confidence)
    first, second = _summary(old), _summary(new)
    difference = second.mean - first.mean
    every = np.concatenate([old, new])
    middle = np.median(every)
    sides = [(int(np.sum(scores < middle)), int(np.sum(scores > middle))) for scores in (old, new)]
    counts = sides[0], sides[1]
    low = high = welch = student = anova = None
    if first.sd or second.sd:
        welch, half = _welch(first, second, share)
        low, high = difference - half, difference + half
        student, anova = _equal_spreads(first, second)
    wins, rank_test = _ranks(old, new)
    return Comparison(
        before=first,
        after=second,
        difference=difference,
        low=low,
        high=high,
        confidence=share,
        welch=welch,
        student=student,
        anova=anova,
        variances=_variances(first, second) if first.sd and second.sd else None,
        mann_whitney=rank_test,
        chi_squared=_chi_squared(counts),
        counts=counts,
        ties=np.unique(every).size < every.size,
        effect=_effect(first, second, share, wins),
    )


def _summary(scores: Floats) -> Scores:
    sd = sd_of(scores)
    return Scores(scores.size, float(scores.mean() if sd else scores[0]), sd)


def _welch(before: Scores, after: Scores, confidence: float) -> tuple[Significance, float]:
    """Return the test, and half the width of the interval."""
    from scipy.special import stdtrit
    from scipy.stats import ttest_ind_from_stats

    test = ttest_ind_from_stats(
        after.mean, after.sd, after.n, before.mean, before.sd, before.n, equal_var=False
    )
    parts = [side.sd**2 / side.n for side in (before, after)]
    rest = sum(part**2 / (side.n - 1) for part, side in zip(parts, (before, after), strict=True))
    freedom = sum(parts) ** 2 / rest
    half = -float(stdtrit(freedom, (1.0 - confidence) / 2.0)) * math.sqrt(sum(parts))
    return Significance(float(test.statistic), (freedom,), float(test.pvalue)), half


def _equal_spreads(before: Scores, after: Scores) -> tuple[Significance, Significance]:
    """Return Student's t test and the analysis of variance."""
    from scipy.stats import f, ttest_ind_from_stats

    freedom = float(before.n + after.n - 2)
    t = ttest_ind_from_stats(after.mean, after.sd, after.n, before.mean, before.sd, before.n)
    # scipy's f_oneway subtracts sums of squares, which makes NaN of equal means.
    ratio = float(t.statistic) ** 2
    return (
        Significance(float(t.statistic), (freedom,), float(t.pvalue)),
        Significance(ratio, (1.0, freedom), float(f.sf(ratio, 1.0, freedom))),
    )


def _variances(before: Scores, after: Scores) -> Significance:
    from scipy.stats import f

    ratio = (after.sd / before.sd) ** 2
    freedom = float(after.n - 1), float(before.n - 1)
    smaller = min(f.cdf(ratio, *freedom), f.sf(ratio, *freedom))
    return Significance(ratio, freedom, min(1.0, 2.0 * float(smaller)))


def _ranks(old: Floats, new: Floats) -> tuple[float, Significance | None]:
    """Return the share of pairs in which the later score is higher, and the test by ranks."""
    from scipy.stats import mannwhitneyu

    test = mannwhitneyu(new, old, alternative="two-sided")
    wins = float(test.statistic) / (old.size * new.size)
    if min(old.min(), new.min()) == max(old.max(), new.max()):
        return wins, None
    return wins, Significance(float(test.statistic), (), float(test.pvalue))


def _chi_squared(counts: tuple[tuple[int, int], tuple[int, int]]) -> Significance | None:
    from scipy.stats import chi2_contingency

    (a, b), (c, d) = counts
    if not (a + b and c + d and a + c and b + d):
        return None
    test = chi2_contingency(counts, correction=False)
    return Significance(float(test.statistic), (1.0,), float(test.pvalue))


def _effect(before: Scores, after: Scores, confidence: float, wins: float) -> Effect:
    from scipy.special import gammaln

    m, n = before.n, after.n
    freedom = m + n - 2
    pooled = math.sqrt(((m - 1) * before.sd**2 + (n - 1) * after.sd**2) / freedom)
    if pooled == 0.0:
        return Effect(None, None, None, wins)
    # J(f) = Gamma(f / 2) / (sqrt(f / 2) Gamma((f - 1) / 2)); 0 for f = 1, but here f >= 2.
    unbiased = math.exp(float(gammaln(freedom / 2) - gammaln((freedom - 1) / 2)))
    unbiased /= math.sqrt(freedom / 2)
    g = unbiased * (after.mean - before.mean) / pooled
    half = critical_value(confidence) * math.sqrt((m + n) / (m * n) + g * g / (2 * (m + n)))
    return Effect(g, g - half, g + half, wins)
