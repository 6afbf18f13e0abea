"""Who broke each rack, as far as the results tell.

The first rack was broken by `first_break`; who broke the next follows from the break
format and, for winner and loser breaks, from who won the rack before.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import InputError
from evenbreak.ratings.results import FORMATS, Results

__all__ = ["Broken", "count_broken"]

_A, _B = FORMATS.index("a"), FORMATS.index("b")


class Broken(NamedTuple):
    """Games by who broke, match by match: shape (3, rows), in the order nobody known, a, b.

    `won` by player a, `lost` by player a.
    """

    won: NDArray[np.int64]
    lost: NDArray[np.int64]


def count_broken(results: Results) -> Broken:
    """Return how many games each match had in which it is not known who broke, a broke, b broke.

    Known it is in matches that one player broke throughout (break format a or b), and
    rack by rack where `racks` and the break format are given; for alternate breaks, and
    the first rack of all others, `first_break` is needed too.

    Parameters
    ----------
    results
        matches that were played.

    Raises
    ------
    InputError
        if racks do not fit the score (see `find_problems`).

    >>> season = Results.from_names(
    ...     ["Ann"], ["Bo"], [3], [1], racks=["abaa"], first_break=[1], break_format=[1]
    ... )
    >>> count_broken(season).won[:, 0], count_broken(season).lost[:, 0]  # winner breaks
    (array([0, 2, 1]), array([0, 1, 0]))
    """
    rows = len(results)
    won, lost = np.zeros((3, rows), np.int64), np.zeros((3, rows), np.int64)
    form = np.zeros(rows, np.int8) if results.break_format is None else results.break_format
    first = np.zeros(rows, np.int8) if results.first_break is None else results.first_break
    for code, side in ((_A, 1), (_B, 2)):
        same = form == code
        won[side, same] = results.score_a[same]
        lost[side, same] = results.score_b[same]
    if results.racks is not None:
        for row in np.flatnonzero((form != _A) & (form != _B) & ((form > 0) | (first > 0))):
            text = results.racks[row]
            breakers = _breakers(text, FORMATS[form[row]], int(first[row]))
            for winner, breaker in zip(text, breakers, strict=True):
                (won if winner == "a" else lost)[breaker, row] += 1
            won[0, row] = lost[0, row] = 0
    won[0] = results.score_a - won[1:].sum(axis=0)
    lost[0] = results.score_b - lost[1:].sum(axis=0)
    if (won[0] < 0).any() or (lost[0] < 0).any():
        raise InputError("racks hold more games than the score; correct what find_problems tells")
    return Broken(won, lost)


def _breakers(racks: str, form: str, first: int) -> list[int]:
    """Return who broke each rack: 1 for a, 2 for b, 0 where it is not known."""
    if form == "alternate":
        other = 3 - first if first else 0
        return [first if k % 2 == 0 else other for k in range(len(racks))]
    winners = [1 if letter == "a" else 2 for letter in racks]
    if form == "winner":
        return [first, *winners][: len(racks)]
    if form == "loser":
        return [first, *(3 - winner for winner in winners)][: len(racks)]
    return [first, *[0] * len(racks)][: len(racks)]
