"""What a file knows about players: design of the prior, and levels of simulated leagues."""

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.errors import InputError
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings import Results, best_prior, fit, walk_forward
from evenbreak.ratings.clear_gains import FEWEST_PLAYERS
from evenbreak.ratings.levels import (
    NEWER,
    RECENT,
    Levels,
    StatedStrength,
    has_handicaps,
    implied_difference,
    joined_late,
    known_levels,
    means_of,
    met_as_newcomers,
    newness,
)
from evenbreak.ratings.validation.starts import starts
from simulated_levels import SPREAD, TEAMS, givers, harm, league, race_covered, teams_covered

SEASON = Results.from_names(
    ["Ann", "Cy", "Ann"],
    ["Bo", "Di", "Eve"],
    [7, 5, 0],
    [5, 7, 0],
    team_a=["X", "Y", "X"],
    team_b=["X", "Y", "Y"],
    date=["2026-01-01", "2026-01-02", "2026-01-03"],
)


def test_a_match_to_come_says_who_is_in_which_team():
    means = means_of(SEASON, Levels(team_sd=0.3))
    assert means.names == (("team", "X"), ("team", "Y"))
    ann, bo, cy, _, eve = means.design
    np.testing.assert_allclose(ann - cy, [1, -1])
    np.testing.assert_allclose(ann, bo)
    np.testing.assert_allclose(eve, cy)


def test_ratings_of_those_who_played_have_the_anchor_as_their_mean():
    for levels in (Levels(newcomers=0.5), Levels(team_sd=0.4)):
        ratings = fit(SEASON, anchor=500, levels=levels)
        assert ratings.rating[:4].mean() == pytest.approx(500)
    assert fit(SEASON, levels=Levels(newcomers=0.5)).rating[4] < 80


def test_levels_are_those_of_the_whole_covariance():
    """Against the mode and the inverse Hessian of the prior without extra unknowns."""
    levels = Levels(team_sd=0.4)
    results, *_ = league(np.random.default_rng(3), days=4)
    ratings = fit(results, prior_sd=SPREAD, levels=levels)
    design = means_of(results, levels).design
    prior = SPREAD**2 * np.eye(len(results.players)) + 0.4**2 * design @ design.T
    skill = np.zeros(len(prior))
    for _ in range(50):
        p = 1 / (1 + np.exp(skill[results.player_b] - skill[results.player_a]))
        games = results.score_a + results.score_b
        slope, bend = results.score_a - games * p, games * p * (1 - p)
        contrast = np.zeros((len(results), len(skill)))
        contrast[np.arange(len(results)), results.player_a] = 1
        contrast[np.arange(len(results)), results.player_b] = -1
        hessian = contrast.T @ (bend[:, None] * contrast) + np.linalg.inv(prior)
        skill = skill + np.linalg.solve(hessian, contrast.T @ slope - np.linalg.solve(prior, skill))
    covariance = np.linalg.inv(hessian)
    log_odds = ratings.scale.log_odds
    np.testing.assert_allclose(log_odds(ratings.rating - 80), skill, atol=1e-6)
    error = np.sqrt(np.diag(covariance))
    np.testing.assert_allclose(log_odds(ratings.standard_error), error, rtol=1e-6)
    difference = covariance[0, 0] + covariance[1, 1] - 2 * covariance[0, 1]
    found = log_odds(ratings.difference_error(*ratings.players[:2]))
    assert found == pytest.approx(np.sqrt(difference))
    quasi = log_odds(ratings.quasi_error) ** 2
    size = len(quasi)
    pairs = size * np.trace(covariance) - covariance.sum()
    assert quasi.sum() * (size - 1) == pytest.approx(pairs)


def test_a_walk_with_levels_ends_where_a_fit_begins():
    results, *_ = league(np.random.default_rng(4), days=6, below=0.5)
    levels = Levels(newcomers=0.6, team_sd=0.3)
    walk = walk_forward(results, prior_sd=SPREAD, levels=levels)
    last = walk.date_of == walk.date_of.max()
    earlier = walk.results.select(~last).joined(walk.results.select(last).unplayed())
    ratings = fit(earlier, prior_sd=SPREAD, levels=levels)
    coming = walk.results.select(last)
    skill = ratings.scale.log_odds(ratings.rating)
    expected = skill[coming.player_a] - skill[coming.player_b]
    np.testing.assert_allclose(walk.difference[last], expected, atol=1e-5)


@pytest.mark.slow
def test_those_who_join_late_and_are_weaker_are_expected_to_be():
    results, _, skill = league(np.random.default_rng(5), below=1.0)
    found = {one.of: one for one in best_prior(results).evidence}
    joined, late = found["joined"], joined_late(results) > 0
    truth = skill[~late].mean() - skill[late].mean()
    assert joined.used
    assert joined.players >= FEWEST_PLAYERS
    assert not found["newcomers"].used
    assert abs(joined.value - truth) < 1.96 * joined.standard_error < truth


@pytest.mark.slow
def test_a_handful_of_many_players_are_too_few_to_expect_less_of_those_who_join_late():
    results, *_ = league(np.random.default_rng(1), below=2.0, players=78, joiners=0.065)
    choice = best_prior(results, half_life=None)
    (joined,) = [one for one in choice.evidence if one.of == "joined"]
    assert (joined.used, joined.too_few) == (False, True)
    assert joined.players == joined_late(results).sum()
    # Nor may they come in by another door.
    assert choice.levels.joined == choice.levels.newcomers == 0.0


