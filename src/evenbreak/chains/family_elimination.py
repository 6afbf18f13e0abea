"""The limits of many chains with one graph: elimination of states over arrays of chances.

The order of elimination depends on the graph alone. Each step is done for all chains at once,
and free of subtraction, as for one chain (see `elimination` and `dense_elimination`).

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

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
    n = len(structure.label)
    rows: list[_Row] = [{} for _ in range(n)]
    for j, i, chance in zip(sources, targets, chances, strict=True):
        if i != j:
            rows[j][i] = chance
    with np.errstate(all="ignore"):
        ends, doubtful = _ends(structure, rows, count)
        limit = np.zeros((n, count))
        for label in np.flatnonzero(structure.closed).tolist():
            members = structure.members(label).tolist()
            mass = sum((ends[state] for state in members if state in ends), 0.0)
            if len(members) == 1:
                limit[members[0]] = mass
                continue
            law, in_doubt = _law([_among(rows[state], members) for state in members], count)
            limit[members] = law * mass
            doubtful |= in_doubt
    return limit, doubtful


def _ends(structure: Structure, rows: list[_Row], count: int) -> tuple[dict[int, Any], Bools]:
    """Return the chance of entering the closed classes at each of their states."""
    inner = np.flatnonzero(~structure.recurrent).tolist()
    if 0 not in inner:
        return {0: np.ones(count)}, np.zeros(count, dtype=bool)
    kept = set(inner)
    leaks = [sum((p for i, p in rows[j].items() if i not in kept), 0.0) for j in inner]
    elimination = Elimination([_among(rows[j], inner) for j in inner], leaks)
    visits = elimination.visits([1.0 if j == 0 else 0.0 for j in inner])
    ends: dict[int, Any] = {}
    for j, visited in zip(inner, visits, strict=True):
        for i, chance in rows[j].items():
            if i not in kept:
                ends[i] = ends.get(i, 0.0) + visited * chance
    return ends, _doubtful(visits, elimination.pivots, count)


def _among(row: _Row, members: list[int]) -> _Row:
    """Return the arcs to `members`, by their places among these."""
    place = {state: k for k, state in enumerate(members)}
    return {place[i]: chance for i, chance in row.items() if i in place}


def _law(rows: list[_Row], count: int) -> tuple[Floats, Bools]:
    """Return the stationary law of the class that the arcs make, shape (m, k), and the doubts."""
    size = len(rows)
    if size >= _DENSE_FROM and 4 * sum(map(len, rows)) >= size * size:
        return _dense_laws(rows, count)
    from_cut, rest = rows[0], list(range(1, size))
    elimination = Elimination(
        [_among(row, rest) for row in rows[1:]], [row.get(0, 0.0) for row in rows[1:]]
    )
    visits = elimination.visits([from_cut.get(i, 0.0) for i in rest])
    law = np.empty((size, count))
    law[0] = 1.0
    for k, visited in enumerate(visits, 1):
        law[k] = visited
    return _scaled(law), _doubtful([1.0, *visits], [1.0, *elimination.pivots], count)


def _dense_laws(rows: list[_Row], count: int) -> tuple[Floats, Bools]:
    """Return the laws by elimination in arrays of (source, target, chain)."""
    size = len(rows)
    chances, absent = [], np.ones((size, size), dtype=bool)
    for j, row in enumerate(rows):
        for i, chance in row.items():
            chances.append((j, i, np.broadcast_to(chance, count)))
            absent[j, i] = False
    law, pivots = np.empty((size, count)), np.ones((size, count))
    workspace = np.empty((size, size, min(_AT_ONCE, count)))
    for begin in range(0, count, _AT_ONCE):
        part = slice(begin, begin + _AT_ONCE)
        A = workspace[:, :, : len(law[0, part])]
        A[absent] = 0.0
        for j, i, chance in chances:
            A[j, i] = chance[part]
        # Each row and column is finished in its turn, from all that were finished before.
        for k in range(size - 1, 0, -1):
            out, back, done = A[k, :k], A[:k, k], slice(k + 1, size)
            out += np.einsum("lc,lic->ic", A[k, done], A[done, :k])
            back += np.einsum("jlc,lc->jc", A[:k, done], A[done, k])
            pivots[k, part] = out.sum(axis=0)
            back /= pivots[k, part]
        law[0, part] = 1.0
        for k in range(1, size):
            np.einsum("jc,jc->c", law[:k, part], A[:k, k], out=law[k, part])
    return _scaled(law), _doubtful(list(law), list(pivots), count)


def _scaled(law: Floats) -> Floats:
    """Return the laws with sums of 1, scaled to a largest entry of 1 first against overflow."""
    law = law / law.max(axis=0)
    return np.asarray(law / law.sum(axis=0))


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
