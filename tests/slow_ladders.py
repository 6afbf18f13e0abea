"""Slow, obvious ladders, for the tests of the fast ones."""

from fractions import Fraction
from itertools import pairwise
from math import comb, erf, sqrt

import numpy as np


def exact_win(p, m, n):
    """Return W(p; m, n) for a fraction p: m or more of m + n - 1 games won."""
    games = m + n - 1
    return sum(comb(games, k) * p**k * (1 - p) ** (games - k) for k in range(m, games + 1))


def exact_law(wins):
    """Return the long run of a +-1 ladder by detailed balance, without rounding."""
    weights = [Fraction(1)]
    for up, down in pairwise(wins):
        weights.append(weights[-1] * up / (1 - down))
    return [weight / sum(weights) for weight in weights]


def chances(law):
    return np.array(law.probability, dtype=float)


def rounded_normal(days, sd):
    """Return the probabilities of a normal deviation rounded to whole points."""
    below = [0.5 * (1 + erf((day - 0.5) / (sd * sqrt(2)))) for day in days]
    above = [0.5 * (1 + erf((day + 0.5) / (sd * sqrt(2)))) for day in days]
    return np.array(above) - np.array(below)
