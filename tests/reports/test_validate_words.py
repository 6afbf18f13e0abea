"""What a validated season is told to mean: sound leagues sound, faults by their name."""

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.matches import race_win_probability
from evenbreak.ratings import Results, scale_of, validate
from evenbreak.ratings.within_matches import play_races
from evenbreak.reports.validate_words import findings, verdict

PLAYERS = 24


def season(seed: int, *, matches: int = 900, side: float = 0.0, spot: bool = False) -> Results:
    """Return a season by the model; with `spot`, player a of each match gives two games."""
    rng = np.random.default_rng(seed)
    skill = rng.normal(0.0, 0.5, PLAYERS)
    a = rng.integers(0, PLAYERS, matches)
    b = (a + rng.integers(1, PLAYERS, matches)) % PLAYERS
    m, n = np.full(matches, 7), np.full(matches, 5 if spot else 7)
    won, games = play_races(expit(skill[a] - skill[b] + side), m, n, rng)
    return Results(
        tuple(f"p{k:02d}" for k in range(PLAYERS)), a, b, won, games - won,
        race_a=m, race_b=n, date=np.datetime64("2024-09-03") + np.arange(matches) // 30,
    )  # fmt: skip


def told(results: Results, **options: float) -> tuple[str, str]:
    found = validate(results, **options)
    return verdict(found), " ".join(findings(found, scale_of("npl")))


def test_leagues_of_the_model_are_sound():
    verdicts = [told(season(seed), prior_sd=0.5)[0] for seed in range(10)]
    # Four tests at 1 % each: three alarms in ten have a chance below 1 %.
    assert verdicts.count("The model holds for this league.") >= 8


def test_a_first_column_that_matters_is_found():
    said, words = told(season(1, side=0.3), prior_sd=0.5)
    assert said.startswith("The model holds on the whole")
    assert "Standing in the first column is an advantage" in words


def test_a_chart_that_gives_too_much_is_found():
    assert race_win_probability(0.5, 7, 5) < 0.3
    said, words = told(season(2, spot=True), prior_sd=0.5)
    assert said.startswith("The model holds on the whole")
    assert "The chart gives too much" in words


def test_chances_that_are_too_sure_or_too_timid_are_found():
    assert "too sure of themselves" in told(season(3, matches=90), prior_sd=20.0)[1]
    said, words = told(season(3), prior_sd=0.05)
    assert said.startswith("The model does not hold")
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
    assert said.startswith(("There are too few", "The ratings predict worse"))
    assert "cannot be told" in words


@pytest.fixture(scope="module")
def chosen():
    return validate(season(5))


def test_the_prior_to_use_is_named_in_points_beside_the_usual_one(chosen):
    words = " ".join(findings(chosen, scale_of("fargo")))
    points = chosen.prior_sd * scale_of("fargo").points_per_log_odds
    assert f"{points:.3g} points on the scale fargo" in words
    assert "as --prior" in words
    assert "The 100 points that are used unless another is given" in words


def test_a_prior_at_the_edge_is_not_recommended():
    results = Results.from_names(
        ["A", "A"], ["B", "B"], [7, 7], [5, 0], date=["2024-09-03", "2024-09-04"]
    )
    words = told(results)[1]
    assert "Which prior to use cannot be told" in words
    assert "as --prior" not in words
