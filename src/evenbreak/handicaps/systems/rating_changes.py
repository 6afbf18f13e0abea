"""How a night's matches change a league's ratings.

The ratings before the night set all of its races, and all changes are added up at its end.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.systems.by_match import PlayedMatch, StepSystem
from evenbreak.handicaps.systems.night_table import (
    NightTable,
    SeasonSoFar,
    levels_alone,
    night_table,
    published,
)
from evenbreak.handicaps.systems.system import System
from evenbreak.ratings.results import Problem, Results, find_problems
from evenbreak.ratings.roster import NOT_STATED, Roster


class MatchChange(NamedTuple):
    """The effect of one match on the ratings.

    Parameters
    ----------
    row
        in the results, from 0.
    winner, loser
        positions in the roster.
    games
        the winner's and the loser's games; None if only the winner is known.
    race
        the same order; None if unknown.
    by_chart
        the chart's race for their ratings, in the same order; None without a chart.
    points
        the winner's and the loser's rating changes; None in a system that doesn't move ratings
        match by match.
    ratings
        the winner's and the loser's, before the night.
    """

    row: int
    winner: int
    loser: int
    games: tuple[int, int] | None
    race: tuple[int, int] | None
    by_chart: tuple[int, int] | None
    points: tuple[int, int] | None
    ratings: tuple[float, float]


@array_values
@dataclass(frozen=True, eq=False)
class RatingChanges:
    """Changes to a list's ratings in a night.

    Parameters
    ----------
    before, after
        the lists before and after the night, with the players in the same order. The games
        and matches of the night are added to those stated; standard errors stay as they were.
    won, lost
        matches won and lost by each player on the list, without forfeits.
    forfeits, empty
        the number of rows that changed nothing: forfeits, and matches at 0-0.
    """

    system: System
    before: Roster
    after: Roster
    matches: tuple[MatchChange, ...]
    won: Ints
    lost: Ints
    forfeits: int
    empty: int


def apply_results(
    system: System,
    roster: Roster,
    results: Results,
    *,
    chart: Chart | System | str | None = None,
    so_far: SeasonSoFar | None = None,
) -> RatingChanges:
    """Return how a night's results change a list's ratings.

    The winner of a match is the one stated in `winner`, or else the player who reached the stated
    race, or else the one who reached the chart's race for the two ratings. Forfeits and 0-0 change
    nothing. If the list states a player's matches, the night's matches are added to them in row
    order; a player without a number is an established player.

    Parameters
    ----------
    results
        the matches of the night; every player must be on the list, with a rating.
    chart
        the chart that sets the races if the results don't state them, for ratings rounded to whole
        points. Without it, a match with neither race nor winner is an error: in a handicap race,
        the player with the higher score has not always won. A system that does not move ratings
        match by match uses its own races.
    so_far
        the earlier nights, which such a system needs; this night is added to them. None: there were
        none.

    Raises
    ------
    InputError
        if the results cannot be used; `night_problems` lists all that is wrong with them.

    Notes
    -----
    Source: the National Pool League's ladder, between Table 5.6 and P5.27.

    >>> from evenbreak.handicaps import system_of
    >>> club = Roster(["Ann", "Bo", "Cy"], [92, 80, 71])
    >>> night = Results.from_names(["Ann", "Ann"], ["Bo", "Cy"], [4, 6], [4, 2])
    >>> changes = apply_results(system_of("npl"), club, night, chart="npl_10")
    >>> changes.after.rating
    array([92., 81., 70.])
    >>> match = changes.matches[0]
    >>> (match.winner, match.loser), match.race, match.points
    ((1, 0), (4, 5), (1, -1))
    """
    problems = night_problems(system, roster, results, chart=chart)
    if problems:
        first = problems[0]
        raise InputError(
            "row {row} of the results: {message}", row=first.row, message=first.message
        )
    night = night_table(roster, results, chart)
    matches = tuple(_match_changes(system, roster, night))
    change, games = np.zeros(len(roster)), np.zeros(len(roster), dtype=np.int64)
    won, lost = np.zeros_like(games), np.zeros_like(games)
    for match in matches:
        pair = [match.winner, match.loser]
        change[pair] += match.points or 0
        games[pair] += sum(match.games or ())
        won[match.winner] += 1
        lost[match.loser] += 1
    rating, level = roster.rating + change, roster.level
    if not isinstance(system, StepSystem):
        numbers = (so_far or SeasonSoFar(system, roster)).after(night)
        both = system.publishes == "levels" and levels_alone(roster)
        if system.publishes == "levels":
            level = numbers
        if system.publishes == "ratings" or both:
            rating = numbers
    after = Roster(
        roster.players,
        rating,
        roster.standard_error,
        np.where(roster.games == NOT_STATED, NOT_STATED, roster.games + games),
        component=roster.component,
        level=level,
        matches=np.where(roster.matches == NOT_STATED, NOT_STATED, roster.matches + won + lost),
    )
    _, forfeits, empty = results.played()
    return RatingChanges(system, roster, after, matches, won, lost, forfeits, empty)


def _match_changes(system: System, roster: Roster, night: NightTable) -> Iterator[MatchChange]:
    """Yield the effect of each match in the night."""
    played = [None if many == NOT_STATED else many for many in roster.matches.tolist()]
    for row in np.flatnonzero(night.counted).tolist():
        yield _match_change(system, roster, night, played, row)
        for place in (night.a[row], night.b[row]):
            before = played[place]
            played[place] = None if before is None else before + 1


def _match_change(
    system: System, roster: Roster, night: NightTable, played: list[int | None], row: int
) -> MatchChange:
    """Return the effect of the match in one row, given each player's number of earlier matches."""
    results = night.results
    sides = (0, 1) if night.winner[row] == 1 else (1, 0)

    def winner_first(a: NDArray[Any] | None, b: NDArray[Any] | None) -> tuple[int, int] | None:
        if a is None or b is None or not a[row]:
            return None
        both = int(a[row]), int(b[row])
        return both[sides[0]], both[sides[1]]

    place = int(night.a[row]), int(night.b[row])
    winner, loser = place[sides[0]], place[sides[1]]
    unscored = results.unscored is not None and bool(results.unscored[row])
    score = int(results.score_a[row]), int(results.score_b[row])
    games = None if unscored else (score[sides[0]], score[sides[1]])
    race = winner_first(results.race_a, results.race_b)
    numbers = published(system, roster)
    ratings = float(numbers[winner]), float(numbers[loser])
    points = None
    if isinstance(system, StepSystem):
        points = system.moves(PlayedMatch(ratings, games, race, (played[winner], played[loser])))
    by_chart = winner_first(night.chart_a, night.chart_b)
    return MatchChange(row, winner, loser, games, race, by_chart, points, ratings)


