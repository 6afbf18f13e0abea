"""Form of the day in simulated leagues of which it is known."""

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.ratings import Results, walk_forward
from evenbreak.ratings.validation.within_matches import match_form, play_races, score_shapes


def league(form_sd, seed, players=24, days=40, race=7):
    """Return a season of even races in which each match has its own form."""
    rng = np.random.default_rng(seed)
    skill = rng.normal(0.0, 0.5, players)
    order = np.concatenate([rng.permutation(players) for _ in range(days)])
    a, b = order[::2], order[1::2]
    p = expit(skill[a] - skill[b] + rng.normal(0.0, form_sd, len(a)))
    needs = np.full(len(a), race)
    won, games = play_races(p, needs, needs, rng)
    return Results(
        tuple(f"p{k:02d}" for k in range(players)), a, b, won, games - won,
        date=np.datetime64("2026-01-01") + np.repeat(np.arange(days), players // 2),
    )  # fmt: skip


def form(form_sd, seed):
    walk = walk_forward(league(form_sd, seed), prior_sd=0.5)
    return match_form(walk, walk.date_of, np.random.default_rng(1))


@pytest.mark.slow
def test_the_variance_is_near_the_truth():
    for form_sd in (0.0, 0.5):
        found = [form(form_sd, seed).variance for seed in range(4)]
        assert sum(one.low <= form_sd**2 <= one.high for one in found) >= 3
        assert np.mean([one.value for one in found]) == pytest.approx(form_sd**2, abs=0.07)


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
    walk = walk_forward(league(0.5, 1, players=4, days=5))
    assert match_form(walk, walk.date_of, np.random.default_rng(1)) is None
