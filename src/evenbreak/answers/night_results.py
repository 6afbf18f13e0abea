"""A night's results applied to a list of ratings, or everything that prevents it."""

from collections.abc import Iterable

from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.files.tables.problems import Problems, quoted
from evenbreak.files.tables.similar_names import similar_names
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.night_problems import night_problems
from evenbreak.handicaps.systems.rating_changes import RatingChanges, apply_results
from evenbreak.handicaps.systems.system import System
from evenbreak.ratings.consistency import Problem
from evenbreak.ratings.results import Results


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
