"""What keeps a night's results from changing ratings, and which chart its scores fit."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.systems.night_table import NightTable, night_table
from evenbreak.handicaps.systems.system import System
from evenbreak.ratings.consistency import Problem, find_problems
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster


def night_problems(
    system: System, roster: Roster, results: Results, *, chart: Chart | str | None = None
) -> list[Problem]:
    """Return every problem that keeps a night's results from changing ratings, by row.

    >>> from evenbreak.handicaps import system_of
    >>> club = Roster(["Ann", "Bo"], [92, 80])
    >>> night = Results.from_names(["Ann", "Ann"], ["Bo", "Boo"], [5, 5], [3, 3], winner=[0, 1])
    >>> for problem in night_problems(system_of("npl"), club, night):
    ...     print(problem.row, problem.message)
    0 neither the race nor the winner is stated ('Ann' - 'Bo', 5-3); give the chart that was used
    (npl_8, npl_10, npl_12 or npl_20), or the columns race_a and race_b
    1 'Boo' is not on the list; add the player with a first rating, or correct the name
    """
    night = night_table(roster, results, chart)
    problems = [
        *_strangers(roster, night),
        *(
            problem
            if chart is None or not _off_chart(night, problem)
            else problem._replace(message=_no_end(roster, night, chart_of(chart), problem.row))
            for problem in find_problems(night.results)
        ),
    ]
    refused = {problem.row for problem in problems}
    problems += [
        Problem(int(row), "winner", _no_winner(system, night.results, int(row)))
        for row in np.flatnonzero(night.counted & night.rated & (night.winner == 0))
        if int(row) not in refused
    ]
    refused = {problem.row for problem in problems}
    problems += [problem for problem in _missing(system, night) if problem.row not in refused]
    return sorted(problems, key=lambda problem: problem.row)


def chart_of_night(system: System, roster: Roster, results: Results) -> Chart | None:
    """Return the chart of the system that a night must have been played by, given its scores.

    It is the only one whose races all scores finish, for ratings rounded to whole points. None
    if no chart is needed, since races or winners are stated, or if none or several charts fit.

    >>> from evenbreak.handicaps import system_of
    >>> club = Roster(["Ann", "Bo"], [92, 80])
    >>> chart_of_night(
    ...     system_of("npl"), club, Results.from_names(["Ann"], ["Bo"], [5], [3])
    ... ).name
    'npl_10'
    """
    night = night_table(roster, results, None)
    if not (night.counted & night.rated & (night.winner == 0)).any():
        return None
    charts = system.known_charts()
    fitting = [chart for chart in charts if _ended(night_table(roster, results, chart))]
    return fitting[0] if len(fitting) == 1 else None


def _strangers(roster: Roster, night: NightTable) -> Iterator[Problem]:
    """Yield for each player without a rating on the list the first row that needs it."""
    seen = set()
    for row in np.flatnonzero(night.counted):
        for column, place in (("player_a", night.a[row]), ("player_b", night.b[row])):
            name = night.results.players[getattr(night.results, column)[row]]
            if name in seen or (place >= 0 and np.isfinite(roster.rating[place])):
                continue
            seen.add(name)
            yield Problem(
                int(row),
                column,
                f"{name!r} has no rating on the list; write a first rating"
                if place >= 0
                else f"{name!r} is not on the list; add the player with a first rating, or "
                "correct the name",
            )


def _off_chart(night: NightTable, problem: Problem) -> bool:
    """Return whether a score contradicts a race that comes from the chart alone."""
    scores = problem.column in ("score_a", "score_b")
    return scores and bool(night.from_chart[problem.row] and night.chart_a[problem.row])


def _ended(night: NightTable) -> bool:
    """Return whether all scores finish the races that come from the chart alone."""
    return not any(_off_chart(night, problem) for problem in find_problems(night.results))


def _no_end(roster: Roster, night: NightTable, chart: Chart, row: int) -> str:
    results, a, b = night.results, night.a[row], night.b[row]
    return (
        f"{results.score_a[row]}-{results.score_b[row]} does not finish the race "
        f"{night.chart_a[row]}:{night.chart_b[row]}, which the chart {chart.name} has for "
        f"{roster.players[a]!r} ({roster.rating[a]:g}) and {roster.players[b]!r} "
        f"({roster.rating[b]:g}); correct the score, give race_a and race_b, or mark a forfeit"
    )


def _no_winner(system: System, results: Results, row: int) -> str:
    name_a, name_b = results.players[results.player_a[row]], results.players[results.player_b[row]]
    return (
        f"neither the race nor the winner is stated ({name_a!r} - {name_b!r}, "
        f"{results.score_a[row]}-{results.score_b[row]}); {_give_chart(system)}"
    )


def _give_chart(system: System) -> str:
    *charts, last = system.charts or ("",)
    names = f" ({', '.join(charts)} or {last})" if charts else ""
    return f"give the chart that was used{names}, or the columns race_a and race_b"


def _missing(system: System, night: NightTable) -> Iterator[Problem]:
    """Yield the matches without a score or race that the system's rule needs."""
    results = night.results
    for row in np.flatnonzero(night.counted & night.rated).tolist():
        if "games" in system.asks and results.unscored is not None and results.unscored[row]:
            yield Problem(
                row,
                "score_a",
                f"the score is not stated, and the system {system.name} moves ratings by it; "
                "write it, or mark a forfeit",
            )
        elif "race" in system.asks and results.race_a is not None and not results.race_a[row]:
            yield Problem(
                row,
                "race_a",
                f"the race is not stated, and the system {system.name} moves ratings by it; "
                f"{_give_chart(system)}",
            )
