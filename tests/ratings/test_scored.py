"""One kind of prediction: its losses and its slope."""

import math

import numpy as np
import pytest

from evenbreak.ratings import walk_forward
from evenbreak.ratings.validation.calibration import Predictions


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
    assert one.mean_loss == pytest.approx(np.mean(by_hand))
    scored = one.scored(np.arange(len(one.p)), np.random.default_rng(1))
    assert scored.log_loss.value == pytest.approx(one.mean_loss)
    assert scored.brier.value == pytest.approx(np.mean((one.p - one.won) ** 2))
    assert scored.log_loss.low < scored.log_loss.value < scored.log_loss.high
