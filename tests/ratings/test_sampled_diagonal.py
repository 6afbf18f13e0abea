"""Variances by blocks and draws, against dense inverses of leagues of many shapes."""

import numpy as np
import pytest
from scipy import sparse

from evenbreak.ratings import Beginning, Levels, Results, fit
from evenbreak.ratings import inverse_diagonal as whole
from evenbreak.ratings import sampled_diagonal as module
from evenbreak.ratings.sampled_diagonal import blocks_of, sampled_diagonal


def clubs(rng, players=700, size=50, across=0.1):
    """Return pairs of a federation: ten a player, one in ten between clubs."""
    low = rng.integers(0, players, 10 * players)
    high = low - low % size + rng.integers(0, size, len(low))
    return low, np.where(rng.random(len(low)) < across, rng.integers(0, players, len(low)), high)


def mixed(rng, players=700):
    return rng.integers(0, players, (2, 10 * players))


def thin(rng, players=700):
    return rng.integers(0, players, (2, 3 * players // 2))


def halves(rng, players=700):
    low, high = mixed(rng, players // 2)
    far = players // 2
    return np.hstack([low, low + far, [3]]), np.hstack([high, high + far, [far + 3]])


def chain_of_clubs(rng, players=700, size=35):
    low, high = clubs(rng, players, size, 0.0)
    return np.append(low, np.arange(players - size)), np.append(high, np.arange(size, players))


def hub(rng, players=700):
    low, high = clubs(rng, players)
    return np.append(low, np.zeros(players - 1, int)), np.append(high, np.arange(1, players))


def islands(rng, players=700):
    return clubs(rng, players, 10, 0.002)


SHAPES = [clubs, mixed, thin, halves, chain_of_clubs, hub, islands]


def hessian(rng, low, high, row_sum, players=700):
    weight = rng.gamma(1.0, 1.5, len(low))
    pairs = sparse.coo_array((weight * (low != high), (low, high)), shape=(players, players))
    pairs = (pairs + pairs.T).tocsc()
    pairs.eliminate_zeros()
    return sparse.csc_array(sparse.diags_array(pairs.sum(axis=0) + row_sum) - pairs)


def off(matrix, row_sum):
    """Return the relative error of every variance, and the one that is stated for the worst."""
    found = sampled_diagonal(matrix, row_sum)
    return found.value / np.diagonal(np.linalg.inv(matrix.toarray())) - 1.0, found.relative_error


@pytest.mark.slow_after(7)
@pytest.mark.parametrize("row_sum", [2.0, 1e-4, 100.0])
@pytest.mark.parametrize("shape", SHAPES)
def test_variances_are_as_near_as_is_stated(monkeypatch, shape, row_sum):
    monkeypatch.setattr(module, "BLOCK", 64)
    rng = np.random.default_rng(5)
    error, stated = off(hessian(rng, *shape(rng), row_sum), row_sum)
    assert stated <= 2.0 * module.ENOUGH
    assert np.abs(error).max() <= 4.5 * stated + 1e-3
    assert 0.5 * error.min() > -0.05
    # What is stated is that of the worst: the others are nearer.
    assert np.sqrt((error**2).mean()) <= stated + 1e-4


@pytest.mark.slow
@pytest.mark.parametrize("shape", [clubs, mixed, islands])
def test_known_players_make_rows_differ(monkeypatch, shape):
    monkeypatch.setattr(module, "BLOCK", 64)
    rng = np.random.default_rng(6)
    low, high = shape(rng)
    row_sums = np.where(rng.random(700) < 0.3, rng.gamma(2.0, 10.0, 700), 0.0) + 1.0
    error, stated = off(hessian(rng, low, high, row_sums), None)
    assert stated <= 2.0 * module.ENOUGH
    assert np.abs(error).max() <= 4.5 * stated + 1e-3


@pytest.mark.slow
def test_the_error_is_that_of_draws_with_other_seeds(monkeypatch):
    """Over 60 seeds the errors of each player have the standard deviation that √(2/K) gives."""
    monkeypatch.setattr(module, "BLOCK", 64)
    rng = np.random.default_rng(7)
    matrix = hessian(rng, *clubs(rng, 200, 40), 2.0, 200)
    exact = np.diagonal(np.linalg.inv(matrix.toarray()))
    errors = []
    for seed in range(60):
        monkeypatch.setattr(module, "SEED", seed)
        found = sampled_diagonal(matrix, 2.0)
        errors.append(found.value / exact - 1.0)
    # Signs rather than normal draws are a little nearer than √(2/K).
    assert np.std(errors, axis=0).max() < 1.3 * found.relative_error
    assert np.abs(np.mean(errors, axis=0)).max() < 4.5 * found.relative_error / np.sqrt(60)


@pytest.mark.slow
@pytest.mark.thorough
def test_errors_of_a_federation_are_within_three_percent():
    players = 3000
    rng = np.random.default_rng(8)
    for _ in range(3):
        matrix = hessian(rng, *clubs(rng, players, 60), 2.5, players)
        error, _ = off(matrix, 2.5)
        of_sd = np.sqrt(1.0 + error) - 1.0
        assert np.quantile(np.abs(of_sd), 0.95) < 0.005
        assert of_sd.min() > -0.04


def test_who_plays_whom_shows_the_clubs():
    rng = np.random.default_rng(9)
    low, high = np.sort(clubs(rng), axis=0)
    block = blocks_of(700, low, high, np.ones(len(low)))
    assert len(np.unique(block)) <= 60  # 14 clubs, and some who mostly played elsewhere
    for club in range(14):
        _, many = np.unique(block[50 * club : 50 * club + 50], return_counts=True)
        assert many.max() >= 45


@pytest.mark.parametrize("shape", SHAPES)
def test_no_block_is_too_large(shape):
    rng = np.random.default_rng(10)
    low, high = np.sort(shape(rng), axis=0)
    block = blocks_of(700, low, high, rng.random(len(low)))
    assert np.bincount(block).max() <= module.BLOCK
    assert np.bincount(block).min() >= 1


def test_a_league_in_one_block_is_exact():
    rng = np.random.default_rng(11)
    error, stated = off(hessian(rng, *mixed(rng, 100), 1.0, 100), 1.0)
    assert stated == 0.0
    assert np.abs(error).max() < 1e-12


def test_the_same_league_has_the_same_answer():
    rng = np.random.default_rng(12)
    matrix = hessian(rng, *clubs(rng), 2.0)
    assert (sampled_diagonal(matrix, 2.0).value == sampled_diagonal(matrix, 2.0).value).all()


def season(rng, players=300):
    a, b = clubs(rng, players, 30)
    a, b = a[a != b], b[a != b]
    won = rng.integers(0, 8, len(a))
    names = [f"P{k:03d}" for k in range(players)]
    divisions = np.array(["East", "West", "North"])[a % 3]
    return Results.from_names(
        [names[k] for k in a], [names[k] for k in b], won, 7 - won, division=divisions,
        date=np.datetime64("2026-01-01") + np.sort(rng.integers(0, 200, len(a))),
    )  # fmt: skip


@pytest.mark.slow_after(2)
@pytest.mark.parametrize(
    "how",
    [
        {},
        {"levels": Levels(division_sd=0.3, newcomers=0.4)},
        {"half_life": 60.0},
        {"levels": Levels(beginning=Beginning(["P001", "P002"], [90, 70], [8, 8]))},
    ],
)
def test_ratings_have_nearly_the_same_errors_by_draws(monkeypatch, how):
    results = season(np.random.default_rng(13))
    exact = fit(results, **how)
    assert exact.error_of_errors == 0.0
    monkeypatch.setattr(whole, "_LARGE", 100)
    monkeypatch.setattr(whole, "_DENSE_UP_TO", 100)
    monkeypatch.setattr(whole, "_MOST_LINKS", 1000)
    monkeypatch.setattr(whole, "_by_cavities", lambda _: None)
    drawn = fit(results, **how)
    assert 0.0 < drawn.error_of_errors <= module.ENOUGH
    for of in ("standard_error", "quasi_error"):
        error = getattr(drawn, of) / getattr(exact, of) - 1.0
        assert np.abs(error).max() < 5.0 * module.ENOUGH
        assert (error != 0.0).any()
