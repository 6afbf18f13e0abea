"""`evenbreak rate --system`: a league's own rule, applied to a night's results."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.terminal import say
from evenbreak.cli.kit.values import refuse
from evenbreak.errors import DataError, InputError

if TYPE_CHECKING:
    from evenbreak.handicaps.charts.chart import Chart


def rate_by_system(
    path: str, *, system: str, roster: str, chart: str | None, aliases: str | None
) -> Answer:
    """Return the list of ratings after a night.

    Parameters
    ----------
    path
        the results of the night.
    system
        the name of the league's system.
    roster
        the list before the night.
    chart
        name or file of the chart that set the races; None: the results say who won, or else
        the only one of the system's charts that fits all scores is used.
    aliases
        the file that says which names mean the same player.
    """
    from evenbreak.answers.night_results import moves_of_files
    from evenbreak.answers.rating_changes import rating_changes_answer
    from evenbreak.files.results import read_results
    from evenbreak.files.roster import read_roster
    from evenbreak.handicaps.systems.catalogue import system_of
    from evenbreak.handicaps.systems.night_problems import chart_of_night

    if [path, roster, chart, aliases].count("-") > 1:
        refuse("- stands for standard input, which only one file can be; name the others")
    try:
        rule = system_of(system)
    except InputError as error:
        refuse(f"--{error}")
    by_chart = None if chart is None else _chart(chart)
    last = read_roster(roster)
    tonight = read_results(path, aliases=aliases)
    if by_chart is None:
        by_chart = chart_of_night(rule, last.roster, tonight.results)
    try:
        moves = moves_of_files(rule, last, tonight, chart=by_chart)
    except DataError:
        for warning in (*last.warnings, *tonight.warnings):  # they may explain it
            say(f"Warning: {warning}")
        raise
    return rating_changes_answer(moves, last, tonight, chart=by_chart, found_chart=chart is None)


def _chart(name: str) -> Chart:
    from evenbreak.files.chart import find_chart
    from evenbreak.handicaps.charts.chart import Chart

    found = find_chart(name)
    if not isinstance(found, Chart):
        refuse(f"--chart {name!r} is a chart of skill levels; give one of rating differences")
    return found
