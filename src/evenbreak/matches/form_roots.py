"""Every zero of a form with whole coefficients for 0 < p < 1.

By Descartes' rule, the changes of sign in the coefficients of p^k q^(N-k) bound the number of
zeros; with no change there is none, with one change there is one. With more changes the
interval is halved and the form rewritten for each half (Vincent; Collins & Akritas 1976). All
of it is done in whole numbers, so rounding neither makes a zero nor loses one.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from evenbreak.matches.win_forms import Form, value_at

_FINEST = 48
"""Halvings after which zeros that are still together count as one."""
_BITS = 64
"""Halvings of an interval with one zero: more than a float can resolve."""


def form_roots(form: Sequence[int]) -> list[float] | None:
    """Return the zeros of a form in 0 < p < 1, ascending; None if it is zero everywhere.

    Zeros closer together than 2^-48 count as one.

    >>> form_roots([-1, 1]), form_roots([1, 1]), form_roots([0, 0])
    ([0.5], [], None)
    """
    if not any(form):
        return None
    found: list[float] = []
    queue = [(_stripped(list(form)), 0, 0)]
    while queue:
        part, place, depth = queue.pop()
        changes = _changes(part)
        if changes == 1:
            found.append(_refined(part, place, depth))
        elif changes and depth == _FINEST:
            found.append((place + 0.5) / 2**depth)
        elif changes:
            left, right = _halves(part)
            if right[0] == 0:
                found.append((2 * place + 1) / 2 ** (depth + 1))
            queue.append((_stripped(left), 2 * place, depth + 1))
            queue.append((_stripped(right), 2 * place + 1, depth + 1))
    return sorted(found)


def sign_at(form: Sequence[int], p: float) -> int:
    """Return the sign of a form at p: -1, 0 or 1, exactly.

    >>> sign_at([-1, 1], 0.5), sign_at([-1, 1], 0.5000000000000001)
    (0, 1)
    """
    numerator, denominator = p.as_integer_ratio()
    value = value_at(form, numerator, denominator - numerator)
    return (value > 0) - (value < 0)


def _stripped(form: Form) -> Form:
    """Return the form without its factors p and q, which are zero only at the ends."""
    places = [k for k, c in enumerate(form) if c]
    return form[places[0] : places[-1] + 1]


def _changes(form: Form) -> int:
    signs = [c > 0 for c in form if c]
    return sum(one != two for one, two in pairwise(signs))


def _refined(form: Form, place: int, depth: int) -> float:
    """Return the one zero of a form that is written for interval number `place` of 2^depth."""
    low, rising = 0, form[-1] > 0
    for bit in range(1, _BITS + 1):
        low *= 2
        middle = value_at(form, low + 1, 2**bit - low - 1)
        if middle == 0:
            low, bits = low + 1, bit
            break
        low += (middle < 0) == rising
    else:
        low, bits = 2 * low + 1, _BITS + 1
    # A quotient of whole numbers is the nearest float to it.
    return ((place << bits) + low) / (1 << (bits + depth))


def _halves(form: Form) -> tuple[Form, Form]:
    """Return the form as p and q run over the lower and over the upper half."""
    left = _moved(form[::-1])[::-1]
    return left, _moved(form)


def _moved(form: Form) -> Form:
    """Return the coefficients of f(1 + 2x), from those of f(x)."""
    shifted = list(form)
    for i in range(len(form) - 1):
        for k in range(len(form) - 2, i - 1, -1):
            shifted[k] += shifted[k + 1]
    return [c << k for k, c in enumerate(shifted)]
