"""`evenbreak rate --system`: a league's own rule, applied to a night's results."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak import answers, files, handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.scales import league_doubts
from evenbreak.cli.kit.said import said
from evenbreak.cli.kit.systems import chart_by_difference, refuse_for_system
from evenbreak.cli.kit.terminal import say
from evenbreak.cli.kit.values import refuse
from evenbreak.errors import DataError

if TYPE_CHECKING:
    from evenbreak.ratings.results import Results


def rate_by_system(
    path: str,
    *,
    system: handicaps.System,
    roster: str,
    chart: str | None,
    reading: dict[str, Any],
) -> Answer:
    """Return the list of ratings after a night, or after several, night by night.

    Parameters
    ----------
    path
        the results.
    system
        the league's system.
    roster
        the list before them.
    chart
        name or file of the chart that set the races; None: the results say who won, or else
        the only one of the system's charts that fits all scores is used.
    reading
        how to read the results, as `files.read_results` takes it.
    """
    if [path, roster, chart, reading["aliases"]].count("-") > 1:
        refuse("- stands for standard input, which only one file can be; name the others")
    by_chart = None if chart is None else chart_by_difference("--chart", chart)
    last = files.read_roster(roster)
    refuse_for_system(last, system)
    tonight = files.read_results(path, **reading)
    if by_chart is None:
        by_chart = handicaps.chart_of_night(system, last.roster, _first_night(tonight.results))
    try:
        moves = answers.rating_changes_of_season(system, last, tonight, chart=by_chart)
    except DataError:
        for warning in (*last.warnings, *tonight.warnings):  # they may explain it
            say(f"Warning: {said(warning)}")
        raise
    answer = answers.rating_changes_answer(
        moves, last, tonight, chart=by_chart, found_chart=chart is None
    )
    if last.scale is not None:
        return answer
    remedy = f"the system {system.name} takes them as they are"
    doubts = league_doubts(system.scale, last.roster.rating, remedy)
    return replace(answer, warnings=[*answer.warnings, *doubts])


def _first_night(results: Results) -> Results:
    """Return the matches of the first date, whose races the ratings of the list have set."""
    if results.date is None or np.isnat(results.date).all():
        return results
    return results.select(np.flatnonzero(results.date == np.nanmin(results.date)))
