"""Sums and products in twice the precision of doubles, against fractions."""

from fractions import Fraction

import numpy as np
from scipy.sparse import csr_array

from evenbreak.chains.double_double import ROUND, Balance, Pair, Rows, two_product, two_sum


def numbers(rng, size):
    return rng.standard_normal(size) * 10.0 ** rng.integers(-12, 12, size)


def test_sums_and_products_of_two_are_exact():
    rng = np.random.default_rng(1)
    a, b = numbers(rng, 200), numbers(rng, 200)
    for found, exact in ((two_sum(a, b), Fraction.__add__), (two_product(a, b), Fraction.__mul__)):
        for high, low, x, y in zip(*found, a, b, strict=True):
            assert Fraction(high) + Fraction(low) == exact(Fraction(x), Fraction(y))


def test_rows_are_summed_in_twice_the_precision():
    """Empty rows, short ones and one of all the entries, with nearly everything canceling."""
    rng = np.random.default_rng(2)
    dense = np.where(rng.random((40, 300)) < 0.02, numbers(rng, (40, 300)), 0.0)
    dense[7], dense[8] = numbers(rng, 300), 0.0
    dense[9, :100] = -dense[7, :100]
    matrix = csr_array(dense)
    high, low = Rows(matrix.indptr).sum(matrix.data)
    for i in range(40):
        row = slice(matrix.indptr[i], matrix.indptr[i + 1])
        terms = [Fraction(x) for x in matrix.data[row]]
        size = float(sum(abs(x) for x in terms))
        missed = abs(float(Fraction(high[i]) + Fraction(low[i]) - sum(terms)))
        assert missed <= ((len(terms) + 4) * ROUND) ** 2 * size
        assert abs(low[i]) <= 2.0 * ROUND * abs(high[i])


def test_what_equations_miss_is_bounded():
    """Of sparse and of full arcs, some of which underflow; a state that all others are left to."""
    rng = np.random.default_rng(3)
    for share in (0.1, 0.9):
        n = 50
        dense = np.where(rng.random((n, n)) < share, rng.random((n, n)), 0.0)
        dense[:, 4], dense[4, 5:] = rng.random(n), 0.0
        dense[7] *= 1e-310
        np.fill_diagonal(dense, 0.0)
        arcs, columns = csr_array(dense), csr_array(dense.T)
        outflow = Rows(columns.indptr).sum(columns.data)
        x = Pair(rng.random(n), rng.random(n) * ROUND / 4.0)
        exact = [Fraction(high) + Fraction(low) for high, low in zip(*x, strict=True)]
        total = [sum(map(Fraction, column)) for column in dense.T]
        into = [sum(Fraction(a) * y for a, y in zip(row, exact, strict=True)) for row in dense]
        b = np.array([float(max(t * y - f, 0)) for t, y, f in zip(total, exact, into, strict=True)])
        found, size = Balance(arcs, outflow, Rows(arcs.indptr)).missed(x, b)
        for k in range(n):
            missed = Fraction(b[k]) - total[k] * exact[k] + into[k]
            assert abs(missed) <= Fraction(size[k])
            assert abs(missed - Fraction(found[k])) <= Fraction(size[k])
        assert (size[b > 0.0] < 1e-15).all()
