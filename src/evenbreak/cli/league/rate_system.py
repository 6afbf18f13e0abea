"""`evenbreak rate --system`: a league's own rule, applied to a night's results."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from evenbreak import answers, files, handicaps
from evenbreak.answers.answer import Answer
from evenbreak.answers.scale_doubts import league_doubts
from evenbreak.cli.kit.systems import chart_by_difference, refuse_other_scale
from evenbreak.cli.kit.terminal import say
from evenbreak.cli.kit.values import refuse
from evenbreak.errors import DataError


def rate_by_system(
    path: str,
    *,
    system: handicaps.System,
    roster: str,
    chart: str | None,
    reading: dict[str, Any],
) -> Answer:
    """Return the list of ratings after a night.

    Parameters
    ----------
    path
        the results of the night.
    system
        the league's system.
    roster
        the list before the night.
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
    refuse_other_scale(last, system.scale, f"the system {system.name}", "give another --system")
    tonight = files.read_results(path, **reading)
    if by_chart is None:
        by_chart = handicaps.chart_of_night(system, last.roster, tonight.results)
    try:
        moves = answers.rating_changes_of_files(system, last, tonight, chart=by_chart)
    except DataError:
        for warning in (*last.warnings, *tonight.warnings):  # they may explain it
            say(f"Warning: {warning}")
        raise
    answer = answers.rating_changes_answer(
        moves, last, tonight, chart=by_chart, found_chart=chart is None
    )
    if last.scale is not None:
        return answer
    remedy = f"the system {system.name} takes them as they are"
    doubts = league_doubts(system.scale, last.roster.rating, remedy)
    return replace(answer, warnings=[*answer.warnings, *doubts])
