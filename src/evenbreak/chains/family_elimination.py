"""Limits of many chains with the same graph: elimination of states over arrays of chances.

The order of elimination depends on the graph alone. Each step is done for all chains at once,
and free of subtraction, as for one chain (see `elimination` and `factorization`).

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.arrays import Bools
from evenbreak.chains.dense_elimination import is_dense
from evenbreak.chains.elimination import Rows, eliminated, limit_in
from evenbreak.chains.factorization import eliminate_together
from evenbreak.chains.family_numbers import Disagreement, Numbers

if TYPE_CHECKING:
    from evenbreak.chains.structure import Structure

_DENSE_FROM = 8
"""Number of states at which a class with a quarter of all arcs is eliminated in a dense array."""
_AT_ONCE = 512
"""Dense chains at a time: numpy's overhead is small, and the caches still help."""
_SMALL = 1e-290
"""Relative to the largest, a float below this may have lost digits to underflow."""
_LEAST, _MOST = 1e-120, 1e40
"""Range of visits, with pivots above the first number, that is far from what `_SMALL` excludes."""


def family_limits(
    structure: Structure,
    sources: Sequence[int],
    targets: Sequence[int],
    chances: Sequence[Numbers | float],
    count: int,
) -> tuple[dict[int, Numbers | float], Bools | None]:
    """Return the limits from state 0, and which of them have to be calculated one by one.

    All classes in the structure must be reachable from state 0; arcs may include self-loops. An
    arc's positive chance of the target, given the source, is `count` numbers, or one for all
    chains. The array, shape (count,), is whether a limit spans so many decades that underflow may
    have affected it. None: no limit does, nor does any other chain that gives the same answers.
    """
    rows: Rows = [{} for _ in structure.label]
    for j, i, chance in zip(sources, targets, chances, strict=True):
        if i != j:
            rows[j][i] = chance
    doubtful: Any = None

    def visits_of(rows: Rows, states: Sequence[int], b: list[Any]) -> list[Any]:
        nonlocal doubtful
        if _is_dense(rows, states):
            visits, pivots = _dense_visits(rows, states, b, count)
        else:
            elimination = eliminated(rows, states)
            visits, pivots = elimination.visits(b), elimination.pivots
            if _are_safe(visits, pivots):
                return visits
        lost = _doubtful([*map(_plain, visits)], [*map(_plain, pivots)])
        doubtful = lost if doubtful is None else doubtful | lost
        return visits

    with np.errstate(all="ignore"):
        return limit_in(structure, rows, {0: 1.0}, visits_of), doubtful


def _is_dense(rows: Rows, states: Sequence[int]) -> bool:
    inside = set(states)
    arcs = sum(len(rows[state].keys() & inside) for state in states)
    return len(states) >= _DENSE_FROM and is_dense(len(states), arcs)


def _dense_visits(
    rows: Rows, states: Sequence[int], b: list[Any], count: int
) -> tuple[list[Any], list[Any]]:
    """Return the visits to states and their pivots, by elimination in arrays.

    The last place stands for all other states: outgoing flow goes there, and `b` comes from there.
    """
    last = len(states)
    place = {state: k for k, state in enumerate(states)}
    chances = {(k, last): chance for k, chance in enumerate(b)}
    for j, state in enumerate(states):
        for target, chance in rows[state].items():
            at = place.get(target, last), j
            chances[at] = chances[at] + chance if at in chances else chance
    arcs = [(i, j, np.broadcast_to(_plain(chance), count)) for (i, j), chance in chances.items()]
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
    return [*map(Numbers, visits[:last])], [*map(Numbers, pivots[:last])]


def _are_safe(visits: Sequence[Any], pivots: Sequence[Any]) -> bool:
    """Return whether all chains' visits and pivots are far from any effect of underflow."""
    try:
        return all(_LEAST < x < _MOST for x in visits) and all(x > _LEAST for x in pivots)
    except Disagreement:
        return False


def _doubtful(visits: Sequence[Any], pivots: Sequence[Any]) -> Any:
    """Return for which chains overflow or underflow may have affected the visits."""
    top: Any = 1.0
    low: Any = 1.0
    for visited, pivot in zip(visits, pivots, strict=True):
        top = np.maximum(top, visited)
        low = np.minimum(low, visited * pivot)
    least = _SMALL * (len(visits) + 1) * top
    return np.logical_not((low >= least) & (least < np.inf))


def _plain(number: Any) -> Any:
    return number.values if isinstance(number, Numbers) else number
