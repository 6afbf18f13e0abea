"""A night's moves as next week's list, with their reasons, and what kept them from being made."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.files.problems import Problems, quoted
from evenbreak.files.results import ResultsFile
from evenbreak.files.roster import RosterFile
from evenbreak.files.similar_names import similar_names
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.night_problems import night_problems
from evenbreak.handicaps.systems.rating_changes import MatchChange, RatingChanges, apply_results
from evenbreak.handicaps.systems.system import System
from evenbreak.ratings.consistency import Problem
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import NOT_STATED

if TYPE_CHECKING:
    import pandas as pd


def moves_of_files(
    system: System, last: RosterFile, tonight: ResultsFile, *, chart: Chart | None = None
) -> RatingChanges:
    """Return how a night's results move the ratings of a list.

    Raises
    ------
    DataError
        with all that keeps the results from moving ratings, each in its line: players who are
        not on the list, matches of which nobody can tell who won.
    """
    results = tonight.results
    found = night_problems(system, last.roster, results, chart=chart)
    strangers = set(results.players).difference(last.roster.players)
    alike = _alike(strangers, last.roster.players)
    told = Problems(tonight.source)
    open_rows = [problem.row for problem in found if _is_open(problem, results, chart)]
    for problem in found:
        message = problem.message
        if problem.row in open_rows[1:]:
            continue
        if problem.row in open_rows and len(open_rows) > 1:
            message += f" ({len(open_rows):,} such matches; --chart NAME serves for all)"
        side = {"player_a": results.player_a, "player_b": results.player_b}.get(problem.column)
        if side is not None:
            message += _perhaps(alike.get(results.players[side[problem.row]], ()))
        told.add(int(tonight.lines[problem.row]), message)
    told.raise_any()
    return apply_results(system, last.roster, results, chart=chart)


def _is_open(problem: Problem, results: Results, chart: Chart | None) -> bool:
    """Tell whether nothing in a row, and no chart, says who won."""
    stated = results.winner is not None and results.winner[problem.row] > 0
    return chart is None and problem.column == "winner" and not stated


def _alike(strangers: set[str], known: Iterable[str]) -> dict[str, list[str]]:
    """Return for each name that is not on the list those on it that may mean the same player."""
    if not strangers:
        return {}
    alike: dict[str, list[str]] = {name: [] for name in strangers}
    for group in similar_names([*strangers, *known]):
        on_list = [name for name in group if name not in strangers]
        for name in strangers.intersection(group):
            alike[name] += on_list
    return alike


def _perhaps(names: Iterable[str]) -> str:
    named = " or ".join(map(quoted, names))
    return f"; if {named} is meant, write that or say so in --aliases" if named else ""


def moves_frame(moves: RatingChanges) -> pd.DataFrame:
    """Return the list after a night, the strongest first, players without a rating last.

    Returns
    -------
    pandas.DataFrame
        player, rating, standard_error, games, component and matches, as lists of players have
        them;
        rating_before and change in points; matches_won and matches_lost that night, without
        forfeits; why: the matches, '' for who did not play.
    """
    import pandas as pd

    before, after = moves.before, moves.after
    why = reasons(moves)
    frame = pd.DataFrame(
        {
            "player": after.players,
            "rating": after.rating,
            "standard_error": after.standard_error,
            "games": pd.Series(after.games, dtype="Int64").where(after.games != NOT_STATED),
            "component": pd.Series(after.component, dtype="Int64").where(after.component > 0),
            "matches": pd.Series(after.matches, dtype="Int64").where(after.matches != NOT_STATED),
            "rating_before": before.rating,
            "change": after.rating - before.rating,
            "matches_won": moves.won,
            "matches_lost": moves.lost,
            "why": ["; ".join(why.get(place, ())) for place in range(len(after))],
        }
    )
    frame = frame.sort_values(["rating", "player"], ascending=[False, True], ignore_index=True)
    # Whole points are written as such, as leagues print them.
    for column in ("rating", "rating_before", "change"):
        values = frame[column]
        if (values.dropna() == np.floor(values.dropna())).all():
            frame[column] = values.astype("Int64")
    return frame


def reasons(moves: RatingChanges) -> dict[int, list[str]]:
    """Return for the place of each player who played what each of his matches was."""
    players = moves.before.players
    told: dict[int, list[str]] = {}
    for match in moves.matches:
        won, lost = _scores(match)
        told.setdefault(match.winner, []).append(f"beat {players[match.loser]}{won}")
        told.setdefault(match.loser, []).append(f"lost to {players[match.winner]}{lost}")
    return told


def _scores(match: MatchChange) -> tuple[str, str]:
    """Return the score and race of a match, as the winner tells them and as the loser does."""
    told = ["", ""]
    for place, turn in enumerate((1, -1)):
        if match.games is not None:
            mine, other = match.games[::turn]
            told[place] += f" {mine}-{other}"
        if match.race is not None:
            mine, other = match.race[::turn]
            told[place] += f" (race {mine}:{other})"
    return told[0], told[1]


def night_warnings(moves: RatingChanges, tonight: ResultsFile, chart: Chart) -> Iterator[str]:
    """Yield what a person should look at in a night that was played by a chart, a line each.

    That is each match that was played by another race than the chart's, and a file of more
    than one night.
    """
    dates = tonight.results.date
    days = 0 if dates is None else len(np.unique(dates[~np.isnat(dates)]))
    if days > 1:
        yield (
            f"{tonight.source}: holds {days:,} dates, for which the chart is looked up with the "
            "same ratings; run one night at a time if the ratings moved in between"
        )
    players, ratings = moves.before.players, moves.before.rating
    for match in moves.matches:
        if match.race is None or match.race == match.by_chart or match.by_chart is None:
            continue
        winner, loser = match.winner, match.loser
        yield (
            f"{tonight.source}:{tonight.lines[match.row]}: {quoted(players[winner])} - "
            f"{quoted(players[loser])} was a race {match.race[0]}:{match.race[1]}; the chart "
            f"{chart.name} has {match.by_chart[0]}:{match.by_chart[1]} for {ratings[winner]:g} "
            f"and {ratings[loser]:g}"
        )
