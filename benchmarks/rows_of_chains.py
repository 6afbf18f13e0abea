"""Rows of `peers_of_chains.py`: what a row is, and the rows that ask about chains themselves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np
from bench_chains import bare_stationary, fresh, grid_chain, metropolis
from bench_families import batched_solve, table_limits
from scipy.linalg import eig
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components
from storm_of_chains import storm_law, storm_model

from evenbreak.chains import (
    Chain,
    chain_from_arrays,
    chain_of,
    limits_over,
    mean_first_passages,
    spectrum,
    stochastic_limit,
)

Call = Callable[[], Any]
OURS = "evenbreak"
NUMPY, SPLU, QUANTECON, STORM = "numpy.linalg", "splu", "QuantEcon", "Storm"
HERE = {name for name in ("quantecon", "stormpy", "flint", "evalica") if find_spec(name)}


@dataclass(frozen=True)
class Goal:
    """What a row may come to at most."""

    most: float
    kind: str = "ratio"

    @property
    def at_most(self) -> float:
        """The measure that is still met: where we are ahead already, the clock has its say."""
        return 1.25 * self.most if self.kind == "keep" else self.most

    def shown(self, measure: float) -> str:
        form = {"exponent": "exponent {}", "seconds": "{} s"}.get(self.kind, "{}")
        return form.format(f"{measure:,.0f}" if measure >= 100 else f"{measure:.2g}")

    def __str__(self) -> str:
        return ("keep " if self.kind == "keep" else "") + self.shown(self.most)


@dataclass(frozen=True)
class Question:
    """A row: our call (or one for each size), the peers' calls, and what is right."""

    work: str
    ours: dict[str, Call]
    peers: dict[str, Call] = field(default_factory=dict)
    goal: Goal | None = None
    exact: Any = None
    error: Callable[[Any], float] | None = None


def question(work: str, ours: Call, peers: dict[str, Call], most: float, **right: Any) -> Question:
    return Question(work, {OURS: ours}, peers, Goal(most), **right)


def kept(work: str, ours: Call, peers: dict[str, Call], most: float, **right: Any) -> Question:
    return Question(work, {OURS: ours}, peers, Goal(most, "keep"), **right)


def repeated(answer: Call, times: int = 10) -> Call:
    """Return a call that asks so many times, where all arrays at once would fill the memory."""

    def asked() -> Any:
        for _ in range(times):
            found = answer()
        return found

    return asked


# Sparse chains -------------------------------------------------------------------------


def random_digraph(n: int) -> Chain:
    """Return a chain with three arcs out of each state to anywhere, of any chances."""
    draw = np.random.default_rng(n)
    key = np.unique(np.repeat(np.arange(n), 3) * n + draw.integers(0, n, 3 * n))
    sources, targets = np.divmod(key, n)
    weights = draw.random(key.size)
    return chain_from_arrays(
        range(n), sources, targets, weights / np.bincount(sources, weights, n)[sources]
    )


def by_powers(matrix: Any, kind: Any = np.float64) -> np.ndarray:
    """Return the limit by steps of the chain, until they change nothing."""
    law, change = np.full(matrix.shape[0], 1 / kind(matrix.shape[0])), kind(2)
    while True:
        following, before = matrix @ law, change
        change = np.abs(following - law).sum()
        if change > 0.99 * before and change < 1e3 * np.finfo(kind).eps:
            return following / following.sum()
        law = following


def closed_law(chain: Chain) -> np.ndarray:
    """Return the law of the only closed class by steps in long doubles, 0 elsewhere."""
    matrix = chain.matrix.tocoo()
    _, part = connected_components(
        csr_array((matrix.data, (matrix.col, matrix.row))), True, "strong"
    )
    leaving = part[matrix.col] != part[matrix.row]
    closed = np.setdiff1d(part, part[matrix.col[leaving]])
    members = np.flatnonzero(np.isin(part, closed))
    law = np.zeros(len(chain), np.longdouble)
    law[members] = by_powers(chain.matrix[members][:, members].astype(np.longdouble), np.longdouble)
    return law


def digraph(n: int, goal: Goal | None = None) -> Question:
    chain = random_digraph(n)
    matrix = chain.matrix.tocsr()
    return Question(
        f"random digraph, out-degree 3, {n:,} states",
        {OURS: lambda: stochastic_limit(fresh(chain), 0)},
        {"power iteration": lambda: by_powers(matrix)},
        goal,
        closed_law(chain),
    )


