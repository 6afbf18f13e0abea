"""Limits of large chains, each beside the bare numpy, scipy or networkx that it must come near to.

Times are from a built `Chain`, classes included, unless the question says otherwise. The
bare side answers the same question for the one kind of chain it knows, without checks.
"""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal, localcontext
from fractions import Fraction
from typing import Any

import networkx as nx
import numpy as np
import pytest
from scipy.linalg import solve_banded
from scipy.sparse import coo_array, csc_array, eye_array
from scipy.sparse.linalg import splu, spsolve_triangular

from evenbreak.chains import Chain, chain_from_arrays, chain_of, stochastic_limit
from evenbreak.game import graph_of
from evenbreak.games import Race, Rack, winner_breaks
from evenbreak.matches import win_probability

Beside = Callable[..., float]


def fresh(chain: Chain) -> Chain:
    """Return the chain with nothing known about it but its matrix."""
    return Chain(chain.states, chain.matrix, chain.start)


def worst(found: np.ndarray, exact: np.ndarray) -> str:
    """Return the largest relative error of the normal floats, to print."""
    normal = exact >= np.finfo(float).tiny
    return f"error {np.max(np.abs(found[normal] / exact[normal] - 1.0)):.1e}"


# Tridiagonal chains --------------------------------------------------------------------


def walk(up: np.ndarray, down: np.ndarray) -> Chain:
    """Return the walk on 0 ... n-1 that goes up and down with the given chances, else stays."""
    n = len(up)
    state = np.arange(n)
    stays = 1.0 - (up + down)
    sources = np.concatenate([state[up > 0], state[down > 0], state[stays > 1e-15]])
    targets = np.concatenate([state[up > 0] + 1, state[down > 0] - 1, state[stays > 1e-15]])
    chances = np.concatenate([up[up > 0], down[down > 0], stays[stays > 1e-15]])
    return chain_from_arrays(range(n), sources, targets, chances)


def test_gamblers_ruin_of_10001_states(beside: Beside) -> None:
    n, start, p = 10_001, 5_000, 0.5001
    up, down = np.full(n, p), np.full(n, 1.0 - p)
    up[[0, -1]] = down[[0, -1]] = 0.0
    chain = walk(up, down)
    band = np.zeros((3, n - 2))
    band[0, 1:], band[1], band[2, :-1] = -(1.0 - p), 1.0, -p
    begin = np.zeros(n - 2)
    begin[start - 1] = 1.0

    def bare() -> tuple[float, float]:
        visits = solve_banded((1, 1), band, begin)
        return (1.0 - p) * visits[0], p * visits[-1]

    def ours() -> Any:
        return stochastic_limit(fresh(chain), start)

    with localcontext(prec=60):
        r = (1 - Decimal(p)) / Decimal(p)
        exact = float((1 - r**start) / (1 - r ** (n - 1)))
    note = f"error {abs(ours()[n - 1] / exact - 1):.0e}, bare {abs(bare()[1] / exact - 1):.0e}"
    beside("gambler's ruin, 10,001 states / solve_banded", ours, bare, rounds=51, note=note)


