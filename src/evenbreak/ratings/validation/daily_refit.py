"""A league's ratings from day to day, as results come in.

Little changes from one day to the next, so a few Newton steps from yesterday's mode find today's
(the model is that of `evenbreak.ratings.posterior`). Newton systems, and the variances of today's
differences, are solved by conjugate gradients, which here take no longer than a factorization and
start no threads that wait for each other. Pairs are numbered in the order in which they first
meet, so those that have met come before all others, and nothing is done for the others.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import cg
from scipy.special import expit

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.beginning import MovingMeans, PriorMeans
from evenbreak.ratings.conjugate_gradients import AT_ONCE, energies
from evenbreak.ratings.covariance import with_levels
from evenbreak.ratings.posterior import damped, find_zero, step_accuracy, tolerance

GRADIENT = 1e-6
"""How small the gradient has to become, in games, multiplied by τ if that is below 1."""

VARIANCE_ACCURACY = 1e-6
"""Fraction of a variance, and of the squared residual, at which iteration stops."""

AHEAD = 1.1
"""Initial size of the graph of play, as a multiple of the pairs that have met."""


class DailyRefit:
    """Skills of a league's players in natural log-odds, as results come in.

    Matches arrive in the order given; τ is the prior precision 1/sd².
    """

    def __init__(
        self,
        players: int,
        player_a: Ints,
        player_b: Ints,
        precision: float,
        means: PriorMeans | None = None,
    ) -> None:
        low, high = np.minimum(player_a, player_b), np.maximum(player_a, player_b)
        pairs, first, place = np.unique(
            low * players + high, return_index=True, return_inverse=True
        )
        order = np.argsort(first)
        self._pair = np.argsort(order)[place]
        self._low, self._high = np.divmod(pairs[order], players)
        self._a_is_low = player_a == low
        self._games = np.zeros(len(pairs))
        self._low_won = np.zeros(len(pairs))
        self._precision = precision
        self._means = PriorMeans.none(players) if means is None else means
        self._kept = 1.0
        self._point = np.concatenate([self._means.mean, np.zeros(len(self._means.level_sd))])
        self._met = 0
        self._graph = self._graph_of(0)

    @property
    def skill(self) -> Floats:
        """The skill of each player."""
        return self._point[: len(self._means.mean)]

    def learn(self, matches: slice, won_a: Floats | Ints, won_b: Floats | Ints) -> None:
        """Add the games won in some of the matches, which may be weighted."""
        pair = self._pair[matches]
        low_won = np.where(self._a_is_low[matches], won_a, won_b)
        self._met = max(self._met, int(pair.max(initial=-1)) + 1)
        self._games[: self._met] += np.bincount(pair, won_a + won_b, self._met)
        self._low_won[: self._met] += np.bincount(pair, low_won, self._met)
        if self._met > len(self._graph.low):
            ahead = round(AHEAD * self._met)
            self._graph = self._graph_of(ahead)

    def begin_day(self, means: PriorMeans | None = None) -> None:
        """Refit, with other prior means if there are any; this ends what was learned."""
        self._means = self._means if means is None else means.faded(self._kept)
        self._find_mode()

    def fade(self, keep: float) -> None:
        """Reduce the weight of everything so far to a fraction of what it was."""
        self._games[: self._met] *= keep
        self._low_won[: self._met] *= keep
        self._kept *= keep
        self._means = self._means.faded(keep)

    def difference_variance(self, a: Ints, b: Ints) -> Floats:
        """Return the posterior variance of skill a - skill b, for each pair (Laplace)."""
        hessian = self._hessian(self._curvatures()[1])
        return np.asarray(hessian.energies(a, b))

    def _graph_of(self, pairs: int) -> _Graph:
        return _Graph(self._low[:pairs], self._high[:pairs], len(self.skill))

    def _find_mode(self) -> None:
        players = len(self.skill)
        moving = MovingMeans(self._means)
        games = self._games[: len(self._graph.low)]
        most = float((self._graph.ends(games) + self._means.information).max())
        enough = tolerance(self._precision, most, GRADIENT)

        def gradient_at(point: Floats) -> tuple[Floats, Callable[[], Floats]]:
            skill, level = point[:players], point[players:]
            if moving.follow(skill):
                self._means = moving.now
            surplus, weight = self._curvatures(skill)
            of_skill, of_level = self._means.slopes(skill, level, self._precision)
            gradient = np.append(self._graph.flow(surplus) + of_skill, of_level)

            def step() -> Floats:
                solved = self._hessian(weight).solution(gradient, step_accuracy(gradient))
                return damped(-solved, self._graph.low, self._graph.high)

            return gradient, step

        self._point = find_zero(self._point, gradient_at, enough).point

    def _curvatures(self, skill: Floats | None = None) -> tuple[Floats, Floats]:
        """Return the first and second derivatives of the negative log-likelihood by pair.

        They are taken in each pair's difference, by default at the current skills. The pairs are
        those of the graph.
        """
        at = self.skill if skill is None else skill
        low, high = self._graph.low, self._graph.high
        games, low_won = self._games[: len(low)], self._low_won[: len(low)]
        p_low = expit(at[low] - at[high])
        expected = games * p_low
        return expected - low_won, expected * (1.0 - p_low)

    def _hessian(self, weight: Floats) -> _Hessian:
        """Return the Hessian of the negative log-posterior if pairs have the given weights."""
        own = self._graph.ends(weight) + self._precision + self._means.information
        across = -self._precision * self._means.design
        levels = np.diag(self._means.precision) - self._means.design.T @ across
        return _Hessian(self._graph, weight, own, across, levels)


class _Graph:
    """Who has met whom: which entries of a Hessian are not 0."""

    def __init__(self, low: Ints, high: Ints, players: int) -> None:
        self.low, self.high, self.players = low, high, players
        many = np.arange(players)
        row = np.concatenate([low, high, many])
        column = np.concatenate([high, low, many])
        order = np.lexsort((column, row))
        self._column = column[order].astype(np.int32)
        starts = np.cumsum(np.bincount(row, minlength=players))
        self._starts = np.append(0, starts).astype(np.int32)
        pair = np.arange(len(low))
        self._slot = np.concatenate([pair, pair, np.full(players, len(low))])[order]

    def ends(self, each: Floats) -> Floats:
        """Return each player's sum over their pairs."""
        low, high = (np.bincount(ends, each, self.players) for ends in (self.low, self.high))
        return np.asarray(low + high)

    def flow(self, each: Floats) -> Floats:
        """Return each player's sum over the pairs where they are low, minus the others."""
        low, high = (np.bincount(ends, each, self.players) for ends in (self.low, self.high))
        return np.asarray(low - high)

    def matrix(self, each: Floats, kind: Any) -> Any:
        """Return the symmetric matrix with an entry for each pair, and 1 on the diagonal."""
        entries = np.append(each, 1.0).astype(kind)[self._slot], self._column, self._starts
        return sparse.csr_array(entries, shape=(self.players, self.players))


