"""How a night's matches change a league's ratings.

The ratings before the night set all of its races, and all changes are added up at its end.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Ints, array_values
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.night_problems import night_problems
from evenbreak.handicaps.systems.night_table import NightTable, night_table
from evenbreak.handicaps.systems.system import PlayedMatch, System
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import NOT_STATED, Roster


class MatchChange(NamedTuple):
    """What one match did to the ratings.

    Parameters
    ----------
    row
        its row in the results, from 0.
    winner, loser
        positions in the roster.
    games
        games won by the winner and by the loser; None where only the winner is known.
    race
        the games that the winner and the loser needed; None where that is not known.
    by_chart
        the race that the chart has for their ratings, in the same order; None without one.
    points
        how much the winner's and the loser's ratings change.
    ratings
        the winner's and the loser's before the night.
    """

    row: int
    winner: int
    loser: int
    games: tuple[int, int] | None
    race: tuple[int, int] | None
    by_chart: tuple[int, int] | None
    points: tuple[int, int]
    ratings: tuple[float, float]


@array_values
@dataclass(frozen=True, eq=False)
class RatingChanges:
    """How a night changed the ratings of a list.

    Parameters
    ----------
    system
        the system of the league.
    before, after
        the lists before and after the night, with the players in the same order. The games
        and matches of the night are added to those stated; standard errors stay as they were.
    matches
        what each match did, in the order of the results.
    won, lost
        matches won and lost by each player of the list, without forfeits.
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
    system: System, roster: Roster, results: Results, *, chart: Chart | str | None = None
) -> RatingChanges:
    """Return how a night's results change the ratings of a list.

    The winner of a match is the one stated in `winner`, or else the player who reached the race
    that is stated, or else the one who reached the chart's race for the two ratings. Forfeits
    and 0-0 change nothing. If the list states a player's matches, those of the night are counted
    on in the order of the rows; a player without a number is an established player.

    Parameters
    ----------
    system
        the system of the league.
    roster
        the list before the night.
    results
        the matches of the night; every player must be on the list, with a rating.
    chart
        which set the races where the results state none, for ratings rounded to whole points.
        Without it a match with neither race nor winner is refused: in a handicap race the higher
        score is not always the winner's.

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
        raise InputError(f"row {first.row} of the results: {first.message}")
    night = night_table(roster, results, chart)
    matches = tuple(_match_changes(system, roster, night))
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
    return RatingChanges(system, roster, after, matches, won, lost, forfeits, empty)


def _match_changes(system: System, roster: Roster, night: NightTable) -> Iterator[MatchChange]:
    """Yield what each match of the night did."""
    played = [None if many == NOT_STATED else many for many in roster.matches.tolist()]
    for row in np.flatnonzero(night.counted).tolist():
        yield _match_change(system, roster, night, played, row)
        for place in (night.a[row], night.b[row]):
            before = played[place]
            played[place] = None if before is None else before + 1


def _match_change(
    system: System, roster: Roster, night: NightTable, played: list[int | None], row: int
) -> MatchChange:
    """Return what the match in one row did, given the matches that each had played before."""
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
    return MatchChange(row, winner, loser, games, race, by_chart, points, ratings)
