"""Quantiles of a distribution on whole numbers, with ties decided as on paper.

P(length <= k) is often exactly the level asked for (an even race 2:2 lasts two racks
with chance 1/2), and floating sums miss it by an ulp; a tie within 1e-12 of the level
counts as reached.
"""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.checks import number_probability

TIE = 1e-12


def quantile_of(probability: Sequence[float], q: float) -> int:
    """Return the first position whose cumulative probability reaches `q`.

    Parameters
    ----------
    probability
        P(position k), in order; they sum to 1.
    q
        the level, 0 to 1.

    Raises
    ------
    InputError
        if q is not a probability.

    >>> quantile_of([0.5, 0.3, 0.2], 0.5), quantile_of([0.5, 0.3, 0.2], 0.9)
    (0, 2)
    """
    q = number_probability(q, "q")
    found = 0
    if q <= 0.5:
        reached = 0.0
        for found, chance in enumerate(probability):
            reached += chance
            if chance > 0.0 and reached >= q * (1.0 - TIE):
                break
        return found
    # The upper levels are read off the tail, which is a small sum of small terms there.
    tail = 0.0
    for k in range(len(probability) - 1, -1, -1):
        if tail > (1.0 - q) * (1.0 + TIE):
            break
        if probability[k] > 0.0:
            found = k
        tail += probability[k]
    return found
