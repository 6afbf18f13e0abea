"""Elimination in decimal numbers of 40 digits and practically unbounded exponents.

It serves long and narrow classes, in which the rounding errors of doubles add up, and laws
that span more decades than doubles do: intermediate results would over- or underflow, and
digits of the answer with them. It is slow (some microseconds an arc), and refuses to start
on what would take more than seconds.
"""

from __future__ import annotations

import math
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal, localcontext
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.chains.elimination import Elimination, eliminated

if TYPE_CHECKING:
    from collections.abc import Callable

    from evenbreak.arrays import Floats
    from evenbreak.chains.arcs import Arcs, Places

_CONTEXT = Context(prec=40, Emax=MAX_EMAX, Emin=MIN_EMIN)
_MOST_ARCS = 3e6


def rows_of(arcs: Arcs) -> list[dict[int, float]]:
    """Return the arcs as a dictionary for each source: target to chance."""
    rows: list[dict[int, float]] = [{} for _ in range(arcs.size)]
    for j, i, chance in zip(
        arcs.sources.tolist(), arcs.targets.tolist(), arcs.chances.tolist(), strict=True
    ):
        rows[j][i] = chance
    return rows


class DecimalElimination:
    """(I - T) factored in decimal numbers; answers are floats, inf where floats end.

    Parameters
    ----------
    arcs
        the arcs of m states among themselves.
    leak
        shape (m,): the probability of leaving them, given the state.

    Raises
    ------
    AccuracyError
        if the elimination would take too long.
    """

    def __init__(self, arcs: Arcs, leak: Floats, most: float = math.inf) -> None:
        with localcontext(_CONTEXT):
            self._factor = _factor(arcs, leak, most)
            self.pivots = _floats(self._factor.pivots)

    def visits(self, b: Floats) -> Floats:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        return self._columns(b, self._factor.visits)

    def values(self, r: Floats) -> Floats:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        return self._columns(r, self._factor.values)

    @staticmethod
    def _columns(b: Floats, solve: Callable[[list[Decimal]], list[Decimal]]) -> Floats:
        with localcontext(_CONTEXT):
            columns = ([Decimal(value) for value in column] for column in b.T.tolist())
            return np.array([_floats(solve(column)) for column in columns]).T


def decimal_solve(arcs: Arcs, leak: Floats, b: Floats, *, transposed: bool) -> Floats:
    """Return (I - T)^-1 b, or (I - T)^-T b, for b >= 0 of shape (m, k); inf where floats end.

    Raises
    ------
    AccuracyError
        if the elimination would take too long.
    """
    factor = DecimalElimination(arcs, leak, _MOST_ARCS)
    return factor.values(b) if transposed else factor.visits(b)


def decimal_arrivals(
    arcs: Arcs, leak: Floats, b: Floats, out: tuple[Places, Places, Floats], size: int
) -> Floats:
    """Return the flow along the arcs `out` to each of `size` places, from b >= 0 of shape (m,).

    Expected visits that are larger than any float may be on the way.

    Raises
    ------
    AccuracyError
        if the elimination would take too long.
    """
    with localcontext(_CONTEXT):
        visits = _factor(arcs, leak, _MOST_ARCS).visits([Decimal(value) for value in b.tolist()])
        flow = [Decimal(0)] * size
        for j, i, chance in zip(*(part.tolist() for part in out), strict=True):
            flow[i] += visits[j] * Decimal(chance)
        return _floats(flow)


def decimal_law(arcs: Arcs) -> Floats:
    """Return the stationary law of the one closed class that the arcs make; shape (m,).

    Raises
    ------
    AccuracyError
        if the elimination would take too long.
    """
    with localcontext(_CONTEXT):
        rows, rest = _rows(arcs), range(1, arcs.size)
        factor = eliminated(rows, rest, _MOST_ARCS)
        law = [Decimal(1), *factor.visits([rows[0].get(i, Decimal(0)) for i in rest])]
        total = sum(law)
        return _floats([value / total for value in law])


def _rows(arcs: Arcs) -> list[dict[int, Decimal]]:
    return [{i: Decimal(chance) for i, chance in row.items()} for row in rows_of(arcs)]


def _factor(arcs: Arcs, leak: Floats, most: float) -> Elimination:
    return Elimination(_rows(arcs), [Decimal(value) for value in leak.tolist()], most)


def _floats(values: list[Decimal]) -> Floats:
    return np.array([float(value) for value in values])
