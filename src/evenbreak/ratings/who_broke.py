"""Who broke each rack, as far as the results tell.

The first rack was broken by `first_break`; who broke the next follows from the break
format and, for winner and loser breaks, from who won the rack before.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import InputError
from evenbreak.ratings.own_break_wins import Splits, split_of, stacked
from evenbreak.ratings.results import FORMATS, Results

_A, _B = FORMATS.index("a"), FORMATS.index("b")


class Broken(NamedTuple):
    """Games by who broke, match by match: shape (3, rows), in the order nobody known, a, b.

    `won` by player a, `lost` by player a. Where the score alone is known, `pattern` says
    which of `splits` applies, else -1; won and lost are then the middle of what may be.
    """

    won: NDArray[np.float64]
    lost: NDArray[np.float64]
    pattern: NDArray[np.int64]
    splits: Splits


def count_broken(results: Results) -> Broken:
    """Return how many games each match had in which it is not known who broke, a broke, b broke.

    Known it is in matches that one player broke throughout (break format a or b); rack by
    rack where `racks` and the break format are given, and for alternate breaks, and the
    first rack of all others, `first_break`; and in number where break format, `first_break`
    and a race are given that one of the players reached (see `evenbreak.ratings.own_break_wins`).

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
    (array([0., 2., 1.]), array([0., 1., 0.]))
    """
    rows = len(results)
    won, lost = np.zeros((3, rows)), np.zeros((3, rows))
    form = np.zeros(rows, np.int8) if results.break_format is None else results.break_format
    first = np.zeros(rows, np.int8) if results.first_break is None else results.first_break
    for code, side in ((_A, 1), (_B, 2)):
        same = form == code
        won[side, same] = results.score_a[same]
        lost[side, same] = results.score_b[same]
    stated = np.zeros(rows, dtype=bool)
    if results.racks is not None:
        stated = np.array([bool(text) for text in results.racks], dtype=bool)
        told = stated & (form != _A) & (form != _B) & ((form > 0) | (first > 0))
        for row in np.flatnonzero(told):
            text = results.racks[row]
            breakers = _breakers(text, FORMATS[form[row]], int(first[row]))
            for winner, breaker in zip(text, breakers, strict=True):
                (won if winner == "a" else lost)[breaker, row] += 1
            won[0, row] = lost[0, row] = 0
    last = _last_winner(results)
    scores = (form > 0) & (form != _A) & (form != _B) & (first > 0) & ~stated & (last > 0)
    pattern, splits = _by_score(results, np.flatnonzero(scores), form, first, last, won, lost)
    won[0] = results.score_a - won[1:].sum(axis=0)
    lost[0] = results.score_b - lost[1:].sum(axis=0)
    if (won[0] < 0).any() or (lost[0] < 0).any():
        raise InputError("racks hold more games than the score; correct what find_problems tells")
    return Broken(won, lost, pattern, splits)


def _last_winner(results: Results) -> NDArray[np.int8]:
    """Return who won the last rack, 0 where no race says so: who alone reached the race."""
    if results.race_a is None or results.race_b is None:
        return np.zeros(len(results), np.int8)
    raced = (results.race_a > 0) & (results.race_b > 0)
    a, b = results.score_a == results.race_a, results.score_b == results.race_b
    a_short, b_short = results.score_a < results.race_a, results.score_b < results.race_b
    return np.where(raced & a & b_short, 1, np.where(raced & b & a_short, 2, 0)).astype(np.int8)


def _by_score(
    results: Results,
    rows: NDArray[np.intp],
    form: NDArray[np.int8],
    first: NDArray[np.int8],
    last: NDArray[np.int8],
    won: NDArray[np.float64],
    lost: NDArray[np.float64],
) -> tuple[NDArray[np.int64], Splits]:
    """Fill in the games of matches known by their score, and return how they may have split."""
    pattern = np.full(len(results), -1)
    keys = np.column_stack([form, first, last, results.score_a, results.score_b])[rows]
    distinct, place = np.unique(keys, axis=0, return_inverse=True)
    splits = []
    for f, breaker, winner, i, j in distinct.tolist():
        splits.append(split_of(FORMATS[f], breaker, (i, j), winner))
    middle = np.array([(split.won[0] + split.won[-1]) / 2 for split in splits])[place]
    broke_a = np.array([split.broke_a for split in splits])[place]
    score_a, score_b = results.score_a[rows], results.score_b[rows]
    pattern[rows] = place
    won[1, rows], lost[1, rows] = middle, broke_a - middle
    won[2, rows], lost[2, rows] = score_a - middle, score_b - (broke_a - middle)
    return pattern, stacked(splits)


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
