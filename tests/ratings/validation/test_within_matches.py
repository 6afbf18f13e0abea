"""Whether play inside matches is what the model says."""

import math
from itertools import pairwise, permutations

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.matches import race_win_probability
from evenbreak.matches.form import center_of_form
from evenbreak.ratings import Results, fit, walk_forward
from evenbreak.ratings.day_form import day_form
from evenbreak.ratings.validation.within_matches import (
    dispersion,
    match_form,
    play_races,
    score_shapes,
    streaks,
)


def test_a_season_of_the_model_shows_nothing(plain):
    spread, runs = dispersion(plain, np.random.default_rng(2)), streaks(plain)
    assert min(spread.p_value, runs.p_value) > 0.01
    assert spread.races == 1160


def test_good_and_bad_days_spread_the_scores(play_season):
    forecasts = walk_forward(play_season(np.random.default_rng(3), form=0.6), prior_sd=0.5)
    found = dispersion(forecasts, np.random.default_rng(2))
    assert found.seen > found.by_chance + 0.1
    assert found.p_value < 1e-4


@pytest.mark.parametrize(("streak", "sign"), [(0.5, -1), (-0.5, 1)])
def test_streaks_are_fewer_runs(play_season, streak, sign):
    forecasts = walk_forward(play_season(np.random.default_rng(4), streak=streak), prior_sd=0.5)
    found = streaks(forecasts)
    assert np.sign(found.z) == sign
    assert found.p_value < 1e-4


def test_good_and_bad_days_are_no_streaks(play_season):
    forecasts = walk_forward(play_season(np.random.default_rng(5), form=1.0), prior_sd=0.5)
    found = streaks(forecasts)
    assert found.p_value > 0.01


def test_runs_are_counted_as_every_order_of_the_racks_has_them():
    """A race 4-2 ends with an a; the other five racks come in any order."""
    results = Results.from_names(
        ["Ann", "Ann"], ["Bo", "Bo"], [4, 3], [2, 3], race_a=[4, 4], race_b=[4, 4],
        racks=["abbaaa", "ababba"], date=["2024-09-03", "2024-09-04"],
    )  # fmt: skip
    found = streaks(walk_forward(results))

    def runs(order):
        return 1 + sum(one != other for one, other in pairwise(order))

    laws = [[runs(order) for order in permutations(racks)] for racks in ("aaabb", "aaabbb")]
    assert found.runs == 3 + 5
    assert found.expected == pytest.approx(sum(np.mean(law) for law in laws))
    sd = math.sqrt(sum(np.var(law) for law in laws))
    assert found.z == pytest.approx((found.runs - found.expected) / sd)


def test_what_the_file_does_not_say_is_not_answered():
    results = Results.from_names(
        ["Ann", "Ann"], ["Bo", "Bo"], [4, 3], [4, 3], date=["2024-09-03", "2024-09-04"]
    )
    forecasts = walk_forward(results)
    assert dispersion(forecasts, np.random.default_rng(1)) is None
    assert streaks(forecasts) is None


def test_races_played_by_chance_follow_their_law():
    rng = np.random.default_rng(9)
    p, m, n = np.full(20_000, 0.6), np.full(20_000, 5), np.full(20_000, 7)
    won, games = play_races(p, m, n, rng)
    lost = games - won
    assert ((won == 5) ^ (lost == 7)).all()
    assert (won == 5).mean() == pytest.approx(race_win_probability(0.6, 5, 7), abs=0.01)
    assert (won - 0.6 * games).mean() == pytest.approx(0.0, abs=0.05)
    assert ((won - 0.6 * games) ** 2).sum() / (0.24 * games).sum() == pytest.approx(1.0, abs=0.03)


# Form of the day in simulated leagues of which it is known.


def league(form_sd, seed, players=24, days=40, race=7):
    """Return a season of even races in which each match has its own form."""
    return league_and_skill(form_sd, seed, players, days, race)[0]


def league_and_skill(form_sd, seed, players=24, days=40, race=7):
    """Return such a season, and the skills; a game's chance is what they say on average."""
    rng = np.random.default_rng(seed)
    skill = rng.normal(0.0, 0.5, players)
    order = np.concatenate([rng.permutation(players) for _ in range(days)])
    a, b = order[::2], order[1::2]
    center = center_of_form(skill[a] - skill[b], 0.0, form_sd)
    p = expit(center + rng.normal(0.0, form_sd, len(a)))
    needs = np.full(len(a), race)
    won, games = play_races(p, needs, needs, rng)
    season = Results(
        tuple(f"p{k:02d}" for k in range(players)), a, b, won, games - won,
        date=np.datetime64("2026-01-01") + np.repeat(np.arange(days), players // 2),
    )  # fmt: skip
    return season, skill


def form(form_sd, seed, **how):
    season = league(form_sd, seed, **how)
    walk = walk_forward(season, prior_sd=0.5)
    found = day_form(season, fit(season, prior_sd=0.5))
    return match_form(walk, found, walk.date_of, np.random.default_rng(1))


def test_with_form_scores_are_said_better():
    found = form(0.7, 3)
    for shape in found.shapes:
        value = shape.seen.value
        assert abs(shape.said_with_form - value) < abs(shape.said - value)
        assert shape.seen.low <= shape.said_with_form <= shape.seen.high


def test_shapes_are_those_of_the_graph_of_the_race():
    p, m, n = np.array([0.6]), np.array([3]), np.array([2])
    decider, sweep, games = score_shapes(p, m, n).ravel()
    assert decider == pytest.approx(3 * 0.6**2 * 0.4 * 1.0)  # 2-1, whoever wins the last game
    assert sweep == pytest.approx(0.6**3 + 0.4**2)
    ends = 3 * 0.6**3 + 2 * 0.4**2 + 3 * 2 * 0.6 * 0.4**2 + 4 * 3 * 0.6**2 * 0.4
    assert games == pytest.approx(ends)


def test_few_races_say_nothing():
    assert form(0.5, 1, players=4, days=5) is None
    assert form(0.5, 1, players=4, days=50) is None
