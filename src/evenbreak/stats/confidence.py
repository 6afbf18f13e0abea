"""Inference from a list of scores about the true mean, and about one more score.

Two distributions can answer both questions. The normal distribution treats the spread of the scores
(their population standard deviation) as the true one; Student's t allows for the spread being
estimated from the same few scores. With 10 scores the difference matters.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from evenbreak.checks import floats, number, one_of, whole
from evenbreak.errors import InputError
from evenbreak.stats.binomial import critical_value

if TYPE_CHECKING:
    from evenbreak.arrays import Floats

LARGEST = 1e9
"""The largest absolute score allowed; beyond it, a typo is more likely."""

SMALLEST_SPREAD = 1e-60
"""Scores that differ by less than this count as equal: its fourth power is still a float."""


def sd_of_mean(sd: float, n: int, *, population: int | None = None) -> float:
    """Return the standard deviation of the mean of n values drawn at random.

    Parameters
    ----------
    sd
        the population standard deviation of the values drawn from.
    population
        how many values there are, if each is drawn at most once (without replacement); None if
        every draw is from all of them (with replacement, or from so many that it doesn't matter).

    Raises
    ------
    InputError
        if sd is not a number from 0 up, n is not a whole number from 1 up, or population
        is less than n.

    Notes
    -----
    P5.18: sd / sqrt(n), times sqrt((N - n) / (N - 1)) for a draw without replacement from N
    values; the mean of all of them is certain.

    >>> round(sd_of_mean(2.5**0.5, 2), 4), round(sd_of_mean(2.5**0.5, 2, population=4), 4)
    (1.118, 0.9129)
    """
    spread = number(sd, "sd", low=0.0)
    n = whole(n, "n", at_least=1)
    if population is None:
        return spread / math.sqrt(n)
    total = whole(population, "population", at_least=n)
    if n == total:
        return 0.0
    return spread * math.sqrt((total - n) / (total - 1) / n)


class MeanInterval(NamedTuple):
    """Interval for the true mean of scores, and the numbers it is based on.

    Over many lists of scores, the share `confidence` of the intervals `low` to `high` contain
    the true mean. `sd` is the sample's (n - 1) for "t" and the population's (n) for "normal";
    `sd_of_mean` is that divided by sqrt(n).
    """

    low: float
    high: float
    confidence: float
    mean: float
    sd: float
    sd_of_mean: float
    n: int
    method: Literal["t", "normal"]


def mean_interval(
    scores: Any, confidence: float = 0.95, *, method: Literal["t", "normal"] = "t"
) -> MeanInterval:
    """Return an interval for the true mean of scores, with a given confidence.

    Parameters
    ----------
    scores
        two or more scores, not all equal; independent and nearly normal, without a trend.
    confidence
        the share of such intervals that contain the true mean, between 0 and 1.
    method
        "t" allows for the spread being estimated from the same scores, is exact for normal
        scores and is the better choice; "normal" treats the spread of the scores as the true one,
        and is too narrow if there are few scores.

    Raises
    ------
    InputError
        if there are fewer than two scores, one is not a finite number, all are the same,
        confidence is not between 0 and 1, or method is unknown.

    Notes
    -----
    P5.19 uses the normal distribution.

    >>> scores = [50, 44, 46, 52, 47, 51, 49, 45, 48, 50]
    >>> text = mean_interval(scores, 0.8, method="normal")
    >>> round(text.low, 2), round(text.high, 2)
    (47.18, 49.22)
    >>> better = mean_interval(scores, 0.8)
    >>> round(better.low, 2), round(better.high, 2)
    (47.04, 49.36)
    """
    method = one_of(method, "method", ("t", "normal"))
    return _interval(_differing(scores), open_share(confidence), method)


class Reading(NamedTuple):
    """How unusual a score is: how often chance alone gives such a score.

    `units` is the distance from the mean in standard deviations. If nothing has changed,
    `as_far` is the probability of a score at least this far from the mean on either side,
    `as_high` of a score at least this high, and `as_low` of a score at most this low.
    """

    units: float
    as_far: float
    as_high: float
    as_low: float


class Luck(NamedTuple):
    """How unusual a new score is compared with earlier ones, measured in three ways and by rank.

    Parameters
    ----------
    score, n, mean
        the new score; number and mean of the earlier ones.
    normal
        by the normal distribution, with mean and population standard deviation of the earlier
        scores treated as exact.
    t
        by Student's t with n - 1 degrees of freedom and the standard deviation
        s sqrt(1 + 1/n) of a new score about an estimated mean: the better choice.
    cautious
        by the normal distribution, measured not from the mean but from the nearer end of its normal
        interval; `units` is 0 if the score is inside it.
    as_high_by_rank, as_low_by_rank
        chance that the new one of n + 1 scores ranks at least this high (or this low) among
        them, whatever distribution they come from: 1 / (n + 1) for a score that beats all
        others, and never less.
    """

    score: float
    n: int
    mean: float
    normal: Reading
    t: Reading
    cautious: Reading
    as_high_by_rank: float
    as_low_by_rank: float


def was_it_luck(scores: Any, score: float, *, confidence: float = 0.95) -> Luck:
    """Return the chance that luck alone gives a score as unusual as a new one.

    Parameters
    ----------
    scores
        two or more earlier scores, not all equal; independent and nearly normal.
    score
        one new score that was not picked for being good: the best of several new scores is
        high more often than these chances say.
    confidence
        of the interval for the mean that the cautious reading counts from.

    Raises
    ------
    InputError
        as `mean_interval`, and if score is not a finite number.

    Notes
    -----
    P5.19: 53 after ten scores is 1.90 units out by the normal distribution, and 1.51 above the
    upper end of the 80% interval (3.8 / 2.52, both rounded; 1.4981 unrounded).
    `P(|z| < 1.51)` is .87, so chance gives a score this far out 13% of the time; the text has these
    two numbers reversed. A single list of scores can only say how rare such a score is: `compare`
    answers whether the scores have changed.

    >>> luck = was_it_luck([50, 44, 46, 52, 47, 51, 49, 45, 48, 50], 53, confidence=0.8)
    >>> round(luck.normal.units, 2), round(luck.normal.as_far, 3), round(luck.t.as_far, 3)
    (1.9, 0.057, 0.119)
    >>> round(luck.cautious.units, 4), round(luck.cautious.as_far, 2)
    (1.4981, 0.13)
    """
    import numpy as np

    earlier = _differing(scores)
    new = number(score, "score")
    text = _interval(earlier, open_share(confidence), "normal")
    own = _interval(earlier, text.confidence, "t")
    nearest = min(max(new, text.low), text.high)
    higher, lower = int(np.sum(earlier >= new)), int(np.sum(earlier <= new))
    return Luck(
        score=new,
        n=text.n,
        mean=text.mean,
        normal=_reading((new - text.mean) / text.sd),
        t=_reading((new - own.mean) / math.hypot(own.sd, own.sd_of_mean), own.n - 1),
        cautious=_reading((new - nearest) / text.sd),
        as_high_by_rank=(1 + higher) / (1 + text.n),
        as_low_by_rank=(1 + lower) / (1 + text.n),
    )


def checked_scores(scores: Any, name: str) -> Floats:
    """Return scores as an array if there are at least two and all are finite numbers.

    >>> checked_scores([48], "scores")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: scores must hold two numbers or more, to show a spread; it holds 1
        score
    """
    wanted = f"a list of finite numbers, at most {LARGEST:g}"
    array = floats(scores, name, low=-LARGEST, high=LARGEST, wanted=wanted)
    if array.ndim != 1:
        raise InputError(
            "{name} must be one list of numbers; it has {ndim} dimensions",
            name=name,
            ndim=array.ndim,
        )
    if array.size < 2:
        count = "1 score" if array.size else "no scores"
        raise InputError(
            "{name} must hold two numbers or more, to show a spread; it holds {count}",
            name=name,
            count=count,
        )
    return array


def sd_of(scores: Floats, *, degrees_used: int = 1) -> float:
    """Return the standard deviation over n - degrees_used; exactly 0 for equal scores.

    >>> import numpy as np
    >>> sd_of(np.array([0.1, 0.1, 0.1])), sd_of(np.array([1.0, 3.0]), degrees_used=0)
    (0.0, 1.0)
    """
    # The mean of equal decimals is off by rounding, which would look like a spread.
    if scores.max() - scores.min() <= max(1e-12 * abs(scores).max(), SMALLEST_SPREAD):
        return 0.0
    return float(scores.std(ddof=degrees_used))


def open_share(confidence: float) -> float:
    """Return a confidence if it is a number strictly between 0 and 1.

    >>> open_share(1)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: confidence must be a number between 0 and 1, such as 0.95; you gave
        1
    """
    wanted = "a number between 0 and 1, such as 0.95"
    return number(confidence, "confidence", above=0.0, below=1.0, wanted=wanted)


def _differing(scores: Any) -> Floats:
    """Return checked scores that are not all the same."""
    array = checked_scores(scores, "scores")
    if sd_of(array) == 0.0:
        raise InputError(
            "scores are all {array:g}. Give scores that differ, so there's a spread to show.",
            array=float(array[0]),
        )
    return array


def _interval(scores: Floats, confidence: float, method: Literal["t", "normal"]) -> MeanInterval:
    from scipy.special import stdtrit

    n, mean = scores.size, float(scores.mean())
    sd = sd_of(scores, degrees_used=1 if method == "t" else 0)
    if method == "t":
        critical = -float(stdtrit(n - 1, (1.0 - confidence) / 2.0))
    else:
        critical = critical_value(confidence)
    spread = sd_of_mean(sd, n)
    low, high = mean - critical * spread, mean + critical * spread
    return MeanInterval(low, high, confidence, mean, sd, spread, n, method)


def _reading(units: float, freedom: int | None = None) -> Reading:
    """Evaluate a distance by the normal distribution, or by Student's t with degrees of freedom."""
    from scipy.special import ndtr, stdtr

    def below(x: float) -> float:
        return float(ndtr(x) if freedom is None else stdtr(freedom, x))

    return Reading(units, 2.0 * below(-abs(units)), below(-units), below(units))
