"""What a match with form of the day says about the ratings, against its exact law."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import expit, log_expit, logit
from scipy.stats import binom

from evenbreak.matches import race_win_probability
from evenbreak.matches.form import center_of_form, normal_rule
from evenbreak.ratings import Beginning, Levels, Results, fit, walk_forward
from evenbreak.ratings.form_weights import form_weights, games_weight
from ratings.validation.test_within_matches import league

NODES, WEIGHTS = normal_rule(1.0, 20, 60)


def on_days(difference, form):
    return expit(center_of_form(difference, 0.0, form) + form * NODES)


def law_of_games(difference, games, form):
    """Return P(k games are won) for k of 0 to all games."""
    return WEIGHTS @ binom.pmf(np.arange(games + 1), games, on_days(difference, form)[:, None])


@pytest.mark.parametrize("difference", [0.0, 1.0])
@pytest.mark.parametrize("games", [1, 5, 11])
@pytest.mark.parametrize("form", [0.25, 0.5])
def test_games_say_as_much_as_their_law_does(difference, games, form):
    """Fisher's information of the number won is n p q times the weight."""
    low, here, high = (law_of_games(difference + h, games, form) for h in (-1e-4, 0.0, 1e-4))
    information = (((high - low) / 2e-4) ** 2 / here).sum()
    p = expit(difference)
    said = games * p * (1.0 - p) * games_weight(difference, games, form)
    assert said == pytest.approx(information, rel=0.05)


@pytest.mark.parametrize("race", [3, 7, 11])
@pytest.mark.parametrize("form", [0.35, 0.5])
def test_races_are_not_drawn_together_by_bad_days_that_last_longer(race, form):
    """The difference at which the mean score is 0 is the true one, races ending as they do."""
    lost = np.arange(race)
    won = np.concatenate([np.full(race, race), lost])
    games = won + np.concatenate([lost, np.full(race, race)])
    log = np.array([log_expit(logit(p) * s) for p in on_days(1.0, form) for s in (1, -1)])
    log_p, log_q = log[::2, None], log[1::2, None]
    law = WEIGHTS @ np.exp(ways(race)[None] + won * log_p + (games - won) * log_q)
    assert law.sum() == pytest.approx(1.0)

    def root(form):
        def score(d):
            return law @ (games_weight(d, games, form) * (won - games * expit(d)))

        return brentq(score, 0.0, 3.0)

    assert root(form) == pytest.approx(1.0, abs=0.004)
    assert root(0.0) < 0.99


def ways(race):
    """Return the logarithm of how many orders of the games end in each score."""
    steps = np.concatenate(
        [[0.0], np.cumsum(np.log((race + np.arange(race - 1)) / (1 + np.arange(race - 1))))]
    )
    return np.concatenate([steps, steps])


def test_a_match_known_by_its_winner_says_less_with_form_unless_it_is_one_game():
    won_only = Results(
        ("a", "b"), [0, 0], [1, 1], [0, 0], [0, 0], race_a=[1, 7], race_b=[1, 7],
        winner=[1, 1], unscored=[True, True],
    )  # fmt: skip
    skill = np.array([0.4, 0.0])
    _, weight = form_weights(won_only.select([]), won_only, skill, 0.5)

    def chance(d, form):
        return WEIGHTS @ race_win_probability(on_days(d, form), 7, 7)

    def information(form):
        slope = (chance(0.401, form) - chance(0.399, form)) / 0.002
        return slope**2 / (chance(0.4, form) * (1.0 - chance(0.4, form)))

    assert weight[0] == 1.0
    assert weight[1] == pytest.approx(information(0.5) / information(0.0), abs=0.08)


def test_the_fit_is_that_of_matches_with_these_weights():
    season = league(0.5, 2, players=6, days=30)
    plain = fit(season, prior_sd=0.5)
    rated = fit(season, prior_sd=0.5, form=0.4)
    a, b = season.player_a, season.player_b
    skill = plain.scale.log_odds(plain.rating - plain.anchor)
    weight = games_weight(skill[a] - skill[b], season.score_a + season.score_b, 0.4)
    skill = rated.scale.log_odds(rated.rating - rated.anchor)
    p = expit(skill[a] - skill[b])
    games = weight * (season.score_a + season.score_b)
    contrast = np.eye(6)[a] - np.eye(6)[b]
    gradient = contrast.T @ (weight * season.score_a - games * p) - skill / 0.25
    assert gradient == pytest.approx(0.0, abs=1e-6)
    inverse = np.linalg.inv(
        contrast.T @ ((games * p * (1 - p))[:, None] * contrast) + np.eye(6) / 0.25
    )
    unit = rated.scale.points_per_log_odds
    assert rated.standard_error == pytest.approx(unit * np.sqrt(np.diag(inverse)))
    assert fit(season, prior_sd=0.5, form=0.4, near=plain).rating == pytest.approx(rated.rating)
    settled = fit(season, prior_sd=0.5, form=0.4, near=rated)
    assert settled.rating == pytest.approx(rated.rating, abs=0.02)


def test_without_form_nothing_changes():
    season = league(0.5, 2, players=6, days=30)
    assert (fit(season, form=0.0).rating == fit(season).rating).all()
    plain, same = walk_forward(season), walk_forward(season, form=0.0)
    assert (plain.p_match_integrated == same.p_match_integrated).all()


def test_form_in_ratings_brought_along_is_not_counted_twice():
    """Half a season after ratings from the other half is as the whole season at once."""
    season = league(0.5, 3, days=60)
    early = np.arange(len(season)) < len(season) // 2
    for form in (0.0, 0.5):
        before = fit(season.select(early), prior_sd=0.5, form=form)
        brought = Beginning(
            before.players,
            before.rating,
            before.quasi_error,
            scale=before.scale,
            prior_sd=before.scale.points(0.5),
            prior_mean=before.anchor,
        )
        later = season.select(~early)
        rated = fit(later, prior_sd=0.5, form=form, levels=Levels(beginning=brought))
        whole = fit(season, prior_sd=0.5, form=form)
        assert rated.quasi_error == pytest.approx(whole.quasi_error, rel=0.02)
        assert rated.rating == pytest.approx(whole.rating, abs=1.5)


def test_a_walk_is_as_uncertain_as_the_fit():
    season = league(0.5, 2, players=8, days=40)
    last = np.asarray(season.date == season.date.max())
    walk = walk_forward(season, form=0.5)
    rated = fit(season.select(~last), form=0.5)
    a, b = season.player_a[last], season.player_b[last]
    rows = walk.date_of == walk.date_of[-1]
    difference = rated.scale.log_odds(rated.rating[a] - rated.rating[b])
    assert walk.difference[rows] == pytest.approx(difference, abs=0.02)
    assert walk.sd[rows] ** 2 == pytest.approx(rated.difference_variances(a, b), rel=0.02)
    # Form leaves the chance of a game as it is, and takes from a favorite's chance of the match.
    no_form = walk_forward(replace(season), form=0.0)
    assert walk.form == 0.5
    ahead = np.abs(walk.difference) > 0.3
    even = np.abs(walk.p_match_integrated - 0.5) < np.abs(no_form.p_match_integrated - 0.5)
    assert even[ahead].all()
