"""Sums and products of doubles in twice their precision, by arithmetic in doubles alone.

A number is a pair of doubles, the rounded value and what rounding took from it. The sum of two
doubles is such a pair exactly (Knuth), and so is their product (Dekker), unless it under- or
overflows. With u = 2^-53, a sum of n products whose errors are added up beside it is off by at most
u of itself and (n u)^2 of the sum of the sizes of its terms (Ogita, Rump and Oishi 2005, "Accurate
sum and dot product", theorem 5.1). No longer type of the platform is needed.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places

    Floats = NDArray[np.float64]

ROUND = 2.0**-53
_SPLITTER = 2.0**27 + 1.0
_FEW_ROWS = 16
"""Rows with more terms than all but so few others are summed one by one."""


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

    The k-th terms of all rows are added at once; the few rows with many more terms than the others
    are added up by `math.fsum`.

    Parameters
    ----------
    indptr
        shape (m + 1,): row i holds the entries from indptr[i] to indptr[i + 1].
    """

    def __init__(self, indptr: Places) -> None:
        degree = np.diff(indptr)
        self.terms = degree
        self._rows = np.argsort(-degree, kind="stable")
        most = np.arange(degree.max(initial=0))
        counts = len(degree) - np.searchsorted(np.sort(degree), most, side="right")
        self._counts = counts[counts >= min(_FEW_ROWS, len(degree))].tolist()
        first = indptr[:-1][self._rows]
        self._layers = [first[:count] + k for k, count in enumerate(self._counts)]
        heavy = self._rows[: counts[len(self._counts)] if len(self._counts) < len(counts) else 0]
        self._heavy = [(i, slice(indptr[i], indptr[i + 1])) for i in heavy.tolist()]

    def sum(self, terms: Floats, errors: Floats) -> Pair:
        """Return the sum of the terms and of the errors beside them, by row; shapes (entries,)."""
        high, low = np.zeros(len(self._rows)), np.zeros(len(self._rows))
        for layer, count in zip(self._layers, self._counts, strict=True):
            high[:count], lost = two_sum(high[:count], terms[layer])
            low[:count] += lost + errors[layer]
        sums = Pair(np.empty_like(high), np.empty_like(low))
        sums.high[self._rows], sums.low[self._rows] = two_sum(high, low)
        for i, row in self._heavy:
            sums.high[i] = math.fsum(terms[row])
            sums.low[i] = math.fsum((*terms[row].tolist(), -sums.high[i])) + math.fsum(errors[row])
        return sums
