"""Approximate diagonal of the inverse of a large sparse matrix, with an error estimate.

The Hessian H of a league is divided into blocks of players who mostly play each other: clubs. If θ
~ N(0, H⁻¹), I is a block and O is all others, the law of total variance gives

    H⁻¹_II = H_II⁻¹ + cov(m),    m = E(θ_I | θ_O) = -H_II⁻¹ H_IO θ_O,

of which the first term is exact. The second, which comes from matches across blocks alone, is
small, and its diagonal is the mean of m² over draws of θ: block Rao-Blackwellization (Sidén,
Lindgren, Bolin & Villani 2018). With H = BᵀWB + D, B the differences of the pairs that met, W their
weights, and z, z' independent signs,

    θ = H⁻¹ (BᵀW^½ z + D^½ z')

has the covariance H⁻¹ (Papandreou & Yuille 2010). All draws are solved for together by conjugate
gradients, with the blocks as the preconditioner M. Where C are the weights across blocks,
H ≥ M / (1 + max C/D): so the residual bounds the error of a solution.

If all of D equals τ, the level of each connected component is separated exactly: it has the
variance 1/(τn).

With K draws the sampled part s of a variance v has the relative standard error √(2/K), and v at
most √(2/K) s/v. Draws are added until that is small enough for everyone; where it takes fewer
solutions, v of the players with the largest s/v is solved for instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from evenbreak.arrays import Bools, Floats, Ints, Places
from evenbreak.errors import AccuracyError

ENOUGH = 0.01
"""Draws are added until the relative standard error of a standard deviation is this small."""

FIRST, MOST = 64, 2000
"""Number of draws to start with, and the most solves, for draws and for single players."""

SEED = 1
"""Seed of the draws, so that the same league always gives the same answer."""

BLOCK = 128
"""The most players in a block."""

_EXACTLY = 1e-2
"""Error of a solution in its own energy norm: the most standard deviations by which a draw is off
for any player; the square of it is the relative error of a single player's variance."""

_NUMBERS = 16_000_000
"""Elements in the largest array that holds several draws."""

_MOST_STEPS = 5_000


class InverseDiagonal(NamedTuple):
    """The diagonal of an inverse, n values.

    `relative_error` is the standard error of the least certain value, relative to it; 0 if the
    values aren't sampled.
    """

    value: Floats
    relative_error: float = 0.0


