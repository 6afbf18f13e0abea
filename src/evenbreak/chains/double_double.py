"""Sums and products of doubles in twice their precision, using only double arithmetic.

A number is a pair of doubles, the rounded value and its rounding error. The sum of two doubles is
such a pair exactly (Knuth), and so is their product (Dekker), unless it under- or overflows. Let u
= 2^-53. If terms are added in pairs, then pairs of pairs, and so on, L times, with their errors
added separately, the error of the sum is at most u of the sum and ((L + 1) u)^2 of the sum of
absolute values (compare Ogita, Rump and Oishi 2005, "Accurate sum and dot product"). The platform
does not need a longer type.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from evenbreak.arrays import Floats

if TYPE_CHECKING:
    from scipy.sparse import csr_array

    from evenbreak.chains.arcs import Places

ROUND = 2.0**-53
_SPLITTER = 2.0**27 + 1.0
_BITS = 3
"""Numbers of terms are rounded up to this many binary digits."""
_DENSE = 0.2
"""Share of nonzero entries above which a matrix is stored with its zeros."""
_TINY = 2.0**-1000
"""An upper bound on what underflow takes from all the products in a row."""


class Pair(NamedTuple):
    """Number in twice the precision: `high` is the nearest double, `low` is the rest."""

    high: Floats
    low: Floats


def two_sum(a: Floats, b: Floats) -> Pair:
    """Return a + b exactly.

    >>> two_sum(np.array([1.0]), np.array([1e-20]))
    Pair(high=array([1.]), low=array([1.e-20]))
    """
    high = a + b
    moved = high - a
    return Pair(high, (a - (high - moved)) + (b - moved))


def halves(a: Floats) -> Pair:
    """Split a number into two of at most 26 bits each."""
    stretched = _SPLITTER * a
    high = stretched - (stretched - a)
    return Pair(high, a - high)


def two_product(a: Floats, b: Floats) -> Pair:
    """Return a b exactly, if it neither under- nor overflows.

    >>> two_product(np.array([1.0 + 2.0**-52]), np.array([1.0 - 2.0**-52])).low == -2.0**-104
    array([ True])
    """
    return product(a, halves(a), b, halves(b))


def product(a: Floats, of_a: Pair, b: Floats, of_b: Pair) -> Pair:
    """Return a b exactly, as `two_product` does, for factors that are already split in `halves`."""
    high = a * b
    middle = of_a.high * of_b.low + of_a.low * of_b.high
    return Pair(high, ((of_a.high * of_b.high - high) + middle) + of_a.low * of_b.low)


class Rows:
    """Sums over the rows of a sparse matrix, in twice the precision of doubles.

    Rows with about the same number of terms are added up together, repeatedly adding one half of
    their terms to the other half. Row i holds the entries from indptr[i] to indptr[i + 1].
    """

    def __init__(self, indptr: Places) -> None:
        self.terms = np.diff(indptr)
        unit = np.left_shift(1, np.maximum(np.frexp(self.terms)[1] - _BITS, 0))
        width = -(-self.terms // unit) * unit
        order = np.argsort(width, kind="stable")
        ends = np.flatnonzero(np.diff(width[order], append=-1)) + 1
        self.blocks = []
        for rows in np.split(order, ends[:-1]):
            term = np.arange(width[rows[0]] if len(rows) else 0)[:, None]
            # What is missing in a row is a term that is 0, kept after the last entry.
            entries = np.where(term < self.terms[rows], indptr[:-1][rows] + term, indptr[-1])
            self.blocks.append((rows, entries))

    def sum(self, terms: Floats) -> Pair:
        """Return the row sums of terms of shape (entries,)."""
        high, low = np.zeros(len(self.terms)), np.zeros(len(self.terms))
        padded = np.append(terms, 0.0)
        for rows, entries in self.blocks:
            some = padded[entries]
            high[rows], low[rows] = _added_up(some, np.zeros_like(some))
        return Pair(high, low)


def _added_up(some: Floats, lost: Floats) -> Pair:
    """Return the sums of columns, and of the rounding errors of their terms."""
    if not len(some):
        return Pair(np.zeros(some.shape[1]), np.zeros(some.shape[1]))
    while len(some) > 1:
        half = len(some) // 2
        added, more = two_sum(some[:half], some[half : 2 * half])
        more += lost[:half]
        more += lost[half : 2 * half]
        odd = len(some) % 2
        some = np.concatenate((added, some[-1:])) if odd else added
        lost = np.concatenate((more, lost[-1:])) if odd else more
    return two_sum(some[0], lost[0])


class Balance:
    """The equations A x = b with A = diag(outflow) - arcs, and their residuals.

    The arcs are sparse, shape (m, m), nonnegative, no diagonal; `rows` are the sums over their
    rows.
    """

    def __init__(self, arcs: csr_array, outflow: Pair, rows: Rows) -> None:
        m = len(rows.terms)
        self.arcs, self.outflow, self._levels = arcs, outflow, m.bit_length() + 8
        if arcs.nnz > _DENSE * m * m:
            states = np.arange(m)
            blocks = [(states, states[:, None], np.ascontiguousarray(arcs.toarray().T))]
        else:
            data, at = np.append(arcs.data, 0.0), np.append(arcs.indices, 0)
            blocks = [(some, at[entries], data[entries]) for some, entries in rows.blocks]
        self._blocks = [(some, at, data, halves(data)) for some, at, data in blocks]

    def missed(self, x: Pair, b: Floats) -> tuple[Floats, Floats]:
        """Return b - A x for x >= 0, and an upper bound on the size of each entry."""
        into = Pair(np.zeros_like(b), np.zeros_like(b))
        for rows, at, data, parts in self._blocks:
            high = x.high[at]
            flow = product(data, parts, high, halves(high))
            added = _added_up(flow.high, flow.low + data * x.low[at])
            into.high[rows], into.low[rows] = added
        out = two_product(self.outflow.high, x.high)
        below = self.outflow.high * x.low + self.outflow.low * x.high
        whole, lost = two_sum(into.high, b)
        rest, more = two_sum(whole, -out.high)
        residual = rest + ((lost + more) + (into.low - (out.low + below)))
        rounding = 2.0 * (ROUND * self._levels) ** 2 * (into.high + out.high + b)
        return residual, (1.0 + 8.0 * ROUND) * np.abs(residual) + rounding + _TINY
