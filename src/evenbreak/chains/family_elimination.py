"""The limits of many chains with one graph: elimination of states over arrays of chances.

The order of elimination depends on the graph alone. Each step is done for all chains at once,
and free of subtraction, as for one chain (see `elimination` and `blocks`).

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains.blocks import eliminate_together
from evenbreak.chains.dense_elimination import is_dense
from evenbreak.chains.elimination import Rows, eliminated, limit_in

if TYPE_CHECKING:
    from evenbreak.arrays import Bools, Floats
    from evenbreak.chains.structure import Structure

_DENSE_FROM = 8
"""A class of so many states with a quarter of all arcs is eliminated in a dense array."""
_AT_ONCE = 512
"""So many dense chains at a time: the calls of numpy cost little, and the caches still help."""
_SMALL = 1e-290
"""A float below this, beside the largest, may have lost digits to underflow."""

_LEAST, _MOST = 1e-120, 1e40
"""Visits between these, with pivots above the first, are far from what `_SMALL` excludes."""


def family_limits(
    structure: Structure,
    sources: Sequence[int],
    targets: Sequence[int],
    chances: Sequence[Floats | float],
    count: int,
) -> tuple[Floats, Bools]:
    """Return the limits from state 0, and which of them have to be calculated one by one.

    Parameters
    ----------
    structure
        the classes of the graph, all of which can be reached from state 0.
    sources, targets
        the arcs, which may include self-loops.
    chances
        for each arc, the positive chance of the target, given the source: shape (k,), or one
        number for all chains.
    count
        the number of chains k.

    Returns
    -------
    tuple of arrays
        the limits, shape (n, k) for n states and k chains; and, of shape (k,), whether a limit
        spans so many decades that underflow may have touched it.

    >>> from scipy.sparse import csc_array
    >>> from evenbreak.chains.arcs import arcs_of
    >>> from evenbreak.chains.structure import structure_of
    >>> sources, targets = [0, 0, 2, 2], [1, 2, 3, 0]
    >>> one_ball = structure_of(arcs_of(csc_array((np.ones(4), (targets, sources)), shape=(4, 4))))
    >>> p1, p2 = np.array([0.5, 0.25]), 0.5
    >>> limits, doubtful = family_limits(one_ball, sources, targets, [p1, 1 - p1, p2, 1 - p2], 2)
    >>> limits[[1, 3]]
    array([[0.66666667, 0.4       ],
           [0.33333333, 0.6       ]])
    """
    rows, doubtful = _rows(structure, sources, targets, chances), np.zeros(count, dtype=bool)

    def visits_of(rows: Rows, states: Sequence[int], b: list[Any]) -> list[Any]:
        nonlocal doubtful
        if _is_dense(rows, states):
            visits, pivots = _dense_visits(rows, states, b, count)
        else:
            elimination = eliminated(rows, states)
            visits, pivots = elimination.visits(b), elimination.pivots
        doubtful |= _doubtful([1.0, *visits], [1.0, *pivots], count)
        return visits

    with np.errstate(all="ignore"):
        limit = np.zeros((len(rows), count))
        for state, share in limit_in(structure, rows, {0: 1.0}, visits_of).items():
            limit[state] = share
    return limit, doubtful


def limits_in_numbers(
    structure: Structure, sources: Sequence[int], targets: Sequence[int], chances: Sequence[Any]
) -> dict[int, Any] | None:
    """Return the limits from state 0 that are not 0, in numbers that answer a comparison as one.

    None for a dense class, and where numbers leave the range in which nothing can underflow.
    """
    rows, safe = _rows(structure, sources, targets, chances), True

    def visits_of(rows: Rows, states: Sequence[int], b: list[Any]) -> list[Any]:
        nonlocal safe
        safe = safe and not _is_dense(rows, states)
        if not safe:
            return b
        elimination = eliminated(rows, states)
        visits = elimination.visits(b)
        safe = all(_LEAST < x < _MOST for x in visits)
        safe = safe and all(x > _LEAST for x in elimination.pivots)
        return visits

    limit = limit_in(structure, rows, {0: 1.0}, visits_of)
    return limit if safe else None


def _rows(
    structure: Structure, sources: Sequence[int], targets: Sequence[int], chances: Sequence[Any]
) -> Rows:
    rows: Rows = [{} for _ in structure.label]
    for j, i, chance in zip(sources, targets, chances, strict=True):
        if i != j:
            rows[j][i] = chance
    return rows


def _is_dense(rows: Rows, states: Sequence[int]) -> bool:
    inside = set(states)
    arcs = sum(len(rows[state].keys() & inside) for state in states)
    return len(states) >= _DENSE_FROM and is_dense(len(states), arcs)


def _dense_visits(
    rows: Rows, states: Sequence[int], b: list[Any], count: int
) -> tuple[list[Any], list[Any]]:
    """Return the visits to states and their pivots, by elimination in arrays.

    The last place is for all other states: what leaves goes there, and `b` comes from there.
    """
    last = len(states)
    place = {state: k for k, state in enumerate(states)}
    chances = {(k, last): chance for k, chance in enumerate(b)}
    for j, state in enumerate(states):
        for target, chance in rows[state].items():
            at = place.get(target, last), j
            chances[at] = chances[at] + chance if at in chances else chance
    arcs = [(i, j, np.broadcast_to(chance, count)) for (i, j), chance in chances.items()]
    absent = np.ones((last + 1, last + 1), dtype=bool)
    absent[tuple(zip(*chances, strict=True))] = False
    visits, pivots = np.ones((2, last + 1, count))
    workspace = np.empty((last + 1, last + 1, min(_AT_ONCE, count)))
    for begin in range(0, count, _AT_ONCE):
        part = slice(begin, begin + _AT_ONCE)
        A = workspace[:, :, : len(visits[0, part])]
        A[absent] = 0.0
        for i, j, chance in arcs:
            A[i, j] = chance[part]
        pivots[:last, part] = eliminate_together(A, last)
        for k in range(last - 1, -1, -1):
            np.einsum("jc,jc->c", A[k, k + 1 :], visits[k + 1 :, part], out=visits[k, part])
    return list(visits[:last]), list(pivots[:last])


def _doubtful(x: Sequence[Any], pivots: Sequence[Any], count: int) -> Bools:
    """Return for which chains overflow or underflow may have touched the visits x."""
    top: Any = 1.0
    for visited in x:
        top = np.maximum(top, visited)
    least = _SMALL * len(x) * top
    safe = np.broadcast_to(least < np.inf, count).copy()
    for visited, pivot in zip(x, pivots, strict=True):
        safe &= visited >= least / pivot
    return ~safe
