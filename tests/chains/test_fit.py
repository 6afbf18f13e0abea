"""Chains from sequences: counts by hand, and the spread of what is drawn."""

from fractions import Fraction

import numpy as np
import pandas as pd
import pytest

from evenbreak.chains import Chain, fit_chain, stochastic_limit
from evenbreak.errors import ChainError

SEQUENCES = [["a", "b", "a", "a"], ["b", "a", "b", "end"], ["end"], []]


def test_counts_chances_and_standard_errors_by_hand() -> None:
    fitted = fit_chain(SEQUENCES, start="b")
    assert (fitted.chain.states, fitted.chain.start) == (["a", "b", "end"], "b")
    assert fitted.counts.toarray().tolist() == [[1, 2, 0], [2, 0, 0], [0, 1, 0]]
    third = float(Fraction(1, 3))
    assert fitted.chain.matrix.toarray() == pytest.approx(
        np.array([[third, 2 * third, 0], [2 * third, 0, 0], [0, third, 1]]), rel=1e-15
    )
    error = float(Fraction(2, 27)) ** 0.5
    assert fitted.standard_errors.toarray() == pytest.approx(
        np.array([[error, error, 0], [error, 0, 0], [0, error, 0]]), rel=1e-15
    )


def test_nothing_leads_from_one_sequence_to_the_next() -> None:
    assert fit_chain([list("ab"), list("cd")]).counts.nnz == 2


def test_tuple_states_and_generators() -> None:
    fitted = fit_chain(iter([((k, 0) for k in range(3))]))
    assert fitted.chain.states == [(0, 0), (1, 0), (2, 0)]
    assert fitted.chain.matrix.toarray().tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 1]]


@pytest.mark.slow
def test_drawn_chances_have_the_moments_of_a_dirichlet_law() -> None:
    """Mean c / n, variance (c / n)(1 - c / n) / (n + 1)."""
    fitted = fit_chain([["s", "x"]] * 6 + [["s", "y"]] * 3 + [["s", "s"]])
    rng = np.random.default_rng(2)
    drawn = np.array([fitted.draw(rng).matrix.toarray()[:, 0] for _ in range(4000)])
    exact = np.array([0.1, 0.6, 0.3])
    variance = exact * (1 - exact) / 11
    assert (fitted.draw(2).matrix.toarray()[:, 0] == drawn[0]).all()
    assert drawn.sum(axis=1) == pytest.approx(np.ones(4000), abs=1e-15)
    assert (np.abs(drawn.mean(axis=0) - exact) < 5 * np.sqrt(variance / 4000)).all()
    assert drawn.var(axis=0) == pytest.approx(variance, rel=0.12)


@pytest.mark.slow
def test_the_spread_of_a_limit_covers_the_truth() -> None:
    """The truth lies within two standard deviations in about 95% of 60 experiments."""
    truth = Chain("ab", np.array([[0.75, 0.5], [0.25, 0.5]]), "a")
    rng = np.random.default_rng(6)
    covered = 0
    for _ in range(60):
        fitted = fit_chain(truth.simulate(20, rng, paths=10).tolist(), start=0)
        at = fitted.chain.index(0)
        drawn = [stochastic_limit(fitted.draw(rng)).probability[at] for _ in range(40)]
        covered += abs(stochastic_limit(fitted.chain)[0] - 2 / 3) < 2 * np.std(drawn)
    assert 51 <= covered <= 60


def test_refusals() -> None:
    with pytest.raises(ChainError, match="no step"):
        fit_chain([["a"], ["b"]])
    with pytest.raises(ChainError, match="no step"):
        fit_chain([])
    with pytest.raises(ChainError, match="a sequence must"):
        fit_chain([3])  # type: ignore[list-item]
    with pytest.raises(ChainError, match="a sequence must"):
        fit_chain([[["a"], ["b"]]])  # type: ignore[list-item]
    with pytest.raises(ChainError, match="start is 'z'"):
        fit_chain([["a", "b"]], start="z")


def test_what_would_be_read_otherwise_than_meant_is_refused() -> None:
    frame = pd.DataFrame([["rain", "sun"], ["sun", "sun"]], columns=["monday", "tuesday"])
    with pytest.raises(ChainError, match="DataFrame"):
        fit_chain(frame)  # type: ignore[arg-type]
    with pytest.raises(ChainError, match="dict"):
        fit_chain({"monday": ["rain", "sun"]})
    with pytest.raises(ChainError, match="string 'rain'"):
        fit_chain(["rain", "sun", "rain"])
    with pytest.raises(ChainError, match="nan"):
        fit_chain([["rain", float("nan"), "sun"]])
    assert fit_chain(frame.to_numpy()).chain.states == ["rain", "sun"]
