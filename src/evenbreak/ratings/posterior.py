"""The posterior mode of the ratings, found by a sparse Newton method in three variants.

With skills θ in natural log-odds, player i beats j with chance 1 / (1 + exp(θj - θi)). Games are
independent given the skills, and every skill has the prior N(0, 1/τ).

`find_mode` is for games that all count alike. Up to a constant the negative log-posterior is

    f(θ) = Σ_{i<j} n_ij log(exp θi + exp θj) - Σ_i w_i θi + (τ/2) Σ_i θi²

so it needs only win totals w and pair counts n. Its Hessian is the Laplacian of the graph of play,
weighted by n_ij p_ij p_ji, plus τI: a symmetric M-matrix. It never evaluates f, so it does a
fraction of the work of the next variant.

`find_mixed_mode` is for results that differ in what they say and how much they weigh. The
likelihood is that of `evenbreak.ratings.likelihood_terms`. Its logarithm is concave in (θ, β), and
those of the priors strictly so. There is one mode, and Newton's method finds it with a step that is
halved until f decreases or, for games alone, shortened so that it must. If only the score tells how
many racks each player broke, the sum is still concave in θ, though not necessarily in β.

`find_modes` is for one season rated by several methods. In a league of a few dozen players, calling
a Newton step takes longer than calculating it, so all methods take each step at once, as arrays
with one row per method. The levels of teams and divisions are integrated out: with the design Z and
the levels' variances S, the skills are normal with

    precision  Q = (σ²I + Z S Zᵀ)⁻¹

about their means, and their mode is the same as that of skills and levels together. The break
advantage, where it is estimated, is the last unknown.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from scipy import sparse
from scipy.special import expit

from evenbreak.arrays import Floats, Places
from evenbreak.errors import AccuracyError
from evenbreak.ratings.beginning import MovingMeans, PriorMeans
from evenbreak.ratings.covariance import Curvature, PairCounts, Pattern, sums_by_player
from evenbreak.ratings.likelihood_terms import LikelihoodTerms, race_slopes


class Mode(NamedTuple):
    """The point where the posterior is highest, the largest gradient entry there, and the steps."""

    point: Floats
    gradient: float
    iterations: int


def find_mode(pairs: PairCounts, precision: float) -> Mode:
    """Return the maximum a posteriori skills, in natural log-odds.

    Each Newton system is solved by conjugate gradients, more exactly as the steps get shorter. τ is
    the prior precision 1/sd². Raises AccuracyError if the gradient's largest entry doesn't fall to
    1e-8 min(1, τ), or to the rounding of the counts if that is larger.

    The model: Bradley & Terry (1952).
    """
    # The prior weighs as much as 4τ games between equals: a start near the mode.
    start = np.log((pairs.won + 2.0 * precision) / (pairs.lost + 2.0 * precision))
    games = pairs.games.data
    ends = len(pairs.won), pairs.low, pairs.high
    pattern = Pattern(*ends)
    # Written over in each step, since allocating them each time takes a tenth longer.
    p_low, surplus = np.empty_like(games), np.empty_like(games)

    def gradient_at(skill: Floats) -> tuple[Floats, Callable[[], Floats]]:
        expit(skill[pairs.low] - skill[pairs.high], out=p_low)
        np.multiply(games, p_low, out=surplus)
        gradient = sums_by_player(*ends, surplus, games - surplus) - pairs.won + precision * skill

        def step() -> Floats:
            curvature = Curvature(*ends, surplus * (1.0 - p_low), precision, pattern=pattern)
            full, _ = curvature.newton_step(gradient, 0.0, step_accuracy(gradient))
            return damped(full, pairs.low, pairs.high)

        return gradient, step

    most = float((pairs.won + pairs.lost).max(initial=0))
    return find_zero(start, gradient_at, tolerance(precision, most))


MOST_STEPS = 200
GRADIENT_TOLERANCE = 1e-8
_ROUNDING = 1e-14


def tolerance(precision: float, most: float, gradient: float = GRADIENT_TOLERANCE) -> float:
    """Return how small the gradient of the negative log-posterior must be, in games.

    H >= τI, where τ is the prior precision of a skill, so a gradient g leaves the skills within
    |g|/τ of the mode. `most` is the largest number of games by one player, whose rounding limits
    the result; `gradient` is enough if τ is 1 or more.
    """
    return max(gradient * min(1.0, precision), _ROUNDING * most)


def find_zero(
    start: Floats,
    gradient_at: Callable[[Floats], tuple[Floats, Callable[[], Floats]]],
    enough: float,
) -> Mode:
    """Return the point where a gradient is zero, to within `enough` in each entry.

    `gradient_at` returns the gradient at a point, and a function for the step from there. Raises
    AccuracyError after `MOST_STEPS` steps.

    >>> find_zero(np.zeros(2), lambda x: (x - 3.0, lambda: 3.0 - x), 1e-9)
    Mode(point=array([3., 3.]), gradient=0.0, iterations=1)
    """
    point, size = start, 0.0
    for iteration in range(MOST_STEPS):
        gradient, step = gradient_at(point)
        size = float(np.abs(gradient).max(initial=0.0))
        if size <= enough:
            return Mode(point, size, iteration)
        point = point + step()
    raise AccuracyError(
        "the ratings' gradient is {size:.1e} after {most_steps} Newton steps. Give a "
        "smaller prior_sd.",
        size=size,
        most_steps=MOST_STEPS,
    )


def step_accuracy(gradient: Floats) -> float:
    """Return the tolerance for a Newton step: tighter as the gradient gets smaller.

    The error of an inexact step adds to the squared error of the exact one.

    >>> step_accuracy(np.array([0.01, -0.02]))
    0.02
    """
    return max(min(0.1, float(np.abs(gradient).max())), 1e-9)


def damped(step: Floats, low: Places, high: Places) -> Floats:
    """Return a Newton step, shortened if it would change a skill difference by much.

    If opponents' skills change by at most β, log(1 + β)/β of the step always decreases f, and so
    does the full step if β < 1.7. So no search for a step length is needed.

    Generalized self-concordance: Bach (2010); Sun & Tran-Dinh (2019), Theorem 2.
    """
    beta = float(np.abs(step[low] - step[high]).max(initial=0.0))
    return step if beta < 1.7 else step * (math.log1p(beta) / beta)


_FULL_STEP = 1e-6
"""Newton steps shorter than this are taken in full: the value can no longer measure their gain."""


def find_mixed_mode(
    terms: LikelihoodTerms,
    precision: float,
    *,
    advantage: float = 0.0,
    break_precision: float | None = None,
    means: PriorMeans | None = None,
    start: Floats | None = None,
    gradient: float = GRADIENT_TOLERANCE,
) -> Mode:
    """Return the maximum a posteriori skills, levels and break advantage, in this order.

    Precisions, such as τ for skills, are 1/sd² in log-odds. Without a `break_precision` the
    advantage is known; otherwise it is the starting value, and the prior is centered at 0.
    `gradient` is the size at which to stop, in games, multiplied by τ if that is below 1. Raises
    AccuracyError if neither it nor rounding is reached.
    """
    players = terms.players
    beforehand = PriorMeans.none(players) if means is None else means
    moving = MovingMeans(beforehand)

    def cost(point: Floats) -> float:
        skill, level, advantage = point[:players], point[players:-1], float(point[-1])
        prior = 0.5 * (break_precision or 0.0) * advantage**2
        prior -= moving.now.log_density(skill, level, precision)
        return prior - terms.log_likelihood(skill, advantage)

    skill = beforehand.mean if start is None else start
    begin = np.concatenate([skill, np.zeros(len(beforehand.level_sd)), [advantage]])
    # Games alone need no search for the length of a step.
    games_alone = not len(terms.race_pair) and break_precision is None
    value = 0.0 if games_alone else cost(begin)

    def gradient_at(point: Floats) -> tuple[Floats, Callable[[], Floats]]:
        nonlocal value
        skill, level, advantage = point[:players], point[players:-1], float(point[-1])
        if moving.follow(skill) and not games_alone:
            value = cost(point)
        pull, slope = terms.derivatives(skill, advantage)
        of_skill, of_level = moving.now.slopes(skill, level, precision)
        pull = np.append(pull + of_skill, of_level)
        slope = slope + break_precision * advantage if break_precision is not None else 0.0
        whole = np.append(pull, slope)

        def step() -> Floats:
            nonlocal value
            curvature = terms.curvature(skill, advantage, precision, break_precision, means)
            full = np.append(*curvature.newton_step(pull, slope, step_accuracy(whole)))
            if games_alone:
                return damped(full, terms.low, terms.high)
            length, longest = 1.0, float(np.abs(full).max())
            while True:
                new = cost(point + length * full)
                if new <= value or longest * length < _FULL_STEP:
                    break
                length *= 0.5
            value = new
            return length * full

        return whole, step

    known_best = float(beforehand.information.max(initial=0.0))
    most = max(float(terms.race_m.max(initial=0)), terms.amount, known_best)
    return find_zero(begin, gradient_at, tolerance(precision, most, gradient))


GRADIENT = 1e-6
"""How small the gradients have to become, in games, multiplied by τ if that is below 1."""

"""Steps shorter than this are taken in full: the cost can no longer measure their gain."""


class WayToRate(NamedTuple):
    """What the skills in a season depend on, apart from its results.

    As in `find_mixed_mode`, except that the terms have their own weights.
    """

    terms: LikelihoodTerms
    precision: float
    advantage: float = 0.0
    break_precision: float | None = None
    means: PriorMeans | None = None


def find_modes(ways: Sequence[WayToRate], start: Floats | None = None) -> tuple[Floats, Floats]:
    """Return the maximum a posteriori skills, shape (ways, players), and break advantages.

    The terms of all methods come from the same matches and differ only in their weights. Raises
    AccuracyError if a gradient doesn't get small enough.
    """
    season = _Season(ways)
    skill = season.mean if start is None else np.broadcast_to(start, season.mean.shape)
    point = np.column_stack([skill, [way.advantage for way in ways]])
    cost = season.cost(point)
    for _ in range(MOST_STEPS):
        if season.follow(point[:, :-1]):
            cost = season.cost(point)
        gradient, curvature = season.slopes(point)
        left = np.abs(gradient).max(1)
        if (left <= season.enough).all():
            return point[:, :-1], point[:, -1]
        step = _newton_step(gradient, curvature)
        longest = np.abs(step).max(1)
        length = np.ones(len(step))
        while True:
            new = season.cost(point + length[:, None] * step)
            too_long = (new > cost) & (length * longest >= _FULL_STEP)
            if not too_long.any():
                break
            length[too_long] *= 0.5
        point, cost = point + length[:, None] * step, new
    raise AccuracyError(
        "the ratings' gradient is {max:.1e} after {most_steps} Newton steps. Give a "
        "smaller prior_sd.",
        max=left.max(),
        most_steps=MOST_STEPS,
    )


def difference_variances(
    ways: Sequence[WayToRate], skills: Floats, advantages: Floats, first: Places, second: Places
) -> Floats:
    """Return the variances of skill differences by several methods: shape (ways, differences).

    The methods, skills and advantages are those of `find_modes`. The variances are those of the
    normal distribution with the same curvature at the mode (Laplace), including the uncertainty of
    the break advantage.
    """
    _, curvature = _Season(ways).slopes(np.column_stack([skills, advantages]))
    covariance = np.linalg.inv(curvature)[:, :-1, :-1]
    own = np.diagonal(covariance, axis1=1, axis2=2)
    return np.asarray(own[:, first] + own[:, second] - 2.0 * covariance[:, first, second])


def _newton_step(gradient: Floats, curvature: Floats) -> Floats:
    """Return each method's step; the curvature in the last unknown may be negative."""
    border, corner = curvature[:, :-1, -1], curvature[:, -1, -1]
    right = np.stack([gradient[:, :-1], border], axis=2)
    plain, bordered = np.moveaxis(np.linalg.solve(curvature[:, :-1, :-1], right), 2, 0)
    across = (border * bordered).sum(1)
    # Where it is not convex: down along the slope, as if all of the corner were left.
    rest = np.where(corner > across, corner - across, np.abs(corner) + across)
    shift = -(gradient[:, -1] - (border * plain).sum(1)) / rest
    return np.column_stack([-plain - bordered * shift[:, None], shift])


