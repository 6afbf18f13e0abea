"""Log of single shots: which to practice next, and whether the player improved.

A player's chances on different shots are similar, so each says something about the others: shot i
is made with chance p_i, drawn from a beta distribution with mean m and weight w (in tries), both
estimated from all shots. Their likelihood is that of beta-binomial counts,

    product over i of B(k_i + m w, n_i - k_i + (1 - m) w) / B(m w, (1 - m) w),

averaged here over a grid with a flat prior for m and the density 1/(1 + w)^2 for w. A shot with few
tries is drawn toward the mean; a shot with many tries hardly is.

To see whether the player improved, the earlier and the later half of the tries are compared. Given
how often each shot was made in total, the number made in the later half is hypergeometric if
nothing has changed; the sum over the shots is distributed as the convolution of these
distributions, which a common odds ratio r tilts by r^s. This gives an exact p-value and an exact
interval of r (Gart 1970).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.checks import whole_numbers
from evenbreak.errors import InputError
from evenbreak.stats.confidence import open_share

_MEANS = np.arange(0.005, 1.0, 0.01)
_WEIGHTS = np.exp(np.linspace(math.log(0.5), math.log(2000.0), 80))
_DRAWS = 10_000  # for the chance that a shot is the weakest, which they leave off by .005 at most
_FARTHEST = 30.0  # of the logarithm of an odds ratio


@array_values
@dataclass(frozen=True, eq=False)
class ShotLog:
    """How often shots were made, with a row for each shot on each day.

    Parameters
    ----------
    names
        the names of the shots, each once.
    shot
        shape (rows,): the position of the shot in `names`.
    made, tried
        shape (rows,): how often it was made, and tried.
    day
        shape (rows,): the date; None if any row has no date.

    Raises
    ------
    InputError
        if there is no row, a shot was made more often than tried, or never tried.
    """

    names: tuple[str, ...]
    shot: Ints
    made: Ints
    tried: Ints
    day: NDArray[Any] | None = None

    def __post_init__(self) -> None:
        made = whole_numbers(self.made, "made", at_least=0)
        tried = whole_numbers(self.tried, "tried", at_least=1)
        if not len(made) or (made > tried).any():
            raise InputError(
                "more shots were made than tried, or no shots were tried. Correct the log."
            )
        object.__setattr__(self, "made", made.astype(np.int64))
        object.__setattr__(self, "tried", tried.astype(np.int64))
        object.__setattr__(self, "shot", np.asarray(self.shot, dtype=np.int64))

    def by_shot(self, rows: Any = slice(None)) -> tuple[Ints, Ints]:
        """Return how often each shot was made and tried in the given rows."""
        many = len(self.names)
        made, tried = (
            np.bincount(self.shot[rows], values[rows], many).astype(np.int64)
            for values in (self.made, self.tried)
        )
        return made, tried


class ShotReport(NamedTuple):
    """One shot in a log.

    Parameters
    ----------
    name, made, tried
        the shot, and its balls made and tries.
    low, high
        the exact interval of its chance from these tries alone (Clopper & Pearson 1934).
    chance
        its chance, drawn toward the other shots' chances.
    p_weakest
        the probability that it is the shot missed most.
    change
        from the earlier to the later half; None if it is not in both.
    """

    name: str
    made: int
    tried: int
    low: float
    high: float
    chance: float
    p_weakest: float
    change: Change | None


class Change(NamedTuple):
    """Comparison of the earlier and the later half of the tries.

    Parameters
    ----------
    before, after
        the share made, at the same mix of shots in both halves.
    ratio, low, high
        the factor on the odds of making a shot, and its exact interval.
    p_value
        the chance of a change at least this large, up or down, if nothing has changed.
    """

    before: float
    after: float
    ratio: float
    low: float
    high: float
    p_value: float


@dataclass(frozen=True)
class ShotAnalysis:
    """Analysis of a log of single shots.

    Parameters
    ----------
    since
        the first day of the later half; None without two days.
    change
        the change over all shots that are in both halves; None if there are none.
    """

    shots: tuple[ShotReport, ...]
    since: Any
    change: Change | None


def share_intervals(made: Ints, tried: Ints, confidence: float) -> tuple[Floats, Floats]:
    """Return the ends of the exact (Clopper-Pearson) interval for each share of shots made."""
    from scipy.special import betainccinv, betaincinv

    tail, missed = (1.0 - confidence) / 2.0, tried - made
    low = np.where(made > 0, betaincinv(np.maximum(made, 1), missed + 1, tail), 0.0)
    return low, np.where(missed > 0, betainccinv(made + 1, np.maximum(missed, 1), tail), 1.0)


def analyze_shots(log: ShotLog, *, confidence: float = 0.95, seed: int = 0) -> ShotAnalysis:
    """Return the analysis of a log of single shots.

    Parameters
    ----------
    confidence
        of the intervals.
    seed
        for the chances that are drawn to see which shot is the weakest.

    >>> log = ShotLog(("cut", "bank"), [0, 1], [40, 4], [60, 20])
    >>> [(one.name, round(one.chance, 2), one.p_weakest > 0.99) for one in analyze_shots(log).shots]
    [('bank', 0.24, True), ('cut', 0.66, False)]
    """
    share = open_share(confidence)
    made, tried = log.by_shot()
    low, high = share_intervals(made, tried, share)
    chance, weakest = _shrunk(made, tried, np.random.default_rng(seed))
    since = _second_half(log)
    halves = [] if since is None else [log.by_shot(log.day < since), log.by_shot(log.day >= since)]
    changes = [
        change_of([(each[0][k], each[1][k]) for each in halves], share) if halves else None
        for k in range(len(log.names))
    ]
    numbers = (each.tolist() for each in (made, tried, low, high, chance, weakest))
    reports = [ShotReport(*row) for row in zip(log.names, *numbers, changes, strict=True)]
    reports.sort(key=lambda report: (-report.p_weakest, report.chance))
    change = change_of(halves, share) if halves else None
    return ShotAnalysis(tuple(reports), since, change)


def _shrunk(made: Ints, tried: Ints, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Return the chance of each shot given all shots, and the chance that it is the lowest."""
    from scipy.special import betaln

    mean, weight = (grid.ravel() for grid in np.meshgrid(_MEANS, _WEIGHTS))
    a, b = mean * weight, (1.0 - mean) * weight
    log_p = np.log(weight) - 2.0 * np.log1p(weight)  # the prior of the weight, on a grid of its log
    for k, n in zip(made.tolist(), tried.tolist(), strict=True):
        log_p += betaln(a + k, b + n - k) - betaln(a, b)
    p = np.exp(log_p - log_p.max())
    p /= p.sum()
    chance = p @ ((a[:, None] + made) / (weight[:, None] + tried))
    at = rng.choice(len(p), _DRAWS, p=p)
    drawn = rng.beta(a[at, None] + made, b[at, None] + tried - made)
    weakest = np.bincount(drawn.argmin(axis=1), minlength=len(made)) / _DRAWS
    return np.asarray(chance), weakest


