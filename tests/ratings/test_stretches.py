"""Seasons predicted stretch by stretch."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import expit
from scipy.stats import norm

from evenbreak.ratings import Results, fit
from evenbreak.ratings.integrated import Scores
from evenbreak.ratings.levels import Levels
from evenbreak.ratings.stretches import SOLVED_AT_ONCE, STRETCHES, stretch_losses


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


def by_hand(before, coming, way):
    """Return what is lost in a stretch, each match integrated by an adaptive rule."""
    ratings = fit(before, **way)
    skill = ratings.scale.log_odds(ratings.rating)
    a, b = coming.player_a, coming.player_b
    sd = np.sqrt(ratings.difference_variances(a, b))
    total = 0.0
    for mean, off, won, lost in zip(
        skill[a] - skill[b], sd, coming.score_a, coming.score_b, strict=True
    ):
        known = norm(mean, off)
        chance, _ = quad(
            lambda d: expit(d) ** won * expit(-d) ** lost * known.pdf(d),  # noqa: B023
            mean - 12 * off,
            mean + 12 * off,
            epsabs=0.0,
            limit=200,
        )
        total -= math.log(chance)
    return total


def test_each_way_is_a_fit_of_the_days_before():
    results = season(2)
    ways = {"prior_sd": 0.2}, {"half_life": 1.0}, {"levels": Levels(newcomers=0.4)}
    (losses,) = stretch_losses(results, ways).losses
    before, coming = results.select(np.arange(4)), results.select(np.arange(4, 8))
    expected = [by_hand(before, coming, way) for way in ways]
    np.testing.assert_allclose(losses, expected, rtol=1e-6)


def test_in_a_league_of_many_players_that_is_nearly_so():
    rng = np.random.default_rng(1)
    players, matches = SOLVED_AT_ONCE + 40, 900
    a = rng.integers(0, players, matches)
    b = (a + rng.integers(1, players, matches)) % players
    won = rng.binomial(9, expit(rng.normal(0.0, 0.7, matches)))
    date = np.datetime64("2026-01-01") + np.repeat([0, 1], [700, 200])
    results = Results(tuple(f"p{k:03d}" for k in range(players)), a, b, won, 9 - won, date=date)
    (losses,) = stretch_losses(results, [{"prior_sd": sd} for sd in (0.2, 0.6, 1.5)]).losses
    before, coming = results.select(date == date[0]), results.select(date > date[0])
    scores = Scores.of(coming, coming.won_only(), breaks=False)
    for sd, loss in zip((0.2, 0.6, 1.5), losses, strict=True):
        ratings = fit(before, prior_sd=sd)
        skill = ratings.scale.log_odds(ratings.rating)
        a, b = coming.player_a, coming.player_b
        mean, variance = skill[a] - skill[b], ratings.difference_variances(a, b)
        exact = -scores.log_chances(mean[None], variance[None], np.zeros(1)).sum()
        assert loss == pytest.approx(exact, abs=0.3)


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


def test_where_a_mode_is_looked_for_first_does_not_matter():
    """Modes begin on lines through those found before: the same ways in another order agree."""
    results = season(3)
    ways = [{"prior_sd": 0.5, "levels": Levels(newcomers=size)} for size in (0.0, 0.2, 0.4, 1.2)]
    ways += [{"prior_sd": width} for width in (0.1, 0.2, 2.0)]
    forth, back = stretch_losses(results, ways), stretch_losses(results, ways[::-1])
    each = np.hstack([stretch_losses(results, [way]).losses for way in ways])
    np.testing.assert_allclose(forth.losses, back.losses[:, ::-1], rtol=1e-6)
    np.testing.assert_allclose(forth.losses, each, rtol=1e-6)
