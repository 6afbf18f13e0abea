"""The summary of a simulated season, a value a row."""

import math

import numpy as np
import pytest

from evenbreak.answers.league.season import summary_rows
from evenbreak.answers.league.season_tables import season_tables
from evenbreak.league import LeaguePlayers, RandomPairing, RoundRobin, Season, run_chunk


def summary(season, **settings):
    tally = run_chunk(season, 10, np.random.SeedSequence(1), batches=3)
    rows = summary_rows(season, tally, season_tables(season, tally), settings)
    return {name: (value, error) for name, value, error in rows}


def test_what_was_simulated_and_what_came_of_it():
    found = summary(Season(LeaguePlayers.of([90, 60]), "npl", None, RandomPairing(2), 3), seed=7)
    values = {name: value for name, (value, _) in found.items()}
    assert values["seed"] == 7
    assert (values["system"], values["chart"], values["play"]) == ("npl", "npl_10", "matches")
    assert values["schedule"] == "random, 2 a week"
    assert (values["replicas"], values["matches_a_season"]) == (30, 6.0)
    assert values["mean_rating_change"] == 0.0
    assert "p_win_weakest_fifth" not in values  # of two players
    assert found["p_stronger_wins"][1] > 0.0
    assert found["seed"][1] is None


def test_the_fifths_of_five_players_are_the_players():
    players = LeaguePlayers.of([90, 85, 80, 75, 70])
    found = summary(Season(players, "npl", None, RoundRobin(5), weeks=5))
    assert 0.0 < found["p_win_weakest_fifth"][0] < 1.0
    assert 0.0 < found["p_win_strongest_fifth"][0] < 1.0


def test_luck_and_skill_spread_the_points():
    season = Season(LeaguePlayers.of([90, 60]), "npl", None, RandomPairing(2), 3)
    tally = run_chunk(season, 10, np.random.SeedSequence(1), batches=3)
    tables = season_tables(season, tally)
    found = {name: value for name, value, _ in summary_rows(season, tally, tables, {})}
    # What one of two players wins the other loses: both spreads are those of either player.
    mean, sd = (tables.standings[column].tolist() for column in ("points_mean", "points_sd"))
    assert found["points_sd_by_luck"] == pytest.approx(sd[0]) == pytest.approx(sd[1])
    assert found["points_sd_between_players"] == pytest.approx(abs(mean[0] - mean[1]) / 2)


def test_a_season_without_players_has_no_errors_of_ratings():
    season = Season(LeaguePlayers.of([90, 60], joins=9), "npl", None, RoundRobin(2), weeks=2)
    found = summary(season)
    assert not [name for name in found if name.startswith(("error_", "p_"))]
    assert not math.isnan(found["points_sd_by_luck"][0])
