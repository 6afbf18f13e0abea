"""Exact answers to small chains in rational arithmetic: obvious, slow, and never wrong by rounding.

A chain is defined here as the library defines it: the arcs between different states are
given, taken as the exact binary fractions that the floats are, and a self-loop is what they
leave over. Then "stays put" drops out of every balance equation: with q_j the sum of the arcs
out of j, the expected visits x obey  q_i x_i = v_i + sum_j p_ij x_j,  and a stationary law
obeys  q_i x_i = sum_j p_ij x_j.
"""

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, isfinite, lcm

import numpy as np
from scipy.sparse import csc_array, diags_array

from evenbreak.chains import Chain

SMALLEST_NORMAL = Fraction(2) ** -1022

Columns = list[dict[int, Fraction]]


def columns_of(chain: Chain) -> Columns:
    """Return the arcs out of each state to other states: columns[j][i] = P(i | j)."""
    matrix = chain.matrix.tocoo()
    columns: Columns = [{} for _ in range(len(chain))]
    for i, j, p in zip(matrix.row.tolist(), matrix.col.tolist(), matrix.data.tolist(), strict=True):
        if i != j and p > 0:
            columns[j][i] = Fraction(p)
    return columns


def with_loops(matrix: csc_array) -> csc_array:
    """Return a matrix of arcs with the self-loops that are what the arcs leave over."""
    rest = 1.0 - np.asarray(matrix.sum(axis=0)).reshape(-1)
    return csc_array(matrix + diags_array(np.maximum(rest, 0.0)))


def reach(columns: Columns, state: int) -> set[int]:
    """Return all states that can be reached from a state, itself included."""
    found = {state}
    frontier = [state]
    while frontier:
        for i in columns[frontier.pop()]:
            if i not in found:
                found.add(i)
                frontier.append(i)
    return found


def closed_classes(columns: Columns) -> list[set[int]]:
    """Return the closed communicating classes: what can be reached can always come back."""
    reached = [reach(columns, j) for j in range(len(columns))]
    classes = []
    for j, states in enumerate(reached):
        if min(states) == j and all(j in reached[i] for i in states):
            classes.append(states)
    return classes


def solve(matrix: Sequence[Sequence[Fraction]], right: Sequence[Fraction]) -> list[Fraction]:
    """Solve a regular square system by Gauss-Jordan elimination without fractions (Bareiss).

    Each equation is first multiplied by its common denominator, so that all is integer.
    """
    rows = []
    for row, b in zip(matrix, right, strict=True):
        whole = lcm(*(x.denominator for x in (*row, b)))
        rows.append([int(x * whole) for x in (*row, b)])
    n, last = len(rows), 1
    for k in range(n):
        pivot_row = next(r for r in range(k, n) if rows[r][k])
        rows[k], rows[pivot_row] = rows[pivot_row], rows[k]
        pivot = rows[k][k]
        for r in range(n):
            if r != k:
                factor = rows[r][k]
                rows[r] = [
                    (pivot * x - factor * y) // last for x, y in zip(rows[r], rows[k], strict=True)
                ]
        last = pivot
    return [Fraction(rows[k][n], rows[k][k]) for k in range(n)]


def visits(columns: Columns, density: dict[int, Fraction]) -> dict[int, Fraction]:
    """Return the expected visits to each transient state that the density can reach."""
    recurrent = set().union(*closed_classes(columns))
    reached = set().union(*(reach(columns, j) for j, v in density.items() if v))
    transient = sorted(reached - recurrent)
    matrix = [
        [
            sum(columns[j].values(), Fraction(0)) if i == j else -columns[j].get(i, Fraction(0))
            for j in transient
        ]
        for i in transient
    ]
    right = [density.get(i, Fraction(0)) for i in transient]
    return dict(zip(transient, solve(matrix, right), strict=True)) if transient else {}


def absorption(columns: Columns, density: dict[int, Fraction]) -> dict[frozenset[int], Fraction]:
    """Return the probability of ending in each closed class."""
    expected = visits(columns, density)
    return {
        frozenset(states): sum(density.get(i, Fraction(0)) for i in states)
        + sum(
            (x * columns[j].get(i, Fraction(0)) for j, x in expected.items() for i in states),
            Fraction(0),
        )
        for states in closed_classes(columns)
    }


def stationary(columns: Columns, states: frozenset[int]) -> dict[int, Fraction]:
    """Return the stationary law of a closed class; its last balance is replaced by the sum."""
    members = sorted(states)
    matrix = [
        [
            sum(columns[j].values(), Fraction(0)) if i == j else -columns[j].get(i, Fraction(0))
            for j in members
        ]
        for i in members[:-1]
    ]
    matrix.append([Fraction(1)] * len(members))
    right = [Fraction(0)] * (len(members) - 1) + [Fraction(1)]
    return dict(zip(members, solve(matrix, right), strict=True))


def limit(columns: Columns, density: dict[int, Fraction]) -> list[Fraction]:
    """Return the stochastic limit of a start density: in each class its mass times its law."""
    answer = [Fraction(0)] * len(columns)
    for states, mass in absorption(columns, density).items():
        if mass:
            for i, x in stationary(columns, states).items():
                answer[i] = mass * x
    return answer


def period(chain: Chain, states: frozenset[int] | set[int]) -> int:
    """Return the gcd of the lengths of all closed walks from one state of a class.

    Walks of up to 3n steps are enough: to any cycle, around it or not, and back.
    """
    matrix = chain.matrix.toarray() > 0
    home = min(states)
    here, common = {home}, 0
    for length in range(1, 3 * len(states) + 1):
        here = {i for j in here for i in matrix[:, j].nonzero()[0].tolist()}
        if home in here:
            common = gcd(common, length)
    return common


def worst_relative_error(found: Sequence[float], exact: Sequence[Fraction]) -> float:
    """Return the largest relative error of the entries that are normal floats or zero.

    A subnormal exact entry may come out as anything below the smallest normal float.
    """
    worst = Fraction(0)
    for x, y in zip(map(float, found), exact, strict=True):
        if not isfinite(x):
            return float("inf")
        if y >= SMALLEST_NORMAL:
            worst = max(worst, abs(Fraction(x) - y) / y)
        elif not 0 <= x <= float(SMALLEST_NORMAL) or (y == 0 and x != 0):
            return float("inf")
    return float(worst)
