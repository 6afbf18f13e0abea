"""Quantiles of a distribution on whole numbers, exact where probabilities tie with the level.

P(length <= k) is often exactly the requested level (an even race 2:2 lasts two racks with
probability 1/2), and sums of floats miss it by the last digit. So the level counts as reached
within a relative tolerance of 1e-12.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

from evenbreak.checks import number_probability

TIE = 1e-12


def quantile_of(probability: Sequence[float], q: float) -> int:
    """Return the first position whose cumulative probability reaches `q`.

    Raises InputError if q is not a probability.

    >>> quantile_of([0.5, 0.3, 0.2], 0.5), quantile_of([0.5, 0.3, 0.2], 0.9)
    (0, 2)
    """
    q = number_probability(q, "q")
    possible = [k for k, chance in enumerate(probability) if chance > 0.0]
    if q <= 0.5:
        totals = accumulate(probability[k] for k in possible)
        reached = (k for k, total in zip(possible, totals, strict=True) if total >= q * (1.0 - TIE))
        return next(reached)
    # The upper levels are read off the tail, a small sum of small terms.
    tail = 0.0
    for k in reversed(possible):
        tail += probability[k]
        if tail > (1.0 - q) * (1.0 + TIE):
            return k
    return possible[0]
