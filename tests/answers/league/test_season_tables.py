"""Tables of simulated seasons: equal to those counted by hand from seasons played one by one."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from evenbreak.answers.league.season_tables import fairness_frame, standings_frame, weeks_frame
from evenbreak.handicaps.charts.chart import Chart, ChartRow
from evenbreak.handicaps.ladders.comparison import near
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.league import (
    FixedSchedule,
    LeaguePlayers,
    Season,
    Tally,
    run_chunk,
    season_matches,
)
from evenbreak.ratings.scale import SCALES, Scale

NAMES = ["Ann", "Bo", "Cy", "Di", "Ed"]

WITNESSES = 1_200

EVEN = Chart("even", [ChartRow(0, None, 5, 5)])
"""A chart whose races are even whatever the ratings are."""


def a_season(**columns: Any) -> Season:
    """All that a season can have: newcomers, absences, drift, days, who comes and who goes."""
    given: dict[str, Any] = {
        "skill": [95, 80, 70, 55, 62],
        "skill_sd": [0, 4, 0, 0, 6],
        "day_sd": [0, 0, 8, 0, 5],
        "drift": [0, 0.4, 0, -0.3, 0],
        "joins": [1, 1, 3, 1, 1],
        "leaves": [0, 0, 0, 5, 0],
        "absence": [0, 0.3, 0, 0, 0.1],
        "played": [100, 100, 5, 29, 100],
        "names": NAMES,
    }
    players = LeaguePlayers.of([90, 84, 50, 60, 61], **(given | columns))
    return Season(players, "npl", "npl_10", weeks=8, play="racks")


def chunks(season: Season, many: int = 20, replicas: int = 200) -> Tally:
    seeds = np.random.SeedSequence(1).spawn(many)
    total = run_chunk(season, replicas, seeds[0])
    for seed in seeds[1:]:
        total += run_chunk(season, replicas, seed)
    return total


def apart(values: Any, mean: Any, se: Any) -> Any:
    """Return how many standard errors the mean of witnesses is off a simulated mean."""
    own = values.std(axis=0, ddof=1) / math.sqrt(len(values))
    return np.abs(values.mean(axis=0) - mean) / np.maximum(np.hypot(own, se), 1e-9)


@pytest.fixture(scope="module")
def simulated() -> tuple[Season, Tally]:
    season = a_season()
    return season, chunks(season)


@pytest.fixture(scope="module")
def witnesses(simulated: tuple[Season, Tally]) -> dict[str, Any]:
    """Return what 1,200 seasons came to that were played rack by rack, each by itself."""
    season, _ = simulated
    seen: dict[str, list[Any]] = {
        name: []
        for name in ("won", "played", "rating", "error", "stronger", "hill", "shut", "games")
    }
    for seed in range(WITNESSES):
        one = season_matches(season, seed)
        results = one.results
        assert results.race_a is not None
        assert results.race_b is not None
        a_won = results.score_a == results.race_a
        winner = np.where(a_won, results.player_a, results.player_b)
        seen["won"].append(np.bincount(winner, minlength=5))
        both = np.concatenate([results.player_a, results.player_b])
        seen["played"].append(np.bincount(both, minlength=5))
        seen["rating"].append(one.rating)
        seen["error"].append(one.rating - np.rint(one.skill_after))
        missing = results.race_a + results.race_b - results.score_a - results.score_b
        seen["hill"].append((missing == 1).sum())
        seen["shut"].append((np.minimum(results.score_a, results.score_b) == 0).sum())
        seen["games"].append((results.score_a + results.score_b).sum())
    return {name: np.array(values) for name, values in seen.items()}


@pytest.mark.slow
def test_standings_are_those_of_seasons_played_one_by_one(simulated, witnesses):
    """Means within 4.5 standard errors, deviations within what 1,200 seasons tell."""
    frame = standings_frame(*simulated).set_index("player").loc[NAMES]
    assert (apart(witnesses["won"], frame["points_mean"], frame["points_se"]) < 4.5).all()
    assert (apart(witnesses["rating"], frame["rating_mean"], frame["rating_se"]) < 4.5).all()
    assert (apart(witnesses["played"], frame["matches"], 0.0) < 4.5).all()
    ratio = witnesses["won"].std(axis=0, ddof=1) / frame["points_sd"].to_numpy()
    assert (np.abs(ratio - 1) < 4.5 * math.sqrt((1 / 1_200 + 1 / 4_000) / 2)).all()
    p = frame["points_mean"] / frame["matches"]
    assert np.allclose(frame["p_win"], p)


@pytest.mark.slow
def test_ratings_after_the_season_are_as_wrong_as_those_of_single_seasons(simulated, witnesses):
    last = weeks_frame(simulated[1]).iloc[-1]
    stays = witnesses["error"][:, [0, 1, 2, 4]]  # Di has left
    assert last["players"] == 4.0
    assert apart(stays.mean(axis=1), last["error_mean"], last["error_mean_se"]) < 4.5
    assert abs(stays.std() - last["error_sd"]) < 4.5 * math.hypot(
        last["error_sd_se"], stays.std() / math.sqrt(2 * WITNESSES)
    )
    assert abs(near(stays, SCALES["npl"]).mean() - last["p_near"]) < 0.03
    quantile = np.quantile(stays, [0.05, 0.5, 0.95], method="inverted_cdf")
    assert np.abs(quantile - last[["error_p05", "error_p50", "error_p95"]].to_numpy()).max() <= 1


@pytest.mark.slow
def test_nights_are_as_fair_as_those_of_single_seasons(simulated, witnesses):
    every = fairness_frame(*simulated).iloc[0]
    matches = witnesses["played"].sum() / 2
    for name, counted in (
        ("p_hill_hill", "hill"),
        ("p_shutout", "shut"),
        ("mean_games", "games"),
    ):
        value = witnesses[counted].sum() / matches
        spread = witnesses[counted].std() * math.sqrt(WITNESSES) / matches
        assert abs(value - every[name]) < 4.5 * math.hypot(spread, every[f"{name}_se"])


def test_gaps_add_up_to_all_matches_and_wide_ones_are_put_together(simulated):
    frame = fairness_frame(*simulated)
    gaps = frame[frame["group"] == "gap"]
    assert gaps["matches"].sum() == pytest.approx(frame["matches"].iloc[0])
    assert gaps["from"].tolist() == list(range(0, 10 * len(gaps), 10))
    assert gaps["to"].isna().tolist() == [*[False] * (len(gaps) - 1), True]
    won = (gaps["matches"] * gaps["p_win"]).sum()
    assert won / gaps["matches"].sum() == pytest.approx(frame["p_win"].iloc[0])
    fifths = frame[frame["group"] == "fifth"]
    assert fifths["matches"].sum() == pytest.approx(2 * frame["matches"].iloc[0])
    assert (fifths["matches"] * fifths["p_win"]).sum() == pytest.approx(frame["matches"].iloc[0])


def test_both_ways_of_playing_tell_the_same_law(simulated):
    season, tally = simulated
    other = Season(season.players, "npl", "npl_10", weeks=8)
    fast = chunks(other)
    one, two = (fairness_frame(*each).iloc[0] for each in ((season, tally), (other, fast)))
    for name in ("p_win", "p_hill_hill", "p_shutout", "mean_games"):
        assert abs(one[name] - two[name]) < 4.5 * math.hypot(one[f"{name}_se"], two[f"{name}_se"])


def test_quantiles_are_reached_and_not_passed(simulated):
    season, tally = simulated
    frame = standings_frame(season, tally).set_index("player")
    assert tally.wins_counts is not None
    for place, name in enumerate(NAMES):
        points = np.repeat(np.arange(tally.wins_counts.shape[1]), tally.wins_counts[place])
        for q in (0.1, 0.5, 0.9):
            told = frame.loc[name, f"points_p{100 * q:.0f}"]
            assert told == np.quantile(points, q, method="inverted_cdf")
        assert abs(frame.loc[name, "rating_p50"] - frame.loc[name, "rating_mean"]) < 3


def test_standard_errors_are_how_far_seeds_lie_apart():
    """30 seeds: the spread of their answers over the mean stated error is near 1."""
    season = Season(LeaguePlayers.of([90, 75, 60, 60], skill=[80, 80, 60, 60]), "npl", weeks=6)
    told = []
    for seed in range(30):
        parts = [run_chunk(season, 20, s) for s in np.random.SeedSequence(seed).spawn(10)]
        tally = sum(parts[1:], parts[0])
        week, points = weeks_frame(tally).iloc[-1], standings_frame(season, tally).iloc[0]
        every = fairness_frame(season, tally).iloc[0]
        told.append(
            [
                *(week["error_sd"], week["error_sd_se"], points["points_mean"]),
                *(points["points_se"], every["p_win"], every["p_win_se"]),
            ]
        )
    values = np.array(told)
    ratio = values[:, ::2].std(axis=0, ddof=1) / values[:, 1::2].mean(axis=0)
    assert ((ratio > 0.6) & (ratio < 1.5)).all()


def test_one_replica_has_no_errors_and_somebody_who_never_plays_no_part():
    season = Season(
        LeaguePlayers.of([80, 80, 80]), "npl", "npl_8", FixedSchedule([1], [0], [1]), weeks=2
    )
    tally = run_chunk(season, 1, np.random.SeedSequence(1))
    frame = standings_frame(season, tally)
    assert frame["points_se"].isna().all()
    assert frame["points_mean"].tolist() == [1.0, 0.0, 0.0]
    assert frame["p_win"].isna().tolist().count(True) == 1
    assert frame["player"].iloc[0] in {"player 1", "player 2"}
    assert weeks_frame(tally)["error_mean_se"].isna().all()


def near_after(weeks: int, step: int, times: int = 1) -> float:
    """The share of ratings near their skill, which they begin with; points are `times` as many."""
    points = times * step
    system = StepSystem(
        "even", Scale("even", 30.0 * times), (), lambda _: (points, -points), "", EVEN
    )
    rating = [times * one for one in (40, 50, 60, 70, 80, 90, 100, 110)]
    season = Season(LeaguePlayers.of(rating, skill=rating), system, weeks=weeks)
    tally = run_chunk(season, 500, np.random.SeedSequence(7))
    return float(weeks_frame(tally, cycle=system.cycle).iloc[-1]["p_near"])


@pytest.mark.parametrize("step", [1, 2, 4])
def test_the_share_near_the_skill_does_not_swing_from_week_to_week(step):
    """After an odd number of matches no rating of a +-4 ladder is right, after an even one many."""
    shares = [near_after(weeks, step) for weeks in (27, 28, 29, 30)]
    assert max(shares) - min(shares) < 0.03


def test_the_ladder_with_the_smaller_steps_is_the_more_accurate_one_in_any_week():
    for weeks in (29, 30):
        shares = [near_after(weeks, step) for step in (1, 2, 4)]
        assert shares == sorted(shares, reverse=True)


def test_the_share_near_the_skill_is_the_same_on_any_scale():
    assert near_after(30, 1, times=10) == near_after(30, 1)
