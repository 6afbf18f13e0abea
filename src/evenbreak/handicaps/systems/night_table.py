"""A night's results beside the list of ratings: who played whom, by which race, and who won."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Ints
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.ratings.consistency import who_won
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster


class NightTable(NamedTuple):
    """A night's results beside the list: arrays with an entry for each row.

    Parameters
    ----------
    results
        the results, with the chart's race where none was stated.
    a, b
        positions of the two players in the list; -1 for a player who is not on it.
    rated
        whether both have a rating.
    counted
        whether the row changes ratings: it is not a forfeit and not 0-0.
    winner
        1, 2, or 0 where it is not known.
    chart_a, chart_b
        the chart's race; 0 where no chart was looked up.
    from_chart
        whether `results` has the chart's race in this row.
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


def night_table(roster: Roster, results: Results, chart: Chart | str | None) -> NightTable:
    """Return a night's results beside the list, with races by the chart if there is one."""
    on_list = {name: position for position, name in enumerate(roster.players)}
    place = np.array([on_list.get(name, -1) for name in results.players], dtype=np.int64)
    a, b = place[results.player_a], place[results.player_b]
    chart_a, chart_b = np.zeros((2, len(results)), dtype=np.int64)
    # One entry more, for players who are not on the list, whose place is -1.
    known = np.append(np.isfinite(roster.rating), False)
    rated = known[a] & known[b]
    if chart is not None:
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
    return NightTable(filled, a, b, rated, counted, _winner(filled), chart_a, chart_b, unraced)


def _winner(results: Results) -> NDArray[np.int8]:
    """Return 1 or 2 where a winner is stated or a player reached the race, else 0."""
    raced = 0 if results.race_a is None else results.race_a
    reached = np.where(raced, who_won(results), 0).astype(np.int8)
    return reached if results.winner is None else np.where(results.winner, results.winner, reached)
