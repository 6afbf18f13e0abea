"""I - T factored class by class, each class by the method that suits its graph.

| class | method | time, memory |
|---|---|---|
| one state, or up to 64 | forward substitution over all of them (`triangular_solve`) | linear |
| a line of states, if long doubles are long | cyclic reduction (`line_elimination`) | linear |
| some hundreds of states, or dense | elimination in fronts (`front_elimination`) | cubic |
| cut in two by few states | sparse LU, every entry proved (`certified`) | n^1.5 on a grid |
| others | iteration on aggregates, every entry proved (`certified`) | about linear |

Consecutive small classes are solved together. A class that is left so rarely that twice the digits
of a double prove nothing is eliminated without subtraction: in fronts, up to 40 million factors, or
in decimal numbers if it is long and narrow, since doubles would repeat the same rounding error at
each state. What would take more than that is refused.
"""

from __future__ import annotations

from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Protocol

import numpy as np
from scipy.sparse import csc_array

from evenbreak.chains.arcs import arcs_of, put_back, sums
from evenbreak.chains.birth_death import LineElimination, line_order
from evenbreak.chains.certified import CertifiedSolve, NotCertifiedError
from evenbreak.chains.dense_elimination import MOST_ENTRIES, is_dense
from evenbreak.chains.dissection import FrontElimination, bandwidth, dissect, neighbours
from evenbreak.chains.elimination import DecimalElimination
from evenbreak.chains.structure import Structure, structure_of
from evenbreak.chains.triangular_solve import TriangularSolve
from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from evenbreak.arrays import Bools, Floats
    from evenbreak.chains.arcs import Arcs, Places
    from evenbreak.chains.dissection import Front

SMALL = 64
_FEW, _MUCH_WORK = 500, 1e10
"""States that are eliminated at once, and multiplications that a factorisation is worth."""
_HUB = 1000
"""A state that so many arcs lead out of makes ordering take longer than the factorisation."""
_WIDE = bool(np.finfo(np.longdouble).eps < np.finfo(np.float64).eps)
"""Whether a long double has more digits than a double, which lines need."""
_NARROW, _MOST_ARCS = 4, 2e7
"""So wide a class is eliminated in decimal numbers, if no more arcs arise: half a minute's work."""


class _Solver(Protocol):
    pivots: Floats

    def visits(self, b: Floats) -> Floats: ...

    def values(self, r: Floats) -> Floats: ...


class _Piece:
    """Consecutive classes, numbered first..last - 1, with the arcs out of their states."""

    def __init__(
        self, offsets: Places, arcs: tuple[Places, Places, Floats], leak: Floats, outflow: Floats
    ) -> None:
        self.first, self.last = int(offsets[0]), int(offsets[-1])
        self._offsets = offsets - self.first
        sources, targets, chances = arcs
        inner = targets < self.last
        # A piece that is the whole part does not copy its arcs.
        own: slice | Bools = slice(None) if inner.all() else inner
        self._inner = sources[own] - self.first, targets[own] - self.first, chances[own]
        self.sources, self.targets = sources[~inner], targets[~inner]
        self.chances = chances[~inner]
        self._leak = leak[self.first : self.last]
        self._outflow = outflow[self.first : self.last]

    @cached_property
    def solver(self) -> _Solver:
        """The factors of the piece, made when first used."""
        size = self.last - self.first
        if len(self._offsets) > 2 or size <= SMALL:
            return TriangularSolve(self._inner, self._leaks, self._outflow, self._offsets)
        order = line_order(self._arcs) if _WIDE else None
        if order is not None:
            return LineElimination(self._arcs, self._leaks, order)
        work = float(size * self._bandwidth**2)
        dense = is_dense(size, self._arcs.nnz)
        if (size <= _FEW or dense) and self._bandwidth > _NARROW:
            return self._eliminated("has arcs between most of its states")
        if work > _MUCH_WORK:  # in this order; perhaps not in a better one
            work = sum(front.work for front in self._fronts[1])
        has_hub = np.diff(self._arcs.indptr).max() > _HUB
        factored = work <= _MUCH_WORK and not has_hub
        return CertifiedSolve(self._arcs, self._leaks, factored=factored)

    def solved(self, b: Floats, *, transposed: bool) -> Floats:
        """Return (I - T)^-1 b (transposed on request), for b >= 0 of shape (m, k)."""
        try:
            return self.solver.values(b) if transposed else self.solver.visits(b)
        except NotCertifiedError:
            self.solver = self._eliminated("is left too rarely to prove an answer in floats")
        return self.solver.values(b) if transposed else self.solver.visits(b)

    @cached_property
    def _leaks(self) -> Floats:
        """The chance of leaving the piece, given each state."""
        return self._leak + sums(self.sources - self.first, self.chances, self.last - self.first)

    @cached_property
    def _arcs(self) -> csc_array:
        sources, targets, chances = self._inner
        size = self.last - self.first
        return csc_array((chances, (targets, sources)), shape=(size, size))

    @cached_property
    def _bandwidth(self) -> int:
        return bandwidth(neighbours(self._arcs))

    @cached_property
    def _fronts(self) -> tuple[Places, list[Front]]:
        return dissect(neighbours(self._arcs))

    def _eliminated(self, reason: str) -> _Solver:
        """Return the factors without subtraction, which there is a reason for.

        Raises
        ------
        AccuracyError
            if they would be too many.
        """
        if self._bandwidth <= _NARROW:
            return DecimalElimination(arcs_of(self._arcs), self._leaks, _MOST_ARCS)
        order, fronts = self._fronts
        entries = sum(front.entries for front in fronts)
        if entries > MOST_ENTRIES:
            raise AccuracyError(
                f"a class of {len(order):,} states {reason}, and no few states cut it apart: "
                f"its factors would be {entries:,} numbers in {entries * 8e-9:.2g} GB, and "
                f"{MOST_ENTRIES:,} are allowed; join some of its states or split the chain"
            )
        return FrontElimination(self._arcs, self._leaks, order, fronts)


