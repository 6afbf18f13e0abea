"""Products of many factors, significand and exponent apart, so that none over- or underflows.

A number is a pair: a significand in [1/2, 1) and a whole exponent of 2. A law that spans
thousands of decades keeps all its digits in this form. Only the last step, to floats on a
common scale, turns into zero what is smaller than any float.

Numerators and denominators are multiplied separately. A running product of quotients would
repeat the rounding error of one quotient n times if all are equal; a running product of the
given numbers rounds differently at each step, so its error grows like the square root of n.
"""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from evenbreak.arrays import Floats
    from evenbreak.chains.arcs import Places

_BLOCK = 32
# 32 factors above 2^-30 stay above 2^-960, and so do 900 significands.
_SMALL_FACTOR = 2.0**-30
_STRETCH = 900


def prefix_products(numerators: Floats, denominators: Floats) -> tuple[Floats, Places]:
    """Return, for each i, the first i numerators multiplied over the first i denominators.

    Parameters
    ----------
    numerators, denominators
        shape (n,); positive, at most 1.

    Returns
    -------
    (value, exponent)
        shape (n + 1,) each, beginning with the empty product: the quotients are
        value * 2**exponent, scaled by a common power of 2 so that the largest lies in
        [1/2, 1). Exponents below -5000 become -5000.

    >>> value, exponent = prefix_products(np.full(1500, 0.5), np.full(1500, 1.0))
    >>> np.ldexp(value[[0, 10, 1000]], exponent[[0, 10, 1000]] + 1000)
    array([5.35754304e+300, 5.23197562e+297, 5.00000000e-001])
    """
    n = len(numerators)
    count = -(-n // _BLOCK) or 1
    single = None
    if n and min(numerators.min(), denominators.min()) < _SMALL_FACTOR:
        numerators, above = np.frexp(numerators)
        denominators, below = np.frexp(denominators)
        single = np.cumsum(above, dtype=np.int64) - np.cumsum(below, dtype=np.int64)
    # Row k holds the k-th factor of every block: one vector operation a row.
    rows = np.empty((_BLOCK, 2, count))
    _fill(rows[:, 0], numerators)
    _fill(rows[:, 1], denominators)
    for before, row in itertools.pairwise(rows):
        np.multiply(before, row, out=row)
    block, shift = _prefix_of_blocks(rows[-1])
    quotients = rows[:, 0]
    quotients /= rows[:, 1]
    quotients *= block
    value = np.empty(n + 1)
    value[0] = 1.0
    full = n // _BLOCK
    value[1 : full * _BLOCK + 1].reshape(full, _BLOCK)[:] = quotients[:, :full].T
    value[full * _BLOCK + 1 :] = quotients[: n - full * _BLOCK, -1]
    if single is None:
        top = max(1, int((np.frexp(quotients.max(axis=0))[1] + shift).max()))
        exponent = np.repeat(_cut(shift - top), _BLOCK)[: n + 1]
        return value, np.concatenate((_cut(np.array([-top])), exponent[:n]))
    power = np.concatenate(([0], single + np.repeat(shift, _BLOCK)[:n]))
    top = int((np.frexp(value)[1] + power).max())
    return value, _cut(power - top)


def _fill(rows: Floats, factors: Floats) -> None:
    """Write the factors down the columns of `rows`, and ones after the last of them."""
    full = len(factors) // _BLOCK
    rest = len(factors) - full * _BLOCK
    rows[:, :full] = factors[: full * _BLOCK].reshape(full, _BLOCK).T
    rows[:rest, full:] = factors[full * _BLOCK :, None]
    rows[rest:, full:] = 1.0


def _cut(exponent: Places) -> Places:
    return exponent.clip(-5000).astype(np.int32)


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
    block = np.ones(products.shape[1])
    shift = np.zeros(products.shape[1], dtype=np.int64)
    np.divide(significand[0, :-1], significand[1, :-1], out=block[1:])
    np.subtract(power[0, :-1], power[1, :-1], out=shift[1:])
    return block, shift


def shares(value: Floats, exponent: Places, split: int) -> tuple[float, float]:
    """Return the shares of the first `split` numbers and of the rest in the sum of all.

    >>> shares(np.full(4, 0.5), np.array([0, 0, -2000, -2000]), 2)
    (1.0, 0.0)
    """
    left, left_top = _sum(value[:split], exponent[:split])
    right, right_top = _sum(value[split:], exponent[split:])
    top = max(left_top, right_top)
    a, b = math.ldexp(left, left_top - top), math.ldexp(right, right_top - top)
    return a / (a + b), b / (a + b)


def _sum(value: Floats, exponent: Places) -> tuple[float, int]:
    significand, more = np.frexp(value)
    more += exponent
    top = int(more.max())
    return float(np.ldexp(significand, more - top).sum()), top