def test_ladder_of_20001_states(beside: Beside) -> None:
    n = 20_001
    lead = (np.arange(n) - n // 2) / 400.0
    up, down = 1.0 / (1.0 + 2.0**lead), 1.0 / (1.0 + 2.0**-lead)
    up[-1] = down[0] = 0.0
    chain = walk(up, down)

    def bare() -> np.ndarray:
        logs = np.concatenate([[0.0], np.cumsum(np.log(up[:-1]) - np.log(down[1:]))])
        weights = np.exp(logs - logs.max())
        return weights / weights.sum()

    def ours() -> Any:
        return stochastic_limit(fresh(chain), 0).probability

    exact = ladder_law(up, down)
    note = f"{worst(ours(), exact)}, bare {worst(bare(), exact)}"
    beside("law of a 20,001-state ladder / log recurrence", ours, bare, rounds=51, note=note)


def ladder_law(up: np.ndarray, down: np.ndarray) -> np.ndarray:
    with localcontext(prec=50, Emin=-(10**9), Emax=10**9):
        weights = [Decimal(1)]
        for rise, fall in zip(up[:-1].tolist(), down[1:].tolist(), strict=True):
            weights.append(weights[-1] * Decimal(rise) / Decimal(fall))
        total = sum(weights)
        return np.array([float(weight / total) for weight in weights])


# Small chains, and fractions --------------------------------------------------------------


@pytest.mark.parametrize("n", [30, 100])
def test_dense_chain(beside: Beside, n: int) -> None:
    P = np.random.default_rng(1).random((n, n))
    P /= P.sum(axis=1, keepdims=True)
    chain = chain_of(P, rows="from")
    stochastic_limit(chain, 0)  # a built chain knows its classes

    def bare() -> np.ndarray:
        A = P.copy()
        for k in range(n - 1, 0, -1):
            A[:k, k] /= A[k, :k].sum()
            A[:k, :k] += np.outer(A[:k, k], A[k, :k])
        law = np.ones(n)
        for k in range(1, n):
            law[k] = law[:k] @ A[:k, k]
        return law / law.sum()

    def ours() -> Any:
        return stochastic_limit(chain, 0).probability

    note = f"difference {np.abs(ours() / bare() - 1.0).max():.0e}"
    beside(f"{n} dense states / elimination in plain numpy", ours, bare, rounds=201, note=note)


def test_ladder_in_fractions(beside: Beside) -> None:
    n, up, down = 201, Fraction(9, 20), Fraction(1, 2)
    rows = {
        i: {k: p for k, p in ((i - 1, down), (i + 1, up)) if 0 <= k < n} | {i: Fraction(1, 20)}
        for i in range(n)
    }
    rows[0][0], rows[n - 1][n - 1] = 1 - up, 1 - down
    chain = chain_of(rows)

    def bare() -> list[Fraction]:
        weights = [Fraction(1)]
        for _ in range(n - 1):
            weights.append(weights[-1] * up / down)
        total = sum(weights)
        return [weight / total for weight in weights]

    def ours() -> Any:
        return list(stochastic_limit(chain, 0, exact=True).values())

    note = "equal" if ours() == bare() else "not equal"
    beside("ladder of 201 states in fractions / products of ratios", ours, bare, note=note)


def test_race_in_fractions(beside: Beside) -> None:
    race, p = Race(50, 50, Rack(0.6)), Fraction(3, 5)

    def bare() -> Fraction:
        row = [Fraction(1), *[Fraction(0)] * 50]  # by the games that player 1 still needs
        for _ in range(50):
            for a in range(1, 51):
                row[a] = p * row[a - 1] + (1 - p) * row[a]
        return row[50]

    def ours() -> Fraction:
        return win_probability(race, exact=True)

    note = "equal" if ours() == bare() else "not equal"
    beside("race 50:50 in fractions / recurrence", ours, bare, note=note)


# A race of 180,000 states --------------------------------------------------------------

RACE = Race(300, 300, Rack(0.6, 0.55), breaks=winner_breaks)


def bare_race_arrays() -> tuple[int, np.ndarray, np.ndarray, np.ndarray]:
    """Return the arcs of RACE as one writes them down for this race alone: two ends in all."""
    m, n, p1, p2 = 300, 300, 0.6, 0.55
    a, b = (grid.ravel() for grid in np.indices((m, n)))
    states = 2 * m * n
    here = 2 * (a * n + b)
    won = np.where(a + 1 < m, here + 2 * n, states)
    lost = np.where(b + 1 < n, here + 3, states + 1)
    sources = np.concatenate([here, here, here + 1, here + 1])
    targets = np.concatenate([won, lost, won, lost])
    return states + 2, sources, targets, np.repeat([p1, 1 - p1, 1 - p2, p2], m * n)


def bare_race_limit() -> np.ndarray:
    n, sources, targets, chances = bare_race_arrays()
    matrix = csc_array(coo_array((chances, (targets, sources)), shape=(n, n)))
    begin = np.zeros(n)
    begin[0] = 1.0
    return spsolve_triangular(eye_array(n, format="csc") - matrix, begin, lower=True)


def test_race_by_its_arrays(beside: Beside) -> None:
    def ours() -> Any:
        return stochastic_limit(chain_of(RACE))

    limit = ours()
    ends = np.array([state[0] == 300 for state in limit.states])
    win = limit.probability[ends].sum()
    note = f"difference {abs(win / bare_race_limit()[-2] - 1):.0e}"
    beside("race 300:300, Race to limit / spsolve_triangular", ours, bare_race_limit, note=note)


def test_race_by_the_same_arrays(beside: Beside) -> None:
    def ours() -> Any:
        n, sources, targets, chances = bare_race_arrays()
        return stochastic_limit(chain_from_arrays(range(n), sources, targets, chances), 0)

    note = f"difference {abs(ours()[180_000] / bare_race_limit()[-2] - 1):.0e}"
    beside("race 300:300, the same arrays / spsolve_triangular", ours, bare_race_limit, note=note)


def test_race_through_networkx(beside: Beside) -> None:
    graph = graph_of(RACE)
    arcs = list(graph.edges(data="probability"))
    del graph

    def bare() -> nx.DiGraph:
        bare_graph: nx.DiGraph = nx.DiGraph()
        bare_graph.add_weighted_edges_from(arcs, weight="probability")
        return bare_graph

    def ours() -> Any:
        return stochastic_limit(chain_of(graph_of(RACE)))

    beside("race 300:300, through networkx / DiGraph alone", ours, bare, rounds=5)


# General classes -----------------------------------------------------------------------


def bare_stationary(matrix: csc_array) -> np.ndarray:
    """Return a stationary law by sparse LU, one state cut out."""
    system = csc_array(eye_array(matrix.shape[0]) - matrix)
    law = splu(csc_array(system[:-1, :-1])).solve(-system[:-1, [-1]].toarray().ravel())
    return np.append(law, 1.0) / (law.sum() + 1.0)


def metropolis(heights: np.ndarray, one: np.ndarray, other: np.ndarray, degree: float) -> Chain:
    """Return a chain with the law 2^-height, arcs being exact powers of two, on given edges."""
    sources, targets = np.concatenate([one, other]), np.concatenate([other, one])
    climb = np.minimum(0.0, heights[sources] - heights[targets])
    chances = 2.0**climb / degree
    states = np.arange(len(heights))
    left = 1.0 - np.bincount(sources, chances, len(heights))
    return chain_from_arrays(
        range(len(heights)),
        np.concatenate([sources, states]),
        np.concatenate([targets, states]),
        np.concatenate([chances, left]),
    )


def grid_chain(side: int = 70) -> tuple[Chain, np.ndarray]:
    """Return hills and valleys on a square grid, 2^-60 deep."""
    x, y = np.indices((side, side))
    heights = np.round(30.0 * (np.sin(0.3 * x) * np.cos(0.4 * y) + 1.0)).ravel()
    number = np.arange(side * side).reshape(side, side)
    one = np.concatenate([number[1:].ravel(), number[:, 1:].ravel()])
    other = np.concatenate([number[:-1].ravel(), number[:, :-1].ravel()])
    return metropolis(heights, one, other, 8.0), heights


def cyclic_grid_chain(side: int = 100) -> tuple[Chain, np.ndarray]:
    """Return hills and valleys on a grid that is closed both ways, 2^-60 deep."""
    turn = 2.0 * np.pi * np.arange(side) / side
    heights = np.round(30.0 * (np.sin(3.0 * turn)[:, None] * np.cos(2.0 * turn) + 1.0)).ravel()
    number = np.arange(side * side).reshape(side, side)
    other = np.concatenate([np.roll(number, 1, axis).ravel() for axis in (0, 1)])
    return metropolis(heights, np.tile(number.ravel(), 2), other, 8.0), heights


def blocks_chain() -> tuple[Chain, np.ndarray]:
    """Return 50 random blocks of 100 states, each joined to the next by one arc of 1e-10."""
    draw = np.random.default_rng(3)
    blocks, size = 50, 100
    base = np.repeat(np.arange(blocks) * size, 4 * size)
    one = base + np.tile(np.arange(size), 4 * blocks)
    other = base + draw.integers(0, size, base.size)
    edges = np.unique(np.sort(np.stack([one, other]), axis=0)[:, one != other], axis=1)
    heights = draw.integers(0, 8, blocks * size).astype(float)
    chain = metropolis(heights, edges[0], edges[1], 64.0)
    # The coupling joins states of one height, so that the law stays what it is.
    low = [
        k * size + int(np.flatnonzero(heights[k * size : (k + 1) * size] == 0)[0])
        for k in range(blocks)
    ]
    coupling = 2.0**-33
    rows, columns = low[:-1] + low[1:], low[1:] + low[:-1]
    joined = chain.matrix + csc_array(
        (np.full(len(rows), coupling), (rows, columns)), shape=chain.matrix.shape
    )
    arcs = coo_array(joined)
    return chain_from_arrays(range(len(heights)), arcs.col, arcs.row, unloop(arcs)), heights


def unloop(arcs: coo_array) -> np.ndarray:
    """Return the chances with each self-loop lowered to what the other arcs leave over."""
    chances = arcs.data.copy()
    loops = arcs.row == arcs.col
    others = np.bincount(arcs.col[~loops], chances[~loops], arcs.shape[0])
    chances[loops] = 1.0 - others[arcs.col[loops]]
    return chances


def random_chain() -> tuple[Chain, np.ndarray]:
    """Return 5,000 states with four random neighbors each, and heights down to 2^-30."""
    draw = np.random.default_rng(4)
    one = np.tile(np.arange(5000), 2)
    other = draw.integers(0, 5000, one.size)
    ring = np.arange(5000)
    one, other = np.append(one, ring), np.append(other, np.roll(ring, 1))
    edges = np.unique(np.sort(np.stack([one, other]), axis=0)[:, one != other], axis=1)
    heights = draw.integers(0, 30, 5000).astype(float)
    return metropolis(heights, edges[0], edges[1], 32.0), heights


@pytest.mark.parametrize(
    ("name", "make"),
    [
        ("70 x 70 grid", grid_chain),
        ("100 x 100 cyclic grid", cyclic_grid_chain),
        ("50 blocks of 100, coupled by 1e-10", blocks_chain),
        ("5,000 random states", random_chain),
    ],
    ids=["grid", "cyclic grid", "blocks", "random"],
)
def test_general_class(
    beside: Beside, name: str, make: Callable[[], tuple[Chain, np.ndarray]]
) -> None:
    chain, heights = make()
    exact = 2.0 ** -(heights - heights.min())
    exact /= exact.sum()

    def bare() -> np.ndarray:
        return bare_stationary(chain.matrix)

    def ours() -> Any:
        return stochastic_limit(fresh(chain), 0)

    limit = ours()
    note = (
        f"{worst(limit.probability, exact)}, residual {limit.residual}, bare {worst(bare(), exact)}"
    )
    beside(f"{name} / splu", ours, bare, rounds=1 if make is random_chain else 5, note=note)


# Chains of small blocks ----------------------------------------------------------------


def small_blocks_chain(blocks: int) -> Chain:
    """Return blocks of three states that go round and at times on to the next block."""
    draw = np.random.default_rng(5)
    state = np.arange(3 * blocks)
    base = state - state % 3
    last = state >= 3 * (blocks - 1)
    sources = np.concatenate([state, state, state[~last]])
    targets = np.concatenate(
        [
            base + (state + 1) % 3,
            base + (state + 2) % 3,
            base[~last] + 3 + draw.integers(0, 3, (~last).sum()),
        ]
    )
    weights = draw.uniform(0.05, 1.0, sources.size)
    chances = weights / np.bincount(sources, weights)[sources]
    return chain_from_arrays(range(3 * blocks), sources, targets, chances)


@pytest.mark.parametrize("blocks", [12_500, 50_000])
def test_many_small_blocks(beside: Beside, blocks: int) -> None:
    chain = small_blocks_chain(blocks)
    inner = 3 * (blocks - 1)
    begin = np.zeros(inner)
    begin[0] = 1.0

    def bare() -> np.ndarray:
        system = csc_array(eye_array(inner) - chain.matrix[:inner, :inner])
        return splu(system).solve(begin)

    def ours() -> Any:
        return stochastic_limit(fresh(chain), 0)

    beside(f"{blocks:,} blocks of 3 states / splu", ours, bare)