# What keeps a night's results from changing ratings, and which chart its scores fit.


def night_problems(
    system: System,
    roster: Roster,
    results: Results,
    *,
    chart: Chart | System | str | None = None,
) -> list[Problem]:
    """Return every problem that keeps a night's results from changing ratings, by row.

    >>> from evenbreak.handicaps import system_of
    >>> club = Roster(["Ann", "Bo"], [92, 80])
    >>> night = Results.from_names(["Ann", "Ann"], ["Bo", "Boo"], [5, 5], [3, 3], winner=[0, 1])
    >>> for problem in night_problems(system_of("npl"), club, night):
    ...     print(problem.row, problem.message)
    0 neither the race nor the winner is given ('Ann' - 'Bo', 5-3). Add the chart that was used
    (npl_8, npl_10, npl_12 or npl_20), or the columns race_a and race_b.
    1 'Boo' isn't on the list. Add the player with a first rating, or correct the name.
    """
    night = night_table(roster, results, chart)
    problems = [
        *_strangers(published(system, roster), night),
        *(
            problem
            if chart is None or not _off_chart(night, problem)
            else problem._replace(message=_no_end(roster, night, chart, problem.row))
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


def chart_of_night(system: StepSystem, roster: Roster, results: Results) -> Chart | None:
    """Return the system's chart that a night must have used, given its scores.

    It is the only one whose races all scores finish, for ratings rounded to whole points. None if
    no chart is needed because races or winners are stated, or if no chart or more than one fits.

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


def _strangers(numbers: Floats, night: NightTable) -> Iterator[Problem]:
    """Yield the first row that needs it for each player without a rating on the list."""
    seen = set()
    for row in np.flatnonzero(night.counted):
        for column, place in (("player_a", night.a[row]), ("player_b", night.b[row])):
            name = night.results.players[getattr(night.results, column)[row]]
            if name in seen or (place >= 0 and np.isfinite(numbers[place])):
                continue
            seen.add(name)
            yield Problem(
                int(row),
                column,
                f"{name!r} has no rating on the list. Add a first rating."
                if place >= 0
                else f"{name!r} isn't on the list. Add the player with a first rating, or "
                "correct the name.",
            )


def _off_chart(night: NightTable, problem: Problem) -> bool:
    """Return whether a score contradicts a race that comes only from the chart."""
    scores = problem.column in ("score_a", "score_b")
    return scores and bool(night.from_chart[problem.row] and night.chart_a[problem.row])


def _ended(night: NightTable) -> bool:
    """Return whether all scores finish the races that come only from the chart."""
    return not any(_off_chart(night, problem) for problem in find_problems(night.results))


def _no_end(roster: Roster, night: NightTable, chart: Chart | System | str, row: int) -> str:
    results, a, b = night.results, night.a[row], night.b[row]
    by = chart if isinstance(chart, System) else chart_of(chart)
    numbers = published(by, roster) if isinstance(by, System) else roster.rating
    whose = "system" if isinstance(by, System) else "chart"
    return (
        f"{results.score_a[row]}-{results.score_b[row]} doesn't finish the race "
        f"{night.chart_a[row]}:{night.chart_b[row]}, which the {whose} {by.name} gives for "
        f"{roster.players[a]!r} ({numbers[a]:g}) and {roster.players[b]!r} ({numbers[b]:g}). "
        "Correct the score, give race_a and race_b, or mark a forfeit."
    )


def _no_winner(system: System, results: Results, row: int) -> str:
    name_a, name_b = results.players[results.player_a[row]], results.players[results.player_b[row]]
    return (
        f"neither the race nor the winner is given ({name_a!r} - {name_b!r}, "
        f"{results.score_a[row]}-{results.score_b[row]}). {_give_chart(system)}"
    )


def _give_chart(system: System) -> str:
    *charts, last = (system.charts if isinstance(system, StepSystem) else ()) or ("",)
    names = f" ({', '.join(charts)} or {last})" if charts else ""
    return f"Add the chart that was used{names}, or the columns race_a and race_b."


def _missing(system: System, night: NightTable) -> Iterator[Problem]:
    """Yield the matches without a score or race that the system's rule needs."""
    results = night.results
    for row in np.flatnonzero(night.counted & night.rated).tolist():
        if "games" in system.asks and results.unscored is not None and results.unscored[row]:
            yield Problem(
                row,
                "score_a",
                f"the score is missing, and the system {system.name} uses it to move ratings. Add "
                "the score, or mark a forfeit.",
            )
        elif "race" in system.asks and results.race_a is not None and not results.race_a[row]:
            yield Problem(
                row,
                "race_a",
                f"the race is missing, and the system {system.name} uses it to move ratings. "
                f"{_give_chart(system)}",
            )
