"""Factorization of I - T class by class, each by the method that suits its graph.

| class | method | time, memory |
|---|---|---|
| one state, or up to 64 | forward substitution over all of them (`TriangularSolve`) | linear |
| a line of states, if long doubles are long | cyclic reduction (`birth_death`) | linear | | some
hundreds of states, or dense | elimination in fronts (`dissection`) | cubic | | cut in two by few
states | sparse LU, every entry proved (`certified`) | n^1.5 on a grid | | others | iteration on
aggregates, every entry proved (`certified`) | about linear |

Consecutive small classes are solved together. A class that is left so rarely that even
double-double precision proves nothing is eliminated without subtraction: in fronts, up to 40
million factors, or in decimal numbers if it is long and narrow, since doubles would repeat the same
rounding error at each state. Anything larger raises an error.

A state that is alone in its class is watched only when it moves (`TriangularSolve`): with P[i, j]
the arc from j to i over the sum of all arcs out of j, the flow f through the states from a vector b
obeys

    f[i] = b[i] + sum over j of P[i, j] f[j],

upstream states first. This is a triangular system whose terms all have one sign, and the expected
visits are f[j] over the sum of the arcs out of j. A small class of several states enters it with
each state twice, as it is entered and as it is left, joined by the factors of
`eliminate_together`: the flow into a state moves on to states eliminated later; divided by the
pivot, it is the visits to the state; and visits to a state bring visits to states eliminated
earlier. So the whole system is triangular, with at most twice as many rows as states, and I - T and
its transpose are each solved in one call.

Graphs of the same size are eliminated together (`eliminate_together`): stacked into one array, the
last axis of which counts them, each step of the elimination of Grassmann, Taksar and Heyman (1985)
is one vector operation over the whole stack, so that no Python loop runs per graph. The arcs out
of state k and into it are finished in its turn, from those of the states before, which touches
memory least:

    A[i, k] += sum of A[i, l] A[l, k] over l < k,   i > k,   d[k] = sum of A[i, k] over i > k,
    A[k, j] = (A[k, j] + sum of A[k, l] A[l, j] over l < k) / d[k],   j > k.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property, partial
from itertools import pairwise
from typing import Protocol

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import spsolve_triangular

from evenbreak.arrays import Bools, Floats
from evenbreak.chains.arcs import Arcs, Places, arcs_of, put_back, sums
from evenbreak.chains.birth_death import LineElimination, line_order
from evenbreak.chains.certified import CertifiedSolve, NotCertifiedError
from evenbreak.chains.dense_elimination import MOST_ENTRIES, is_dense
from evenbreak.chains.dissection import Front, FrontElimination, bandwidth, dissect, neighbors
from evenbreak.chains.elimination import DecimalElimination
from evenbreak.chains.structure import Structure, structure_of
from evenbreak.errors import AccuracyError

SMALL = 64
_FEW, _MUCH_WORK = 500, 1e10
"""States that are eliminated at once, and multiplications that make a factorization worthwhile."""
_HUB = 1000
"""Number of arcs out of one state that makes ordering take longer than the factorization."""
_WIDE = bool(np.finfo(np.longdouble).eps < np.finfo(np.float64).eps)
"""Whether a long double has more digits than a double, which lines need."""
_NARROW, _MOST_ARCS = 4, 2e7
"""Width up to which a class is eliminated in decimal numbers; more takes over half a minute."""


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
        """The factors of the piece, made on first use."""
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
        return bandwidth(neighbors(self._arcs))

    @cached_property
    def _fronts(self) -> tuple[Places, list[Front]]:
        return dissect(neighbors(self._arcs))

    def _eliminated(self, reason: str) -> _Solver:
        """Return the factors without subtraction; AccuracyError if there are too many."""
        if self._bandwidth <= _NARROW:
            return DecimalElimination(arcs_of(self._arcs), self._leaks, _MOST_ARCS)
        order, fronts = self._fronts
        entries = sum(front.entries for front in fronts)
        if entries > MOST_ENTRIES:
            raise AccuracyError(
                f"a class of {len(order):,} states {reason} and can't be split by taking out a "
                f"few of them: factoring it would take {entries:,} numbers ({entries * 8e-9:.2g} "
                f"GB); the limit is {MOST_ENTRIES:,}. Merge some of its states or split the chain."
            )
        return FrontElimination(self._arcs, self._leaks, order, fronts)


class Factorization:
    """Factorization of I - T, where T holds the arcs among m states.

    `leak`, shape (m,), is the probability of leaving them, given the state; from each state a state
    with a leak can be reached. `outflow` is the sum of all arcs out of each state and its leak.
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
        """A proved bound on the relative errors so far; None if elimination needed none."""
        errors = [solver.error for _, solver in self._used if isinstance(solver, CertifiedSolve)]
        return sum(errors) if errors else None

    @property
    def is_proved(self) -> bool:
        """Whether answers are proved as a whole, since flow between pieces may underflow."""
        return len(self._pieces) == 1 and self.bound is not None

    @property
    def pivots(self) -> Floats:
        """The chance of moving on to later states, given each state, when it is eliminated.

        It is a lower bound where answers are proved, and 0 where no flow has arrived so far,
        because of missing arcs or underflow.
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
    """Add each row of `values` to its place in `to`."""
    if len(place):
        first, last = int(place.min()), int(place.max()) + 1
        for k, column in enumerate(values.T):
            to[first:last, k] += sums(place - first, column, last - first)


def _runs(offsets: Places) -> list[Places]:
    """Cut the classes into runs: each large class alone, small ones in between together."""
    large = np.flatnonzero(np.diff(offsets) > SMALL)
    if not len(large):
        return [offsets]
    marks = np.unique(np.concatenate(([0, len(offsets) - 1], large, large + 1)))
    return [offsets[a : b + 1] for a, b in pairwise(marks)]


Triples = tuple[Places, Places, Floats]

_ENTRIES = 2_000_000
_FEW_TERMS = 256
"""Number of arcs into or out of a state above which sums are compensated."""


class TriangularSolve:
    """Factorization of (I - T) for consecutive classes, all of them small.

    States are numbered class by class, upstream first; `offsets` has the first state of each class,
    and m. `leak`, the chance of leaving all these states, given the state, is only read for classes
    of several states; `outflow`, the chance of leaving the state, for states alone in their class.
    """

    def __init__(self, arcs: Triples, leak: Floats, outflow: Floats, offsets: Places) -> None:
        sources, targets, chances = arcs
        m, sizes = int(offsets[-1]), np.diff(offsets)
        self.pivots = self._unit = outflow
        self._enter: Places | slice = slice(None)
        self._leave: Places | slice = slice(None)
        if len(sizes) == m:
            self._system = _unit_lower(m, sources, targets, chances / outflow[sources])
            return
        label = np.repeat(np.arange(len(sizes)), sizes)
        width = np.where(sizes > 1, 2 * sizes, 1)
        begin = np.cumsum(width) - width
        number = np.arange(m) - offsets[label]
        self.pivots = outflow.copy()
        self._unit = np.where(sizes[label] > 1, 1.0, outflow)
        self._enter = entered = begin[label] + number
        # Left in the opposite order: the last state to be eliminated is known first.
        self._leave = left = (begin + width - 1)[label] - number
        inside = label[sources] == label[targets]
        across = ~inside
        columns = [left[sources[across]]]
        rows = [entered[targets[across]]]
        entries = [chances[across] / self._unit[sources[across]]]
        leaks = leak + sums(sources[across], chances[across], m)
        inner = sources[inside], targets[inside], chances[inside]
        for states, A in _stacks(offsets, label, inner, leaks):
            size = len(states)
            self.pivots[states] = pivot = eliminate_together(A, size)
            made, onward = A[:size] != 0.0, np.tri(size, k=-1, dtype=bool)[:, :, None]
            enter, leave = entered[states], left[states]
            columns += [enter.ravel(), np.where(onward, enter, leave)[made]]
            rows += [leave.ravel(), np.where(onward, enter[:, None], leave[:, None])[made]]
            entries += [1.0 / pivot.ravel(), (A[:size] / np.where(onward, pivot, 1.0))[made]]
        self._system = _unit_lower(
            int(width.sum()), np.concatenate(columns), np.concatenate(rows), np.concatenate(entries)
        )

    def visits(self, b: Floats) -> Floats:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        return self._solved(b, transposed=False) / self._unit[:, None]

    def values(self, r: Floats) -> Floats:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        return self._solved(r / self._unit[:, None], transposed=True)

    @cached_property
    def _most_terms(self) -> int:
        """The largest number of arcs into or out of a state."""
        into = np.bincount(self._system.indices).max(initial=0)
        return max(int(into), int(np.diff(self._system.indptr).max(initial=0)))

    def _solved(self, b: Floats, *, transposed: bool) -> Floats:
        system = self._system.T if transposed else self._system
        put, take = (self._leave, self._enter) if transposed else (self._enter, self._leave)
        right = np.zeros((system.shape[0], b.shape[1]))
        right[put] = b
        solve = partial(
            spsolve_triangular, system, lower=not transposed, unit_diagonal=True, overwrite_A=True
        )
        x: Floats = solve(right)
        if self._most_terms > _FEW_TERMS:
            # Terms added up one after the other lose digits that one correction brings back.
            entries = system.tocoo()
            terms = (entries.data * column[entries.col] for column in x.T)
            balance = np.stack([sums(entries.row, term, len(x)) for term in terms], axis=1)
            x += solve(right - balance)
        return x[take]


def _stacks(
    offsets: Places, label: Places, arcs: Triples, leaks: Floats
) -> Iterator[tuple[Places, Floats]]:
    """Yield the classes of several states, with equal sizes together, as memory allows.

    Each stack is the states, shape (size, classes), and their arcs, shape (size + 1, size,
    classes): entry [i, j] is the arc from the j-th to the i-th state, and the last row the leaks.
    """
    sources, targets, chances = arcs
    sizes = np.diff(offsets)
    layers = np.empty(len(sizes), dtype=np.intp)
    for size in np.unique(sizes[sizes > 1]).tolist():
        classes = np.flatnonzero(sizes == size)
        for stack in np.array_split(classes, len(classes) * size * size // _ENTRIES + 1):
            layers[:] = -1
            layers[stack] = np.arange(len(stack))
            layer = layers[label[sources]]
            own, lowest = layer >= 0, offsets[stack]
            layer = layer[own]
            A = np.zeros((size + 1, size, len(stack)))
            A[targets[own] - lowest[layer], sources[own] - lowest[layer], layer] = chances[own]
            states = lowest + np.arange(size)[:, None]
            A[size] = leaks[states]
            yield states, A


def _unit_lower(size: int, columns: Places, rows: Places, entries: Floats) -> csc_array:
    """Return I - E for arcs E that all lead forward, sorted and with ones as SuperLU requires."""
    diagonal = np.arange(size, dtype=np.int32)
    at = [
        np.concatenate((diagonal, ends), dtype=np.int32, casting="same_kind")
        for ends in (rows, columns)
    ]
    return csc_array((np.concatenate((np.ones(size), -entries)), tuple(at)), shape=(size, size))


def eliminate_together(A: Floats, size: int) -> Floats:
    """Eliminate the first `size` states of all graphs in a stack in place; return the pivots.

    A has shape (m, n, graphs), m >= n >= size: A[i, j] is the arc from the j-th to the i-th state;
    a leak may be the last row. It becomes the arcs onward below the diagonal, and above it those
    back divided by the pivot of their target. Pivots have shape (size, graphs).
    """
    pivot = np.empty((size, A.shape[2]))
    for k in range(size):
        onward, back, done = A[k + 1 :, k], A[k, k + 1 :], slice(k)
        onward += np.einsum("ilc,lc->ic", A[k + 1 :, done], A[done, k])
        back += np.einsum("lc,ljc->jc", A[k, done], A[done, k + 1 :])
        pivot[k] = onward.sum(axis=0)
        back /= pivot[k]
    return pivot
