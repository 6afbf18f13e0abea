"""Reversible chains: every eigenvector, real and orthonormal, whatever decades the law spans."""

from dataclasses import replace

import mpmath
import numpy as np
import pytest

from evenbreak.chains import Chain, chain_from_arrays, chain_of, spectrum, stochastic_limit
from evenbreak.chains.spectrum import reversible_classes, symmetric_form
from evenbreak.errors import AccuracyError
from evenbreak.games import Ahead, OneBall, Rack
from evenbreak.handicaps import Ladder, chart, system_of
from evenbreak.ratings.scale import scale_of

CHARTS = ("npl_8", "npl_10", "npl_12", "npl_20")


def walk(n: int, pull: float, stay: float = 0.25) -> Chain:
    """A walk on n rungs that is pulled to the middle."""
    i = np.arange(n)
    up = (1.0 - stay) / (1.0 + 2.0 ** ((i - n // 2) / pull))
    down = (1.0 - stay) / (1.0 + 2.0 ** ((n // 2 - i) / pull))
    sources = np.concatenate((i[:-1], i[1:], i))
    targets = np.concatenate((i[1:], i[:-1], i))
    loops = np.full(n, stay)
    loops[0] += down[0]
    loops[-1] += up[-1]
    return chain_from_arrays(
        range(n), sources, targets, np.concatenate((up[:-1], down[1:], loops)), n // 2
    )


def grid(side: int, seed: int) -> Chain:
    """A walk on a square grid that is balanced by random weights."""
    draw = np.random.default_rng(seed)
    number = np.arange(side * side).reshape(side, side)
    one = np.concatenate((number[1:].ravel(), number[:, 1:].ravel()))
    other = np.concatenate((number[:-1].ravel(), number[:, :-1].ravel()))
    weight = 2.0 ** draw.integers(-20, 1, side * side)
    sources, targets = np.concatenate((one, other)), np.concatenate((other, one))
    chances = np.minimum(1.0, weight[targets] / weight[sources]) / 8
    loops = 1.0 - np.bincount(sources, chances)
    state = np.arange(side * side)
    return chain_from_arrays(
        range(side * side),
        np.concatenate((sources, state)),
        np.concatenate((targets, state)),
        np.concatenate((chances, loops)),
        0,
    )


def eigenpairs_in_extended_precision(chain: Chain) -> tuple[mpmath.matrix, mpmath.matrix]:
    """Eigenvalues of the symmetric form of a closed line, ascending, and their vectors."""
    with mpmath.workdps(40):
        n = len(chain)
        M = chain.matrix.toarray()
        S = mpmath.zeros(n)
        for j in range(n):
            arcs = [mpmath.mpf(float(M[i, j])) for i in range(n) if i != j]
            S[j, j] = 1 - mpmath.fsum(arcs) if M[j, j] else 0
            for i in range(n):
                if i != j and M[i, j]:
                    S[i, j] = mpmath.sqrt(mpmath.mpf(float(M[i, j])) * mpmath.mpf(float(M[j, i])))
        return mpmath.eigsy(S)


@pytest.mark.slow
@pytest.mark.parametrize(
    "chain",
    [walk(41, 30.0), walk(41, 2.0), *(chain_of(Ladder(chart(c), widest=15)) for c in CHARTS)],
    ids=["gentle", "steep", *CHARTS],
)
def test_against_dense_eigenpairs_in_extended_precision(chain: Chain) -> None:
    found = spectrum(chain)
    values, vectors = eigenpairs_in_extended_precision(chain)
    exact = np.array([float(v) for v in values])
    order = np.argsort(found.values)
    np.testing.assert_allclose(found.values[order], exact, rtol=0, atol=2e-15)
    Q = np.array(vectors.tolist(), dtype=float)
    overlap = np.abs((Q * found.orthonormal[:, order]).sum(axis=0))
    np.testing.assert_allclose(overlap, 1.0, rtol=0, atol=1e-14)


@pytest.mark.parametrize("name", CHARTS)
def test_the_national_pool_leagues_ladders(name: str) -> None:
    chain = chain_of(Ladder(chart(name)))
    found = spectrum(chain)
    n = len(chain)
    assert n == 121
    assert found.values.shape == (n,)
    assert found.values.dtype == float
    assert len(np.unique(found.values.round(12))) == n
    assert found.residual < 1e-14
    np.testing.assert_allclose(
        found.orthonormal.T @ found.orthonormal, np.eye(n), rtol=0, atol=1e-14
    )
    law = stochastic_limit(chain).probability
    np.testing.assert_allclose(found.right[:, 0], law, rtol=2e-15)
    np.testing.assert_allclose(found.limit(), law, rtol=0, atol=1e-15)
    assert found.limit_error < 1e-14
    values, _ = np.linalg.eigh(chain.matrix.toarray() * np.sqrt(law) / np.sqrt(law)[:, None])
    np.testing.assert_allclose(np.sort(found.values), values, rtol=0, atol=1e-14)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "points", "widest"),
    [*((name, 30, 60) for name in CHARTS), ("npl_20", 120, 960)],
)
def test_chart_ladders_in_extended_precision(name: str, points: int, widest: int) -> None:
    """Residuals r of n orthonormal vectors put each value within r of an eigenvalue of S."""
    system = replace(system_of("npl"), scale=scale_of(str(points)))
    chain = chain_of(Ladder(system, chart(name), widest=widest))
    found = spectrum(chain)
    n = len(chain)
    assert n == 2 * widest + 1
    assert found.values.shape == (n,)
    assert found.values.dtype == float
    Q, M = found.orthonormal, chain.matrix
    np.testing.assert_allclose(Q.T @ Q, np.eye(n), rtol=0, atol=3e-14)
    inside, up, down = (M.diagonal(k).astype(np.longdouble) for k in (0, -1, 1))
    beside = np.sqrt(up) * np.sqrt(down)
    residual = Q * (inside[:, None] - found.values)
    residual[:-1] += beside[:, None] * Q[1:]
    residual[1:] += beside[:, None] * Q[:-1]
    assert np.sqrt((residual**2).sum(axis=0)).max() < 5e-14
    law = stochastic_limit(chain).probability
    np.testing.assert_allclose(found.limit(), law, rtol=0, atol=1e-15)


@pytest.mark.parametrize("n", [511, 1023])
def test_wide_ladders(n: int) -> None:
    chain = walk(n, 30.0)
    found = spectrum(chain)
    assert found.orthonormal.shape == (n, n)
    assert found.residual < 1e-13
    assert found.values[0] == 1.0
    np.testing.assert_allclose(
        found.limit(), stochastic_limit(chain).probability, rtol=1e-13, atol=1e-300
    )


@pytest.mark.slow
def test_a_law_that_no_float_can_hold() -> None:
    chain = walk(1921, 5.0)
    found = spectrum(chain)
    assert found.residual < 1e-13
    np.testing.assert_allclose(found.limit(), stochastic_limit(chain).probability, atol=1e-15)
    with pytest.raises(AccuracyError, match="orthonormal"):
        _ = found.left


@pytest.mark.parametrize("n", [3000, 20_001])
def test_a_few_pairs_of_a_long_line(n: int) -> None:
    chain = walk(n, 300.0)
    found = spectrum(chain)
    assert found.values.shape == (6,)
    assert found.residual < 1e-13
    assert (np.diff(found.values) < 0).all()


def test_a_grid_is_reversible_and_not_a_line() -> None:
    chain = grid(9, seed=1)
    found = spectrum(chain)
    assert found.residual < 1e-14
    M = chain.matrix.toarray()
    np.testing.assert_allclose(M @ found.right, found.right * found.values, atol=1e-14)
    np.testing.assert_allclose((found.right * found.values) @ found.left, M, rtol=0, atol=1e-10)
    np.testing.assert_allclose(found.limit(), stochastic_limit(chain).probability, atol=1e-14)


def test_a_match_n_ahead_between_its_two_ends() -> None:
    """P5.27: dense eigensolvers find no 99 vectors of it, the symmetric form has all of them."""
    chain = chain_of(Ahead(50, 50, Rack(0.8)))
    found = spectrum(chain)
    n = len(chain)
    assert found.values.shape == (n,)
    rest = 2 * np.sqrt(0.8 * 0.2) * np.cos(np.arange(1, n - 1) * np.pi / (n - 1))
    np.testing.assert_allclose(np.sort(found.values[2:]), np.sort(rest), rtol=0, atol=1e-14)
    M = chain.matrix.toarray()
    np.testing.assert_allclose(
        M @ found.right, found.right * found.values, atol=1e-13 * abs(found.right).max()
    )
    np.testing.assert_allclose(found.limit(), stochastic_limit(chain).probability, atol=1e-14)


def test_one_ball_has_two_states_between_two_ends() -> None:
    chain = chain_of(OneBall(0.3, 0.6))
    found = spectrum(chain)
    M = chain.matrix.toarray()
    np.testing.assert_allclose(M @ found.right, found.right * found.values, atol=1e-15)
    np.testing.assert_allclose(found.left @ found.right, np.eye(4), atol=1e-15)


@pytest.mark.parametrize("rare", [1e-3, 1e-9, 1e-15, 1e-16, 1e-20, 1e-200])
@pytest.mark.filterwarnings("error")
def test_states_that_are_hardly_ever_left(rare: float) -> None:
    """An eigenvalue may differ from 1 by less than a double can tell."""
    arcs = [
        ("a", "b", rare),
        ("a", "V", rare / 4),
        ("a", "W", rare / 2),
        ("a", "a", 1 - 1.75 * rare),
    ]
    found = spectrum(chain_of([*arcs, ("b", "a", 0.5), ("b", "b", 0.5)], start="a"))
    M = found.chain.matrix.toarray()
    np.testing.assert_allclose(
        M @ found.right, found.right * found.values, atol=1e-15 * abs(found.right).max()
    )
    np.testing.assert_allclose(found.left @ found.right, np.eye(4), atol=1e-14)


def test_weights_of_a_line_are_its_law() -> None:
    chain = walk(200, 3.0)
    form = symmetric_form(chain, np.arange(200))
    assert form is not None
    law = stochastic_limit(chain).probability
    assert form.roots**2 == pytest.approx(law, rel=2e-15, abs=1e-300)


@pytest.mark.parametrize(
    "arcs",
    [
        [(0, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)],  # one way round
        [(j, (j + s) % 3, 0.5 + s * 0.1) for j in range(3) for s in (1, -1)],  # faster one way
    ],
    ids=["one way", "faster one way"],
)
def test_what_goes_round_is_not_reversible(arcs) -> None:
    chain = chain_of([(j, i, p) for j, i, p in arcs])
    assert symmetric_form(chain, np.arange(3)) is None
    assert spectrum(chain).orthonormal is None


def test_two_transient_classes_are_not_served() -> None:
    arcs = [("s", "t", 0.5), ("s", "end", 0.5), ("t", "end", 1.0)]
    assert reversible_classes(chain_of(arcs)) is None


def test_several_closed_classes() -> None:
    arcs = [("a", "b", 0.5), ("a", "a", 0.5), ("b", "a", 1.0), ("c", "d", 1.0), ("d", "c", 1.0)]
    found = spectrum(chain_of([*arcs, ("e", "e", 1.0)], start="a"))
    assert found.units == 3
    np.testing.assert_allclose(found.values, [1, 1, 1, -1, -0.5], rtol=0, atol=1e-15)
    np.testing.assert_allclose(found.limit(), [2 / 3, 1 / 3, 0, 0, 0], atol=1e-15)
    np.testing.assert_allclose(found.left @ found.right, np.eye(5), atol=1e-15)
