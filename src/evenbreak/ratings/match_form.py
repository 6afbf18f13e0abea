"""Form of the day: how much the chances of a game vary from match to match about the predictions.

In match i the games are won with the log-odds d + e, where d has the mean and the variance of the
forecast, and e, the same in all games of the match, is normal with mean 0 and variance v. v is
estimated by maximum likelihood, with e and the uncertainty of the ratings integrated out; its
standard error is the sandwich's. Whatever else the ratings miss, such as players who improve, is
in v too, and so is that their standard errors take the games of a match for independent: where the
true v is 0.25, estimates are 0.28 on average.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import expit, log_expit, logsumexp

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.ratings.calibration import Estimate, bootstrap_ratio, with_error
from evenbreak.ratings.walk_forward import Forecasts

NODES = 15
"""Nodes of the Gauss-Hermite rule."""

LARGEST = 4.0
"""The largest variance that is looked for."""

LONGEST = 50
"""Races with more games are left out."""

FEWEST = 100
"""Races from which the variance is estimated."""

_STEP = 1e-3


class ScoreShape(NamedTuple):
    """How often something about scores was seen, and how often it was to be expected.

    Parameters
    ----------
    of
        'deciders': races that went to the last possible game; 'sweeps': races whose loser won no
        game; 'games': the games of a race.
    seen
        its mean over races.
    said
        what the forecasts say, the uncertainty of ratings integrated out.
    said_with_form
        what they say with form of the day.
    """

    of: str
    seen: Estimate
    said: float
    said_with_form: float

    @property
    def nearer(self) -> bool:
        """Whether form brings what is said nearer to what was seen."""
        return abs(self.said_with_form - self.seen.value) < abs(self.said - self.seen.value)


class MatchForm(NamedTuple):
    """Form of the day, and what it means for scores.

    Parameters
    ----------
    variance
        v in squared log-odds, with its 95% interval, which may begin below 0.
    races
        the races that it is estimated from.
    shapes
        deciders, sweeps and games, seen and said.
    """

    variance: Estimate
    races: int
    shapes: tuple[ScoreShape, ...]

    @property
    def sd(self) -> float:
        """The standard deviation of form in a match, in log-odds."""
        return math.sqrt(self.variance.value)

    @property
    def established(self) -> bool:
        """Whether the variance is above 0 with 99% confidence."""
        middle = (self.variance.high + self.variance.low) / 2.0
        return middle - (self.variance.high - middle) * 2.576 / 1.960 > 0.0


def match_form(forecasts: Forecasts, cluster: Ints, rng: np.random.Generator) -> MatchForm | None:
    """Return form of the day; None with fewer than 100 races of two games or more.

    Parameters
    ----------
    forecasts
        a walk through a season; its first date is left out.
    cluster
        matches of one cluster, such as those of a date, may depend on each other.
    rng
        resamples them.
    """
    rows = _judged(forecasts)
    if rows.sum() < FEWEST:
        return None
    difference, sd = forecasts.difference[rows], forecasts.sd[rows]
    won = forecasts.results.score_a[rows].astype(float)
    lost = forecasts.results.score_b[rows].astype(float)
    points, weights = _rule()

    def log_likelihood(v: float) -> Floats:
        x = difference[:, None] + np.sqrt(np.maximum(sd**2 + v, 0.0))[:, None] * points
        log = won[:, None] * log_expit(x) + lost[:, None] * log_expit(-x) + np.log(weights)
        return np.asarray(logsumexp(log, axis=1))

    found = minimize_scalar(
        lambda v: -float(log_likelihood(v).sum()), bounds=(0.0, LARGEST), method="bounded"
    )
    v = float(found.x) if found.x > _STEP else 0.0
    here, above, below = (log_likelihood(max(v, _STEP) + step) for step in (0.0, _STEP, -_STEP))
    bend = float((2.0 * here - above - below).sum()) / _STEP**2
    _, cluster = np.unique(cluster[rows], return_inverse=True)
    slopes = np.bincount(cluster, (above - below) / (2.0 * _STEP))
    error = math.sqrt(float(((slopes - slopes.mean()) ** 2).sum())) / bend if bend > 0 else math.inf
    return MatchForm(
        with_error(v, error), int(rows.sum()), tuple(_shapes(forecasts, rows, v, cluster, rng))
    )


def _judged(forecasts: Forecasts) -> Bools:
    fewest = np.minimum(forecasts.race_a, forecasts.race_b)
    most = np.maximum(forecasts.race_a, forecasts.race_b)
    return np.asarray((fewest > 1) & (most <= LONGEST) & (forecasts.date_of > 0))


def _rule() -> tuple[Floats, Floats]:
    points, weights = np.polynomial.hermite_e.hermegauss(NODES)
    return points, weights / math.sqrt(2.0 * math.pi)


def _shapes(
    forecasts: Forecasts, rows: Bools, v: float, cluster: Ints, rng: np.random.Generator
) -> list[ScoreShape]:
    m, n = forecasts.race_a[rows], forecasts.race_b[rows]
    a, b = forecasts.results.score_a[rows], forecasts.results.score_b[rows]
    seen = np.array([a + b == m + n - 1, np.minimum(a, b) == 0, a + b], dtype=float)
    said = np.zeros((2, 3))
    for row, extra in enumerate((0.0, v)):
        spread = np.sqrt(forecasts.sd[rows] ** 2 + extra)
        for point, weight in zip(*_rule(), strict=True):
            p = expit(forecasts.difference[rows] + spread * point)
            said[row] += weight * score_shapes(p, m, n).mean(1)
    ones = np.ones(len(m))
    return [
        ScoreShape(of, bootstrap_ratio(one, ones, cluster, rng), float(plain), float(formed))
        for of, one, plain, formed in zip(("deciders", "sweeps", "games"), seen, *said, strict=True)
    ]


def score_shapes(p: Floats, m: Ints, n: Ints) -> Floats:
    """Return the chance of a decider and of a sweep, and the mean games, of races m:n.

    >>> score_shapes(np.array([0.5]), np.array([2]), np.array([2])).ravel().tolist()
    [0.5, 0.5, 2.5]
    """
    found = np.zeros((3, len(p)))
    for mine, needed, other in ((p, m, n), (1.0 - p, n, m)):
        chance = mine**needed
        found[1] += chance
        for lost in range(int(other.max())):
            if lost:
                chance = chance * (1.0 - mine) * (needed + lost - 1) / lost
            counts = np.where(lost < other, chance, 0.0)
            found[0] += np.where(lost == other - 1, counts, 0.0)
            found[2] += counts * (needed + lost)
    return found
