"""A night's results with the list of ratings: who played whom, in which race, and who won.

Systems that look at all results are given all nights so far.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.handicaps.systems.history import Entries, History, Matches, joined
from evenbreak.handicaps.systems.system import System, checked_races, checked_ratings, updated
from evenbreak.ratings.results import Results, who_won
from evenbreak.ratings.roster import NOT_STATED, Roster


class NightTable(NamedTuple):
    """A night's results with the list: arrays with an entry for each row.

    Results without a stated race have the chart's race (`from_chart`). Players are positions in the
    list, -1 if not on it; `counted` rows change ratings: they are neither forfeits nor 0-0. The
    winner is 1, 2, or 0 if unknown; a chart's race is 0 if none was looked up.
    """

    results: Results
    a: Ints
    b: Ints
    rated: Bools
    counted: Bools
    winner: NDArray[np.int8]
    chart_a: Ints
    chart_b: Ints
    from_chart: Bools


def night_table(roster: Roster, results: Results, chart: Chart | System | str | None) -> NightTable:
    """Return a night's results with the list, with races from the chart if there is one.

    A system that is given uses its own races. If it doesn't need races, a race that the score does
    not finish is left out, and the player with more games has won.
    """
    on_list = {name: position for position, name in enumerate(roster.players)}
    place = np.array([on_list.get(name, -1) for name in results.players], dtype=np.int64)
    a, b = place[results.player_a], place[results.player_b]
    chart_a, chart_b = np.zeros((2, len(results)), dtype=np.int64)
    # One entry more, for players who are not on the list, whose place is -1.
    has_rating = np.append(np.isfinite(roster.rating), False)
    rated = has_rating[a] & has_rating[b]
    by_score = np.zeros(len(results), bool)
    if isinstance(chart, System):
        numbers = np.append(published(chart, roster), np.nan)
        rated = np.isfinite(numbers)[a] & np.isfinite(numbers)[b]
        races = checked_races(chart, numbers[a[rated]], numbers[b[rated]])
        chart_a[rated], chart_b[rated] = races
        if "race" not in chart.asks and chart.publishes == "ratings":
            ended = (results.score_a == chart_a) & (results.score_b < chart_b)
            ended |= (results.score_b == chart_b) & (results.score_a < chart_a)
            chart_a[~ended] = chart_b[~ended] = 0
            by_score = ~ended
    elif chart is not None:
        # As `evenbreak matchups` rounds: each rating, halves upwards.
        points = np.floor(np.append(roster.rating, 0.0) + 0.5)
        chart_a[rated], chart_b[rated] = chart_of(chart).races((points[a] - points[b])[rated])
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
    winner = _winner(filled)
    more = np.where(filled.score_a > filled.score_b, 1, 2)
    open_ = by_score & (winner == 0) & (filled.score_a != filled.score_b)
    winner = np.where(open_, more, winner).astype(np.int8)
    return NightTable(filled, a, b, rated, counted, winner, chart_a, chart_b, unraced)


def _winner(results: Results) -> NDArray[np.int8]:
    """Return 1 or 2 if a winner is stated or a player reached the race, else 0."""
    raced = 0 if results.race_a is None else results.race_a
    reached = np.where(raced, who_won(results), 0).astype(np.int8)
    return reached if results.winner is None else np.where(results.winner, results.winner, reached)


class SeasonSoFar:
    """A league's nights, in the form needed by a system that looks at all of them."""

    def __init__(self, system: System, roster: Roster) -> None:
        self.system, self.entries = system, _entries(roster)
        self.initial = published(system, roster)
        self.ratings = self.initial
        self.nights: list[Matches] = []
        self.days: list[float] = []
        self.kept: dict[str, Any] = {}
        self._first: Any = None

    def after(self, night: NightTable) -> Floats:
        """Return what the system publishes after another night."""
        rows, results = np.flatnonzero(night.counted), night.results
        a, b = night.a[rows], night.b[rows]
        race_a: Any = results.race_a
        race_b: Any = results.race_b
        score_a, score_b = results.score_a, results.score_b
        if results.unscored is not None:  # the winner is known, and stands for the score
            winner = np.where(results.unscored, night.winner, 0)
            score_a = np.where(winner == 1, np.maximum(race_a, 1), score_a)
            score_b = np.where(winner == 2, np.maximum(race_b, 1), score_b)
        self.nights.append(
            Matches.of_night(
                len(self.nights) + 1,
                a,
                b,
                score_a[rows],
                score_b[rows],
                race_a[rows],
                race_b[rows],
                self.ratings[a],
                self.ratings[b],
            )
        )
        self.days.append(self._day(results))
        history = History(
            self.entries,
            self.initial,
            self.ratings,
            len(self.nights),
            joined(self.nights),
            np.array(self.days),
            self.kept,
        )
        self.ratings = updated(self.system, history)
        return self.ratings

    def _day(self, results: Results) -> float:
        """Return days since the first night; an undated night is a week after the last."""
        date = None if results.date is None or not len(results) else results.date[0]
        if date is None or np.isnat(date):
            return self.days[-1] + 7.0 if self.days else 0.0
        self._first = date if self._first is None else self._first
        return max(float((date - self._first) / np.timedelta64(1, "D")), *self.days[-1:], 0.0)


def listed(system: System, roster: Roster) -> Roster:
    """Return a list as a system publishes it before the first night, with newcomers' numbers.

    A player without a number on the list has played no matches, unless the list states otherwise.
    """
    if isinstance(system, StepSystem):
        return roster
    new = np.isnan(published(system, roster))
    games, matches = (
        np.where(new & (played == NOT_STATED), 0, played)
        for played in (roster.games, roster.matches)
    )
    numbers = checked_ratings(system, system.initial(_entries(roster)), (len(roster),), "initial")
    levels = system.publishes == "levels"
    rating = numbers if not levels or levels_alone(roster) else roster.rating
    return Roster(
        roster.players,
        rating,
        roster.standard_error,
        games,
        component=roster.component,
        matches=matches,
        provisional=roster.provisional,
        level=numbers if levels else roster.level,
    )


def published(system: System, roster: Roster) -> Floats:
    """Return the list's numbers that a system publishes: its levels or its ratings."""
    return roster.level if system.publishes == "levels" else roster.rating


def levels_alone(roster: Roster) -> bool:
    """Return whether a list states only levels, in which case its ratings are levels."""
    return bool(np.array_equal(roster.rating, roster.level, equal_nan=True))


def _entries(roster: Roster) -> Entries:
    rating = np.full(len(roster), np.nan) if levels_alone(roster) else roster.rating
    return Entries.of(rating, roster.level, roster.matches, roster.games)