def test_who_met_others_as_a_newcomer_is_who_was_clearly_newer():
    results, *_ = league(np.random.default_rng(3), days=8, below=0.5)
    games, new = np.zeros(len(results.players)), set()
    for a, b, m, n in zip(
        results.player_a, results.player_b, results.score_a, results.score_b, strict=True
    ):
        for player, other in ((a, b), (b, a)):
            if newness(games[player]) - newness(games[other]) > NEWER:
                new.add(player)
        games[[a, b]] += m + n
    assert 0 < len(new) < len(games)
    assert set(np.flatnonzero(met_as_newcomers(results))) == new


@pytest.mark.slow
def test_teams_that_differ_are_found_and_others_are_not():
    results, truth, _ = league(np.random.default_rng(6), team_sd=0.6)
    choice = best_prior(results)
    assert choice.levels.team_sd > 0
    ratings = fit(results, prior_sd=choice.prior_sd, levels=choice.levels)
    best = max(ratings.groups, key=lambda one: one.above)
    assert best.name == f"team {truth.argmax()}"


def test_estimated_levels_cover_the_truth():
    covered = np.concatenate([teams_covered(seed) for seed in range(25)])
    assert len(covered) == 25 * TEAMS
    assert 0.9 <= covered.mean() <= 0.99


@pytest.mark.slow
@pytest.mark.parametrize("truth", [1.0, 3.0])
def test_the_real_part_of_stated_races_is_covered(truth):
    found = [race_covered(seed, truth) for seed in range(2)]
    known = [one for one in found if one is not None]
    assert sum(known) >= len(known) - 1
    assert known


@pytest.mark.slow
@pytest.mark.parametrize("drift", [pytest.param(0.0, marks=pytest.mark.thorough), 0.06])
@pytest.mark.parametrize("truth", [1.0, 3.0])
def test_who_gives_games_is_said_to_win_what_they_win(truth, drift):
    won, said, of = np.array([givers(seed, truth, drift=drift) for seed in range(2)]).T
    assert abs(won - said).mean() < 3.3 * np.sqrt((won * (1.0 - won) / of).mean())


@pytest.mark.slow
def test_one_estimate_of_what_races_take_back_is_used_and_said():
    results, *_ = league(np.random.default_rng(1), races=3.0)
    choice = best_prior(results)
    share = starts(results).share
    assert choice.levels.race == share.value
    (found,) = (one for one in choice.evidence if one.of == "race")
    assert (found.value, found.standard_error) == (share.value, share.standard_error)


@pytest.mark.slow
def test_a_league_without_levels_is_not_made_worse():
    costs = [harm(seed)[0] for seed in range(2)]
    assert np.mean(costs) <= 0.0002


def test_what_a_file_knows():
    assert known_levels(SEASON) == ("team_sd", "newcomers")
    assert known_levels(league(np.random.default_rng(1), days=6, races=1.0)[0])[0] == "race"


def test_nonsense_is_refused():
    with pytest.raises(InputError, match="team_sd"):
        Levels(team_sd=-1.0)


# Strengths by the races that a league makes its players play.


def season(a, b, race_a, race_b, **more):
    zeros = [0] * len(a)
    return Results.from_names(a, b, zeros, zeros, race_a=race_a, race_b=race_b, **more)


def test_the_implied_difference_makes_the_race_even():
    results = season(["A"] * 3, ["B"] * 3, [7, 2, 5], [3, 6, 5])
    p = expit(implied_difference(results))
    np.testing.assert_allclose(race_win_probability(p, [7, 2, 5], [3, 6, 5]), 0.5, atol=1e-9)


def test_strengths_have_the_implied_differences():
    results = season(["A", "B", "C"], ["B", "C", "A"], [5, 4, 3], [4, 5, 5])
    known = StatedStrength(results)
    assert not known.strength().any()
    known.see(slice(0, 1))
    a, b, c = known.strength()
    assert c == 0
    assert a - b == pytest.approx(implied_difference(results)[0], rel=0.01)


def test_even_races_are_no_handicaps():
    assert not has_handicaps(season(["A"], ["B"], [5], [5]))
    assert has_handicaps(season(["A"], ["B"], [5], [4]))


@pytest.mark.parametrize("more", [1, 6, 60])
def test_a_race_counts_less_the_more_races_both_have_had_since(more):
    many = 10 + more
    date = np.datetime64("2026-01-01") + np.maximum(np.arange(many) - 9, 0)
    results = season(["A"] * many, ["B"] * many, [5] * 10 + [7] * more, [5] * many, date=date)
    shuffled = np.random.default_rng(1).permutation(many)
    for order in (np.arange(many), shuffled):
        known = StatedStrength(results.select(order))
        known.see(slice(None))
        a, b = known.strength()
        weight = 0.5 ** (np.arange(more) / RECENT)
        old = 10 * 0.5 ** (more / RECENT)
        share = weight.sum() / (weight.sum() + old)
        assert a - b == pytest.approx(share * implied_difference(results)[-1], rel=0.01)


def test_who_pauses_keeps_what_races_said():
    dates = ["2020-01-01", *(f"2026-01-{day:02d}" for day in range(1, 31))]
    results = season(["A", *["C"] * 30], ["B", *["D"] * 30], [7, *[5] * 30], [5] * 31, date=dates)
    known = StatedStrength(results)
    known.see(slice(None))
    a, b, *_ = known.strength()
    assert a - b == pytest.approx(implied_difference(results)[0], rel=0.01)
