"""How a league's ratings move by the matches of a night.

The ratings with which the players came decide all of a night's races, and all moves are
added up at its end.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.system import PlayedMatch, System
from evenbreak.ratings.consistency import Problem, find_problems, who_won
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import NOT_STATED, Roster


class MatchMove(NamedTuple):
    """What one match did to the ratings.

    Parameters
    ----------
    row
        its place in the results, from 0.
    winner, loser
        positions in the roster.
    games
        games won by the winner and by the loser; None where only the winner is known.
    race
        the games that the winner and the loser needed; None where that is not known.
    by_chart
        the race that the chart has for their ratings, in the same order; None without one.
    points
        by how much the winner's and the loser's ratings move.
    """

    row: int
    winner: int
    loser: int
    games: tuple[int, int] | None
    race: tuple[int, int] | None
    by_chart: tuple[int, int] | None
    points: tuple[int, int]


@dataclass(frozen=True, eq=False)
class Moves:
    """A night's moves.

    Parameters
    ----------
    system
        by which the ratings moved.
    before, after
        the list before the night and the one after it, players in the same order. The games
        of the night are added to the games stated, its matches to the matches; standard errors
        stay as they were.
    matches
        what each match did, in the order of the results.
    won, lost
        matches won and lost by each player of the list, without forfeits.
    forfeits, empty
        rows that moved nobody: matches given away, and those that stand at 0-0.
    """

    system: System
    before: Roster
    after: Roster
    matches: tuple[MatchMove, ...]
    won: NDArray[np.int64]
    lost: NDArray[np.int64]
    forfeits: int
    empty: int


def apply_results(
    system: System, roster: Roster, results: Results, *, chart: Chart | None = None
) -> Moves:
    """Return how the ratings of a list move by a night's results.

    Who won a match says `winner`; or the race that is stated, or else that of the chart for
    the two ratings, and who reached it. Forfeits and 0-0 move nobody. Where the list states
    a player's matches, those of the night are counted on in the order of the rows; who has
    none stated is an established player.

    Parameters
    ----------
    system
        the system of the league.
    roster
        the list with which the players came.
    results
        the matches of the night; every player must be on the list, with a rating.
    chart
        by which the races were given where the results state none, for ratings rounded to
        whole points. Without it a match with
        neither race nor winner is refused: of two scores the higher need not be the winner's.

    Raises
    ------
    InputError
        if the results cannot be used; `night_problems` lists all that is wrong with them.

    Notes
    -----
    Source: the National Pool League's ladder, between Table 5.6 and P5.27.

    >>> from evenbreak.handicaps import chart, system_of
    >>> club = Roster(["Ann", "Bo", "Cy"], [92, 80, 71])
    >>> night = Results.from_names(["Ann", "Ann"], ["Bo", "Cy"], [4, 6], [4, 2])
    >>> moves = apply_results(system_of("npl"), club, night, chart=chart("npl_10"))
    >>> moves.after.rating
    array([92., 81., 70.])
    >>> moves.matches[0]
    MatchMove(row=0, winner=1, loser=0, games=(4, 4), race=(4, 5), by_chart=(4, 5), points=(1, -1))
    """
    problems = night_problems(system, roster, results, chart=chart)
    if problems:
        first = problems[0]
        raise InputError(f"row {first.row} of the results: {first.message}")
    night = _night_of(roster, results, chart)
    matches = tuple(_moves(system, roster, night))
    change, games = np.zeros(len(roster)), np.zeros(len(roster), dtype=np.int64)
    won, lost = np.zeros_like(games), np.zeros_like(games)
    for match in matches:
        pair = [match.winner, match.loser]
        change[pair] += match.points
        games[pair] += sum(match.games or ())
        won[match.winner] += 1
        lost[match.loser] += 1
    after = Roster(
        roster.players,
        roster.rating + change,
        roster.standard_error,
        np.where(roster.games == NOT_STATED, NOT_STATED, roster.games + games),
        component=roster.component,
        matches=np.where(roster.matches == NOT_STATED, NOT_STATED, roster.matches + won + lost),
    )
    _, forfeits, empty = results.played()
    return Moves(system, roster, after, matches, won, lost, forfeits, empty)


def night_problems(
    system: System, roster: Roster, results: Results, *, chart: Chart | None = None
) -> list[Problem]:
    """Return all that keeps a night's results from moving the ratings, in the order of the rows.

    >>> from evenbreak.handicaps import system_of
    >>> club = Roster(["Ann", "Bo"], [92, 80])
    >>> night = Results.from_names(["Ann", "Ann"], ["Bo", "Boo"], [5, 5], [3, 3], winner=[0, 1])
    >>> for problem in night_problems(system_of("npl"), club, night):
    ...     print(problem.row, problem.message)
    0 neither the race nor the winner is stated ('Ann' - 'Bo', 5-3); give the chart by which they
    played (npl_8, npl_10, npl_12 or npl_20), or the columns race_a and race_b
    1 'Boo' is not on the list; add the player with a rating to begin with, or correct the name
    """
    night = _night_of(roster, results, chart)
    problems = [
        *_strangers(roster, night),
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
    problems += [problem for problem in _untold(system, night) if problem.row not in refused]
    return sorted(problems, key=lambda problem: problem.row)


def chart_of_night(system: System, roster: Roster, results: Results) -> Chart | None:
    """Return the system's chart by which a night must have been played, as its scores tell.

    That is the only one whose race every score ends, for ratings rounded to whole points.
    None where no chart is needed, since races or winners are stated, and where not just one
    of the charts fits.

    >>> from evenbreak.handicaps import system_of
    >>> club = Roster(["Ann", "Bo"], [92, 80])
    >>> chart_of_night(
    ...     system_of("npl"), club, Results.from_names(["Ann"], ["Bo"], [5], [3])
    ... ).name
    'npl_10'
    """
    night = _night_of(roster, results, None)
    if not (night.counted & night.rated & (night.winner == 0)).any():
        return None
    charts = system.known_charts()
    fitting = [chart for chart in charts if _ended(_night_of(roster, results, chart))]
    return fitting[0] if len(fitting) == 1 else None


class _Night(NamedTuple):
    """A night's results beside the list: arrays with an entry for each row.

    `results` has the chart's races where none was stated; a and b are positions in the list,
    -1 where a player is not on it; `rated` says where both have a rating, `counted` which rows
    move ratings; `winner` is 1, 2, or 0 where it cannot be told; `chart_a` and `chart_b` are 0
    where no chart was looked up; `from_chart` says where `results` has the chart's race.
    """

    results: Results
    a: NDArray[np.int64]
    b: NDArray[np.int64]
    rated: NDArray[np.bool_]
    counted: NDArray[np.bool_]
    winner: NDArray[np.int8]
    chart_a: NDArray[np.int64]
    chart_b: NDArray[np.int64]
    from_chart: NDArray[np.bool_]


def _night_of(roster: Roster, results: Results, chart: Chart | None) -> _Night:
    on_list = {name: position for position, name in enumerate(roster.players)}
    place = np.array([on_list.get(name, -1) for name in results.players], dtype=np.int64)
    a, b = place[results.player_a], place[results.player_b]
    chart_a, chart_b = np.zeros((2, len(results)), dtype=np.int64)
    # One entry more, for those who are not on the list and whose place is -1.
    known = np.append(np.isfinite(roster.rating), False)
    rated = known[a] & known[b]
    if chart is not None:
        # As `evenbreak matchups` rounds: each rating, halves upwards.
        points = np.floor(np.append(roster.rating, 0.0) + 0.5)
        chart_a[rated], chart_b[rated] = chart.races((points[a] - points[b])[rated])
    race_a = np.zeros_like(chart_a) if results.race_a is None else results.race_a
    race_b = np.zeros_like(chart_b) if results.race_b is None else results.race_b
    unraced = (race_a == 0) & (race_b == 0)
    filled = replace(
        results,
        race_a=np.where(unraced, chart_a, race_a),
        race_b=np.where(unraced, chart_b, race_b),
    )
    given_away = np.zeros(len(results), bool) if results.forfeit is None else results.forfeit
    unscored = np.zeros(len(results), bool) if results.unscored is None else results.unscored
    counted = ~given_away & (unscored | (results.score_a > 0) | (results.score_b > 0))
    return _Night(filled, a, b, rated, counted, _winner(filled), chart_a, chart_b, unraced)


def _winner(results: Results) -> NDArray[np.int8]:
    """Return 1 or 2 where a winner is stated or a race tells who it is, else 0."""
    raced = 0 if results.race_a is None else results.race_a
    reached = np.where(raced, who_won(results), 0).astype(np.int8)
    return reached if results.winner is None else np.where(results.winner, results.winner, reached)


def _strangers(roster: Roster, night: _Night) -> Iterator[Problem]:
    """Yield for each player without a rating on the list the first row that needs it."""
    told = set()
    for row in np.flatnonzero(night.counted):
        for column, place in (("player_a", night.a[row]), ("player_b", night.b[row])):
            name = night.results.players[getattr(night.results, column)[row]]
            if name in told or (place >= 0 and np.isfinite(roster.rating[place])):
                continue
            told.add(name)
            yield Problem(
                int(row),
                column,
                f"{name!r} has no rating on the list; write one to begin with"
                if place >= 0
                else f"{name!r} is not on the list; add the player with a rating to begin with, "
                "or correct the name",
            )


def _off_chart(night: _Night, problem: Problem) -> bool:
    """Tell whether a score is at odds with a race that only the chart says."""
    scores = problem.column in ("score_a", "score_b")
    return scores and bool(night.from_chart[problem.row] and night.chart_a[problem.row])


def _ended(night: _Night) -> bool:
    """Tell whether all scores end the races that only the chart says."""
    return not any(_off_chart(night, problem) for problem in find_problems(night.results))


def _no_end(roster: Roster, night: _Night, chart: Chart, row: int) -> str:
    results, a, b = night.results, night.a[row], night.b[row]
    return (
        f"{results.score_a[row]}-{results.score_b[row]} is no end of the race "
        f"{night.chart_a[row]}:{night.chart_b[row]} that {roster.players[a]!r} and "
        f"{roster.players[b]!r} have by the chart {chart.name} for {roster.rating[a]:g} and "
        f"{roster.rating[b]:g}; correct the score, give race_a and race_b, or mark a forfeit"
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
    return f"give the chart by which they played{names}, or the columns race_a and race_b"


def _untold(system: System, night: _Night) -> Iterator[Problem]:
    """Yield the matches of which the system's rule asks what nobody has stated."""
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


def _moves(system: System, roster: Roster, night: _Night) -> Iterator[MatchMove]:
    """Yield what each match of the night did."""
    played = [None if many == NOT_STATED else many for many in roster.matches.tolist()]
    for row in np.flatnonzero(night.counted).tolist():
        yield _move(system, roster, night, played, row)
        for place in (night.a[row], night.b[row]):
            before = played[place]
            played[place] = None if before is None else before + 1


def _move(
    system: System, roster: Roster, night: _Night, played: list[int | None], row: int
) -> MatchMove:
    """Return what the match in a row did, after so many matches of each player."""
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
    ratings = float(roster.rating[winner]), float(roster.rating[loser])
    points = system.moves(PlayedMatch(ratings, games, race, (played[winner], played[loser])))
    by_chart = winner_first(night.chart_a, night.chart_b)
    return MatchMove(row, winner, loser, games, race, by_chart, points)
