"""What is said about the prior: newcomers, races, teams, and what each is worth."""

import numpy as np
import pytest

from evenbreak.answers.prior_words import evidence_rows, group_rows, level_words, levels_data
from evenbreak.ratings import Levels, Results, best_prior, fit
from simulated_levels import league

SEASON = Results.from_names(
    ["Ann", "Cy"], ["Bo", "Di"], [30, 20], [20, 30], team_a=["X", "Y"], team_b=["Y", "X"]
)


def test_nothing_is_said_where_nothing_is_known():
    assert not list(level_words(fit(SEASON), None))
    assert group_rows(fit(SEASON)) == []


def test_teams_are_given_in_points():
    ratings = fit(SEASON, levels=Levels(team_sd=0.4))
    best, worst = group_rows(ratings)
    assert (best["name"], worst["name"]) == ("X", "Y")
    assert best["above"] == pytest.approx(-worst["above"])
    assert f"{best['above']:.1f}" in " ".join(level_words(ratings, None))


def test_the_error_of_an_estimate_is_given_with_it():
    results, *_ = league(np.random.default_rng(5), below=1.0)
    choice = best_prior(results)
    ratings = fit(results, prior_sd=choice.prior_sd, levels=choice.levels)
    data = levels_data(ratings, choice)
    assert 0 < data["joined_below_standard_error"] < data["joined_below"]
    assert f"{data['joined_below']:.1f} points below" in " ".join(level_words(ratings, choice))
    used = {row["of"]: row["used"] for row in evidence_rows(choice)}
    assert used["joined"]
    assert not used["team_sd"]