class Factorisation:
    """I - T factored, where T holds the arcs of m states among themselves.

    Parameters
    ----------
    arcs
        the arcs among m states.
    leak
        shape (m,): the probability of leaving them, given the state. From each state a state
        with a leak can be reached.
    outflow
        shape (m,): the sum of all arcs out of each state and its leak.
    structure
        the classes of the arcs, if they are known already.
    """

    def __init__(
        self, arcs: Arcs, leak: Floats, outflow: Floats, structure: Structure | None = None
    ) -> None:
        structure = structure or structure_of(arcs)
        self.order: Places | None = None
        sources, targets, indptr = arcs.sources, arcs.targets, arcs.indptr
        chances = arcs.chances
        if not structure.in_order:
            self.order = structure.order
            place = np.empty(arcs.size, dtype=np.int32)
            place[self.order] = np.arange(arcs.size, dtype=np.int32)
            by_source = csc_array(
                (chances, (place[targets], place[sources])), shape=(arcs.size, arcs.size)
            )
            chances, targets, indptr = by_source.data, by_source.indices, by_source.indptr
            sources = np.repeat(np.arange(arcs.size, dtype=np.int32), np.diff(indptr))
            leak, outflow = leak[self.order], outflow[self.order]
        self._pieces = []
        for offsets in _runs(structure.offsets):
            span = slice(indptr[offsets[0]], indptr[offsets[-1]])
            piece = _Piece(offsets, (sources[span], targets[span], chances[span]), leak, outflow)
            self._pieces.append(piece)

    @property
    def bound(self) -> float | None:
        """A proved bound on the relative errors so far; None where elimination needed none."""
        errors = [solver.error for _, solver in self._used if isinstance(solver, CertifiedSolve)]
        return sum(errors) if errors else None

    @property
    def is_proved(self) -> bool:
        """Whether answers are proved as a whole; what flows between pieces may underflow."""
        return len(self._pieces) == 1 and self.bound is not None

    @property
    def pivots(self) -> Floats:
        """The chance of moving on to later states, given each state, when it is eliminated.

        Less, where answers are proved; 0 where no flow has arrived so far, for want of arcs or by
        underflow.
        """
        pivots = np.zeros(self._pieces[-1].last)
        for piece, solver in self._used:
            pivots[piece.first : piece.last] = solver.pivots
        return pivots if self.order is None else put_back(pivots, self.order)

    @property
    def _used(self) -> list[tuple[_Piece, _Solver]]:
        return [(piece, piece.solver) for piece in self._pieces if "solver" in vars(piece)]

    def visits(self, b: Floats) -> Floats:
        """Return the visits to each state from b >= 0, shape (m, k): (I - T)^-1 b."""
        f = b.copy() if self.order is None else b[self.order]
        for piece in self._pieces:
            part = f[piece.first : piece.last]
            if part.any():
                part[:] = piece.solved(part, transposed=False)
                _add(f, piece.targets, f[piece.sources] * piece.chances[:, None])
        return f if self.order is None else put_back(f, self.order)

    def values(self, r: Floats) -> Floats:
        """Return the sum of r >= 0, shape (m, k), over the visits from each: (I - T)^-T r."""
        y = r.copy() if self.order is None else r[self.order]
        for piece in reversed(self._pieces):
            _add(y, piece.sources, y[piece.targets] * piece.chances[:, None])
            part = y[piece.first : piece.last]
            if part.any():
                part[:] = piece.solved(part, transposed=True)
        return y if self.order is None else put_back(y, self.order)


def _add(to: Floats, place: Places, values: Floats) -> None:
    """Add each row of `values` to the row of `to` at its place."""
    if len(place):
        first, last = int(place.min()), int(place.max()) + 1
        for k, column in enumerate(values.T):
            to[first:last, k] += sums(place - first, column, last - first)


def _runs(offsets: Places) -> list[Places]:
    """Cut the classes into runs: each large class alone, the small ones between them together."""
    large = np.flatnonzero(np.diff(offsets) > SMALL)
    if not len(large):
        return [offsets]
    marks = np.unique(np.concatenate(([0, len(offsets) - 1], large, large + 1)))
    return [offsets[a : b + 1] for a, b in pairwise(marks)]
