"""Scores that can hardly be games do not count where games within matches are looked at."""

from collections.abc import Callable

import numpy as np
import pytest

from evenbreak.ratings import Results, fit, walk_forward
from evenbreak.ratings.day_form import day_form
from evenbreak.ratings.doubtful_scores import doubtful_scores
from evenbreak.ratings.validation.within_matches import dispersion, match_form, play_races

POINTS = 9
"""Matches written down in points, 30-19: the sum of many a long match."""


def season(points: int) -> Results:
    """A season of races to 7, in which the last matches of each player are in points."""
    rng = np.random.default_rng(3)
    a = rng.integers(0, 12, 400)
    b = (a + rng.integers(1, 12, 400)) % 12
    needs = np.full(400, 7)
    won, games = play_races(rng.uniform(0.3, 0.7, 400), needs, needs, rng)
    lost = games - won
    won[400 - points :], lost[400 - points :] = 30, 19
    date = np.datetime64("2026-01-01") + np.arange(400) // 10
    return Results(tuple(f"p{k:02d}" for k in range(12)), a, b, won, lost, date=date)


def of_match_form(results: Results) -> int:
    walk = walk_forward(results, prior_sd=0.5)
    form = day_form(results, fit(results, prior_sd=0.5))
    found = match_form(walk, form, walk.date_of, np.random.default_rng(1))
    assert found is not None
    return found.races


def of_day_form(results: Results) -> int:
    found = day_form(results, fit(results, prior_sd=0.5))
    assert found is not None
    return found.races


def of_dispersion(results: Results) -> int:
    found = dispersion(walk_forward(results, prior_sd=0.5), np.random.default_rng(1))
    assert found is not None
    return found.races


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("counted", [of_match_form, of_day_form, of_dispersion])
def test_scores_that_can_hardly_be_games_do_not_count(counted: Callable[[Results], int]) -> None:
    assert doubtful_scores(season(POINTS)).sum() == POINTS
    assert counted(season(POINTS)) == counted(season(0)) - POINTS
