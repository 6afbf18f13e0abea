"""The summary of a simulated season: what was simulated and what came of it, a value a row."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from evenbreak import __version__
from evenbreak.answers.season_tables import SeasonTables, weeks_with_players
from evenbreak.handicaps.ladders.comparison import NEAR
from evenbreak.league.schedule import FixedSchedule, RandomPairing, RoundRobin
from evenbreak.league.season import Season
from evenbreak.league.tally import Tally

Row = tuple[str, Any, float | None]
"""A quantity, its value, and its standard error where the value was drawn at random."""


def summary_rows(
    season: Season, tally: Tally, tables: SeasonTables, settings: Mapping[str, Any]
) -> list[Row]:
    """Return the rows of `summary.csv`.

    Parameters
    ----------
    season, tally, tables
        the season, what its replicas came to, and its tables.
    settings
        what a reader must know besides, such as the seed and the name of the roster's file.
    """
    replicas = int(tally.replicas.sum())
    played: dict[str, Any] = {
        **settings,
        "system": season.system.name,
        "points_per_doubling": season.system.scale.points_per_doubling,
        "near_points": NEAR * season.system.scale.points_per_doubling,
        "chart": season.chart.name,
        "schedule": _schedule(season),
        "play": season.play,
        "players": len(season.players),
        "weeks": season.weeks,
        "replicas": replicas,
        "matches_a_season": float(tally.matches.sum() / 2 / replicas),
    }
    standings = tables.standings
    came = {
        "points_sd_between_players": float(standings["points_mean"].std(ddof=0)),
        "points_sd_by_luck": float(np.sqrt((standings["points_sd"] ** 2).mean())),
        "mean_rating_change": float(tally.rating.sum() / tally.rating.size / replicas),
        "evenbreak_version": __version__,
    }
    return [
        *((name, value, None) for name, value in played.items()),
        *_of_ratings(tables.weeks),
        *_of_fairness(tables.fairness),
        *((name, value, None) for name, value in came.items()),
    ]


def _of_ratings(weeks: pd.DataFrame) -> Iterator[Row]:
    there = weeks_with_players(weeks)
    if not len(there):
        return
    for when, row in (("start", there.iloc[0]), ("end", there.iloc[-1])):
        for what in ("error_mean", "error_sd", "p_near"):
            yield f"{what}_{when}", float(row[what]), float(row[f"{what}_se"])


def _of_fairness(fairness: pd.DataFrame) -> Iterator[Row]:
    for row in fairness[fairness["group"] == "all"].to_dict("records"):
        for column in ("p_win", "p_hill_hill", "p_shutout", "mean_games"):
            name = "p_stronger_wins" if column == "p_win" else column
            yield name, row[column], row[f"{column}_se"]
    fifths = fairness[fairness["group"] == "fifth"].to_dict("records")
    if fifths:
        for name, row in (("weakest", fifths[0]), ("strongest", fifths[-1])):
            yield f"p_win_{name}_fifth", row["p_win"], row["p_win_se"]


def _schedule(season: Season) -> str:
    match season.schedule:
        case RoundRobin(matches_a_week=matches):
            return f"round robin, {matches} a week"
        case RandomPairing(matches_a_week=matches):
            return f"random, {matches} a week"
        case FixedSchedule():
            return f"list of {len(season.schedule):,} matches"
        case _:
            return type(season.schedule).__name__
