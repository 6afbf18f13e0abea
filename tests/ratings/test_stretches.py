"""Seasons predicted stretch by stretch."""

import numpy as np
import pytest

from evenbreak.ratings import Results, fit
from evenbreak.ratings.levels import Levels
from evenbreak.ratings.stretches import STRETCHES, stretch_losses


def season(days):
    rng = np.random.default_rng(3)
    a = rng.integers(0, 6, 4 * days)
    b = (a + rng.integers(1, 6, 4 * days)) % 6
    won = rng.integers(0, 8, 4 * days)
    date = np.datetime64("2026-01-01") + np.repeat(np.arange(days), 4)
    return Results(tuple("ABCDEF"), a, b, won, 7 - won, date=date)


@pytest.mark.parametrize("days", [2, 5, 200])
def test_all_stretches_but_the_first_are_predicted(days):
    steps = []
    found = stretch_losses(season(days), [{}], progress=lambda *step: steps.append(step))
    many = len(found.losses)
    assert many == min(days, STRETCHES) - 1
    assert steps == [(k, many) for k in range(1, many + 1)]
    assert found.predicted.sum() < 28 * days


def test_each_way_is_a_fit_of_the_days_before():
    results = season(2)
    (losses,), _ = stretch_losses(results, [{"prior_sd": 0.2}, {"half_life": 1.0}])
    before, coming = results.select(np.arange(4)), results.select(np.arange(4, 8))
    for loss, way in zip(losses, ({"prior_sd": 0.2}, {"half_life": 1.0}), strict=True):
        ratings = fit(before, **way)
        skill = ratings.scale.log_odds(ratings.rating)
        x = skill[coming.player_a] - skill[coming.player_b]
        by_hand = coming.score_a @ np.log1p(np.exp(-x)) + coming.score_b @ np.log1p(np.exp(x))
        assert loss == pytest.approx(by_hand)


def test_races_set_by_results_of_a_stretch_are_not_known_before_it():
    days = 3 * STRETCHES
    date = np.datetime64("2026-01-01") + np.arange(days)
    won = np.random.default_rng(1).integers(0, 8, days)
    a, b = np.zeros(days, dtype=int), np.ones(days, dtype=int)

    def losses(row, race):
        race_a = np.where(np.arange(days) % 2, 5, 7)
        race_a[row] = race
        season = Results(
            ("A", "B"), a, b, won, 7 - won, date=date, race_a=race_a, race_b=np.full(days, 7)
        )
        return stretch_losses(season, [{"levels": Levels(race=1.0)}]).losses

    np.testing.assert_array_equal(losses(-1, 3), losses(-1, 6))
    assert losses(-3, 3)[-1] != losses(-3, 6)[-1]
