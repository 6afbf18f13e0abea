"""A simulated season, for league operators: ratings, fairness, who gains, and luck."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from evenbreak import __version__
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, frame_table, quantities_of
from evenbreak.answers.kit.parts import Quantities, Table
from evenbreak.answers.kit.wording import count_of
from evenbreak.answers.league.season_tables import SeasonTables, weeks_with_players
from evenbreak.handicaps.ladders.comparison import NEAR
from evenbreak.league.schedule import FixedSchedule, RandomPairing, RoundRobin
from evenbreak.league.season import Season, Tally

SHOWN = 12
"""Places in the standings shown on a terminal: half from the top and half from the bottom."""

MISTAKEN = 0.05
"""The largest chance of naming a player as gaining or losing when no player is."""


def season_answer(
    season: Season,
    tally: Tally,
    tables: SeasonTables,
    settings: Mapping[str, Any],
    *,
    drawn: int = 0,
    exact: int = 0,
    warnings: Sequence[str] = (),
) -> Answer:
    """Return a season's outcome; in files, the rows of `summary_rows`.

    `drawn` players have their true skill drawn for each season; for `exact` players nothing better
    than the rating is known.
    """
    rows = summary_rows(season, tally, tables, settings)
    summary = Table("summary", columns_of("quantity value -standard_error"), rows)
    data: dict[str, Any] = {name: value for name, value, _ in rows}
    data["standings"] = frame_table("", tables.standings).to_dicts()
    data["standard_errors"] = {
        name: error for name, _, error in rows if error is not None and math.isfinite(error)
    }
    heading = (
        f"{count_of(len(season.players), 'player')}, {count_of(season.weeks, 'week')}, "
        f"{_mean(data['matches_a_season'])} matches a season; system {season.system.name}, chart "
        f"{season.chart.name}\n{count_of(data['replicas'], 'season')} simulated"
    )
    assumed = " ".join(_assumed(len(season.players), drawn, exact))
    if not data["matches_a_season"]:
        nobody = (
            "No match was played: the two players in a scheduled match were never there together."
        )
        return Answer(heading, [nobody], warnings=warnings, data=data, csv=summary)
    return Answer(
        heading,
        [
            _ratings(tables.weeks, season),
            _fairness(tables.fairness),
            _who_gains(tables.standings, len(tally.replicas)),
            _luck(data),
            *([assumed] if assumed else []),
            _standings(tables.standings),
        ],
        details=[_statistics(rows)],
        warnings=warnings,
        data=data,
        csv=summary,
    )


def _assumed(players: int, drawn: int, exact: int) -> Iterator[str]:
    """Yield what is assumed about the players' skills."""
    if drawn:
        yield (
            f"For {drawn:,} of {players:,} players, the true skill is drawn anew for each "
            f"season, from the rating and its standard error."
        )
    if exact:
        yield (
            f"For {exact:,} of {players:,} players, the rating is treated as the true skill "
            f"at the start: the roster gives neither skill nor standard_error."
        )


def _ratings(weeks: pd.DataFrame, season: Season) -> str:
    there = weeks_with_players(weeks)
    first, last = there.iloc[0], there.iloc[-1]
    points = f"{season.system.scale.points_per_doubling * NEAR:.1f}".removesuffix(".0")
    start = "At the start" if first["week"] == 0 else f"After week {first['week']:.0f}"
    text = (
        f"How far off are the ratings? {start}, {_percent(first['p_near'], first['p_near_se'])} "
        f"are within {points} points of the true skill (a sixth of what doubles the odds); "
        f"{_end(int(last['week']), season.system.cycle)}, "
        f"{_percent(last['p_near'], last['p_near_se'])} are, and 9 out of 10 are off by "
        f"{last['error_p05']:+.0f} to {last['error_p95']:+.0f} points (a minus "
        "means rated too low)."
    )
    empty = int((weeks["players"][1:] == 0).sum())
    if not empty:
        return text
    return (
        f"{text} In {empty:,} of {count_of(len(weeks) - 1, 'week')} no one is in the league; "
        f"these figures are for weeks {max(first['week'], 1):.0f} to {last['week']:.0f}."
    )


def _end(week: int, cycle: int) -> str:
    """Return the weeks over which shares are averaged.

    >>> _end(30, 1), _end(30, 2), _end(1, 2)
    ('after week 30', 'after weeks 29 and 30', 'after week 1')
    """
    first = max(1, week - cycle + 1)
    if first == week:
        return f"after week {week}"
    return f"after weeks {first} {'and' if week - first == 1 else 'to'} {week}"


def _fairness(fairness: pd.DataFrame) -> str:
    every = fairness[fairness["group"] == "all"].iloc[0]
    fifths = fairness[fairness["group"] == "fifth"]
    text = (
        "How fair are the matches? On the night, the stronger player wins "
        f"{_percent(every['p_win'], every['p_win_se'])} of them; 50% would be fair. "
        f"{_percent(every['p_hill_hill'])} go hill-hill, {_percent(every['p_shutout'])} are "
        f"shutouts, and a match takes {every['mean_games']:.1f} games on average."
    )
    if len(fifths) < 2:
        return text
    low, high = fifths.iloc[0], fifths.iloc[-1]
    return (
        f"{text} The weakest fifth of the players win {_percent(low['p_win'], low['p_win_se'])} "
        f"of their matches, and the strongest fifth win "
        f"{_percent(high['p_win'], high['p_win_se'])} of theirs."
    )


