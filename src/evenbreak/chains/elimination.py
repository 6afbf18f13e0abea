"""Elimination of states one by one, in plain Python, for any kind of number.

Eliminating state k means watching the chain only while it is elsewhere: each path
j -> k -> i becomes an arc j -> i,

    a[j][i] += a[j][k] a[k][i] / d[k],

where d[k], the pivot, is the sum of the arcs out of k and of its leak, never 1 minus
something. Only nonnegative numbers are added, multiplied and divided, so each entry of the answer
is accurate to a few units in the last place times the number of states, no matter how stiff the
chain is.

Decimal numbers with 40 digits and practically unbounded exponents are used for long and narrow
classes, in which the rounding errors of doubles add up, and for distributions that span more
decades than doubles do, whose intermediate results would over- or underflow. They are slow (some
microseconds per arc), so anything that would take more than seconds raises an error.

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993; Alfa, Xue and Ye 2002.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Mapping, Sequence
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal, localcontext
from typing import TYPE_CHECKING, Any, TypeAlias

from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from evenbreak.arrays import Floats
    from evenbreak.chains.arcs import Arcs
    from evenbreak.chains.structure import Structure


Rows: TypeAlias = list[dict[int, Any]]
VisitsOf: TypeAlias = Callable[[Rows, Sequence[int], list[Any]], list[Any]]
Core: TypeAlias = Callable[[Rows, list[Any]], Any]

_CONTEXT = Context(prec=40, Emax=MAX_EMAX, Emin=MIN_EMIN)
MOST_ARCS = 3e6
"""Limit on the number of arcs; more might take longer than a few seconds."""


class Elimination:
    """Factorization of (I - T), where T holds the arcs among transient states.

    `arcs[j][i]` is the probability of i, given j, for i other than j (overwritten); `leaks[j]` is
    the probability of leaving for good, given j. After `most` new arcs, `core` makes the solver for
    the remaining states from their arcs and leaks; without `core`, AccuracyError is raised.
    """

    def __init__(
        self, arcs: Rows, leaks: Sequence[Any], most: float = math.inf, core: Core | None = None
    ) -> None:
        into: list[dict[int, Any]] = [{} for _ in arcs]
        for j, row in enumerate(arcs):
            for i, chance in row.items():
                into[i][j] = chance
        leak = list(leaks)
        heap = [(len(arcs[k]) * len(into[k]), k) for k in range(len(leak))]
        heapq.heapify(heap)
        # (state, its pivot, arcs to and from the states that are eliminated later)
        self.steps: list[tuple[int, Any, dict[int, Any], dict[int, Any]]] = []
        self._rest: list[int] = []
        done = [False] * len(leak)
        while heap:
            cost, k = heapq.heappop(heap)
            out, back = arcs[k], into[k]
            # Each change of a state's cost adds an entry; only the last one counts.
            if done[k] or cost != len(out) * len(back):
                continue
            most -= cost
            if most < 0 and core:
                self._rest = [j for j, gone in enumerate(done) if not gone]
                place = {j: n for n, j in enumerate(self._rest)}
                among = [{place[i]: p for i, p in arcs[j].items()} for j in self._rest]
                self._core = core(among, [leak[j] for j in self._rest])
                break
            done[k] = True
            if most < 0:
                raise AccuracyError(
                    f"the chances of these {len(leak)} states span more orders of magnitude than "
                    "floats can, and the states are too many to eliminate in decimal numbers. "
                    "Split the chain or scale its arcs."
                )
            pivot = sum(out.values(), leak[k])
            self.steps.append((k, pivot, out, back))
            for i in out:
                del into[i][k]
            for j, chance in back.items():
                row = arcs[j]
                del row[k]
                share = chance / pivot
                leak[j] = leak[j] + share * leak[k]
                for i, onward in out.items():
                    if i != j:
                        row[i] = into[i][j] = row.get(i, 0) + share * onward
            for j in out.keys() | back.keys():
                heapq.heappush(heap, (len(arcs[j]) * len(into[j]), j))

    @property
    def pivots(self) -> list[Any]:
        """The pivot of each state."""
        pivots = [0] * len(self.steps)
        for k, pivot, _, _ in self.steps:
            pivots[k] = pivot
        return pivots

    def visits(self, b: Sequence[Any]) -> list[Any]:
        """Return x = (I - T)^-1 b: the expected visits to each state from the vector b."""
        return self._solved(b, transposed=False)

    def values(self, r: Sequence[Any]) -> list[Any]:
        """Return y = (I - T)^-T r: the expected sum of r over the visits from each state."""
        return self._solved(r, transposed=True)

    def _solved(self, b: Sequence[Any], *, transposed: bool) -> list[Any]:
        x = list(b)
        steps = [(k, d, i, o) if transposed else (k, d, o, i) for k, d, o, i in self.steps]
        for k, pivot, onward, _ in steps:
            if not _is_nothing(x[k]):
                share = x[k] / pivot
                for i, chance in onward.items():
                    x[i] = x[i] + share * chance
        if self._rest:
            remaining = [x[j] for j in self._rest]
            core = self._core.values(remaining) if transposed else self._core.visits(remaining)
            for j, value in zip(self._rest, core, strict=True):
                x[j] = value
        for k, pivot, _, back in reversed(steps):
            x[k] = sum((chance * x[j] for j, chance in back.items()), x[k]) / pivot
        return x


def limit_in(
    structure: Structure, rows: Rows, v: Mapping[int, Any], visits_of: VisitsOf
) -> dict[int, Any]:
    """Return the stochastic limit over the states reached, in any kind of numbers.

    `rows` are the arcs between different states, by source; v is the start, by position.
    `visits_of` returns the visits to some states, given all arcs and the probabilities on the
    states, until they are left.
    """
    limit: dict[int, Any] = {}
    for label, mass in masses_in(structure, rows, v, visits_of).items():
        first, *rest = structure.members(label).tolist()
        visits = visits_of(rows, rest, [rows[first].get(i, 0) for i in rest])
        limit[first] = share = mass / sum(visits, 1) if rest else mass
        limit.update((state, share * visit) for state, visit in zip(rest, visits, strict=True))
    return limit


def masses_in(
    structure: Structure, rows: Rows, v: Mapping[int, Any], visits_of: VisitsOf
) -> dict[int, Any]:
    """Return the probability of ending in each class that can be reached; see `limit_in`."""
    label, recurrent = structure.label.tolist(), structure.recurrent.tolist()
    inner = [state for state, inside in enumerate(recurrent) if not inside]
    entered = [(state, chance) for state, chance in v.items() if recurrent[state]]
    visits = visits_of(rows, inner, [v.get(state, 0) for state in inner])
    for state, visit in zip(inner, visits, strict=True):
        if not _is_nothing(visit):
            entered += [(i, visit * p) for i, p in rows[state].items() if recurrent[i]]
    masses: dict[int, Any] = {}
    for state, mass in entered:
        k = label[state]
        masses[k] = masses[k] + mass if k in masses else mass
    return masses


def eliminated(
    rows: Rows, states: Sequence[int], most: float = math.inf, core: Core | None = None
) -> Elimination:
    """Return I - T factored, with T the arcs among some of the states; `rows` is unchanged."""
    place = {state: k for k, state in enumerate(states)}
    inner = [{place[i]: p for i, p in rows[j].items() if i in place} for j in states]
    leaks = [sum(p for i, p in rows[j].items() if i not in place) for j in states]
    return Elimination(inner, leaks, most, core)


def _is_nothing(value: Any) -> bool:
    """Return whether a number is 0; always False for an array."""
    return not hasattr(value, "shape") and not value


def rows_of(arcs: Arcs, number: Callable[[float], Any] = float) -> Rows:
    """Return the arcs as a dictionary for each source, from target to chance."""
    rows: Rows = [{} for _ in range(arcs.size)]
    chances = map(number, arcs.chances.tolist())
    for j, i, chance in zip(arcs.sources.tolist(), arcs.targets.tolist(), chances, strict=True):
        rows[j][i] = chance
    return rows


class PlainElimination:
    """Factorization of (I - T) with a dictionary for each state: fastest for a few dozen states.

    `leak`, shape (m,), is the probability of leaving them, given the state. Raises AccuracyError if
    the elimination would make more than `most` arcs.
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
            return _floats([solve(column) for column in columns]).T


