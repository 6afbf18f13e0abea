"""The modes of several ways of rating, found together."""

import numpy as np
import pytest

from evenbreak.ratings import Levels, Results
from evenbreak.ratings.beginning import PriorMeans
from evenbreak.ratings.fit import weights_of
from evenbreak.ratings.likelihood_terms import likelihood_terms
from evenbreak.ratings.posterior import WayToRate, find_mixed_mode, find_modes
from evenbreak.ratings.results_frame import FORMATS
from evenbreak.ratings.stretches import SeasonSoFar


def season(matches=60, players=9, seed=5):
    """Scores, matches known by their winner alone, racks whose breaker is known, and teams."""
    rng = np.random.default_rng(seed)
    a = rng.integers(0, players, matches)
    b = (a + rng.integers(1, players, matches)) % players
    lost, race = rng.integers(0, 7, matches), np.full(matches, 7)
    a_won = rng.random(matches) < 0.5
    unscored = rng.random(matches) < 0.3
    return Results(
        tuple("ABCDEFGHI"[:players]), a, b, np.where(unscored, 0, np.where(a_won, 7, lost)),
        np.where(unscored, 0, np.where(a_won, lost, 7)),
        date=np.datetime64("2026-01-01") + np.sort(rng.integers(0, 90, matches)),
        race_a=race, race_b=race, unscored=unscored,
        break_format=np.full(matches, FORMATS.index("alternate")),
        first_break=rng.integers(1, 3, matches),
        winner=np.where(unscored, rng.integers(1, 3, matches), 0),
        team_a=np.array(["Cues", "Bridges", "Chalk"])[a % 3],
        team_b=np.array(["Cues", "Bridges", "Chalk"])[b % 3],
    )  # fmt: skip


def way(results, sd, *, half_life=None, means=None, advantage=0.0, break_precision=None):
    scored, won_only = results.played().results, results.won_only()
    weights = weights_of(scored, won_only, half_life, None)
    terms = likelihood_terms(scored, won_only, weights, breaks=True)
    return WayToRate(terms, sd**-2, advantage, break_precision, means)


def test_each_mode_is_that_of_its_way_alone():
    results = season()
    rng = np.random.default_rng(8)
    teams = PriorMeans(
        rng.normal(0.0, 0.5, 9), np.eye(3)[np.arange(9) % 3], np.array([0.3, 0.3, 0.8])
    )
    ways = [
        way(results, 0.1),
        way(results, 2.0, advantage=0.2),
        way(results, 0.5, half_life=20.0),
        way(results, 0.4, means=teams),
        way(results, 0.6, means=teams, break_precision=2.0),
        way(results, 1.5, break_precision=0.01, half_life=30.0),
    ]
    for skill, advantage, one in zip(*find_modes(ways), ways, strict=True):
        alone = find_mixed_mode(
            one.terms,
            one.precision,
            advantage=one.advantage,
            break_precision=one.break_precision,
            means=one.means,
        )
        assert skill == pytest.approx(alone.point[:9], abs=1e-7)
        assert advantage == pytest.approx(alone.point[-1], abs=1e-7)


def test_a_far_start_makes_no_difference():
    ways = [way(season(), 0.5), way(season(), 50.0)]
    far, near = find_modes(ways, np.linspace(-9.0, 9.0, 9)), find_modes(ways)
    assert far[0] == pytest.approx(near[0], abs=1e-3)


def test_both_routes_rate_alike(monkeypatch):
    results = season()
    ways = [
        {"prior_sd": sd, "half_life": days, "levels": Levels(newcomers=0.4, team_sd=0.2)}
        for sd, days in ((0.1, None), (0.4, 30.0))
    ]
    together, _ = SeasonSoFar(results).skills(ways)
    monkeypatch.setattr("evenbreak.ratings.stretches.SOLVED_AT_ONCE", 0)
    alone, _ = SeasonSoFar(results).skills(ways)
    assert together == pytest.approx(alone, abs=1e-7)
