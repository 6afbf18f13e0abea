"""A season from its files, night by night, and which of its matches belong to which events."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from evenbreak.answers.kit.wording import count_of
from evenbreak.errors import DataError, InputError
from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.files.tables.problems import Problems, quoted
from evenbreak.files.tables.similar_names import similar_names
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.rating_changes import RatingChanges, apply_results, night_problems
from evenbreak.handicaps.systems.system import System
from evenbreak.league.sandbag_watch import PlayedNight, played_nights
from evenbreak.ratings.results import Problem, Results
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.validation.walk_forward import even_races

MOST_TRIED = 20
"""The most events that are tried: each of them takes as long as a watch without events."""


def nights_of_files(
    system: System, first: RosterFile, season: ResultsFile, *, chart: Chart | None = None
) -> list[PlayedNight]:
    """Return a season night by night, with the ratings after each night.

    Parameters
    ----------
    system
        the league's system.
    first
        the list of ratings before the first night.
    season
        the results.
    chart
        which sets the races where the results state none.

    Raises
    ------
    DataError
        with every problem that keeps the results from moving ratings, and its line.
    """
    problems: dict[str, None] = {}

    def of_night(list_: Roster, rows: NDArray[np.int64]) -> RatingChanges:
        # The season goes on without a night that has problems, so that all are listed at once.
        kept = rows
        while True:
            night = replace(season, results=season.results.select(kept), lines=season.lines[kept])
            try:
                return rating_changes_of_files(
                    system, replace(first, roster=list_), night, chart=chart
                )
            except DataError as error:
                problems.update(dict.fromkeys(error.problems))
                kept = kept[:0]

    nights = played_nights(system, first.roster, season.results, chart=chart, apply=of_night)
    if problems:
        raise DataError(_once(problems))
    return nights


def rating_changes_of_season(
    system: System, first: RosterFile, season: ResultsFile, *, chart: Chart | None = None
) -> RatingChanges:
    """Return how the results of one or several dates change the ratings of a list.

    The ratings after each date set the races of the next. Without dates all is one night.

    Parameters
    ----------
    system, first, season, chart
        as for `nights_of_files`.

    Raises
    ------
    DataError
        as `nights_of_files` does.
    """
    if count_dates(season.results) < 2:
        return rating_changes_of_files(system, first, season, chart=chart)
    nights = nights_of_files(system, first, season, chart=chart)
    changes = [night.changes for night in nights]
    return RatingChanges(
        system,
        changes[0].before,
        changes[-1].after,
        tuple(
            match._replace(row=int(rows[match.row]))
            for rows, change in nights
            for match in change.matches
        ),
        np.sum([change.won for change in changes], axis=0),
        np.sum([change.lost for change in changes], axis=0),
        sum(change.forfeits for change in changes),
        sum(change.empty for change in changes),
    )


def count_dates(results: Results) -> int:
    """Return on how many dates there are matches, 0 without dates.

    >>> count_dates(Results.from_names(["A"] * 2, ["B"] * 2, [5] * 2, [4] * 2))
    0
    """
    dates = results.date
    return 0 if dates is None else len(np.unique(dates[~np.isnat(dates)]))


def with_even_races(season: ResultsFile) -> tuple[ResultsFile, list[str]]:
    """Return a season with a race for every match, and a warning if some were not stated.

    A match without a race or a winner is read as an even race to the winner's games, unless such
    a match was drawn (see `even_races`).

    >>> plain = Results.from_names(["Ann"], ["Bo"], [7], [5])
    >>> raced, warnings = with_even_races(ResultsFile(plain, "r.csv", (), (), ""))
    >>> raced.results.races, len(warnings)
    ((array([7]), array([7])), 1)
    """
    results = season.results
    winner = np.zeros(len(results)) if results.winner is None else results.winner
    unknown = results.counted & (results.races[0] == 0) & (winner == 0)
    if not unknown.any():
        return season, []
    made = even_races(results.select(unknown))[:2]
    race_a, race_b = (race.copy() for race in results.races)
    race_a[unknown], race_b[unknown] = made
    many = count_of(int((race_a != results.races[0]).sum()), "match", "matches")
    if many.startswith("0 "):
        return season, []
    warning = (
        f"{season.source}: the race of {many} is not stated, so each is read as an even race to "
        "the winner's games; if a chart set the races, name it with --chart"
    )
    return replace(season, results=replace(results, race_a=race_a, race_b=race_b)), [warning]


def _once(problems: Iterable[str]) -> list[str]:
    """Return problems without those that differ from an earlier one by their line only."""
    first: dict[str, str] = {}
    for problem in problems:
        first.setdefault(problem.split(": ", 1)[-1], problem)
    return list(first.values())


def events_marked(results: Results, events: Sequence[str]) -> NDArray[np.bool_]:
    """Return which matches belong to these events.

    Raises
    ------
    InputError
        if the results have no such event.
    """
    column = results.event
    known = sorted({str(event) for event in (() if column is None else column) if event})
    for event in events:
        if event not in known:
            names = ", ".join(known[:10]) or "none: the file has no column event"
            raise InputError(f"the results have no event {event!r}; give one of these: {names}")
    return np.isin(np.asarray(column, dtype=str), list(events))


def events_to_try(results: Results) -> dict[str, NDArray[np.bool_]]:
    """Return which matches belong to each event, those with the most matches first.

    There is nothing to try if all matches are of one event; at most `MOST_TRIED` are.

    >>> events = ["cup", "league", "league"]
    >>> night = Results.from_names(["A"] * 3, ["B"] * 3, [5] * 3, [4] * 3, event=events)
    >>> {name: rows.tolist() for name, rows in events_to_try(night).items()}
    {'league': [False, True, True], 'cup': [True, False, False]}
    """
    if results.event is None:
        return {}
    column = np.asarray(results.event, dtype=str)
    names, matches = np.unique(column[column != ""], return_counts=True)
    order = sorted(zip(names.tolist(), matches.tolist(), strict=True), key=lambda one: -one[1])
    found = {name: column == name for name, _ in order[:MOST_TRIED]}
    return {} if any(rows.all() for rows in found.values()) else found


def rating_changes_of_files(
    system: System, last: RosterFile, tonight: ResultsFile, *, chart: Chart | None = None
) -> RatingChanges:
    """Return how a night's results change the ratings of a list.

    Raises
    ------
    DataError
        with everything that prevents it, each in its line: players who are not on the list,
        matches whose winner cannot be determined.
    """
    results = tonight.results
    found = night_problems(system, last.roster, results, chart=chart)
    strangers = set(results.players).difference(last.roster.players)
    alike = _alike(strangers, last.roster.players)
    problems = Problems(tonight.source)
    open_rows = [problem.row for problem in found if _needs_chart(problem, results, chart)]
    for problem in found:
        message = problem.message
        if problem.row in open_rows[1:]:
            continue
        if problem.row in open_rows and len(open_rows) > 1:
            message += f" ({len(open_rows):,} such matches; --chart NAME settles them all)"
        side = {"player_a": results.player_a, "player_b": results.player_b}.get(problem.column)
        if side is not None:
            message += _suggestion(alike.get(results.players[side[problem.row]], ()))
        problems.add(int(tonight.lines[problem.row]), message)
    problems.raise_any()
    return apply_results(system, last.roster, results, chart=chart)


def _needs_chart(problem: Problem, results: Results, chart: Chart | None) -> bool:
    """Return whether nothing in a row, and no chart, says who won."""
    stated = results.winner is not None and results.winner[problem.row] > 0
    return chart is None and problem.column == "winner" and not stated


def _alike(strangers: set[str], known: Iterable[str]) -> dict[str, list[str]]:
    """Return for each name that is not on the list those on it that may be the same player."""
    if not strangers:
        return {}
    alike: dict[str, list[str]] = {name: [] for name in strangers}
    for group in similar_names([*strangers, *known]):
        on_list = [name for name in group if name not in strangers]
        for name in strangers.intersection(group):
            alike[name] += on_list
    return alike


def _suggestion(names: Iterable[str]) -> str:
    named = " or ".join(map(quoted, names))
    return f"; if {named} is meant, write that name, or add it to --aliases" if named else ""
