"""The complement of a probability, with the digits of its decimal."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, overload

if TYPE_CHECKING:
    from evenbreak.arrays import Floats

_DECIMALS = 1e15


@overload
def complement(p: float) -> float: ...
@overload
def complement(p: Floats) -> Floats: ...
def complement(p: Any) -> Any:
    """Return 1 - p, computed in decimal if p has at most 15 decimals: .1 for .9.

    So a small chance of losing keeps its digits. For other values, 1 - p is a float, or a
    `Fraction` or sympy formula if p is one.

    >>> complement(0.9), 1.0 - 0.9
    (0.1, 0.09999999999999998)
    """
    if isinstance(p, Fraction) or hasattr(p, "free_symbols"):
        return 1 - p
    left = 1.0 - p
    if isinstance(left, float):
        decimal = round(left * _DECIMALS) / _DECIMALS
        return decimal if 1.0 - decimal == p else left
    import numpy as np

    decimals = np.rint(left * _DECIMALS) / _DECIMALS
    # The difference is exact where the decimal is the right one. This is a choice without branches.
    return left + (decimals - left) * (1.0 - decimals == p)
