"""Form of the day in simulated leagues, from the ratings that are fitted to them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.ratings import covariance, fit
from evenbreak.ratings.day_form import day_form, with_form
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.fitted import DayForm
from ratings.validation.test_within_matches import league, league_and_skill


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
    sure, doubtful = DayForm(Estimate(0.16, 0.1, 0.22), 400), DayForm(Estimate(0.16, 0, 0.32), 90)
    assert sure.sd_error == pytest.approx(0.06 / 1.959964 / 0.8)
    assert sure.used == 0.4
    assert doubtful.used == 0.0
    season = league(0.5, 1, players=4, days=5)
    assert set(fit(season, form=0.4).to_frame()["match_form"]) == {0.4}
    assert "match_form" not in fit(season).to_frame()


@pytest.mark.parametrize("how", [{}, {"half_life": 60, "as_of": "2026-02-05"}])
def test_ratings_allow_for_form_where_it_is_established(how):
    for form_sd in (0.0, 0.7):
        season = league(form_sd, 1)
        plain = fit(season, prior_sd=0.5, **how)
        rated = with_form(season, plain)
        assert rated.match_form == rated.form.used
        assert (rated.match_form > 0.0) == (form_sd > 0.0)
        again = fit(season, prior_sd=0.5, form=rated.match_form, **how)
        assert rated.rating == pytest.approx(again.rating, abs=0.05)
        assert rated.standard_error == pytest.approx(again.standard_error, rel=0.003)
        assert rated.weight == plain.weight
        assert (rated.rating == plain.rating).all() == (form_sd == 0.0)


def test_what_can_hardly_be_games_says_nothing_about_form():
    season = league(0.5, 1)
    rng = np.random.default_rng(1)
    points = rng.choice(len(season), 8, replace=False)
    scores = season.score_a.copy(), season.score_b.copy()
    for score in scores:
        score[points] = rng.integers(40, 100, len(points))
    results = replace(season, score_a=scores[0], score_b=scores[1])
    games_alone = np.setdiff1d(np.arange(len(season)), points)
    one, other = (
        with_form(matches, fit(matches, prior_sd=0.5))
        for matches in (results, season.select(games_alone))
    )
    assert one.form == other.form
    assert one.games.sum() == 2 * (results.score_a + results.score_b).sum()  # in ratings they count


@pytest.mark.slow_after(1)
def test_errors_cover_as_often_as_they_state():
    held = {"with": [], "without": []}
    for seed in range(12):
        season, skill = league_and_skill(0.5, seed)
        plain = fit(season, prior_sd=0.5)
        for name, rated in (("without", plain), ("with", with_form(season, plain))):
            first, second = np.triu_indices(len(skill), 1)
            miss = rated.scale.log_odds(rated.rating[first] - rated.rating[second])
            miss -= skill[first] - skill[second]
            held[name] += [miss**2 <= rated.difference_variances(first, second)]
    assert np.mean(held["without"]) < 0.63
    assert np.mean(held["with"]) == pytest.approx(0.683, abs=0.035)


@pytest.mark.slow_after(1)
def test_form_is_found_in_large_leagues_from_some_of_the_matches(monkeypatch):
    season = league(0.5, 4, players=300, days=30)
    ratings = fit(season, prior_sd=0.5, form=0.5)
    form = day_form(season, ratings)
    assert form.races == len(season)
    assert form.variance.value == pytest.approx(0.25, abs=0.05)
    monkeypatch.setattr(covariance, "_DENSE_UP_TO", 10)
    assert day_form(season, ratings).variance.value == pytest.approx(form.variance.value, abs=0.003)
    monkeypatch.setitem(day_form.__globals__, "MOST", 2000)
    some = day_form(season, ratings)
    assert some.races == 2000
    assert some.variance.value == pytest.approx(form.variance.value, abs=0.06)
    assert some == day_form(season, ratings)