def _who_gains(standings: pd.DataFrame, batches: int) -> str:
    """Return the highest and lowest shares of matches won, if they aren't luck.

    By luck alone, some of many players will be far from a half, so the test gets stricter with more
    players.
    """
    from scipy.special import stdtrit

    played = standings[standings["matches"] > 0]
    off = played["p_win"] - 0.5
    clear = -float(stdtrit(max(batches - 1, 1), MISTAKEN / 2 / len(played)))
    sure = off.abs() > clear * played["p_win_se"]  # never where there is no standard error
    above, below = played[sure & (off > 0)], played[sure & (off < 0)]

    def wins(row: pd.Series[Any]) -> str:
        return (
            f"{row['player']}, rated {row['rating_start']:.0f} with a true skill of "
            f"{row['skill_start']:.0f}, wins {_percent(row['p_win'], row['p_win_se'])}"
        )

    if above.empty and below.empty:
        return (
            "Who gains? No one, as far as these seasons show: no player clearly wins more or less "
            "than half of their matches."
        )
    most = "No one clearly wins more than half of their matches"
    least = "no one clearly wins less than half"
    if not above.empty:
        most = f"{wins(above.iloc[above['p_win'].argmax()])} of their matches, the most"
    if not below.empty:
        least = f"{wins(below.iloc[below['p_win'].argmin()])}, the least"
    return f"Who gains? {most}; {least}."


def _luck(data: Mapping[str, Any]) -> str:
    between, luck = data["points_sd_between_players"], data["points_sd_by_luck"]
    if math.isnan(luck):
        return "How much of the table is luck? One season can't show that. Simulate more seasons."
    share = luck**2 / (between**2 + luck**2) if between or luck else 1.0
    return (
        f"How much of the table is luck? About {100 * share:.0f}% of the differences in one "
        "season's table; the rest comes from who the players are and how often they play. From "
        f"luck alone, a player's wins typically vary by {luck:.1f} from season to season; the "
        f"players' averages differ by {between:.1f}."
    )


def _standings(standings: pd.DataFrame) -> Table:
    """Return the standings for display; if there are many players, only the first and the last."""
    records, half = standings.to_dict("records"), SHOWN // 2
    rows = [(str(place), *_cells(record)) for place, record in enumerate(records, 1)]
    if len(rows) > SHOWN + 1:
        rows[half:-half] = [("...", *[None] * 7)]
    columns = columns_of(
        "place_text player rating_start matches_played points_mean points_p10_p90 share_won "
        "rating_end"
    )
    return Table("", columns, rows)


def _cells(record: Mapping[Any, Any]) -> tuple[Any, ...]:
    # One season has no spread, and of a large league no histograms are kept.
    low, high = record["points_p10"], record["points_p90"]
    known = not math.isnan(record["points_sd"]) and low == low
    return (
        str(record["player"]),
        record["rating_start"],
        record["matches"],
        record["points_mean"],
        f"{low:.0f} to {high:.0f}" if known else None,
        None if math.isnan(record["p_win"]) else record["p_win"],
        record["rating_mean"],
    )


def _statistics(rows: Sequence[Row]) -> Quantities:
    errors = {name: error for name, _, error in rows}
    values = {name: value for name, value, _ in rows}
    names = (
        *("error_sd_start", "error_sd_end", "error_mean_start", "error_mean_end"),
        *("points_sd_by_luck", "points_sd_between_players", "mean_rating_change"),
    )
    notes = {name: f"± {_error(error)}" for name, error in errors.items() if error and error > 0.0}
    return Quantities(
        quantities_of({name: values.get(name) for name in names}, notes=notes),
        "± is one standard error of the simulation; more seasons make it smaller.",
        in_json=False,
    )


def _mean(matches: float) -> str:
    """Return an average number of matches.

    >>> _mean(12.0), _mean(14.26), _mean(12_345.6)
    ('12', '14.3', '12,346')
    """
    whole = matches >= 1000.0 or matches == round(matches)
    return f"{matches:,.0f}" if whole else f"{matches:.1f}"


def _percent(p: float, error: float = math.nan) -> str:
    """Return a probability in percent, with its standard error if there is one.

    >>> _percent(0.5329, 0.00153), _percent(0.0655), _percent(0.5, 0.0)
    ('53.3 ± 0.2%', '6.6%', '50.0%')
    """
    known = not math.isnan(error) and error
    return f"{100 * p:.1f} ± {_error(100 * error)}%" if known else f"{100 * p:.1f}%"


def _error(error: float) -> str:
    """Return a standard error, rounded so that it never looks like zero.

    >>> _error(0.153), _error(0.038)
    ('0.2', '0.04')
    """
    return f"{error:.1f}" if error >= 0.095 else f"{error:.1g}"


Row = tuple[str, Any, float | None]
"""A quantity, its value, and its standard error if the value was drawn at random."""


def summary_rows(
    season: Season, tally: Tally, tables: SeasonTables, settings: Mapping[str, Any]
) -> list[Row]:
    """Return the rows of `summary.csv`, which repeats the settings (the seed, say)."""
    replicas = int(tally.replicas.sum())
    played: dict[str, Any] = {
        **settings,
        "system": season.system.name,
        "points_per_doubling": season.system.scale.points_per_doubling,
        "near_points": NEAR * season.system.scale.points_per_doubling,
        "chart": season.chart.name,
        "schedule": _schedule(season),
        "play": season.play,
        "player_count": len(season.players),
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
