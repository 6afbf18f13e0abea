"""Probabilities as the decimals that people write: .9 is nine tenths.

Ties are real. With p = .5 the chance of a score of 7 or less after 8 innings is exactly one
half, and ceil((2 x .9 - 1) / (1 - .9)) is 8, but 9 in floats. So wherever floats come near a
tie, modes, medians and quantiles are decided in rational arithmetic.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from evenbreak.checks import number_probability


def exact(p: Any, name: str = "p") -> Fraction:
    """Return a probability as the fraction that its decimal means.

    Parameters
    ----------
    p
        a number from 0 to 1: a `Fraction` or an int is taken as it is, a float as the
        shortest decimal that reads back as the same float, so that .9 is 9/10.
    name
        what to call the value in a message.

    Raises
    ------
    InputError
        if p is not a number from 0 to 1.

    >>> exact(0.9), exact(Fraction(24, 25)), exact(1)
    (Fraction(9, 10), Fraction(24, 25), Fraction(1, 1))
    """
    if isinstance(p, Fraction) and 0 <= p <= 1:
        return p
    return Fraction(repr(number_probability(p, name)))
