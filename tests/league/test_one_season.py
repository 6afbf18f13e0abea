"""One season match by match: it replays, follows the exact chances, and closes the loop."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from evenbreak.handicaps import Chart, ChartRow, apply_results, chart, system_of
from evenbreak.league.one_season import PlayedSeason, season_matches
from evenbreak.league.players import LeaguePlayers
from evenbreak.league.schedule import FixedSchedule, RandomPairing, RoundRobin
from evenbreak.league.season import Season
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings import Results, Roster, find_problems, fit, scale_of

CHART = chart("npl_10")
ESTABLISHED = 100


def season_of(rating: Any, *, schedule: Any = None, weeks: int = 20, **columns: Any) -> Season:
    players = LeaguePlayers.of(rating, **{"played": ESTABLISHED, **columns})
    return Season(players, system_of("npl"), CHART, schedule, weeks)


def test_the_same_seed_gives_the_same_season_and_another_one_another() -> None:
    season = season_of([92, 80, 71, 65], day_sd=5, skill_sd=10)
    first, again, other = (season_matches(season, seed) for seed in (3, 3, 4))
    assert first.results.racks is not None
    assert again.results.racks is not None
    assert other.results.racks is not None
    assert first.results.racks.tolist() == again.results.racks.tolist()
    assert first.skill.tolist() == again.skill.tolist()
    assert first.results.racks.tolist() != other.results.racks.tolist()


def test_a_season_can_be_true_and_replays_night_by_night() -> None:
    """The league's own rule, applied to each night's results, gives the ratings again."""
    schedule = FixedSchedule([1, 1, 1, 2, 4, 4], [0, 0, 2, 3, 1, 1], [1, 2, 3, 0, 2, 3])
    names = ["Ann", "Bo", "Cy", "Di"]
    season = season_of([99, 80, 71, 62], schedule=schedule, weeks=4, names=names, day_sd=9)
    played = season_matches(season, seed=1)
    assert not find_problems(played.results)
    assert played.week.tolist() == [1, 1, 1, 2, 4, 4]
    assert str(played.results.date[-1]) == "2025-01-28"  # type: ignore[index]
    roster = Roster(names, season.players.rating)
    for week in range(1, 5):
        rows = np.flatnonzero(played.week == week)
        night = played.results.select(rows)
        for column, rating in (
            (night.player_a, played.rating_a),
            (night.player_b, played.rating_b),
        ):
            assert roster.rating[column].tolist() == rating[rows].tolist()
        roster = apply_results(season.system, roster, night, chart=CHART).after
    assert roster.rating.tolist() == played.rating.tolist()


def test_races_are_those_of_the_chart_and_newcomers_move_faster() -> None:
    played = season_matches(season_of([90, 60], weeks=1, played=[100, 0]), seed=1)
    assert np.column_stack([played.results.race_a, played.results.race_b]).tolist() == [[6, 3]]  # type: ignore[list-item]
    won = 1 if played.results.score_a[0] == 6 else -1
    assert (played.rating - [90, 60]).tolist() == [won, -3 * won]


def wins_of(played: PlayedSeason) -> np.ndarray[Any, Any]:
    return np.asarray(played.results.score_a == played.results.race_a)


@pytest.mark.slow
def test_matches_are_won_as_often_as_the_exact_chance_says() -> None:
    """Pairs that meet once, misrated: 5,000 matches a cell; 4.5 standard errors."""
    many = 5_000
    for gap, error in ((0, 10), (20, -12), (40, 0)):
        rating = np.tile([80 + gap + error, 80], many)
        schedule = FixedSchedule(np.ones(many), 2 * np.arange(many), 2 * np.arange(many) + 1)
        season = season_of(rating, skill=np.tile([80 + gap, 80], many), schedule=schedule, weeks=1)
        p = float(
            race_win_probability(scale_of("npl").win_probability(gap), *CHART.race(gap + error))
        )
        seen = wins_of(season_matches(season, seed=2)).mean()
        assert abs(seen - p) < 4.5 * (p * (1 - p) / many) ** 0.5


def test_skill_is_drawn_varies_by_the_day_and_drifts() -> None:
    many = 4_000
    season = season_of(np.full(many, 80), skill_sd=7, drift=0.5, weeks=4, schedule=RandomPairing())
    played = season_matches(season, seed=1)
    assert abs(played.skill.std() - 7) < 5 * 7 / (2 * many) ** 0.5
    assert np.allclose(played.skill_after - played.skill, 2.0)
    # With skills far apart on the day the first to win keeps winning: games become one-sided.
    steady, wild = (
        season_matches(season_of(np.full(400, 80), day_sd=sd, weeks=3), seed=1) for sd in (0, 60)
    )
    margins = [np.abs(one.results.score_a - one.results.score_b).mean() for one in (steady, wild)]
    assert margins[1] > margins[0] + 1.0


def test_absent_players_do_not_play() -> None:
    season = season_of(
        np.full(6, 80),
        schedule=RoundRobin(6),
        weeks=30,
        joins=[5, 1, 1, 1, 1, 1],
        leaves=[0, 10, 0, 0, 0, 0],
        absence=[0, 0, 1, 0.5, 0, 0],
    )
    played = season_matches(season, seed=1)
    weeks = [
        played.week[(played.results.player_a == k) | (played.results.player_b == k)]
        for k in range(6)
    ]
    assert weeks[0].min() == 5
    assert weeks[1].max() <= 10
    assert len(weeks[2]) == 0
    assert 0 < len(weeks[3]) < len(weeks[4])


def test_nights_are_a_week_apart_and_players_have_names() -> None:
    results = season_matches(season_of([80, 80], weeks=2, names=["Ann", "Bo"]), seed=1).results
    assert results.players == ("Ann", "Bo")
    assert [str(day) for day in results.date] == ["2025-01-07", "2025-01-14"]  # type: ignore[union-attr]
    assert season_matches(season_of([80, 80]), seed=1).results.players == ("player 1", "player 2")


def covered(results: Results, skill: np.ndarray[Any, Any]) -> tuple[int, int]:
    """Return how many differences of separate pairs their 95% interval covers, of how many."""
    found = fit(results)
    order = [found.players.index(f"player {k + 1}") for k in range(len(skill))]
    inside = 0
    for one in range(0, len(skill) - 1, 2):
        names = f"player {one + 1}", f"player {one + 2}"
        said = found.rating[order[one]] - found.rating[order[one + 1]]
        error = said - (skill[one] - skill[one + 1])
        inside += abs(error) <= 1.959964 * found.difference_error(*names)
    return inside, len(skill) // 2


def test_the_loop_closes() -> None:
    """Ratings estimated from simulated seasons cover the true ones at the stated rate.

    Everybody begins at 80 and is drawn from the prior of `fit`, so that its intervals should
    cover 95%: 40 seasons of 8 separate pairs, 4.5 standard errors of a binomial.
    """
    season = season_of(np.full(16, 80), skill_sd=30, weeks=15)
    counted = []
    for seed in range(40):
        played = season_matches(season, seed)
        counted.append(covered(played.results, played.skill))
    inside, pairs = np.sum(counted, axis=0)
    assert pairs == 320
    assert abs(inside / pairs - 0.95) < 4.5 * (0.95 * 0.05 / pairs) ** 0.5


def test_the_loop_would_show_a_league_that_the_model_does_not_fit() -> None:
    """With wild days the intervals, made for steady players, are too short."""
    season = season_of(np.full(16, 80), skill_sd=30, day_sd=45, weeks=15)
    counted = []
    for seed in range(20):
        played = season_matches(season, seed)
        counted.append(covered(played.results, played.skill))
    inside, pairs = np.sum(counted, axis=0)
    assert inside / pairs < 0.85


def test_a_house_chart_is_played_to_its_last_row() -> None:
    house = Chart("house", [ChartRow(0, 99, 3, 3), ChartRow(100, None, 9, 1)])
    season = Season(LeaguePlayers.of([180, 60]), system_of("npl"), house, None, 1)
    assert season_matches(season, seed=1).results.race_a == [9]
