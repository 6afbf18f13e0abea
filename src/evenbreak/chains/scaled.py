"""Products of many factors, significand and exponent apart, so that none over- or underflows.

A number is a pair: a significand in [1/2, 1) and a whole exponent of 2. A law that spans
thousands of decades keeps all its digits in this form. Only the last step, to floats on a
common scale, turns into zero what is smaller than any float.

Numerators and denominators are multiplied separately. A running product of quotients would
repeat the rounding error of one quotient n times if all are equal; a running product of the
given numbers rounds differently at each step, so its error grows like the square root of n.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from evenbreak.arrays import Floats
    from evenbreak.chains.arcs import Places

_BLOCK = 32
# 32 factors above 2^-30 stay above 2^-960, and so do 900 significands.
_SMALL_FACTOR = 2.0**-30
_STRETCH = 900
_HIGH = 900
"""Terms are added up at this power of 2, from where those that count do not underflow."""


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
    """Return the shares of the first `split` numbers and of the rest in the sum of all.

    >>> shares(np.full(4, 0.5), np.array([0, 0, -2000, -2000]), 2)
    (1.0, 0.0)
    """
    significand, more = np.frexp(value)
    power = more + exponent
    terms = np.ldexp(significand, power - power.max() + _HIGH)
    left, right = float(terms[:split].sum()), float(terms[split:].sum())
    return left / (left + right), right / (left + right)
