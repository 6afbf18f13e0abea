"""Form of the day in simulated leagues, from the ratings that are fitted to them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.ratings import fit
from evenbreak.ratings.day_form import day_form
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.fitted import DayForm
from ratings.validation.test_within_matches import league


def found(form_sd, seed, **how):
    season = league(form_sd, seed)
    return day_form(season, fit(season, prior_sd=0.5, **how))


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("form_sd", [0.0, 0.5])
def test_the_interval_covers_the_truth(form_sd):
    forms = [found(form_sd, seed) for seed in range(10)]
    assert sum(one.variance.low <= form_sd**2 <= one.variance.high for one in forms) >= 8
    assert np.mean([one.variance.value for one in forms]) == pytest.approx(form_sd**2, abs=0.06)
    assert sum(one.established for one in forms) >= 8 if form_sd else True
    assert sum(one.established for one in forms) == 0 if not form_sd else True


def test_a_match_is_compared_with_the_ratings_without_it():
    season = league(0.5, 3, players=6, days=40)
    ratings = fit(season, prior_sd=0.5)
    a, b = season.player_a[:1], season.player_b[:1]
    won, lost = float(season.score_a[0]), float(season.score_b[0])
    variance = ratings.difference_variances(a, b)[0]
    d = ratings._skill[a][0] - ratings._skill[b][0]
    left = 1.0 - variance * (won + lost) * expit(d) * expit(-d)
    rest = fit(season.select(np.arange(1, len(season))), prior_sd=0.5)
    without = d - variance * (won - (won + lost) * expit(d)) / left
    assert without == pytest.approx((rest._skill[a] - rest._skill[b])[0], abs=0.002)
    assert variance / left == pytest.approx(rest.difference_variances(a, b)[0], rel=0.01)
    error = ratings.difference_error(season.players[a[0]], season.players[b[0]])
    assert variance**0.5 == pytest.approx(ratings.scale.log_odds(error))


def test_form_is_found_with_old_matches_counting_less_and_up_to_a_day():
    season = league(0.7, 1)
    ratings = fit(season, prior_sd=0.5, half_life=60, as_of="2026-02-05")
    form = day_form(season, ratings)
    assert form.established
    assert form.races == ratings.matches == len(season) - ratings.later


def test_few_matches_and_a_break_advantage_say_nothing():
    season = league(0.5, 1, players=4, days=5)
    assert day_form(season, fit(season)) is None
    season = league(0.5, 1, players=12, days=40)
    assert day_form(season, replace(fit(season), break_advantage=5.0)) is None


def test_only_what_is_established_is_stated():
    ratings = fit(league(0.5, 1, players=4, days=5))
    sure, doubtful = DayForm(Estimate(0.16, 0.1, 0.22), 400), DayForm(Estimate(0.16, 0, 0.32), 90)
    assert sure.sd_error == pytest.approx(0.06 / 1.96 / 0.8)
    stated = replace(ratings, form=sure)
    assert stated.match_form == 0.4
    assert set(stated.to_frame()["match_form"]) == {0.4}
    assert replace(ratings, form=doubtful).match_form == ratings.match_form == 0.0
    assert "match_form" not in ratings.to_frame()
