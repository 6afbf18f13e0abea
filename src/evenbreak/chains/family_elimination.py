"""The limits of many chains with one graph: elimination of states over arrays of chances.

The order of elimination depends on the graph alone. Each step is done for all chains at once,
and free of subtraction, as for one chain (see `elimination` and `blocks`).

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains.blocks import eliminate_together
from evenbreak.chains.elimination import Elimination

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

_Row = dict[int, Any]


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
    rows = _rows(structure, sources, targets, chances)
    with np.errstate(all="ignore"):
        ends, visits, pivots = _ends(structure, rows)
        doubtful = _doubtful(visits, pivots, count)
        limit = np.zeros((len(rows), count))
        for members in _closed(structure):
            mass = _mass(ends, members)
            if len(members) == 1:
                limit[members[0]] = mass
                continue
            among = [_among(rows[state], members) for state in members]
            visits, pivots = _dense_visits(among, count) if _is_dense(among) else _visits(among)
            law = np.array([np.broadcast_to(visited, count) for visited in visits])
            law /= law.max(axis=0)  # first, against overflow
            limit[members] = law / law.sum(axis=0) * mass
            doubtful |= _doubtful(visits, pivots, count)
    return limit, doubtful


def limits_in_numbers(
    structure: Structure, sources: Sequence[int], targets: Sequence[int], chances: Sequence[Any]
) -> dict[int, Any] | None:
    """Return the limits from state 0 that are not 0, in numbers that answer a comparison as one.

    None for a dense class, and where numbers leave the range in which nothing can underflow.
    """
    rows = _rows(structure, sources, targets, chances)
    ends, visits, pivots = _ends(structure, rows)
    limit: dict[int, Any] = {}
    for members in _closed(structure):
        mass = _mass(ends, members)
        if len(members) == 1:
            limit[members[0]] = mass
            continue
        among = [_among(rows[state], members) for state in members]
        if _is_dense(among):
            return None
        law, of_law = _visits(among)
        visits, pivots = [*visits, *law], [*pivots, *of_law]
        share = mass / sum(law, 0.0)
        limit.update((state, visited * share) for state, visited in zip(members, law, strict=True))
    safe = all(_LEAST < x < _MOST for x in visits) and all(x > _LEAST for x in pivots)
    return limit if safe else None


def _rows(
    structure: Structure, sources: Sequence[int], targets: Sequence[int], chances: Sequence[Any]
) -> list[_Row]:
    rows: list[_Row] = [{} for _ in structure.label]
    for j, i, chance in zip(sources, targets, chances, strict=True):
        if i != j:
            rows[j][i] = chance
    return rows


def _closed(structure: Structure) -> Iterator[list[int]]:
    """Yield the states of each closed class."""
    for label in np.flatnonzero(structure.closed).tolist():
        yield structure.members(label).tolist()


def _mass(ends: dict[int, Any], members: list[int]) -> Any:
    return sum((ends[state] for state in members if state in ends), 0.0)


def _is_dense(rows: list[_Row]) -> bool:
    return len(rows) >= _DENSE_FROM and 4 * sum(map(len, rows)) >= len(rows) ** 2


def _ends(structure: Structure, rows: list[_Row]) -> tuple[dict[int, Any], list[Any], list[Any]]:
    """Return the chance of entering the closed classes at each of their states.

    The visits to the states before, and the pivots there, come with it.
    """
    inner = np.flatnonzero(~structure.recurrent).tolist()
    if 0 not in inner:
        return {0: 1.0}, [], []
    kept = set(inner)
    leaks = [sum((p for i, p in rows[j].items() if i not in kept), 0.0) for j in inner]
    elimination = Elimination([_among(rows[j], inner) for j in inner], leaks)
    visits = elimination.visits([1.0 if j == 0 else 0.0 for j in inner])
    ends: dict[int, Any] = {}
    for j, visited in zip(inner, visits, strict=True):
        for i, chance in rows[j].items():
            if i not in kept:
                ends[i] = ends.get(i, 0.0) + visited * chance
    return ends, visits, elimination.pivots


def _among(row: _Row, members: list[int]) -> _Row:
    """Return the arcs to `members`, by their places among these."""
    place = {state: k for k, state in enumerate(members)}
    return {place[i]: chance for i, chance in row.items() if i in place}


def _visits(rows: list[_Row]) -> tuple[list[Any], list[Any]]:
    """Return the visits to the states of a closed class for each one to the first, and pivots."""
    rest = list(range(1, len(rows)))
    elimination = Elimination(
        [_among(row, rest) for row in rows[1:]], [row.get(0, 0.0) for row in rows[1:]]
    )
    visits = elimination.visits([rows[0].get(i, 0.0) for i in rest])
    return [1.0, *visits], [1.0, *elimination.pivots]


def _dense_visits(rows: list[_Row], count: int) -> tuple[list[Any], list[Any]]:
    """Return what `_visits` does, by elimination in arrays, from the last state to the second."""
    last = len(rows) - 1
    chances, absent = [], np.ones((last + 1, last + 1), dtype=bool)
    for j, row in enumerate(rows):
        for i, chance in row.items():
            chances.append((last - i, last - j, np.broadcast_to(chance, count)))
            absent[last - i, last - j] = False
    visits, pivots = np.ones((2, last + 1, count))
    workspace = np.empty((last + 1, last + 1, min(_AT_ONCE, count)))
    for begin in range(0, count, _AT_ONCE):
        part = slice(begin, begin + _AT_ONCE)
        A = workspace[:, :, : len(visits[0, part])]
        A[absent] = 0.0
        for i, j, chance in chances:
            A[i, j] = chance[part]
        pivots[:last, part] = eliminate_together(A, last)
        for k in range(last - 1, -1, -1):
            np.einsum("jc,jc->c", A[k, k + 1 :], visits[k + 1 :, part], out=visits[k, part])
    return list(visits[::-1]), list(pivots[::-1])


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
