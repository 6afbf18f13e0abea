"""Strengths of skill levels: the public table of 40,000 matches, and leagues of known strengths."""

import numpy as np
import pytest

from evenbreak.handicaps import LevelChart, audit_levels, level_chart, level_skills
from evenbreak.ratings.results import Results

MEAN_POINTS = {
    (7, 6): (1.50, 0.89),
    (7, 5): (1.60, 0.92),
    (7, 4): (1.78, 0.99),
    (7, 3): (2.15, 0.72),
    (7, 2): (2.23, 0.68),
    (6, 5): (1.42, 0.96),
    (6, 4): (1.49, 1.00),
    (6, 3): (1.80, 1.00),
    (6, 2): (2.31, 0.63),
    (5, 4): (1.33, 1.22),
    (5, 3): (1.53, 1.23),
    (5, 2): (2.03, 0.81),
    (4, 3): (1.48, 1.35),
    (4, 2): (1.86, 0.98),
    (3, 2): (1.63, 1.23),
}
"""Mean match points by the levels, APA 8-ball, one region, some 40,000 matches (2025)."""


def mean_points(p: float, m: int, n: int) -> tuple[float, float]:
    """Return the mean points in a race m:n, 3-0, 2-1 or 2-0, by walking through its scores."""
    reached = {(0, 0): 1.0}
    points = np.zeros(2)
    for a in range(m + 1):
        for b in range(n + 1):
            chance = reached.get((a, b), 0.0)
            if a < m and b < n:
                reached[a + 1, b] = reached.get((a + 1, b), 0.0) + chance * p
                reached[a, b + 1] = reached.get((a, b + 1), 0.0) + chance * (1 - p)
            elif a == m and b < n:
                points += chance * np.array([3 if b == 0 else 2, int(0 < b == n - 1)])
            elif b == n and a < m:
                points += chance * np.array([int(0 < a == m - 1), 3 if a == 0 else 2])
    return points[0], points[1]


def test_measured_levels_bring_the_mean_points_of_the_public_table():
    skills = level_skills("apa_8ball")
    assert skills.source == "measured"
    for (high, low), published in MEAN_POINTS.items():
        race = level_chart("apa_8ball").race(high, low)
        assert mean_points(skills.chance(high, low), *race) == pytest.approx(published, abs=0.025)


def test_steps_between_levels_are_those_of_their_pairs_within_the_errors():
    skills = level_skills("apa_8ball")
    steps = [skills.difference(k + 1, k) for k in range(2, 7)]
    assert steps == pytest.approx([100, 78, 55, 64, 74], abs=1)
    assert np.diff(skills.points) == pytest.approx(steps, abs=skills.error(3, 2))
    assert skills.difference(5, 3) == -skills.difference(3, 5)


def test_an_own_chart_is_an_assumption_until_there_are_results():
    chart = LevelChart("ours", [2, 3, 4], [[2, 2, 2], [3, 2, 2], [4, 3, 2]])
    skills = level_skills(chart)
    assert (skills.source, skills.spread) == ("chart", 0.0)
    assert skills.points.tolist() == pytest.approx(audit_levels(chart, scale="fargo").ratings)
    assert np.isnan(skills.standard_error).all()
    assert skills.error(2, 4) == 0.0
    np.testing.assert_array_equal(skills.strength([3.0, 9.0]), [skills.points[1], np.nan])


def league(rng, points, *, players=60, matches=400, spread=45.0):
    """Return the results of players whose strengths are N(their level's, spread²)."""
    level = rng.choice(np.arange(2, 8), players, p=[0.1, 0.2, 0.3, 0.2, 0.12, 0.08])
    skill = points[level - 2] + rng.normal(0.0, spread, players)
    a = rng.integers(players, size=matches)
    b = (a + rng.integers(1, players, size=matches)) % players
    m, n = level_chart("apa_8ball").races(level[a], level[b])
    p = 1.0 / (1.0 + 2.0 ** (-(skill[a] - skill[b]) / 100.0))
    won = np.zeros((2, matches), dtype=int)
    for _ in range(13):
        on, a_wins = (won[0] < m) & (won[1] < n), rng.random(matches) < p
        won += np.array([on & a_wins, on & ~a_wins])
    names = np.array([f"P{k}" for k in range(players)])
    levels = {"level_a": level[a].astype(str), "level_b": level[b].astype(str)}
    return Results.from_names(names[a].tolist(), names[b].tolist(), *won, **levels)


@pytest.mark.slow
def test_errors_from_results_cover_the_true_gaps():
    # 40 leagues of 60 players and 400 matches, whose levels differ from other leagues' by 50 points
    # (one standard deviation): 15 gaps each, strongly correlated within a league.
    rng, usual = np.random.default_rng(7), level_skills("apa_8ball")
    upper, off, spreads = np.triu_indices(6, 1), [], []
    for _ in range(40):
        truth = usual.points + rng.normal(0.0, 50.0, 6)
        found = level_skills("apa_8ball", league(rng, truth))
        assert found.source == "results"
        off.append((found.gaps - truth[:, None] + truth)[upper] / found.errors[upper])
        spreads.append(found.spread)
    assert np.mean(np.abs(off) < 1.645) == pytest.approx(0.9, abs=0.05)
    assert np.mean(spreads) == pytest.approx(45.0, abs=4.0)


def test_few_results_leave_the_measured_levels():
    rng, usual = np.random.default_rng(1), level_skills("apa_8ball")
    few = league(rng, usual.points, matches=90)
    assert level_skills("apa_8ball", few).source == "measured"


def test_many_results_outweigh_what_was_measured_elsewhere():
    rng, truth = np.random.default_rng(2), np.arange(6) * 30.0
    found = level_skills("apa_8ball", league(rng, truth, matches=3000, players=200, spread=0.0))
    assert np.diff(found.points) == pytest.approx(np.diff(truth), abs=15.0)
    assert found.spread < 20.0
