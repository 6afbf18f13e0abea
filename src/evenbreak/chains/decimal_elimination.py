"""Elimination in decimal numbers of 40 digits and practically unbounded exponents.

It serves long and narrow classes, in which the rounding errors of doubles add up, and laws
that span more decades than doubles do: intermediate results would over- or underflow, and
digits of the answer with them. It is slow (some microseconds an arc), and refuses to start
on what would take more than seconds.
"""

from __future__ import annotations

import math
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal, localcontext
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains.elimination import Elimination, eliminated, masses_in

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from evenbreak.arrays import Floats
    from evenbreak.chains.arcs import Arcs
    from evenbreak.chains.structure import Structure

_CONTEXT = Context(prec=40, Emax=MAX_EMAX, Emin=MIN_EMIN)
MOST_ARCS = 3e6
"""More are refused where that may take more than seconds."""


def rows_of(arcs: Arcs, number: Callable[[float], Any] = float) -> list[dict[int, Any]]:
    """Return the arcs as a dictionary for each source: target to chance."""
    rows: list[dict[int, Any]] = [{} for _ in range(arcs.size)]
    chances = map(number, arcs.chances.tolist())
    for j, i, chance in zip(arcs.sources.tolist(), arcs.targets.tolist(), chances, strict=True):
        rows[j][i] = chance
    return rows


class PlainElimination:
    """(I - T) factored with a dictionary for each state: the fastest for a few dozen states.

    Parameters
    ----------
    arcs
        the arcs of m states among themselves.
    leak
        shape (m,): the probability of leaving them, given the state.
    most
        the number of arcs to make at most.

    Raises
    ------
    AccuracyError
        if the elimination would take too long.
    """

    bound, is_proved = None, False
    _number: Callable[[float], Any] = float

    def __init__(self, arcs: Arcs, leak: Floats, most: float = math.inf) -> None:
        with localcontext(_CONTEXT):
            leaks = [*map(self._number, leak.tolist())]
            self._factor = Elimination(rows_of(arcs, self._number), leaks, most)
            self.pivots = _floats(self._factor.pivots)

    def visits(self, b: Floats) -> Floats:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        return self._columns(b, self._factor.visits)

    def values(self, r: Floats) -> Floats:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        return self._columns(r, self._factor.values)

    def _columns(self, b: Floats, solve: Callable[[list[Any]], list[Any]]) -> Floats:
        with localcontext(_CONTEXT):
            columns = ([*map(self._number, column)] for column in b.T.tolist())
            return np.array([_floats(solve(column)) for column in columns]).T


class DecimalElimination(PlainElimination):
    """(I - T) factored in decimal numbers; answers are floats, inf where floats end."""

    _number = Decimal


def decimal_masses(structure: Structure, v: Floats) -> Floats:
    """Return the probability of ending in each class from the density v; shape (classes,).

    Expected visits that are larger than any float may be on the way.

    Raises
    ------
    AccuracyError
        if the elimination would take too long.
    """
    with localcontext(_CONTEXT):
        rows, density = rows_of(structure.arcs, Decimal), dict(enumerate(map(Decimal, v.tolist())))
        masses = masses_in(structure, rows, density, partial(_visits, rows))
        return _floats([masses.get(label, Decimal(0)) for label in range(structure.count)])


def decimal_law(arcs: Arcs) -> Floats:
    """Return the stationary law of the one closed class that the arcs make; shape (m,).

    Raises
    ------
    AccuracyError
        if the elimination would take too long.
    """
    with localcontext(_CONTEXT):
        rows, rest = rows_of(arcs, Decimal), range(1, arcs.size)
        law = [Decimal(1), *_visits(rows, rest, [rows[0].get(i, Decimal(0)) for i in rest])]
        total = sum(law)
        return _floats([value / total for value in law])


def _visits(
    rows: list[dict[int, Decimal]], states: Sequence[int], b: list[Decimal]
) -> list[Decimal]:
    return eliminated(rows, states, MOST_ARCS).visits(b)


def _floats(values: list[Decimal]) -> Floats:
    return np.array([float(value) for value in values])