def box(*sides: int) -> tuple[Chain, np.ndarray]:
    """Return a box of states with arcs both ways between neighbors, and its law."""
    number = np.arange(np.prod(sides)).reshape(sides)
    axes = range(len(sides))
    one, other = (
        np.concatenate([np.delete(number, cut, axis).ravel() for axis in axes]) for cut in (0, -1)
    )
    heights = np.random.default_rng(len(number)).integers(0, 10, number.size).astype(float)
    law = 2.0 ** -(heights - heights.min())
    return metropolis(heights, one, other, 8.0), law / law.sum()


def cubes(*sides: int) -> Question:
    """Return how the time grows with the number of states of a grid in three dimensions."""
    made = [box(side, side, side) for side in sides]
    laws = {len(chain): law for chain, law in made}

    def error(limit: Any) -> float:
        return float(np.max(np.abs(limit.probability / laws[len(limit)] - 1)))

    return Question(
        "3-D grids " + " / ".join(f"{side}^3" for side in sides),
        {f"{len(c):,}": lambda c=c: stochastic_limit(fresh(c), 0) for c, _ in made},
        goal=Goal(1.4, "exponent"),
        error=error,
    )


def strip(width: int) -> Question:
    chain, law = box(30_000, width)
    return question(
        f"strip 30,000 x {width}",
        lambda: stochastic_limit(fresh(chain), 0),
        {SPLU: lambda: bare_stationary(chain.matrix)},
        6,
        exact=law,
    )


def grid() -> Question:
    chain, heights = grid_chain(100)
    law = 2.0 ** -(heights - heights.min())
    ours, exact = (lambda: stochastic_limit(fresh(chain), 0)), law / law.sum()
    peers = {STORM: storm_law(storm_model(chain, {}))} if "stormpy" in HERE else {}
    peers[SPLU] = lambda: bare_stationary(chain.matrix)
    return question("grid 100 x 100", ours, peers, 1.5, exact=exact)


# Dense chains --------------------------------------------------------------------------


def random_table(n: int, kind: type = float) -> np.ndarray:
    P = np.random.default_rng(1).random((n, n)).astype(kind)
    return P / P.sum(axis=1, keepdims=True)


def wide_law(P: np.ndarray) -> np.ndarray:
    """Return the law by elimination in long doubles."""
    A = P.astype(np.longdouble)
    n = len(A)
    for k in range(n - 1, 0, -1):
        A[:k, k] /= A[k, :k].sum()
        A[:k, :k] += np.outer(A[:k, k], A[k, :k])
    law = np.ones(n, dtype=np.longdouble)
    for k in range(1, n):
        law[k] = law[:k] @ A[:k, k]
    return law / law.sum()


def dense(n: int, most: float) -> Question:
    P = random_table(n)
    chain = chain_of(P, rows="from")
    stochastic_limit(chain, 0)  # a built chain knows its classes
    peers: dict[str, Call] = {}
    if "quantecon" in HERE:
        from quantecon.markov import gth_solve

        peers[QUANTECON] = lambda: gth_solve(P)
    peers[NUMPY] = lambda: batched_solve(P[None])[0]
    work = f"law of {n:,} dense states, built"
    return question(work, lambda: stochastic_limit(chain, 0), peers, most, exact=wide_law(P))


def many(count: int = 10_000) -> tuple[np.ndarray, dict[str, Call], np.ndarray]:
    """Return `count` tables of 30 states, who answers them ten times over, and the first laws."""
    tables = np.random.default_rng(1).random((count, 30, 30)) + 0.1
    tables /= tables.sum(axis=2, keepdims=True)

    peers: dict[str, Call] = {}
    if "quantecon" in HERE:
        from numba import njit

        solve = import_module("quantecon.markov.gth_solve")._gth_solve_jit  # noqa: SLF001

        @njit  # type: ignore[untyped-decorator]
        def loop(tables: Any, laws: Any) -> Any:
            for k in range(len(tables)):
                solve(tables[k].copy(), laws[k])
            return laws

        peers[QUANTECON + " jitted"] = repeated(lambda: loop(tables, np.zeros((count, 30))))
    peers[NUMPY] = repeated(lambda: batched_solve(tables))
    return tables, peers, np.array([wide_law(table) for table in tables[:50]])


def dense_family() -> Question:
    tables, peers, exact = many()
    return question(
        "10^5 chains of 30 dense states",
        repeated(table_limits(tables)),
        peers,
        1.5,
        error=lambda laws: float(np.max(np.abs(laws[:50] / exact - 1))),
    )


class Table:
    """A game without an end on 30 states, from the columns of a stack of tables."""

    start = 0

    def __init__(self, **columns: Any) -> None:
        self.columns = columns

    def moves(self, state: int) -> dict[int, Any]:
        return {i: self.columns[f"p{state}_{i}"] for i in range(30)}

    def winner(self, state: int) -> None:  # noqa: ARG002
        return None


