"""Probabilities as the decimals that people write: .9 is nine tenths.

Ties are real: with p = .5 the chance of a score of 7 or less after 8 innings is one half
exactly, and ceil((2 x .9 - 1) / (1 - .9)) is 8 but 9 in floats. So modes, medians and
quantiles are decided in rational arithmetic wherever floats come near a tie.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from evenbreak.errors import InputError


def exact(p: Any, name: str = "p") -> Fraction:
    """Return a probability as the fraction that was meant.

    Parameters
    ----------
    p
        a number from 0 to 1: a `Fraction` or an int as it stands, a float as the shortest
        decimal that reads back as it, so that .9 is 9/10.
    name
        what the value is called where the caller wrote it.

    Raises
    ------
    InputError
        if p is not a number from 0 to 1.

    >>> exact(0.9), exact(Fraction(24, 25)), exact(1)
    (Fraction(9, 10), Fraction(24, 25), Fraction(1, 1))
    """
    try:
        if isinstance(p, str | bytes) or getattr(p, "ndim", False):
            raise TypeError
        number = p if isinstance(p, Fraction) else float(p)
    except (TypeError, ValueError):
        number = math.nan
    if not 0 <= number <= 1:
        raise InputError(f"{name} is {p!r}, not a probability; give a number from 0 to 1")
    return number if isinstance(number, Fraction) else Fraction(repr(number))
