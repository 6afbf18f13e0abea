"""Mean passage times between all states, against fractions and against one target at a time."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import oracle
from evenbreak.chains import (
    Chain,
    chain_of,
    first_passage,
    kemeny_constant,
    mean_first_passages,
    stationary_laws,
)
from evenbreak.errors import ChainError
from evenbreak.games import OneBall, Race, Rack

OZ = Chain(
    ["rain", "nice", "snow"], np.array([[0.5, 0.5, 0.25], [0.25, 0, 0.25], [0.25, 0.5, 0.5]])
)


def test_the_land_of_oz() -> None:
    """Kemeny and Snell 1960, section 4.4; there the diagonal has the times of return."""
    exact = [[0, 8 / 3, 10 / 3], [4, 0, 4], [10 / 3, 8 / 3, 0]]
    assert mean_first_passages(OZ) == pytest.approx(np.array(exact), rel=1e-15)
    assert kemeny_constant(OZ) == pytest.approx(32 / 15, rel=1e-15)


@st.composite
def weights(draw: st.DrawFn) -> list[list[int]]:
    """Columns of whole numbers that sum to 16."""
    n = draw(st.integers(1, 5))
    cuts = st.lists(st.integers(0, 16), min_size=n - 1, max_size=n - 1)
    return [np.diff([0, *sorted(draw(cuts)), 16]).tolist() for _ in range(n)]


def exact_mean(columns: list[list[int]], target: int) -> list[Fraction]:
    n = len(columns)
    others = [j for j in range(n) if j != target]
    rows = [[Fraction(int(i == j)) - Fraction(columns[j][i], 16) for i in others] for j in others]
    means = oracle.solve(rows, [Fraction(1)] * (n - 1)) if others else []
    found = dict(zip(others, means, strict=True))
    return [found.get(j, Fraction(0)) for j in range(n)]


@settings(max_examples=80, deadline=None)
@given(weights())
def test_against_fractions(columns: list[list[int]]) -> None:
    chain = chain_of(np.array(columns) / 16, rows="from")
    means = mean_first_passages(chain)
    for i in range(len(chain)):
        for j in range(len(chain)):
            one = first_passage(chain, j, i).mean
            assert means[i, j] == pytest.approx(np.inf if one is None else one, rel=1e-14)
        if np.isfinite(means[i]).all():
            assert oracle.worst_relative_error(means[i], exact_mean(columns, i)) <= 1e-14
    if chain.structure.closed.sum() == 1:
        law, inside = stationary_laws(chain), chain.structure.recurrent
        from_each = law[inside] @ means[np.ix_(inside, inside)]
        assert kemeny_constant(chain) == pytest.approx(from_each, rel=1e-13)


def test_kemeny_constant_by_eigenvalues() -> None:
    """The sum of 1 / (1 - eigenvalue) over the eigenvalues other than 1."""
    draw = np.random.default_rng(4).random((30, 30))
    chain = chain_of(draw / draw.sum(axis=0), rows="to")
    values = np.sort_complex(np.linalg.eigvals(chain.matrix.toarray()))[:-1]
    assert kemeny_constant(chain) == pytest.approx(np.sum(1 / (1 - values)).real, rel=1e-12)


def test_rare_steps_lose_no_digits() -> None:
    chain = chain_of([("a", "a", 1.0), ("a", "b", 1e-200), ("b", "b", 1.0), ("b", "a", 3e-200)])
    assert mean_first_passages(chain)[1, 0] == pytest.approx(1e200, rel=1e-15)
    assert kemeny_constant(chain) == pytest.approx(0.25e200, rel=1e-15)


def test_states_that_may_never_be_reached() -> None:
    means = mean_first_passages(chain_of(Race(2, 2, Rack(0.5))))
    assert (means.diagonal() == 0.0).all()
    assert np.isinf(means[~np.eye(len(means), dtype=bool)]).sum() > 0


def test_refusals() -> None:
    with pytest.raises(ChainError, match="2 closed classes"):
        kemeny_constant(chain_of(OneBall(0.5, 0.5)))
    large = chain_of([(k, (k + 1) % 2001, 1.0) for k in range(2001)])
    with pytest.raises(ChainError, match="2001 states"):
        mean_first_passages(large)
    with pytest.raises(ChainError, match="2001 states"):
        kemeny_constant(large)
