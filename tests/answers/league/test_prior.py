"""What is said about the prior: newcomers, races, teams, and what each is worth."""

import numpy as np
import pytest

from evenbreak.answers.league.prior import (
    evidence_rows,
    group_rows,
    groups_warnings,
    level_words,
    levels_data,
)
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.ratings import Levels, Results, best_prior, fit, levels
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.prior import Evidence, PriorChoice
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


@pytest.mark.slow
def test_the_error_of_an_estimate_is_given_with_it():
    results, *_ = league(np.random.default_rng(5), below=1.0)
    choice = best_prior(results)
    ratings = fit(results, prior_sd=choice.prior_sd, levels=choice.levels)
    data = levels_data(ratings, choice)
    assert 0 < data["joined_below_standard_error"] < data["joined_below"]
    below, error = data["joined_below"], data["joined_below_standard_error"]
    text = " ".join(level_words(ratings, choice))
    assert f"{below:.1f} ± {error:.1f} points below" in text
    used = {row["of"]: row["used"] for row in evidence_rows(choice)}
    assert used["joined"]
    assert not used["team_sd"]


def test_by_how_much_players_differ_is_said_with_its_error():
    season = Results.from_names(["Ann"], ["Bo"], [7], [5], race_a=[7], race_b=[6])
    found = Evidence("race", (3.08,), (Estimate(0.01, 0.001, 0.03),), True, 3.08, 0.1)
    choice = PriorChoice(0.7, (0.7,), (0.6,), 200, 0.7, 0.7, True, 0.6, evidence=(found,))
    (text,) = level_words(fit(season, levels=Levels(race=3.08)), choice)
    assert "differ by 3.08 ± 0.10 times what their races make up for" in text


def test_what_rests_on_few_players_is_said_not_to_be_used():
    gains = (Estimate(0.001, 0.0005, 0.0015),)
    found = Evidence("joined", (0.4,), gains, False, 0.4, players=12, too_few=True)
    choice = PriorChoice(0.7, (0.7,), (0.6,), 200, 0.7, 0.7, True, 0.6, evidence=(found,))
    assert list(level_words(fit(SEASON), choice)) == [
        "Joining late was not used: the evidence for it comes from 12 players."
    ]
    (row,) = evidence_rows(choice)
    assert (row["used"], row["players"]) == (False, 12)
    assert not list(level_words(fit(SEASON), choice._replace(evidence=())))


def test_how_much_of_the_field_newcomers_have_is_said():
    ratings = fit(SEASON, levels=Levels(field=0.85))
    (text,) = level_words(ratings, None)
    assert "85% of the difference between that field and the usual one" in text
    found = Evidence("field", (0.75,), (Estimate(0.001, 0.0005, 0.0015),), True, 0.85, 0.1)
    choice = PriorChoice(0.7, (0.7,), (0.6,), 200, 0.7, 0.7, True, 0.6, evidence=(found,))
    (text,) = level_words(ratings, choice)
    assert "85% (± 10%) of" in text
    assert levels_data(ratings, choice)["field_standard_error"] == 0.1


def test_teams_that_are_too_many_to_compare_are_said_not_to_be_used(monkeypatch):
    file = ResultsFile(SEASON, "r.csv", (), (), "")
    chosen = PriorChoice(0.7, (0.7,), (0.6,), 200, 0.7, 0.7, True, 0.6)
    assert levels.has_groups(SEASON, "team")
    assert not list(groups_warnings(file, chosen))
    monkeypatch.setattr(levels, "MOST_SHARES", 7)
    assert not levels.has_groups(SEASON, "team")
    assert list(groups_warnings(file, chosen)) == [
        "The difference between teams was not used: 2 for 4 players are too many to compare."
    ]
    assert not list(groups_warnings(file, chosen._replace(learned=False)))
    assert not list(groups_warnings(file, None))


def test_a_share_of_the_field_above_one_is_said():
    assert "125% of the difference" in " ".join(
        level_words(fit(SEASON, levels=Levels(field=1.25)), None)
    )
