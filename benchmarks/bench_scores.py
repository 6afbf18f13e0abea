"""Laws of scores and the ladder's law, each beside bare scipy or numpy for the same question."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.special import betainc, expit, nbdtr

from evenbreak.handicaps import autocorrelated_ladder, chart
from evenbreak.matches import StraightPool, straight_pool_odds
from evenbreak.stats import InningsScore

Beside = Callable[..., float]


def test_scores_of_innings(beside: Beside) -> None:
    law, scores = InningsScore(0.96, 50), np.arange(10**5)
    assert law.cumulative(scores) == pytest.approx(nbdtr(scores, 50, 0.04), rel=1e-9)
    beside(
        "P(score <= n) after 50 innings, 10^5 scores / scipy.special.nbdtr",
        lambda: law.cumulative(scores),
        lambda: nbdtr(scores, 50, 0.04),
    )


def bare_straight_pool(points: int, p1: float, p2: float) -> float:
    """Return the chance of the player who shoots first, by scipy's negative binomial sums."""
    innings = np.arange(2000)
    left_1, left_2 = nbdtr(points - 1, innings[1:], 1 - p1), nbdtr(points - 1, innings[1:], 1 - p2)
    reach = -np.diff(np.concatenate([[1.0], left_1]))
    return float(reach[0] + reach[1:] @ left_2[:-1])


def test_straight_pool(beside: Beside) -> None:
    match = StraightPool(1000, 1000, 0.9, 0.89)
    assert straight_pool_odds(match).p_win_1 == pytest.approx(
        bare_straight_pool(1000, 0.9, 0.89), rel=1e-9
    )
    beside(
        "straight pool to 1000, chance / scipy.special.nbdtr, 2,000 innings",
        lambda: straight_pool_odds(match),
        lambda: bare_straight_pool(1000, 0.9, 0.89),
        note="with mean, sd and quantiles of the length",
    )


def bare_ladder(rounds: int, needs: np.ndarray, widest: int) -> np.ndarray:
    """Return the law of the autocorrelated ladder by products of ratios."""
    errors = np.arange(-widest, widest + 1)
    m, n = needs[:, :1], needs[:, 1:]
    table = betainc(m, n, expit(-errors * np.log(2) / 30))
    v = (errors == 0).astype(float)
    for _ in range(rounds + 1):
        win = table @ v
        win = (win + 1 - win[::-1]) / 2
        v = np.exp(np.cumsum(np.log(np.concatenate([[1.0], win[:-1] / (1 - win[1:])]))))
        v /= v.sum()
    return v


def test_autocorrelated_ladder(beside: Beside) -> None:
    npl = chart("npl_10")
    needs = np.array([npl.race(error) for error in range(-60, 61)])
    law = autocorrelated_ladder(npl)
    rounds = len(law.changes)
    assert law.distribution.probability == pytest.approx(bare_ladder(rounds, needs, 60), rel=1e-9)
    beside(
        "autocorrelated ladder, chart 10 / bare numpy, as many rounds",
        lambda: autocorrelated_ladder(npl),
        lambda: bare_ladder(rounds, needs, 60),
    )
