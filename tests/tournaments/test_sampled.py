"""Odds with drawn first rounds: near the exact ones, by as much as their standard errors say."""

from __future__ import annotations

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.tournaments import (
    double_elimination,
    groups_then_knockout,
    round_robin,
    single_elimination,
    title_odds,
)
from evenbreak.tournaments.odds.cut import cut_before
from evenbreak.tournaments.odds.planning import elimination_order, exact_plan, plan_of
from evenbreak.tournaments.odds.sampled import slope_of
from tournaments.fields import by_seed, one_favorite


@pytest.mark.slow_after(2)
@pytest.mark.parametrize(
    "bracket",
    [
        double_elimination(16),
        double_elimination(11, final="single"),
        double_elimination(16, qualifiers=4),
        groups_then_knockout(12, 4),
        single_elimination(16, third_place=True),
    ],
    ids=lambda bracket: f"{bracket.format} {len(bracket.players)}",
)
def test_drawn_odds_are_those_that_are_exact(bracket, monkeypatch) -> None:
    win = by_seed(len(bracket.players))
    exact = title_odds(bracket, win)
    monkeypatch.setattr("evenbreak.tournaments.odds.sampled._STATES_PER_SAMPLE", 500.0)
    drawn = title_odds(bracket, win, most_states=0, samples=4000)
    assert exact.exact
    assert drawn.samples == 4000
    gap = np.abs(drawn.p_place - exact.p_place)
    assert (gap <= 5.0 * drawn.error + 1e-9).all()
    assert drawn.error[:, 0].max() < 0.004
    assert drawn.p_place.sum(axis=0) == pytest.approx(exact.p_place.sum(axis=0), abs=1e-9)
    assert drawn.p_place.sum(axis=1) == pytest.approx(np.ones(len(win)), abs=1e-9)
    assert drawn.matches_mean == pytest.approx(exact.matches_mean, abs=0.02)
    meet = drawn.expected_meetings() - exact.expected_meetings()
    assert np.abs(meet).max() < 0.06


@pytest.mark.parametrize("tiny", [1.0, 1e-5, 1e-9, 0.0])
def test_controls_that_repeat_each_other_or_never_vary_are_no_hindrance(tiny: float) -> None:
    rng = np.random.default_rng(4)
    plain = (rng.random((500, 6)) < 0.3).astype(float)
    y = plain @ rng.random((6, 3)) + 0.1 * rng.random((500, 3))
    more = [plain[:, :2], 1.0 - plain, np.ones((500, 2)), tiny * plain[:, :1], 0.0 * plain]
    found = []
    for x in (plain, np.concatenate([plain, *more], axis=1)):
        x = x - x.mean(axis=0)
        slope, rank = slope_of(x.T @ x, x.T @ (y - y.mean(axis=0)), 500)
        assert rank == 6
        found.append(x @ slope)
    np.testing.assert_allclose(found[0], found[1], atol=1e-6)


@pytest.mark.slow
def test_standard_errors_are_honest() -> None:
    """Over many seeds, misses are as large as the standard errors say."""
    bracket, win = double_elimination(8), by_seed(8)
    exact = title_odds(bracket, win).title
    scores = []
    for seed in range(12):
        rng = np.random.default_rng(seed)
        drawn = title_odds(bracket, win, most_states=0, samples=400, rng=rng)
        scores.append((drawn.title - exact) / np.maximum(drawn.error[:, 0], 1e-12))
    assert 0.6 < np.std(scores) < 1.5


@pytest.mark.slow
@pytest.mark.parametrize("drops", ["fewest rematches", "usual"])
def test_a_favorite_in_a_drawn_bracket(drops) -> None:
    odds = title_odds(double_elimination(32, drops=drops), one_favorite(32, 2 / 3), samples=2000)
    assert not odds.exact
    assert odds.title[0] == pytest.approx(30080 / 177147, abs=5 * odds.error[0, 0] + 1e-15)
    assert odds.error[0, 0] < 0.002


@pytest.mark.slow
def test_a_drawn_bracket_after_some_results() -> None:
    bracket, win = double_elimination(32), by_seed(32)
    results = {"W1.1": "32"}
    odds = title_odds(bracket, win, results=results, samples=1000)
    assert not odds.exact
    assert odds.p_place.sum(axis=1) == pytest.approx(np.ones(32), abs=1e-9)
    assert odds.title[0] < title_odds(bracket, win, samples=1000).title[0]
    with pytest.raises(InputError, match="F"):
        title_odds(bracket, win, results={"F": "1"})


def test_a_large_group_is_played_out() -> None:
    odds = title_odds(round_robin(9), np.full((9, 9), 0.5), samples=4000)
    assert not odds.exact
    assert odds.title == pytest.approx([1 / 9] * 9, abs=0.03)


def test_what_would_be_too_large_is_not_begun() -> None:
    assert exact_plan(double_elimination(64)) is None
    assert exact_plan(double_elimination(16), (), 1000) is None
    assert plan_of(double_elimination(8)).states < 2000


@pytest.mark.parametrize(
    ("players", "drops", "most"),
    [(8, "usual", 672), (16, "usual", 73_728), (32, "straight", 115_200)],
)
def test_few_joint_states_are_open(players: int, drops, most: int) -> None:
    """No more than with a plain dictionary of states."""
    plan = plan_of(double_elimination(players, drops=drops))
    assert max(step.size for step in plan.steps) <= most


def test_the_estimate_is_on_the_safe_side() -> None:
    for bracket in (double_elimination(16), double_elimination(32, drops="straight")):
        plan = plan_of(bracket)
        assert plan.states <= elimination_order(bracket).states


def test_the_cut_is_between_rounds() -> None:
    cut = cut_before(double_elimination(32), 1e5)
    assert {name.split(".")[0] for name in cut.early} == {"W1", "W2", "L1"}
    assert len(cut.entrants) == len(cut.rest.players) == 24
