"""The modes of one season rated in several ways, found together.

In a league of a few dozen players a step of Newton's method takes longer to call than to calculate,
so here all ways take each step at once, as arrays with one row a way. The model is that of
`evenbreak.ratings.mixed_posterior` with a known break advantage. The levels of teams and divisions
are integrated out: with the design Z and the levels' variances S, the skills are normal with

    precision  Q = (σ²I + Z S Zᵀ)⁻¹

about their means, and their mode is the same as that of skills and levels together.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy import sparse
from scipy.special import expit

from evenbreak.arrays import Floats
from evenbreak.errors import AccuracyError
from evenbreak.ratings.likelihood_terms import LikelihoodTerms
from evenbreak.ratings.newton import MOST_STEPS, tolerance
from evenbreak.ratings.prior_means import PriorMeans
from evenbreak.ratings.race_likelihood import race_slopes

GRADIENT = 1e-6
"""How small the gradients have to become, in games, times τ where that is below 1."""

_FULL_STEP = 1e-6
"""Steps shorter than this are taken whole: the cost can no longer measure their gain."""


class WayToRate(NamedTuple):
    """What the skills of a season depend on, apart from its results.

    Parameters
    ----------
    terms
        what was played, in weights of its own.
    precision
        τ, the prior precision of a skill, 1/sd² in log-odds.
    advantage
        the break advantage in log-odds.
    means
        where players are expected to be before any result; None: all at 0.
    """

    terms: LikelihoodTerms
    precision: float
    advantage: float = 0.0
    means: PriorMeans | None = None


def find_modes(ways: Sequence[WayToRate], start: Floats | None = None) -> Floats:
    """Return the most likely skills a posteriori, shape (ways, players).

    Parameters
    ----------
    ways
        one or more; their terms are of the same matches and differ in weights alone.
    start
        skills from which to begin.

    Raises
    ------
    AccuracyError
        if a gradient does not come down to what is wanted.
    """
    season = _Season(ways)
    skill = season.mean if start is None else np.broadcast_to(start, season.mean.shape)
    cost = season.cost(skill)
    for _ in range(MOST_STEPS):
        gradient, curvature = season.slopes(skill)
        left = np.abs(gradient).max(1)
        if (left <= season.enough).all():
            return np.asarray(skill)
        step = -np.linalg.solve(curvature, gradient[:, :, None])[:, :, 0]
        longest = np.abs(step).max(1)
        length = np.ones(len(step))
        while True:
            new = season.cost(skill + length[:, None] * step)
            too_long = (new > cost) & (length * longest >= _FULL_STEP)
            if not too_long.any():
                break
            length[too_long] *= 0.5
        skill, cost = skill + length[:, None] * step, new
    raise AccuracyError(
        f"the ratings' gradient is {left.max():.1e} after {MOST_STEPS} Newton steps; give a "
        "smaller prior_sd"
    )


class _Season:
    """The negative log-posterior of each way, with its first two derivatives."""

    def __init__(self, ways: Sequence[WayToRate]) -> None:
        terms = ways[0].terms
        self._terms, self._players = terms, terms.players
        self._won = np.array([way.terms.won for way in ways])
        self._lost = np.array([way.terms.lost for way in ways])
        self._race_weight = np.array([way.terms.race_weight for way in ways])
        self._shift = np.array([[way.advantage] for way in ways]) * terms.broke
        known = [way.means or PriorMeans.none(self._players) for way in ways]
        self.mean = np.array([one.mean for one in known])
        pairs = [(one, way.precision) for one, way in zip(known, ways, strict=True)]
        self._precision = np.array([_precision_of(one, precision) for one, precision in pairs])
        most = max(float(terms.race_m.max(initial=0)), terms.amount)
        self.enough = np.array([tolerance(way.precision, most, GRADIENT) for way in ways])
        many = len(terms.low)
        # Which pair each term is about, and the two players of each pair.
        pair = np.concatenate([terms.pair, terms.race_pair])
        rows = np.arange(len(pair))
        self._to_pairs = sparse.csr_array((np.ones(len(pair)), (rows, pair)), (len(pair), many))
        ends = np.zeros((many, self._players))
        ends[np.arange(many), terms.low] = 1.0
        ends[np.arange(many), terms.high] = -1.0
        self._ends = ends

    def _differences(self, skill: Floats) -> tuple[Floats, Floats]:
        """Return the log-odds of each term of games, and of each race for its winner."""
        terms = self._terms
        difference = skill[:, terms.low] - skill[:, terms.high]
        games = difference[:, terms.pair] + self._shift
        return games, terms.race_side * difference[:, terms.race_pair]

    def cost(self, skill: Floats) -> Floats:
        """Return minus the logarithm of each posterior density, but for a constant."""
        games, races = self._differences(skill)
        # ln(1 + exp(x)) is ln(1 + exp(-x)) + x.
        common = (self._won + self._lost) * np.logaddexp(0.0, games) - self._won * games
        log_win = race_slopes(races, self._terms.race_m, self._terms.race_n).log_win
        prior = 0.5 * ((skill - self.mean) * self._pull(skill)).sum(1)
        return np.asarray(common.sum(1) - (self._race_weight * log_win).sum(1) + prior)

    def slopes(self, skill: Floats) -> tuple[Floats, Floats]:
        """Return the gradients, and the Hessians."""
        games, races = self._differences(skill)
        played, p = self._won + self._lost, expit(games)
        found = race_slopes(races, self._terms.race_m, self._terms.race_n)
        slope = -self._race_weight * self._terms.race_side * found.slope
        pull = np.hstack([played * p - self._won, slope]) @ self._to_pairs
        bend = np.hstack([played * p * (1.0 - p), -self._race_weight * found.curvature])
        bend = bend @ self._to_pairs
        gradient = pull @ self._ends + self._pull(skill)
        return gradient, self._precision + self._laplacians(bend)

    def _pull(self, skill: Floats) -> Floats:
        """Return the gradient of minus the prior's logarithm."""
        off = skill - self.mean
        return np.asarray((self._precision @ off[:, :, None])[:, :, 0])

    def _laplacians(self, bend: Floats) -> Floats:
        n = self._players
        whole = np.zeros((len(bend), n, n))
        whole[:, self._terms.low, self._terms.high] = -bend
        whole += whole.transpose(0, 2, 1)
        whole[:, np.arange(n), np.arange(n)] = bend @ np.abs(self._ends)
        return whole


def _precision_of(means: PriorMeans, precision: float) -> Floats:
    """Return the precision of the skills' prior, levels integrated out."""
    one = np.eye(len(means.mean))
    if not len(means.level_sd):
        return precision * one
    spread = means.design * means.level_sd
    return np.asarray(np.linalg.inv(one / precision + spread @ spread.T), dtype=np.float64)
