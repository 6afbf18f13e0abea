"""What a validated season is said to mean: sound leagues sound, faults by their name."""

import dataclasses

import numpy as np
import pytest

from evenbreak.answers.league.validate import validate_answer, verdict
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.matches import race_win_probability
from evenbreak.ratings import Results, scale_of, validate


def said(results, **options):
    return verdict(validate(results, **options), scale_of("npl"))


@pytest.mark.slow
def test_leagues_of_the_model_are_sound(play_season):
    verdicts = [said(play_season(seed), prior_sd=0.5) for seed in range(10)]
    # Four tests at 1% each: three alarms in ten have a chance below 1%.
    assert sum(text.startswith("You can trust these ratings:") for text in verdicts) >= 8


def test_the_order_of_the_columns_is_no_fault_of_the_ratings(play_season):
    assert "column" not in said(play_season(1, side=0.15), prior_sd=0.5)


def test_a_chart_that_gives_too_much_is_found(play_season):
    assert race_win_probability(0.5, 7, 5) < 0.3
    assert "give too much" in said(play_season(2, spot=True), prior_sd=0.5)


@pytest.mark.slow
def test_a_prior_that_is_too_wide_or_too_narrow_is_refused(play_season):
    wide = said(play_season(3, matches=180), prior_sd=20.0)
    assert "866 points" in wide or "coin" in wide
    narrow = said(play_season(3), prior_sd=0.05)
    assert "2.16 points" in narrow
    assert "more often" in narrow
    assert "larger prior" in narrow


@pytest.mark.slow
def test_players_who_are_too_alike_are_not_told_apart(play_season):
    rng = np.random.default_rng(4)
    results = play_season(4, matches=120)
    turned = rng.random(120) < 0.5
    a, b = results.score_a, results.score_b
    results = Results(
        results.players, results.player_a, results.player_b, np.where(turned, b, a),
        np.where(turned, a, b), date=results.date,
    )  # fmt: skip
    assert "too equal" in said(results)
    assert "Leave prior out" in said(results, prior_sd=0.3)


def test_few_matches_are_too_few(play_season):
    results = play_season(6, matches=12)
    results = dataclasses.replace(results, date=np.datetime64("2024-09-03") + np.arange(12) // 3)
    assert "too few matches" in said(results, prior_sd=0.3)


def test_form_of_the_day_is_allowed_for(play_season):
    found = validate(play_season(7, days=0.7), prior_sd=0.5)
    assert found.forecasts.form == found.ratings.match_form > 0.5
    assert found.dispersion.p_value > 0.01
    file = ResultsFile(found.forecasts.results, "r.csv", (), (), "")
    text = " ".join(validate_answer(file, found, scale_of("npl")).sentences)
    assert text.startswith("You can trust")
    assert "Day-to-day form is allowed for" in text


def test_what_no_form_explains_makes_chances_of_matches_unreliable(demo):
    spread = demo.dispersion._replace(seen=2.0 * demo.dispersion.by_chance, p_value=0.0)
    text = verdict(dataclasses.replace(demo, dispersion=spread), scale_of("npl"))
    assert text.startswith("Do not rely")
    assert text.endswith("No command corrects this.")


def test_ratings_that_underrate_those_who_give_games_are_found(demo):
    text = verdict(demo, scale_of("npl"))
    assert text.startswith("You can trust")
    assert "players who give games win more often" in text


def test_a_default_prior_that_is_wrong_comes_after_the_answer(alike):
    scale = scale_of("npl")
    best = f"{alike.prior_sd * scale.points_per_log_odds:.3g}"
    text = verdict(alike, scale)
    assert text.startswith("You can trust these ratings")
    assert f"{best} points" in text
    assert "30 points" in text
    assert "less often" in text
