"""Advantages that the ratings do not know: of breaking first, and of the break."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import expit, log_expit, logsumexp

from evenbreak.arrays import Floats
from evenbreak.ratings.calibration import Estimate, two_sided, with_error
from evenbreak.ratings.result_words import FORMATS
from evenbreak.ratings.walk_forward import NODES, Forecasts
from evenbreak.ratings.who_broke import breakers

MOST_ADVANTAGE = 5.0
"""How far the search for an advantage of the breaker goes, in log-odds."""


class FirstBreaks(NamedTuple):
    """How often the first breaker won the race, beside what was predicted.

    Parameters
    ----------
    won, expected
        races won by the first breaker, and the sum of their predicted chances.
    p_value
        the two-sided chance of as large a difference.
    matches
        races whose first breaker is known.
    """

    won: int
    expected: float
    p_value: float
    matches: int


def first_breaks(forecasts: Forecasts) -> FirstBreaks | None:
    """Compare the races that the first breaker won with those that were predicted."""
    first = forecasts.results.first_break
    if first is None:
        return None
    rows = (first > 0) & (forecasts.race_a > 0)
    if not rows.any():
        return None
    breaks_a = first[rows] == 1
    p, won = forecasts.p_match_integrated[rows], forecasts.won[rows]
    p, won = np.where(breaks_a, p, 1.0 - p), np.where(breaks_a, won, 1.0 - won)
    z = float((won - p).sum()) / math.sqrt(float((p * (1.0 - p)).sum()))
    return FirstBreaks(int(won.sum()), float(p.sum()), two_sided(z), int(rows.sum()))


def break_advantage(forecasts: Forecasts) -> Estimate | None:
    """Return the advantage of the breaker in log-odds, where it is known who broke each rack.

    None where no match states its racks, who broke first and who broke next, or where
    the breaker won every rack, or none.

    Notes
    -----
    Under winner breaks the stronger player breaks more often, the more so the stronger they
    are on that day. So the difference of each match is integrated out: normal about that of
    the ratings, with their variance plus that of good and bad days, which is estimated too.
    The standard error is the sandwich's, with each match a cluster.
    """
    from scipy.optimize import minimize

    tally = _tally(forecasts)
    rows = tally.sum((1, 2)) > 0
    if not rows.any():
        return None
    won, lost = tally[rows, :, 0].T[:, :, None], tally[rows, :, 1].T[:, :, None]
    points, weights = np.polynomial.hermite_e.hermegauss(NODES)
    breaks = np.array([1.0, -1.0])[:, None, None]

    def at(b: float, days: float) -> tuple[Floats, Floats]:
        """Return the log-likelihood of each match and its slope in b."""
        spread = np.sqrt(forecasts.sd[rows] ** 2 + days**2)
        x = forecasts.difference[rows, None] + spread[:, None] * points + b * breaks
        log = (won * log_expit(x) + lost * log_expit(-x)).sum(0) + np.log(weights)
        whole = logsumexp(log, axis=1)
        slope = (breaks * (won - (won + lost) * expit(x))).sum(0)
        return whole, (np.exp(log - whole[:, None]) * slope).sum(1)

    def loss(x: Floats) -> float:
        return -float(at(x[0], x[1])[0].sum())

    box = [(-MOST_ADVANTAGE, MOST_ADVANTAGE), (0.0, MOST_ADVANTAGE)]
    b, days = map(float, minimize(loss, np.array([0.0, 0.1]), method="L-BFGS-B", bounds=box).x)
    curvature = float((at(b - 1e-4, days)[1] - at(b + 1e-4, days)[1]).sum()) / 2e-4
    if abs(b) > 0.99 * MOST_ADVANTAGE or curvature <= 0.0:
        return None
    return with_error(b, math.sqrt(float((at(b, days)[1] ** 2).sum())) / curvature)


def known_breaks(forecasts: Forecasts) -> int:
    """Return how many racks `break_advantage` counts: those whose breaker is known."""
    return int(_tally(forecasts).sum())


def _tally(forecasts: Forecasts) -> Floats:
    """Return the racks of each match, by who broke and who won: 0 for a, 1 for b."""
    results = forecasts.results
    tally = np.zeros((len(forecasts), 2, 2))
    first, form = results.first_break, results.break_format
    if results.racks is None or first is None or form is None:
        return tally
    for row in np.flatnonzero((first > 0) & (form > 0)):
        racks = results.racks[row]
        broke = breakers(racks, FORMATS[form[row]], int(first[row]))
        for breaker, letter in zip(broke, racks, strict=True):
            tally[row, breaker - 1, "ab".index(letter)] += 1.0
    return tally