class DecimalElimination(PlainElimination):
    """Factorization of (I - T) in decimal numbers; answers are floats, or inf beyond them."""

    _number = Decimal


def decimal_masses(structure: Structure, v: Floats) -> Floats:
    """Return the probability of ending in each class from the vector v; shape (classes,).

    Intermediate expected visits may be larger than any float. Raises AccuracyError if the
    elimination would take too long.
    """
    with localcontext(_CONTEXT):
        rows, density = rows_of(structure.arcs, Decimal), dict(enumerate(map(Decimal, v.tolist())))
        masses = masses_in(structure, rows, density, _visits)
        return _floats([masses.get(label, Decimal(0)) for label in range(structure.count)])


def decimal_law(arcs: Arcs) -> Floats:
    """Return the stationary distribution of the single closed class of these arcs; shape (m,).

    Raises AccuracyError if the elimination would take too long.
    """
    with localcontext(_CONTEXT):
        rows, rest = rows_of(arcs, Decimal), range(1, arcs.size)
        law = [Decimal(1), *_visits(rows, rest, [rows[0].get(i, Decimal(0)) for i in rest])]
        total = sum(law)
        return _floats([value / total for value in law])


def _visits(rows: Rows, states: Sequence[int], b: list[Any]) -> list[Any]:
    return eliminated(rows, states, MOST_ARCS).visits(b)


def _floats(values: Sequence[Any]) -> Floats:
    import numpy as np  # matches in plain numbers do without it

    return np.array(values, dtype=np.float64)
