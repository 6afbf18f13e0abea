"""What form of the day means for scores: deciders, sweeps and games, seen and expected.

Here the variance of form (see `evenbreak.ratings.day_form`) is estimated from forecasts, which know
the past only. So whatever else they miss, such as players who improve, is in it too, and so is that
their standard errors take the games of a match for independent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.special import expit

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.ratings.calibration import Estimate, bootstrap_ratio
from evenbreak.ratings.day_form import (
    FEWEST,
    LONGEST,
    DayForm,
    form_variance,
    log_odds_of,
    normal_nodes,
)
from evenbreak.ratings.doubtful_scores import doubtful_scores
from evenbreak.ratings.walk_forward import Forecasts


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


@dataclass(frozen=True)
class MatchForm(DayForm):
    """Form of the day, and what it means for scores.

    Parameters
    ----------
    shapes
        deciders, sweeps and games, seen and said.
    """

    shapes: tuple[ScoreShape, ...]


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
    variance = form_variance(difference, sd, won, lost, cluster[rows])
    shapes = _shapes(forecasts, rows, variance.value, cluster[rows], rng)
    return MatchForm(variance, int(rows.sum()), tuple(shapes))


def _judged(forecasts: Forecasts) -> Bools:
    fewest = np.minimum(forecasts.race_a, forecasts.race_b)
    most = np.maximum(forecasts.race_a, forecasts.race_b)
    judged = (fewest > 1) & (most <= LONGEST) & (forecasts.date_of > 0)
    return np.asarray(judged & ~doubtful_scores(forecasts.results))


def _shapes(
    forecasts: Forecasts, rows: Bools, v: float, cluster: Ints, rng: np.random.Generator
) -> list[ScoreShape]:
    m, n = forecasts.race_a[rows], forecasts.race_b[rows]
    a, b = forecasts.results.score_a[rows], forecasts.results.score_b[rows]
    seen = np.array([a + b == m + n - 1, np.minimum(a, b) == 0, a + b], dtype=float)
    said = np.zeros((2, 3))
    difference, sd = forecasts.difference[rows], forecasts.sd[rows]
    for row, extra in enumerate((0.0, v)):
        mean, spread = log_odds_of(difference, sd, extra), np.sqrt(sd**2 + extra)
        for point, weight in zip(*normal_nodes(), strict=True):
            p = expit(mean + spread * point)
            said[row] += weight * score_shapes(p, m, n).mean(1)
    ones = np.ones(len(m))
    _, cluster = np.unique(cluster, return_inverse=True)
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