class _Hessian:
    """The Hessian of the negative log-posterior in skills and levels, for a unit diagonal.

    `own` is the diagonal in the skills, `across` and `levels` the rest: of players and levels, and
    of levels.
    """

    def __init__(
        self, graph: _Graph, weight: Floats, own: Floats, across: Floats, levels: Floats
    ) -> None:
        self._graph = graph
        self._scale = 1.0 / np.sqrt(np.append(own, np.diagonal(levels)))
        self._of_player = self._scale[: len(own)]
        self._between = -weight * self._of_player[graph.low] * self._of_player[graph.high]
        self._across, self._levels = across, levels

    def _matrix(self, kind: Any) -> Any:
        """Return the matrix as a function that multiplies columns of the given dtype."""
        between = self._graph.matrix(self._between, kind)
        if not len(self._levels):
            return between
        of_level = self._scale[len(self._of_player) :]
        return with_levels(
            between,
            (self._across * self._of_player[:, None] * of_level).astype(kind),
            (self._levels * of_level[:, None] * of_level).astype(kind),
        )

    def solution(self, right: Floats, accuracy: float) -> Floats:
        """Return what the Hessian maps to `right`, to within a tolerance."""
        solved, _ = cg(
            self._matrix(np.float64),
            self._scale * right,
            rtol=accuracy,
            maxiter=2 * len(right) + 100,
        )
        return np.asarray(self._scale * solved)

    def energies(self, a: Ints, b: Ints) -> Floats:
        """Return xᵀ H⁻¹ x for each pair, where x is 1 at a, -1 at b and 0 elsewhere."""
        matrix = self._matrix(np.float32)
        blocks = np.array_split(np.arange(len(a)), max(-(-len(a) // AT_ONCE), 1))
        return np.concatenate([self._energies(matrix, a[rows], b[rows]) for rows in blocks])

    def _energies(self, matrix: Any, a: Ints, b: Ints) -> Floats:
        which = np.arange(len(a))
        # Half the memory, and so half the time; an energy is off by the error's square.
        residual: Any = np.zeros((len(self._scale), len(a)), dtype=np.float32)
        residual[a, which] += self._scale[a].astype(np.float32)
        residual[b, which] -= self._scale[b].astype(np.float32)
        return energies(matrix, residual, VARIANCE_ACCURACY)
