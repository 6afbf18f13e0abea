"""Losses, intervals and slopes, against what is known."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar
from scipy.special import expit
from scipy.stats import binomtest

from evenbreak.ratings import walk_forward
from evenbreak.ratings.estimates import bootstrap_ratio, logistic_coefficient, wilson
from evenbreak.ratings.validation.calibration import Predictions, brier, calibration, log_loss


def test_a_coin_has_log_loss_ln_2_and_brier_a_quarter():
    p, won, games = np.full(3, 0.5), np.array([7.0, 0.0, 5.0]), np.array([10.0, 7.0, 5.0])
    assert log_loss(p, won, games) == pytest.approx(games * math.log(2))
    assert brier(p, won, games) == pytest.approx(games / 4)


def test_a_sure_prediction_that_comes_true_costs_nothing():
    assert log_loss(np.array([1.0]), np.array([7.0]), np.array([7.0])) == 0.0
    assert brier(np.array([0.0]), np.array([0.0]), np.array([7.0])) == 0.0
    assert log_loss(np.array([1.0]), np.array([6.0]), np.array([7.0])) == np.inf


def test_the_slope_is_the_most_likely_one():
    rng = np.random.default_rng(4)
    x = rng.normal(size=50)
    games = rng.integers(1, 12, 50).astype(float)
    won = rng.binomial(games.astype(int), expit(0.7 * x)).astype(float)
    found = logistic_coefficient(x, won, games, np.arange(50))
    best = minimize_scalar(
        lambda b: log_loss(expit(b * x), won, games).sum(), bracket=(0.0, 1.0), tol=1e-12
    )
    assert found is not None
    assert found.value == pytest.approx(best.x, abs=1e-6)


def test_the_interval_of_a_slope_covers_19_times_in_20():
    rng = np.random.default_rng(5)
    covered = 0
    for _ in range(400):
        x = rng.normal(0.0, 0.6, 300)
        won = (rng.random(300) < expit(x)).astype(float)
        found = logistic_coefficient(x, won, np.ones(300), np.arange(300) // 10)
        assert found is not None
        covered += found.low <= 1.0 <= found.high
    assert 0.91 <= covered / 400 <= 0.98


@pytest.mark.parametrize(
    ("x", "won"),
    [([0.0, 0.0], [1.0, 0.0]), ([1.0, 2.0], [1.0, 1.0])],
    ids=["no favorite", "won all"],
)
def test_where_nothing_determines_a_slope_there_is_none(x, won):
    assert logistic_coefficient(np.array(x), np.array(won), np.ones(2), np.arange(2)) is None


def test_the_bootstrap_draws_clusters_whole():
    """Ten copies of each match in one cluster tell no more than the match itself."""
    rng = np.random.default_rng(6)
    loss = rng.random(40)
    one = bootstrap_ratio(loss, np.ones(40), np.arange(40), np.random.default_rng(1))
    copies = np.repeat(np.arange(40), 10)
    ten = bootstrap_ratio(loss[copies], np.ones(400), copies, np.random.default_rng(1))
    assert ten == pytest.approx(one)
    split = bootstrap_ratio(loss[copies], np.ones(400), np.arange(400), np.random.default_rng(1))
    assert split.high - split.low < 0.5 * (one.high - one.low)
    half = (one.high - one.low) / 2
    assert half == pytest.approx(1.96 * loss.std() / math.sqrt(40), rel=0.1)


def test_bins_hold_the_favorites_whoever_is_called_a():
    p = np.array([0.55, 0.45, 0.5, 0.97, 0.0])
    won = np.array([6.0, 4.0, 9.0, 5.0, 0.0])
    games = np.array([10.0, 10.0, 9.0, 5.0, 3.0])
    bins = calibration(p, won, games)
    assert [(row.p_from, row.matches, row.games) for row in bins] == [
        (0.55, 2, 20),
        (0.95, 2, 8),
    ]
    assert bins[0].predicted == pytest.approx(0.55)
    assert bins[0].seen == pytest.approx(0.6)
    assert bins[1].seen == 1.0


@given(st.integers(0, 30), st.integers(1, 30))
def test_wilson_holds_the_share(won, more):
    low, high = wilson(won / (won + more), won + more)
    assert 0.0 <= low <= won / (won + more) <= high <= 1.0


def test_games_that_are_worth_less_make_wider_intervals():
    p, won, games = np.array([0.6]), np.array([60.0]), np.array([100.0])
    (all_worth,), (half_worth,) = (calibration(p, won, games, worth=w) for w in (1.0, 0.5))
    assert (all_worth.low, all_worth.high) == pytest.approx(wilson(0.6, 100))
    assert (half_worth.low, half_worth.high) == pytest.approx(wilson(0.6, 50))


@pytest.mark.parametrize(("won", "games"), [(5, 10), (0, 7), (37, 40)])
def test_wilson_is_that_of_scipy(won, games):
    exact = binomtest(won, games).proportion_ci(method="wilson")
    assert wilson(won / games, games) == pytest.approx((exact.low, exact.high))


# One kind of prediction: its losses and its slope.


@pytest.fixture(scope="module")
def walk(play_season):
    return walk_forward(play_season(np.random.default_rng(21), matches=300), prior_sd=0.35)


def test_games_and_matches_are_counted_from_the_scores(walk):
    games = Predictions.of_walk(walk, "game", "plug-in")
    matches = Predictions.of_walk(walk, "match", "plug-in")
    assert games.trials.sum() == walk.games.sum()
    assert set(matches.trials) == {1.0}
    assert (matches.won == (walk.results.score_a == 7)).all()


def test_integrated_chances_are_nearer_to_even(walk):
    plain, whole = (Predictions.of_walk(walk, "match", how) for how in ("plug-in", "integrated"))
    assert (np.abs(whole.p - 0.5) <= np.abs(plain.p - 0.5) + 1e-9).all()


def test_losses_are_the_mean_of_minus_log(walk):
    one = Predictions.of_walk(walk, "match", "integrated")
    by_hand = [-math.log(p if won else 1 - p) for p, won in zip(one.p, one.won, strict=True)]
    scored = one.scored(np.arange(len(one.p)), np.random.default_rng(1))
    assert scored.log_loss.value == pytest.approx(np.mean(by_hand))
    assert scored.brier.value == pytest.approx(np.mean((one.p - one.won) ** 2))
    assert scored.log_loss.low < scored.log_loss.value < scored.log_loss.high