def sampled_diagonal(matrix: sparse.csc_array, row_sum: float | None) -> InverseDiagonal:
    """Return the diagonal of the inverse of a diagonally dominant M-matrix, by blocks and draws.

    As in `evenbreak.ratings.inverse_diagonal`. Raises AccuracyError if the matrix is singular to
    within rounding.

    >>> path = sparse.csc_array([[2.0, -1.0, 0.0], [-1.0, 3.0, -1.0], [0.0, -1.0, 2.0]])
    >>> sampled_diagonal(path, 1.0).value  # one block: exact
    array([0.625, 0.5  , 0.625])
    """
    size = matrix.shape[0]
    upper = sparse.triu(matrix, 1).tocoo()
    low, high = (ends.astype(np.int64) for ends in upper.coords)
    blocks = _Blocks(matrix, blocks_of(size, low, high, -upper.data))
    own = blocks.own_variance
    level, shares = _levels(matrix, blocks, row_sum)
    if not blocks.across.nnz:
        return InverseDiagonal(own)
    squares, draws = np.zeros(size), 0
    noise = _Noise(size, low, high, -upper.data, blocks.row_sums)
    wanted, exactly = FIRST, np.zeros(0, dtype=np.int64)
    while draws < wanted:
        many = min(noise.at_once, wanted - draws)
        theta = blocks.solve(shares.apart(noise.draw(many)))
        squares += (blocks.mean_given_others(shares.apart(theta)) ** 2).sum(1)
        draws += many
        if draws >= wanted:
            sampled = squares / draws
            variance = own + sampled + level
            wanted, exactly = _division(sampled / variance)
    error = np.sqrt(2.0 / draws) * sampled / variance
    for several in np.array_split(exactly, -(-len(exactly) // noise.at_once) or 1):
        unit = np.zeros((size, len(several)))
        scale = 1.0 / np.sqrt(own[several])
        unit[several, np.arange(len(several))] = scale
        variance[several] = blocks.solve(unit)[several, np.arange(len(several))] / scale
    error[exactly] = 0.0
    return InverseDiagonal(variance, float(error.max()))


def _division(share: Floats) -> tuple[int, Places]:
    """Return the number of draws and the players to solve for that take the least work."""
    hardest_first = np.argsort(-share, kind="stable")[:MOST]
    draws = np.ceil(2.0 * (share[hardest_first] / (2.0 * ENOUGH)) ** 2)
    alone = int((np.maximum(draws, FIRST) + np.arange(len(draws))).argmin())
    return int(np.clip(draws[alone], FIRST, MOST)), hardest_first[:alone]


class _Noise:
    """Draws of BᵀW^½ z + D^½ z', which have the covariance H."""

    def __init__(self, size: int, low: Ints, high: Ints, weight: Floats, row_sums: Floats) -> None:
        pairs = len(low)
        root = np.sqrt(weight)
        ends = np.concatenate([low, high]), np.tile(np.arange(pairs), 2)
        shape = (size, pairs)
        self._differences = sparse.csr_array((np.concatenate([root, -root]), ends), shape=shape)
        self._own = np.sqrt(row_sums)[:, None]
        self._rng = np.random.default_rng(SEED)
        self.at_once = max(1, min(32, _NUMBERS // max(pairs, size)))

    def draw(self, many: int) -> Floats:
        pairs, size = self._differences.shape[1], len(self._own)
        drawn = self._differences @ self._signs(pairs, many) + self._own * self._signs(size, many)
        return np.asarray(drawn)

    def _signs(self, rows: int, many: int) -> Floats:
        return np.asarray(2.0 * self._rng.integers(0, 2, (rows, many), dtype=np.int8) - 1.0)


@dataclass(frozen=True, eq=False)
class _Shares:
    """The mean over each connected component, or nothing if no level is separated."""

    component: NDArray[Any]
    to_means: sparse.csr_array | None

    def apart(self, values: Floats) -> Floats:
        """Return values minus their mean over each component."""
        if self.to_means is None:
            return values
        return np.asarray(values - (self.to_means @ values)[self.component])


def _levels(
    matrix: sparse.csc_array, blocks: _Blocks, row_sum: float | None
) -> tuple[Floats, _Shares]:
    """Return what the components' levels add to the variances, given the other blocks."""
    size = matrix.shape[0]
    if row_sum is None:
        return np.zeros(size), _Shares(np.zeros(size, dtype=np.int64), None)
    number, label = connected_components(matrix, directed=False)
    members = np.bincount(label)[label]
    shape = (number, size)
    to_means = sparse.csr_array((1.0 / members, (label, np.arange(size))), shape=shape)
    # A level of 1 in all other blocks is one of 1 - τ H_II⁻¹ 1 here.
    here = 1.0 - row_sum * blocks.precondition(np.ones((size, 1)))[:, 0]
    return here**2 / (row_sum * members), _Shares(label, to_means)


class _Blocks:
    """Matrix whose players are divided into numbered blocks."""

    def __init__(self, matrix: sparse.csc_array, block: Ints) -> None:
        self._matrix = sparse.csr_array(matrix)
        entries = matrix.tocoo()
        row, column = entries.coords
        same = block[row] == block[column]
        apart = entries.data[~same], (row[~same], column[~same])
        self.across = sparse.csr_array(apart, shape=matrix.shape)
        self._groups = [
            (players, there, _inverses(players, there, row[same], column[same], entries.data[same]))
            for players, there in _groups_of(block)
        ]

    @cached_property
    def own_variance(self) -> Floats:
        """The variance of each player given all other blocks."""
        variance = np.zeros(self._matrix.shape[0])
        for players, there, inverse in self._groups:
            variance[players[there]] = np.diagonal(inverse, axis1=1, axis2=2)[there]
        return variance

    @cached_property
    def row_sums(self) -> Floats:
        return np.maximum(self._matrix.sum(axis=1), 0.0)

    def precondition(self, right: Floats) -> Floats:
        """Return the solution of the matrix without its entries across blocks."""
        padded = np.vstack([right, np.zeros((1, right.shape[1]))])
        solution = np.zeros_like(padded)
        for players, _, inverse in self._groups:
            solution[players] = inverse @ padded[players]
        return solution[:-1]

    def mean_given_others(self, theta: Floats) -> Floats:
        """Return the mean of each block's players, given all other blocks."""
        return -self.precondition(self.across @ theta)

    @cached_property
    def _residual(self) -> float:
        """The squared residual, weighted by the preconditioner, at which to stop."""
        across = -self.across.sum(axis=1)
        apart = across > 0.0
        most = float((across[apart] / np.maximum(self.row_sums[apart], 1e-300)).max())
        return _EXACTLY**2 / (1.0 + most)

    def solve(self, right: Floats) -> Floats:
        """Return H⁻¹ times each column, by conjugate gradients."""
        solution, residual = np.zeros_like(right), right.copy()
        step = self.precondition(residual)
        size = np.einsum("ij,ij->j", residual, step)
        for _ in range(_MOST_STEPS):
            if (size <= self._residual).all():
                return solution
            image = self._matrix @ step
            length = size / np.maximum(np.einsum("ij,ij->j", step, image), 1e-300)
            solution += length * step
            residual -= length * image
            toward = self.precondition(residual)
            last, size = size, np.einsum("ij,ij->j", residual, toward)
            step *= size / np.maximum(last, 1e-300)
            step += toward
        raise not_definite()


def not_definite() -> AccuracyError:
    """Return the error for a Hessian that rounding has made singular."""
    return AccuracyError(
        "the posterior's Hessian is singular to within rounding errors. Give a smaller prior_sd."
    )


def _groups_of(block: Ints) -> list[tuple[Places, Bools]]:
    """Return the players in blocks of similar size, and which places hold a player.

    Empty places hold the number of players, which is no one's position.
    """
    order = np.argsort(block, kind="stable")
    size = np.bincount(block)
    begin = np.cumsum(size) - size
    width = np.where(size > 1, -(-size // 8) * 8, 1)
    groups = []
    for wide in np.unique(width):
        alike = np.flatnonzero(width == wide)
        there = np.arange(wide) < size[alike, None]
        at = np.where(there, begin[alike, None] + np.arange(wide), 0)
        groups.append((np.where(there, order[at], len(block)), there))
    return groups


def _inverses(players: Places, there: Bools, row: Ints, column: Ints, value: Floats) -> Floats:
    """Return the inverse of each block of a group, all of one width; no one's row is a unit."""
    many, wide = players.shape
    place = np.full(max(int(players.max()), int(row.max(initial=0))) + 1, -1)
    place[players[there]] = np.flatnonzero(there)
    here = place[row] >= 0
    at, to = place[row[here]], place[column[here]]
    blocks = np.zeros((many, wide, wide))
    blocks[at // wide, at % wide, to % wide] = value[here]
    blocks[:, np.arange(wide), np.arange(wide)] += ~there
    try:
        return np.asarray(np.linalg.inv(blocks), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise not_definite() from None


_ROUNDS = 64


def blocks_of(players: int, low: Ints, high: Ints, weight: Floats) -> NDArray[np.int64]:
    """Return each player's block number, found from who plays whom.

    Blocks grow from single players: in each round, two blocks merge if each is the other's closest
    among those that would not make it too large. The closeness of two blocks is the mean weight of
    their pairs of players.

    >>> low, high = np.array([0, 0, 1, 2, 3, 3, 4]), np.array([1, 2, 2, 3, 4, 5, 5])
    >>> blocks_of(6, low, high, np.array([9.0, 9.0, 9.0, 1.0, 9.0, 9.0, 9.0]))
    array([0, 0, 0, 0, 0, 0])
    """
    block: NDArray[np.int64] = np.arange(players)
    size: NDArray[np.int64] = np.ones(players, dtype=np.int64)
    for _ in range(_ROUNDS):
        kept = size[low] + size[high] <= BLOCK
        low, high, weight = low[kept], high[kept], weight[kept]
        if not len(low):
            break
        close = weight / (size[low] * size[high])
        # Among equals the order is as good as random, so that many find each other in one round.
        shuffled = np.random.default_rng(SEED).permutation(len(low))
        rank = np.empty(len(low), dtype=np.int64)
        rank[np.lexsort((shuffled, close))] = np.arange(len(low))
        best = np.full(len(size), -1)
        np.maximum.at(best, low, rank)
        np.maximum.at(best, high, rank)
        mutual = (best[low] == rank) & (best[high] == rank)
        merged = np.arange(len(size))
        merged[high[mutual]] = low[mutual]
        _, merged = np.unique(merged, return_inverse=True)
        block = merged[block]
        size = np.bincount(merged, size).astype(np.int64)
        low, high = np.sort([merged[low], merged[high]], axis=0)
        apart = low != high
        pair = low[apart] * len(size) + high[apart]
        pair, place = np.unique(pair, return_inverse=True)
        weight = np.bincount(place, weight[apart]).astype(np.float64)
        low, high = pair // len(size), pair % len(size)
    return block
