"""Chains whose states are in a line: each moves only to its neighbors (birth and death).

A closed stretch of the line has the stationary distribution

    pi[i] / pi[a] = (up[a] ... up[i - 1]) / (down[a] ... down[i - 1]),

and a chain that starts in state s of a stretch lo..hi with two exits leaves it on the right with
the gambler's-ruin probability

    W = (g[lo] + ... + g[s]) / (g[lo] + ... + g[hi + 1]),
    g[i] = (down[lo - 1] ... down[i - 2]) / (up[lo] ... up[i - 1]), g[lo] = 1,

where up[i] is the arc from i to i + 1 and down[i] the arc from i + 1 to i. These formulas use only
products, quotients and sums of positive numbers. Each number is stored as a significand and an
integer exponent of 2, so no digits are lost, no matter how many decades a distribution spans. Only
the last step, to floats on a common scale, turns numbers smaller than any float into zero.

Numerators and denominators are multiplied separately. A running product of quotients would
repeat the rounding error of one quotient n times if all are equal; a running product of the
given numbers rounds differently at each step, so its error grows like the square root of n.

`LineElimination` solves such a class by eliminating every second state. No two states at odd places
are neighbors, so all of them are eliminated at once, in one vector operation: with d[i] the sum of
the arcs out of state i and its leak, the arc from i - 1 to i + 1 becomes up[i - 1] up[i] / d[i],
and likewise down the line. Half the states are left, again in a line; after log2(n) rounds, one is
left. This is the elimination of Grassmann, Taksar and Heyman (1985) in the order of cyclic
reduction (Hockney 1965). It works in the platform's extended precision. If all arcs are equal, each
round repeats the rounding errors of the round before, which in doubles would show at n = 10,000;
and arcs between states far apart are smaller than any double. If a long double is no wider than a
double (Windows, some ARM), lines are solved by another method (see `factorization`).

References: Feller, An Introduction to Probability Theory I, chapter XIV; Karlin and McGregor 1957.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, csgraph

from evenbreak.arrays import Floats, array_values
from evenbreak.chains.arcs import Places, put_back

_BLOCK = 32
# 32 factors above 2^-30 stay above 2^-960, and so do 900 significands.
_SMALL_FACTOR = 2.0**-30
_STRETCH = 900
_HIGH = 900
"""Terms are added up at this power of 2, so that significant ones do not underflow."""


@array_values
@dataclass(frozen=True, eq=False)
class BirthDeath:
    """Chain whose states are in a line.

    `up` and `down`, shape (n - 1,), are the arcs from i to i + 1 and back; `loops` has shape (n,).
    """

    up: Floats
    down: Floats
    loops: Floats

    def limit(self, start: int) -> tuple[Floats, int]:
        """Return the stochastic limit from the state `start`, and its period.

        The limit has shape (n,); it is conditional on the start.
        """
        first, last, leftmost, rightmost = self._stretches
        k = int(np.searchsorted(last, start))
        ends = sorted({int(leftmost[k]), int(rightmost[k])} - {k}) or [k]
        chances: tuple[float, ...] = (1.0,)
        if len(ends) == 2:
            lo, hi = first[k], last[k]
            products = prefix_products(self.down[lo - 1 : hi], self.up[lo : hi + 1])
            chances = shares(*products, start - lo + 1)[::-1]
        limit, period = np.zeros(len(self.loops)), 1
        for end, chance in zip(ends, chances, strict=True):
            lo, hi = first[end], last[end]
            limit[lo : hi + 1] = birth_death_law(self.up[lo:hi], self.down[lo:hi])
            limit[lo : hi + 1] *= chance
            if lo < hi and not self.loops[lo : hi + 1].any():
                period = 2
        return limit, period

    def limits(self) -> csc_array | None:
        """Return the limits from all states as columns, if the chain always ends in one state.

        Column j is the limit from state j. None if the chain may end in a closed stretch of several
        states, or if the products leave the range of long doubles, in which they are formed.
        """
        n = len(self.loops)
        first, last, leftmost, rightmost = self._stretches
        number = np.arange(len(first))
        left, right = leftmost < number, rightmost > number
        if (first < last)[~left & ~right].any():
            return None
        sizes = last - first + 1
        ends = np.repeat(first[np.stack((leftmost, rightmost), axis=1)], sizes, axis=0)
        chances = np.repeat(np.stack((~right, right), axis=1), sizes, axis=0).astype(np.float64)
        for lo, hi in zip(first[left & right].tolist(), last[left & right].tolist(), strict=True):
            exits = self._exits_from_all(lo, hi)
            if exits is None:
                return None
            chances[lo : hi + 1, 0], chances[lo : hi + 1, 1] = exits
        possible = chances > 0.0
        indptr = np.zeros(n + 1, dtype=np.int32)
        np.cumsum(np.add(*possible.T, dtype=np.int32), out=indptr[1:])
        flat = possible.ravel()
        return csc_array((chances.ravel()[flat], ends.ravel()[flat], indptr), shape=(n, n))

    def _exits_from_all(
        self, lo: int, hi: int
    ) -> tuple[NDArray[np.longdouble], NDArray[np.longdouble]] | None:
        """Return the chances of leaving lo..hi on the left and on the right, from each state.

        The products are formed in long doubles: with equal arcs, each step repeats the rounding
        error of one quotient. None if they leave the range.
        """
        g = np.empty(hi - lo + 2, dtype=np.longdouble)
        g[0], g[1:] = 1.0, self.down[lo - 1 : hi]
        with np.errstate(over="ignore"):
            g[1:] /= self.up[lo : hi + 1].astype(np.longdouble)
            np.multiply.accumulate(g, out=g)
            smallest, from_right = g.min(), np.add.accumulate(g[::-1])[::-1]
            from_left = np.add.accumulate(g, out=g)
        total = from_left[-1]
        if not (np.isfinite(total) and smallest >= np.finfo(np.longdouble).tiny):
            return None
        for chances in (from_left, from_right):
            chances *= 1 / total
            if min(chances[0], chances[-1]) < 2.0**-1074:
                # Zero as a float, but a hundred times as slow to convert as zero itself.
                chances[chances < 2.0**-1074] = 0.0
        return from_right[1:], from_left[:-1]

    @cached_property
    def _stretches(self) -> tuple[Places, Places, Places, Places]:
        """The first and the last state of each class, and the classes where the chain ends from it.

        These are one on the left and one on the right, or the class itself if it is not left on
        that side. Beyond a cut there is no way back: the chain ends at the next missing outward
        arc.
        """
        n, cuts = len(self.loops), np.flatnonzero((self.up == 0.0) | (self.down == 0.0))
        first, last = np.append(0, cuts + 1).astype(np.int32), np.append(cuts, n - 1)
        left, right = np.zeros((2, len(first)), dtype=bool)
        left[1:], right[:-1] = self.down[cuts] > 0.0, self.up[cuts] > 0.0
        number = np.arange(len(first))
        leftmost = np.maximum.accumulate(np.where(left, 0, number))
        rightmost = np.minimum.accumulate(np.where(right, n, number)[::-1])[::-1]
        return first, last, leftmost, rightmost


def birth_death_law(up: Floats, down: Floats) -> Floats:
    """Return the stationary distribution of a closed line; shape (n,) for n - 1 arcs each way.

    >>> birth_death_law(np.array([0.5, 0.5]), np.array([0.25, 0.5]))
    array([0.2, 0.4, 0.4])
    """
    law, exponent = prefix_products(up, down)
    np.ldexp(law, exponent, out=law)
    law /= law.sum()
    return law


def birth_death_of(matrix: csc_array) -> BirthDeath | None:
    """Return the chain as a line, or None if its states are not numbered along one."""
    n = matrix.shape[0]
    if n < 3 or matrix.nnz > 3 * n - 2:
        return None
    middle = matrix.indices[matrix.indptr[n // 2] : matrix.indptr[n // 2 + 1]]
    if np.any(np.abs(middle - n // 2) > 1):
        return None
    up, down, loops = matrix.diagonal(-1), matrix.diagonal(1), matrix.diagonal()
    stored = np.count_nonzero(up) + np.count_nonzero(down) + np.count_nonzero(loops)
    return BirthDeath(up, down, loops) if stored == matrix.nnz else None


def line_of(matrix: csc_array) -> tuple[Places, BirthDeath] | None:
    """Return the order that puts a chain's states in a line, and the chain in that order.

    None if there is no such order.

    >>> one_ball = csc_array([[0, 0, 0.2, 0], [0.4, 1, 0, 0], [0.6, 0, 0, 0], [0, 0, 0.8, 1]])
    >>> order, line = line_of(one_ball)
    >>> order, line.limit(1)
    (array([1, 0, 2, 3], dtype=int32), (array([0.45454545, 0.        , 0.        , 0.54545455]), 1))
    """
    paths = coo_array(matrix)
    apart = paths.row != paths.col
    ones = np.ones(np.count_nonzero(apart))
    either = csc_array((ones, (paths.row[apart], paths.col[apart])), shape=matrix.shape)
    order = line_order(csc_array(either + either.T)) if matrix.shape[0] > 1 else None
    if order is None:
        return None
    line = csc_array(matrix[:, order])[order]
    return order, BirthDeath(line.diagonal(-1), line.diagonal(1), line.diagonal())


def prefix_products(numerators: Floats, denominators: Floats) -> tuple[Floats, Places]:
    """Return, for each i, the product of the first i numerators over the first i denominators.

    Both are positive, at most 1, shape (n,). The result, (value, exponent) of shape (n + 1,) each,
    starts with the empty product: the quotients are value * 2**exponent, scaled by a common power
    of 2 so that the largest lies in [1/2, 1). Exponents below -5000 become -5000.

    >>> value, exponent = prefix_products(np.full(1500, 0.5), np.full(1500, 1.0))
    >>> np.ldexp(value[[0, 10, 1000]], exponent[[0, 10, 1000]] + 1000)
    array([5.35754304e+300, 5.23197562e+297, 5.00000000e-001])
    """
    n = len(numerators)
    factors = np.ones((2, (n // _BLOCK + 1) * _BLOCK))
    factors[:, 1 : n + 1] = numerators, denominators
    exponent: Places = np.zeros((n // _BLOCK + 1, 1), dtype=np.int64)
    if factors.min() < _SMALL_FACTOR:
        factors, (above, below) = np.frexp(factors)
        exponent = np.cumsum(above - below, dtype=np.int64).reshape(-1, _BLOCK)
    blocks = factors.reshape(2, -1, _BLOCK)
    np.multiply.accumulate(blocks, axis=2, out=blocks)
    before, shift = _prefix_of_blocks(blocks[:, :, -1])
    value, below = blocks
    value /= below
    value *= before[:, None]
    exponent = exponent + shift[:, None]
    # Within a block that shares its exponent, the largest number decides.
    largest = value if exponent.shape == value.shape else value.max(axis=1, keepdims=True)
    exponent -= int((np.frexp(largest)[1] + exponent).max())
    exponent = np.broadcast_to(exponent.clip(-5000).astype(np.int32), value.shape)
    return value.ravel()[: n + 1], exponent.ravel()[: n + 1]


def _prefix_of_blocks(products: Floats) -> tuple[Floats, Places]:
    """Return the quotient of all blocks before each one, as floats near 1 and exponents."""
    significand, exponent = np.frexp(products)
    power = np.cumsum(exponent, axis=1, dtype=np.int64)
    for first in range(0, products.shape[1], _STRETCH):
        stretch = significand[:, first : first + _STRETCH]
        if first:
            stretch[:, 0] *= significand[:, first - 1]
        np.multiply.accumulate(stretch, axis=1, out=stretch)
        stretch[:], more = np.frexp(stretch)
        power[:, first : first + _STRETCH] += more
        power[:, first + _STRETCH :] += more[:, -1:]
    block = np.append(1.0, significand[0, :-1] / significand[1, :-1])
    return block, np.append(0, power[0, :-1] - power[1, :-1])


def shares(value: Floats, exponent: Places, split: int) -> tuple[float, float]:
    """Return the shares of the first `split` numbers, and of the rest, in the total sum.

    >>> shares(np.full(4, 0.5), np.array([0, 0, -2000, -2000]), 2)
    (1.0, 0.0)
    """
    significand, more = np.frexp(value)
    power = more + exponent
    terms = np.ldexp(significand, power - power.max() + _HIGH)
    left, right = float(terms[:split].sum()), float(terms[split:].sum())
    return left / (left + right), right / (left + right)


Wide = NDArray[np.longdouble]


class _Round(NamedTuple):
    """The states at odd places: their pivots, their arcs down and up, and the arcs into them."""

    pivot: Wide
    out: tuple[Wide, Wide]
    into: tuple[Wide, Wide]


def line_order(T: csc_array) -> Places | None:
    """Return the order that puts the states of a class in a line, or None.

    `T` holds the arcs within the class, without its diagonal.

    >>> line_order(csc_array([[0.0, 0.0, 0.5], [0.0, 0.0, 0.5], [1.0, 1.0, 0.0]]))
    array([0, 2, 1], dtype=int32)
    """
    size = T.shape[0]
    if T.nnz != 2 * (size - 1):
        return None
    ends = np.flatnonzero(np.diff(T.indptr) == 1)
    if len(ends) != 2:
        return None
    order = csgraph.breadth_first_order(T, ends[0], return_predecessors=False)
    place = np.empty(size, dtype=np.intp)
    place[order] = np.arange(size)
    sources = np.repeat(place, np.diff(T.indptr))
    return order if (np.abs(place[T.indices] - sources) == 1).all() else None


class LineElimination:
    """(I - T) factored, for a class whose states are in a line, in the given order.

    T is sparse, shape (m, m): T[i, j] is the arc from j to i; no diagonal. `leak`, not all zero, is
    the probability of leaving the line, given the state.
    """

    def __init__(self, T: csc_array, leak: Floats, order: Places) -> None:
        self._order = order
        self._rounds: list[_Round] = []
        line = csc_array(T[:, order])[order]
        u = np.append(line.diagonal(-1), 0.0).astype(np.longdouble)
        d = np.concatenate(([0.0], line.diagonal(1))).astype(np.longdouble)
        leaks = leak[order].astype(np.longdouble)
        pivots = np.empty(len(leak))
        place = np.arange(len(leak))
        while len(leaks) > 1:
            pivot = u[1::2] + d[1::2] + leaks[1::2]
            share_up, share_down, share_leak = u[1::2] / pivot, d[1::2] / pivot, leaks[1::2] / pivot
            from_left, from_right = u[0::2][: len(pivot)], d[2::2]
            self._rounds.append(_Round(pivot, (d[1::2], u[1::2]), (from_left, from_right)))
            pivots[place[1::2]] = pivot
            inner = len(from_right)
            leaks = leaks[0::2].copy()
            leaks[: len(pivot)] += from_left * share_leak
            leaks[1 : inner + 1] += from_right * share_leak[:inner]
            u, d = np.zeros_like(leaks), np.zeros_like(leaks)
            u[: len(pivot)] = from_left * share_up
            d[1 : inner + 1] = from_right * share_down[:inner]
            place = place[0::2]
        self._last = leaks
        pivots[place] = leaks
        self.pivots = put_back(pivots, order)

    def visits(self, b: Floats) -> Floats:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        return self._solved(b, transposed=False)

    def values(self, r: Floats) -> Floats:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        return self._solved(r, transposed=True)

    def _solved(self, b: Floats, *, transposed: bool) -> Floats:
        x = b[self._order].astype(np.longdouble)
        rounds = [(r.pivot, r.into, r.out) if transposed else r for r in self._rounds]
        waiting = []
        for pivot, (left, right), _ in rounds:
            odd, x = x[1::2] / pivot[:, None], x[0::2].copy()
            inner = len(x) - 1
            x[: len(pivot)] += odd * left[:, None]
            x[1:] += odd[:inner] * right[:inner, None]
            waiting.append(odd)
        x /= self._last[:, None]
        for (pivot, _, (left, right)), odd in zip(rounds[::-1], waiting[::-1], strict=True):
            inner = len(x) - 1
            more = x[: len(pivot)] * left[:, None]
            more[:inner] += x[1:] * right[:inner, None]
            even, x = x, np.empty((len(x) + len(odd), x.shape[1]), dtype=np.longdouble)
            x[0::2], x[1::2] = even, odd + more / pivot[:, None]
        return put_back(x.astype(np.float64), self._order)