def dense_games() -> Question:
    tables, peers, exact = many()
    columns = {f"p{j}_{i}": np.ascontiguousarray(tables[:, j, i]) for j, i in np.ndindex(30, 30)}

    def error(found: Any) -> float:
        return float(np.max(np.abs(getattr(found, "probability", found)[:50] / exact - 1)))

    return Question(
        "10^5 chains of 30 dense states, by `limits_over`",
        {OURS: repeated(partial(limits_over, Table, **columns))},
        peers,
        error=error,
    )


def passages(n: int) -> Question:
    P = random_table(n)
    chain = chain_of(P, rows="from")

    def bare() -> Any:
        law = batched_solve(P[None])[0]
        Z = np.linalg.inv(np.eye(n) - P + law)
        return ((np.diag(Z) - Z) / law).T

    def wide() -> Any:
        """By the same formula, its inverse refined in long doubles."""
        law, one, A = wide_law(P), np.eye(n, dtype=np.longdouble), P.astype(np.longdouble)
        Z = np.linalg.inv(np.eye(n) - P + law.astype(float)).astype(np.longdouble)
        for _ in range(3):
            Z = Z + Z @ (one - (one - A + law) @ Z)
        return ((np.diag(Z) - Z) / law).T

    exact, off = wide(), ~np.eye(n, dtype=bool)

    def error(found: Any) -> float:
        return float(np.max(np.abs(np.asarray(found)[off] / exact[off] - 1)))

    work = f"`mean_first_passages` of {n} states"
    return question(work, lambda: mean_first_passages(chain), {NUMPY: bare}, 10, error=error)


def exact_law(n: int) -> Question:
    weights = np.random.default_rng(1).integers(1, 1001, (n, n)).tolist()
    P = [[Fraction(weight, sum(row)) for weight in row] for row in weights]
    chain = chain_of({j: dict(enumerate(row)) for j, row in enumerate(P)})
    peers: dict[str, Call] = {}
    if "flint" in HERE:
        from flint import fmpq, fmpq_mat

        rows = [[P[j][i] - (i == j) for j in range(n)] for i in range(n - 1)]
        entries = [fmpq(p.numerator, p.denominator) for row in rows for p in row]
        system = fmpq_mat(n, n, entries + n * [fmpq(1)])
        peers["python-flint"] = lambda: system.solve(fmpq_mat(n, 1, (n - 1) * [0] + [1]))

    def error(found: Any) -> float:
        """Return how far one step takes the law, in fractions: 0."""
        entries = found.values() if hasattr(found, "values") else found.entries()
        law = [x if isinstance(x, Fraction) else Fraction(int(x.p), int(x.q)) for x in entries]
        columns = zip(*P, strict=True)
        moved = [sum(x * p for x, p in zip(law, column, strict=True)) for column in columns]
        return float(max(abs(x - y) for x, y in zip(moved, law, strict=True)))

    ours = partial(stochastic_limit, chain, 0, exact=True)
    return question(f"exact, {n} dense states", ours, peers, 5, error=error)


def eigen(n: int) -> Question:
    P = random_table(n)
    chain = chain_of(P, rows="from")

    def error(found: Any) -> float:
        """Return the residual of the worst pair."""
        values, right = found if isinstance(found, tuple) else (found.values, found.right)
        M = P if isinstance(found, tuple) else P.T
        missed = np.linalg.norm(M @ right - right * values, axis=0)
        return float(np.max(missed / np.linalg.norm(right, axis=0)))

    peers: dict[str, Call] = {
        "scipy.linalg.eig": lambda: eig(P),
        "with left vectors": lambda: eig(P, left=True)[::2],
    }
    return question(
        f"spectrum of {n} dense states", lambda: spectrum(fresh(chain)), peers, 1.5, error=error
    )


CHAIN_ROWS: dict[str, list[Callable[[], Question]]] = {
    "digraph": [
        partial(digraph, 1_000),
        partial(digraph, 8_000),
        partial(digraph, 100_000, Goal(2, "seconds")),
    ],
    "cubes": [partial(cubes, 16, 27, 46)],
    "strips": [partial(strip, width) for width in (2, 3, 4)],
    "passages": [partial(passages, n) for n in (100, 400)],
    "dense": [partial(dense, n, goal) for n, goal in ((5, 20), (30, 8), (100, 2), (1_000, 1))],
    "families": [dense_family, dense_games],
    "grid": [grid],
    "exact": [partial(exact_law, n) for n in (40, 160)],
    "spectrum": [partial(eigen, 300)],
}