class _Season:
    """The negative log-posterior of each method, with its first two derivatives."""

    def __init__(self, ways: Sequence[WayToRate]) -> None:
        terms = ways[0].terms
        self._terms, self._players = terms, terms.players
        self._won = np.array([way.terms.won for way in ways])
        self._lost = np.array([way.terms.lost for way in ways])
        self._race_weight = np.array([way.terms.race_weight for way in ways])
        self._own_break_weight = np.array([way.terms.own_break_weight for way in ways])
        self._estimated = np.array([way.break_precision is not None for way in ways])
        self._break_precision = np.array([way.break_precision or 0.0 for way in ways])
        beforehand = [way.means or PriorMeans.none(self._players) for way in ways]
        self._moving = [MovingMeans(means) for means in beforehand]
        priors = [
            _prior_of(means, way.precision) for means, way in zip(beforehand, ways, strict=True)
        ]
        self.mean = np.array([mean for mean, _, _ in priors])
        self._precision = np.array([precision for _, precision, _ in priors])
        self._share = [share for _, _, share in priors]
        brought = max(float(means.information.max(initial=0.0)) for means in beforehand)
        most = max(float(terms.race_m.max(initial=0)), terms.amount, brought)
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

    def follow(self, skills: Floats) -> bool:
        """Return whether any method's means followed its skills."""
        moved = False
        for row, (moving, skill) in enumerate(zip(self._moving, skills, strict=True)):
            before = moving.now.mean
            if moving.follow(skill):
                step, share = moving.now.mean - before, self._share[row]
                self.mean[row] += step if share is None else share @ step
                moved = True
        return moved

    def _differences(self, point: Floats) -> tuple[Floats, Floats]:
        """Return the log-odds of each term of games, and of the winner of each race."""
        terms = self._terms
        difference = point[:, terms.low] - point[:, terms.high]
        games = difference[:, terms.pair] + point[:, -1:] * terms.broke
        return games, terms.race_side * difference[:, terms.race_pair]

    def cost(self, point: Floats) -> Floats:
        """Return the negative log of each posterior density, up to a constant."""
        games, races = self._differences(point)
        # ln(1 + exp(x)) is ln(1 + exp(-x)) + x.
        common = (self._won + self._lost) * np.logaddexp(0.0, games) - self._won * games
        log_win = race_slopes(races, self._terms.race_m, self._terms.race_n).log_win
        prior = 0.5 * ((point[:, :-1] - self.mean) * self._pull(point)).sum(1)
        prior += 0.5 * self._break_precision * point[:, -1] ** 2
        breaks = self._own_break_weight * self._terms.own_breaks.log_sums(point[:, -1])[0]
        own = common.sum(1) - (self._race_weight * log_win).sum(1) - breaks.sum(1)
        return np.asarray(own + prior)

    def slopes(self, point: Floats) -> tuple[Floats, Floats]:
        """Return the gradients, and the Hessians."""
        games, races = self._differences(point)
        played, p = self._won + self._lost, expit(games)
        of_race = race_slopes(races, self._terms.race_m, self._terms.race_n)
        miss = played * p - self._won
        slope = -self._race_weight * self._terms.race_side * of_race.slope
        pull = np.hstack([miss, slope]) @ self._to_pairs
        of_games = played * p * (1.0 - p)
        bend = np.hstack([of_games, -self._race_weight * of_race.curvature]) @ self._to_pairs
        n = self._players
        gradient, curvature = np.zeros((len(point), n + 1)), np.zeros((len(point), n + 1, n + 1))
        gradient[:, :n] = pull @ self._ends + self._pull(point)
        curvature[:, :n, :n] = self._precision + self._laplacians(bend)
        curvature[:, n, n] = 1.0
        if self._estimated.any():
            broke = self._terms.broke
            _, mean, spread = self._terms.own_breaks.log_sums(point[:, -1])
            weight = self._own_break_weight
            slope = miss @ broke - (weight * mean).sum(1) + self._break_precision * point[:, -1]
            corner = of_games @ (broke != 0) - (weight * spread).sum(1) + self._break_precision
            rest = np.zeros((len(point), len(self._terms.race_pair)))
            border = np.hstack([of_games * broke, rest]) @ self._to_pairs @ self._ends
            gradient[:, n] = np.where(self._estimated, slope, 0.0)
            curvature[:, n, n] = np.where(self._estimated, corner, 1.0)
            curvature[:, :n, n] = np.where(self._estimated[:, None], border, 0.0)
        return gradient, curvature

    def _pull(self, point: Floats) -> Floats:
        """Return the gradient of the prior's negative log in the skills."""
        off = point[:, :-1] - self.mean
        return np.asarray((self._precision @ off[:, :, None])[:, :, 0])

    def _laplacians(self, bend: Floats) -> Floats:
        n = self._players
        whole = np.zeros((len(bend), n, n))
        whole[:, self._terms.low, self._terms.high] = -bend
        whole += whole.transpose(0, 2, 1)
        whole[:, np.arange(n), np.arange(n)] = bend @ np.abs(self._ends)
        return whole


def _prior_of(means: PriorMeans, precision: float) -> tuple[Floats, Floats, Floats | None]:
    """Return the mean and precision of the skills' prior, with the levels integrated out.

    They include the evidence of earlier results, which is also normal in the skills. The last item
    returned is the fraction of `means.mean` in this mean; None: all of it.
    """
    identity = np.eye(len(means.mean))
    prior = precision * identity
    if len(means.level_sd):
        spread = means.design * means.level_sd
        prior = np.asarray(
            np.linalg.inv(identity / precision + spread @ spread.T), dtype=np.float64
        )
    if means.known is None:
        return means.mean, prior, None
    both = prior + np.diag(means.known.information)
    mean = np.linalg.solve(both, prior @ means.mean + means.known.pull)
    share = None
    if means.follow is not None:
        share = np.asarray(np.linalg.solve(both, prior), dtype=np.float64)
    return np.asarray(mean, dtype=np.float64), both, share
