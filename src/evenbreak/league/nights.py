"""A season night by night, as its results changed the ratings."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Ints
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.night_problems import night_problems
from evenbreak.handicaps.systems.rating_changes import RatingChanges, apply_results
from evenbreak.handicaps.systems.system import System
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster


class PlayedNight(NamedTuple):
    """A night of a season: the rows of its matches in the results, and what they changed."""

    rows: Ints
    changes: RatingChanges


def played_nights(
    system: System,
    roster: Roster,
    results: Results,
    *,
    chart: Chart | str | None = None,
    apply: Callable[[Roster, Ints], RatingChanges] | None = None,
) -> list[PlayedNight]:
    """Return a season night by night, with the ratings after each night.

    Without dates each match is a night of its own, in the order of the rows; matches without a
    date come last.

    Parameters
    ----------
    system
        the league's system.
    roster
        the ratings before the first night.
    results
        the season.
    chart
        which sets the races where the results state none.
    apply
        how the matches of a night change a list of ratings; None: as `apply_results` does.

    Raises
    ------
    InputError
        if results cannot be used.
    """

    def by_results(list_: Roster, rows: Ints) -> RatingChanges:
        night = results.select(rows)
        for problem in night_problems(system, list_, night, chart=chart):
            raise InputError(f"row {rows[problem.row]} of the results: {problem.message}")
        return apply_results(system, list_, night, chart=chart)

    nights, now = [], roster
    for rows in _nights(results):
        changes = (apply or by_results)(now, rows)
        nights.append(PlayedNight(rows, changes))
        now = changes.after
    return nights


def _nights(results: Results) -> list[Ints]:
    """Return the rows of each night's matches by date; without dates each match is a night."""
    if results.date is None:
        return [np.array([row]) for row in range(len(results))]
    _, night = np.unique(results.date, return_inverse=True)
    return [np.flatnonzero(night == day) for day in range(night.max(initial=-1) + 1)]
