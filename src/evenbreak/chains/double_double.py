"""Sums and products of doubles in twice their precision, by arithmetic in doubles alone.

A number is a pair of doubles, the rounded value and what rounding took from it. The sum of two
doubles is such a pair exactly (Knuth), and so is their product (Dekker), unless it under- or
overflows. With u = 2^-53, a sum of n products whose errors are added up beside it is off by at most
u of itself and (n u)^2 of the sum of the sizes of its terms (Ogita, Rump and Oishi 2005, "Accurate
sum and dot product", theorem 5.1). No longer type of the platform is needed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.sparse import csr_array

    from evenbreak.chains.arcs import Places

    Floats = NDArray[np.float64]

ROUND = 2.0**-53
_SPLITTER = 2.0**27 + 1.0
_BITS = 3
"""Numbers of terms are rounded up to so many binary digits."""
_TINY = 2.0**-1000
"""More than underflow takes from a product."""


class Pair(NamedTuple):
    """A number of twice the precision: `high` is the double next to it, `low` is the rest."""

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
    """Return a number as two of at most 26 bits each."""
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
    """Return a b exactly, as `two_product` does, of factors that are cut in `halves` already."""
    high = a * b
    middle = of_a.high * of_b.low + of_a.low * of_b.high
    return Pair(high, ((of_a.high * of_b.high - high) + middle) + of_a.low * of_b.low)


class Rows:
    """Sums over the rows of a sparse matrix, in twice the precision of doubles.

    Rows of about the same number of terms are added up together, one half of their terms to the
    other half, again and again.

    Parameters
    ----------
    indptr
        shape (m + 1,): row i holds the entries from indptr[i] to indptr[i + 1].
    """

    def __init__(self, indptr: Places) -> None:
        self.terms = np.diff(indptr)
        unit = np.left_shift(1, np.maximum(np.frexp(self.terms)[1] - _BITS, 0))
        width = -(-self.terms // unit) * unit
        order = np.argsort(width, kind="stable")
        ends = np.flatnonzero(np.diff(width[order], append=-1)) + 1
        self._blocks = []
        for rows in np.split(order, ends[:-1]):
            term = np.arange(width[rows[0]] if len(rows) else 0)[:, None]
            # What is missing in a row is a term that is 0, kept after the last entry.
            entries = np.where(term < self.terms[rows], indptr[:-1][rows] + term, indptr[-1])
            self._blocks.append((rows, entries))

    def sum(self, terms: Floats, errors: Floats) -> Pair:
        """Return the sum of the terms and of the errors beside them, by row; shapes (entries,)."""
        terms, errors = np.append(terms, 0.0), np.append(errors, 0.0)
        high, low = np.zeros(len(self.terms)), np.zeros(len(self.terms))
        for rows, entries in self._blocks:
            some, lost = terms[entries], errors[entries]
            while len(some) > 1:
                half = len(some) // 2
                added, more = two_sum(some[:half], some[half : 2 * half])
                more += lost[:half] + lost[half : 2 * half]
                some = np.concatenate((added, some[2 * half :]))
                lost = np.concatenate((more, lost[2 * half :]))
            if len(some):
                high[rows], low[rows] = two_sum(some[0], lost[0])
        return Pair(high, low)


class Balance:
    """The equations A x = b, A = diag(outflow) - arcs, and by how much they are missed.

    Parameters
    ----------
    arcs
        sparse, shape (m, m), nonnegative, no diagonal.
    outflow
        shape (m,) each: the diagonal of A.
    rows
        the sums over the rows of `arcs`.
    """

    def __init__(self, arcs: csr_array, outflow: Pair, rows: Rows) -> None:
        self.arcs, self.outflow, self._rows = arcs, outflow, rows
        self._halves = halves(arcs.data)

    def missed(self, x: Pair, b: Floats) -> tuple[Floats, Floats]:
        """Return b - A x for x >= 0, and at least the size of each."""
        at, terms = self.arcs.indices, self._rows.terms + 8
        parts = halves(x.high)
        flow = product(
            self.arcs.data, self._halves, x.high[at], Pair(parts.high[at], parts.low[at])
        )
        into = self._rows.sum(flow.high, flow.low + self.arcs.data * x.low[at])
        out = two_product(self.outflow.high, x.high)
        below = self.outflow.high * x.low + self.outflow.low * x.high
        whole, lost = two_sum(into.high, b)
        rest, more = two_sum(whole, -out.high)
        residual = rest + ((lost + more) + (into.low - (out.low + below)))
        rounding = 2.0 * (ROUND * terms) ** 2 * (into.high + out.high + b)
        return residual, (1.0 + 2.0 * ROUND) * np.abs(residual) + rounding + terms * _TINY
