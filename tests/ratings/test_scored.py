"""One kind of prediction: its losses, its slope and its best prior."""

import math

import numpy as np
import pytest

from evenbreak.ratings import walk_forward
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.scored import PRIORS, Predictions, best_predictions, loss_as_it_went


@pytest.fixture(scope="module")
def season(play_season):
    return play_season(np.random.default_rng(21), matches=300)


@pytest.fixture(scope="module")
def walks(season):
    return [walk_forward(season, prior_sd=sd) for sd in PRIORS]


def test_games_and_matches_are_counted_from_the_scores(walks):
    games = Predictions.of_walk(walks[0], "game", "plug-in")
    matches = Predictions.of_walk(walks[0], "match", "plug-in")
    assert games.trials.sum() == walks[0].games.sum()
    assert set(matches.trials) == {1.0}
    assert (matches.won == (walks[0].results.score_a == 7)).all()


def test_integrated_chances_are_nearer_to_even(walks):
    plain, whole = (
        Predictions.of_walk(walks[4], "match", how) for how in ("plug-in", "integrated")
    )
    assert (np.abs(whole.p - 0.5) <= np.abs(plain.p - 0.5) + 1e-9).all()


def test_losses_are_the_mean_of_minus_log(walks):
    one = Predictions.of_walk(walks[3], "match", "integrated")
    by_hand = [-math.log(p if won else 1 - p) for p, won in zip(one.p, one.won, strict=True)]
    assert one.mean_loss == pytest.approx(np.mean(by_hand))
    scored = one.scored(np.arange(len(one.p)), np.random.default_rng(1))
    assert scored.log_loss.value == pytest.approx(one.mean_loss)
    assert scored.brier.value == pytest.approx(np.mean((one.p - one.won) ** 2))
    assert scored.log_loss.low < scored.log_loss.value < scored.log_loss.high


def test_the_best_prior_is_no_worse_than_those_tried(walks, season):
    best = best_predictions(walks, "game", "integrated", season, None)
    losses = [Predictions.of_walk(walk, "game", "integrated").mean_loss for walk in walks]
    assert best.mean_loss <= min(losses)
    # Between those tried the parabola's lowest point is better still.
    assert best.mean_loss < min(losses)
    assert PRIORS[0] < best.walk.prior_sd < PRIORS[-1]


def test_a_single_walk_is_the_best_one(walks, season):
    assert best_predictions(walks[:1], "game", "plug-in", season, None).walk is walks[0]
    assert loss_as_it_went(walks[:1], "game", "plug-in") is None


def test_as_it_went_the_first_date_has_the_default_prior(walks):
    two = [
        walk_forward(one.results.select(one.date_of < 2), prior_sd=one.prior_sd) for one in walks
    ]
    default = Predictions.of_walk(two[PRIORS.index(PRIOR_SD)], "game", "plug-in")
    first = default.losses[two[0].date_of == 0].sum()
    total = loss_as_it_went(two, "game", "plug-in") * default.trials.sum()
    assert total >= first > 0
