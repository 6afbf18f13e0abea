"""Leagues that fill in: every shortcut against the dense inverse."""

import numpy as np
import pytest
from scipy import sparse

from evenbreak.errors import AccuracyError
from evenbreak.ratings import inverse_diagonal as module
from evenbreak.ratings.inverse_diagonal import inverse_diagonal


@pytest.fixture(autouse=True)
def small_leagues_are_large(monkeypatch):
    monkeypatch.setattr(module, "_LARGE", 100)
    monkeypatch.setattr(module, "_MOST_LINKS", 0)


def hessian(rng, players, pairs, row_sum, *, halves=False):
    """Return the Hessian of random pairs, between two halves only once if so wanted."""
    low = rng.integers(0, players, pairs)
    high = (low + rng.integers(1, players, pairs)) % players
    weight = rng.uniform(0.05, 3, pairs)
    if halves:
        high = low // (players // 2) * (players // 2) + high % (players // 2)
        low, high, weight = np.append(low, 0), np.append(high, players - 1), np.append(weight, 1e-3)
    games = sparse.coo_array((weight * (low != high), (low, high)), shape=(players, players))
    games = (games + games.T).tocsc()
    return sparse.csc_array(sparse.diags_array(games.sum(axis=0) + row_sum) - games)


def exact(matrix):
    return np.diagonal(np.linalg.inv(matrix.toarray()))


@pytest.mark.parametrize("row_sum", [1e-6, 1.0, 50.0])
def test_cavities_of_a_well_mixed_league_keep_three_digits(row_sum):
    matrix = hessian(np.random.default_rng(5), 600, 120_000, row_sum)
    league = module._Leveled.of(matrix, row_sum)
    by_cavities = module._by_cavities(league) * league.scale**2 + league.level
    np.testing.assert_allclose(by_cavities, exact(matrix), rtol=2e-4)
    assert (inverse_diagonal(matrix, row_sum).value == by_cavities).all()


def test_cavities_know_more_than_how_many_games_a_player_has():
    matrix = hessian(np.random.default_rng(5), 600, 120_000, 1.0)
    truth, by_degree = exact(matrix), 1.0 / matrix.diagonal()
    by_degree += (truth - by_degree).mean()
    found = inverse_diagonal(matrix, 1.0).value
    assert np.abs(found - truth).max() < 0.1 * np.abs(by_degree - truth).max()


@pytest.mark.parametrize("row_sum", [1e-6, 1.0])
def test_single_precision_keeps_six_digits_whatever_the_prior(row_sum):
    matrix = hessian(np.random.default_rng(5), 600, 12_000, row_sum)
    league = module._Leveled.of(matrix, row_sum)
    assert module._by_cavities(league) is None  # too few games to be sure
    found = inverse_diagonal(matrix, row_sum).value
    assert (found != module._in_double_precision(matrix)).any()
    np.testing.assert_allclose(found, exact(matrix), rtol=1e-5)


def test_two_halves_that_hardly_met_take_double_precision():
    # Without a prior their difference is all but unknown.
    matrix = hessian(np.random.default_rng(5), 400, 60_000, 1e-4, halves=True)
    league = module._Leveled.of(matrix, 1e-4)
    assert module._by_cavities(league) is None
    assert module._in_single_precision(league) is None
    np.testing.assert_allclose(inverse_diagonal(matrix, 1e-4).value, exact(matrix), rtol=1e-8)


def test_small_leagues_are_good_to_rounding(monkeypatch):
    monkeypatch.setattr(module, "_LARGE", 601)
    matrix = hessian(np.random.default_rng(5), 600, 120_000, 1.0)
    np.testing.assert_allclose(inverse_diagonal(matrix, 1.0).value, exact(matrix), rtol=1e-12)


def test_a_matrix_that_is_not_definite_is_refused():
    with pytest.raises(AccuracyError, match="smaller prior_sd"):
        inverse_diagonal(sparse.csc_array(-np.eye(5)), -1.0)
