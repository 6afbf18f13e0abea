"""Uncertainty from the curvature, against the dense inverse."""

import numpy as np
import pytest

from evenbreak.ratings import covariance
from evenbreak.ratings.beginning import PriorMeans
from evenbreak.ratings.covariance import Curvature, count_pairs, sums_by_player

LOW, HIGH = np.array([0, 0, 1, 2]), np.array([1, 2, 3, 3])
WEIGHT = np.array([3.0, 0.5, 2.0, 1.5])
BORDER, CORNER = np.array([0.4, -0.1, 0.2, -0.5]), 6.0


def whole(curvature):
    matrix = np.zeros((5, 5))
    matrix[:4, :4] = curvature.matrix.toarray()
    matrix[4, :4] = matrix[:4, 4] = curvature.border
    matrix[4, 4] = curvature.corner
    return matrix


@pytest.fixture(params=["factorized", "iterated"])
def bordered(request, monkeypatch):
    if request.param == "iterated":
        monkeypatch.setattr(covariance, "_DENSE_UP_TO", 0)
    return Curvature(4, LOW, HIGH, WEIGHT, 0.7, BORDER, CORNER)


def test_rows_sum_to_the_prior_precision():
    matrix = Curvature(4, LOW, HIGH, WEIGHT, 0.7).matrix.toarray()
    np.testing.assert_allclose(matrix.sum(axis=0), 0.7)
    assert (matrix == matrix.T).all()


def test_variances_with_a_break_advantage(bordered):
    exact = np.linalg.inv(whole(bordered))
    np.testing.assert_allclose(bordered.variances(), np.diagonal(exact)[:4], rtol=1e-10)
    assert bordered.border_variance == pytest.approx(exact[4, 4], rel=1e-10)


def test_covariances_of_a_contrast(bordered):
    exact = np.linalg.inv(whole(bordered))[:4, :4]
    contrast = np.array([1.0, 0.0, -1.0, 0.0])
    np.testing.assert_allclose(bordered.times(contrast), exact @ contrast, rtol=1e-9)


def test_without_an_advantage_there_is_no_variance_of_it():
    assert Curvature(4, LOW, HIGH, WEIGHT, 0.7).border_variance is None


@pytest.mark.parametrize("route", ["factorized", "iterated"])
def test_what_levels_add_to_the_covariance(monkeypatch, route):
    if route == "iterated":
        monkeypatch.setattr(covariance, "_DENSE_UP_TO", 0)
    design = np.array([[0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [-0.5, 0.5]])
    means = PriorMeans(np.zeros(4), design, np.array([0.3, 0.6]))
    curvature = Curvature(4, LOW, HIGH, WEIGHT, 0.7, means=means)
    # Levels integrated out, the prior's covariance is σ²I + ZSZᵀ.
    laplacian = curvature.matrix.toarray() - 0.7 * np.eye(4)
    prior = np.eye(4) / 0.7 + design @ np.diag(means.level_sd**2) @ design.T
    exact = np.linalg.inv(laplacian + np.linalg.inv(prior))
    np.testing.assert_allclose(curvature.variances(), np.diagonal(exact), rtol=1e-10)
    group = np.array([0, 0, 0, 0])
    np.testing.assert_allclose(curvature.with_means(group), exact.mean(1), rtol=1e-9)


def test_covariances_with_the_means_of_groups(monkeypatch):
    """Two groups that never met, whom the break advantage and the levels link."""
    monkeypatch.setattr(covariance, "_DENSE_UP_TO", 0)
    design = np.array([[1.0], [0.2], [-0.4], [0.0]])
    means = PriorMeans(np.zeros(4), design, np.array([0.5]))
    pairs = np.array([0, 2]), np.array([1, 3]), np.array([2.0, 3.0])
    curvature = Curvature(4, *pairs, 0.7, BORDER, CORNER, means=means)
    exact = np.column_stack([curvature.times(row) for row in np.eye(4)])
    group = np.array([1, 1, 2, 2])
    same = (group[:, None] == group) / 2.0
    np.testing.assert_allclose(curvature.with_means(group), (exact * same).sum(1), rtol=1e-9)


def test_a_newton_step_solves_the_whole_system(bordered):
    gradient, slope = np.array([1.0, -0.3, 0.2, 0.4]), -0.6
    step, shift = bordered.newton_step(gradient, slope, 1e-12)
    exact = -np.linalg.solve(whole(bordered), np.append(gradient, slope))
    np.testing.assert_allclose(np.append(step, shift), exact, rtol=1e-8)


A, B = np.array([0, 2, 1, 0]), np.array([1, 0, 0, 2])
WON, LOST = np.array([7, 5, 3, 0]), np.array([4, 7, 7, 2])


def test_games_of_a_pair_are_added_up_whoever_is_named_first():
    counts = count_pairs(3, A, B, WON, LOST)
    assert counts.won.tolist() == [7 + 7 + 7 + 0, 4 + 3, 5 + 2]
    assert counts.lost.tolist() == [4 + 5 + 3 + 2, 7 + 7, 7 + 0]
    assert counts.games.toarray().tolist() == [[0, 21, 14], [0, 0, 0], [0, 0, 0]]
    assert list(zip(counts.low, counts.high, strict=True)) == [(0, 1), (0, 2)]


def test_sums_count_each_pair_for_both_players():
    low, high = np.array([0, 0, 1]), np.array([1, 2, 2])
    each = np.array([1.0, 10.0, 100.0])
    assert sums_by_player(4, low, high, each).tolist() == [11, 101, 110, 0]
    assert sums_by_player(4, low, high, each, -each).tolist() == [11, 99, -110, 0]


def test_a_sum_over_many_opponents_is_right_to_a_rounding():
    many = 50_000
    low, high = np.zeros(many, dtype=int), np.arange(1, many + 1)
    each = np.full(many, 2.999999)
    assert sums_by_player(many + 1, low, high, each)[0] == 2.999999 * many
