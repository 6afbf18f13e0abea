"""What a validated season is told to mean: sound leagues sound, faults by their name."""

import dataclasses

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.answers.validate_verdict import verdict
from evenbreak.answers.validate_words import findings
from evenbreak.files.results import read_results
from evenbreak.matches import race_win_probability
from evenbreak.ratings import Results, scale_of, validate
from evenbreak.ratings.within_matches import play_races
from places import DATA

PLAYERS = 24


def season(
    seed: int,
    *,
    matches: int = 900,
    side: float = 0.0,
    spot: bool = False,
    skills: float = 0.5,
    days: float = 0.0,
) -> Results:
    """Return a season by the model; with `spot`, player a of each match gives two games.

    `skills` is the spread of strengths, `days` that of good and bad days.
    """
    rng = np.random.default_rng(seed)
    skill = rng.normal(0.0, skills, PLAYERS)
    a = rng.integers(0, PLAYERS, matches)
    b = (a + rng.integers(1, PLAYERS, matches)) % PLAYERS
    m, n = np.full(matches, 7), np.full(matches, 5 if spot else 7)
    day = days * rng.standard_normal(matches) if days else 0.0
    won, games = play_races(expit(skill[a] - skill[b] + side + day), m, n, rng)
    return Results(
        tuple(f"p{k:02d}" for k in range(PLAYERS)), a, b, won, games - won,
        race_a=m, race_b=n, date=np.datetime64("2024-09-03") + np.arange(matches) // 30,
    )  # fmt: skip


def told(results: Results, **options: float) -> tuple[str, str]:
    found = validate(results, **options)
    scale = scale_of("npl")
    return verdict(found, scale), " ".join(findings(found, scale))


def test_leagues_of_the_model_are_sound():
    verdicts = [told(season(seed), prior_sd=0.5)[0] for seed in range(10)]
    # Four tests at 1 % each: three alarms in ten have a chance below 1 %.
    assert verdicts.count("The model holds for this league.") >= 8


def test_a_first_column_that_matters_is_found():
    more = "the player in the first column wins more than the model says"
    said = told(season(1, side=0.3), prior_sd=0.5)[0]
    assert "Beside that, scores are" in said
    assert more in said
    said, words = told(season(1, side=0.15), prior_sd=0.5)
    assert said == f"The model holds on the whole, but {more}."
    assert "Standing in the first column is an advantage" in words


def test_a_chart_that_gives_too_much_is_found():
    assert race_win_probability(0.5, 7, 5) < 0.3
    said, words = told(season(2, spot=True), prior_sd=0.5)
    assert said.startswith("The model holds on the whole, but the chart gives too much")
    assert "The chart gives too much" in words


def test_chances_that_are_too_sure_or_too_timid_are_found():
    said, words = told(season(3, matches=180), prior_sd=20.0)
    assert "too sure of themselves" in words
    assert said.startswith(("Do not use a prior of 866 points: chances of games", "The ratings"))
    said, words = told(season(3), prior_sd=0.05)
    assert said.startswith("Do not use a prior of 2.16 points: chances of games and of matches")
    assert "Use a larger --prior" in said
    assert "Chances of games are too timid" in words


def test_no_skill_is_not_trusted():
    rng = np.random.default_rng(4)
    results = season(4, matches=120)
    turned = rng.random(120) < 0.5
    a, b = results.score_a, results.score_b
    results = Results(
        results.players, results.player_a, results.player_b, np.where(turned, b, a),
        np.where(turned, a, b), date=results.date,
    )  # fmt: skip
    said, words = told(results, prior_sd=0.3)
    assert said == "The ratings know no more than a coin: these players are too alike."
    assert "Nothing shows that the ratings know more than a coin" in words


def test_a_few_matches_say_that_they_are_few():
    results = season(6, matches=12)
    results = dataclasses.replace(results, date=np.datetime64("2024-09-03") + np.arange(12) // 3)
    said, words = told(results, prior_sd=0.3)
    assert said.startswith("There are too few")
    assert "slope" not in words
    assert "as --prior" not in words


def test_good_and_bad_days_are_no_sound_model():
    said, words = told(season(7, days=1.0), prior_sd=0.5)
    assert said.startswith(("Do not take chances of matches", "Do not use a prior"))
    assert "Scores are more spread than the model says" in words


def test_longer_races_that_the_ratings_misjudge_are_found(demo):
    said = verdict(demo, scale_of("npl"))
    assert "longer races win more than the ratings say" in said
    words = " ".join(findings(demo, scale_of("npl")))
    assert "The chart may be right, but the ratings do not know it" in words
    assert "Nothing speaks against the chart" not in words


@pytest.fixture(scope="module")
def demo():
    place = DATA / "demo_league.csv"
    return validate(read_results(place).results, prior_sd=0.52)


@pytest.fixture(scope="module")
def chosen():
    return validate(season(5))


@pytest.fixture(scope="module")
def alike():
    """Return a season of players who are nearly equal, whom the usual prior tells apart."""
    return validate(season(8, matches=500, skills=0.2))


def test_the_usual_prior_is_judged_too(alike):
    scale = scale_of("npl")
    said, words = verdict(alike, scale), " ".join(findings(alike, scale))
    best = f"{alike.prior_sd * scale.points_per_log_odds:.3g}"
    assert said.startswith(f"Give rate and report --prior {best}: with the 30 points")
    assert "are too sure. With that prior the model holds" in said
    assert "with a prior of 30 points, chances of games are too sure (slope 0." in words


def test_the_prior_to_use_is_named_in_points_beside_the_usual_one(chosen):
    words = " ".join(findings(chosen, scale_of("fargo")))
    points = chosen.prior_sd * scale_of("fargo").points_per_log_odds
    assert f"{points:.3g} points on the scale fargo" in words
    assert "as --prior" in words
    assert "The 100 points that they use unless told otherwise cost" in words


def test_a_prior_at_the_edge_is_not_recommended():
    results = Results.from_names(
        ["A", "A"], ["B", "B"], [7, 7], [5, 0], date=["2024-09-03", "2024-09-04"]
    )
    words = told(results)[1]
    assert "Which prior to use cannot be told" in words
    assert "as --prior" not in words