def _second_half(log: ShotLog) -> Any:
    """Return the day on which the later half of the tries starts; None without two days."""
    if log.day is None:
        return None
    days, place = np.unique(log.day, return_inverse=True)
    if len(days) < 2:
        return None
    before = np.cumsum(np.bincount(place, log.tried))[:-1]
    return days[1 + int(np.abs(before - log.tried.sum() / 2.0).argmin())]


def change_of(halves: Sequence[tuple[Any, Any]], confidence: float = 0.95) -> Change | None:
    """Return the change in how often shots were made between two halves.

    Parameters
    ----------
    halves
        for the earlier and the later half, how often each shot was made and tried: two numbers,
        or two arrays.
    confidence
        of the interval.

    Returns
    -------
    Change or None
        None if no shot was tried in both halves.

    >>> found = change_of([(10, 30), (20, 30)])
    >>> round(found.ratio, 2), round(found.p_value, 4)
    (3.9, 0.0194)
    """
    from scipy.stats import hypergeom

    (made_1, tried_1), (made_2, tried_2) = (
        (np.atleast_1d(made), np.atleast_1d(tried)) for made, tried in halves
    )
    both = (tried_1 > 0) & (tried_2 > 0)
    if not both.any():
        return None
    k1, n1, k2, n2 = (values[both] for values in (made_1, tried_1, made_2, tried_2))
    law, least = np.ones(1), 0
    for won, first, second in zip((k1 + k2).tolist(), n1.tolist(), n2.tolist(), strict=True):
        low, high = max(0, won - first), min(won, second)
        each = hypergeom.pmf(np.arange(low, high + 1), first + second, won, second)
        law, least = np.convolve(law, each), least + low
    place, mix = int(k2.sum()) - least, (n1 + n2) / (n1 + n2).sum()
    return Change(
        float(mix @ (k1 / n1)), float(mix @ (k2 / n2)), *_odds_ratio(law, place, confidence)
    )


def _odds_ratio(law: Floats, place: int, confidence: float) -> tuple[float, float, float, float]:
    """Return the odds ratio for an exact count distribution, its interval, and the p-value of 1.

    `law[place]` is the chance of the observed count if the ratio is 1.
    """
    with np.errstate(divide="ignore"):
        logs = np.log(law)
    counts = np.arange(len(law))

    def tilted(log_ratio: float) -> Floats:
        weights = logs + counts * log_ratio
        chances = np.exp(weights - weights.max())
        return np.asarray(chances / chances.sum())

    def solved(rising: Callable[[float], float], *, none: float) -> float:
        from scipy.optimize import brentq

        if rising(-_FARTHEST) > 0.0 or rising(_FARTHEST) < 0.0:
            return none
        return math.exp(float(brentq(rising, -_FARTHEST, _FARTHEST, xtol=1e-10)))

    tail, last = (1.0 - confidence) / 2.0, len(law) - 1
    low = solved(lambda at: float(tilted(at)[place:].sum()) - tail, none=0.0) if place else 0.0
    high = math.inf
    if place < last:
        high = solved(lambda at: tail - float(tilted(at)[: place + 1].sum()), none=math.inf)
    ratio = 0.0 if not place else math.inf
    if 0 < place < last:
        ratio = solved(lambda at: float(tilted(at) @ counts) - place, none=math.nan)
    elif not last:
        ratio = 1.0
    p = 2.0 * min(float(law[place:].sum()), float(law[: place + 1].sum()))
    return ratio, low, high, min(1.0, p)
