"""`evenbreak rate --system`: a league's own update rule, applied to a night's results."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import refuse
from evenbreak.cli.kit.output import SCHEMA_VERSION, aligned, print_json, say, to_terminal
from evenbreak.errors import InputError

if TYPE_CHECKING:
    import pandas as pd

    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.systems.rating_changes import RatingChanges

COLUMNS = ("player", "rating_before", "rating", "change", "games")
"""What a terminal shows of the list."""


def rate_by_system(
    path: str, *, system: str, roster: str, chart: str | None, aliases: str | None, as_json: bool
) -> None:
    """Print the list of ratings after a night: as JSON, CSV or, on a terminal, who moved and why.

    Parameters
    ----------
    path
        the results of the night.
    system
        the name of the league's system.
    roster
        the list with which the players came.
    chart
        name or file of the chart by which they played; None: the results say who won, or else
        their scores which of the system's charts it was.
    aliases
        the file that says which names mean whom.
    as_json
        whether JSON was asked for.
    """
    from evenbreak.answers.rating_changes_frame import moves_frame, moves_of_files, night_warnings
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
    for warning in (*last.warnings, *tonight.warnings):
        say(f"Warning: {warning}")
    if by_chart is None:
        by_chart = chart_of_night(rule, last.roster, tonight.results)
        if by_chart is not None:
            say(
                f"No --chart: {by_chart.name} is taken, the only chart of the system whose races "
                "all scores end"
            )
    moves = moves_of_files(rule, last, tonight, chart=by_chart)
    if by_chart is not None:
        for warning in night_warnings(moves, tonight, by_chart):
            say(f"Warning: {warning}")
    frame = moves_frame(moves)
    if as_json:
        print_json(_as_json(moves, frame, by_chart))
    elif to_terminal():
        # Names may have letters that the terminal's encoding lacks.
        text = _heading(moves, last.source, tonight.source) + _tables(moves, frame)
        click.echo(text.encode(sys.stdout.encoding or "utf-8", "replace"), nl=False)
    else:
        from evenbreak.files.csv_writer import to_csv

        for line in _heading(moves, last.source, tonight.source).splitlines():
            say(line)
        click.echo(to_csv(frame), nl=False)


def _chart(name: str) -> Chart:
    from evenbreak.files.chart import find_chart
    from evenbreak.handicaps.charts.chart import Chart

    found = find_chart(name)
    if not isinstance(found, Chart):
        refuse(f"--chart {name!r} is a chart of skill levels; give one of rating differences")
    return found


def _heading(moves: RatingChanges, last: str, tonight: str) -> str:
    """Return by which rule the list was moved, and what was left out."""
    left_out = [
        f"{count:,} {what}"
        for count, what in (
            (moves.forfeits, "forfeit" + "s" * (moves.forfeits != 1)),
            (moves.empty, "at 0-0"),
        )
        if count
    ]
    matches = len(moves.matches)
    return (
        f"System {moves.system.name}: {moves.system.in_words}.\n{_newcomers(moves)}"
        f"{len(moves.before):,} players of {last}; {matches:,} match{'es' * (matches != 1)} of "
        f"{tonight}" + (f"; left out: {', '.join(left_out)}" if left_out else "") + ".\n"
    )


def _newcomers(moves: RatingChanges) -> str:
    """Return how newcomers move, where the list has such and the system a rule for them."""
    from evenbreak.ratings.roster import NOT_STATED

    steps, before = moves.system.newcomer_steps, moves.before.matches
    first = sum(matches for matches, _ in steps)
    if not ((before != NOT_STATED) & (before < first)).any():
        return ""
    stages = [
        f"{factor} times in the next {matches}"
        if stage
        else f"{factor} times as far in their first {matches} matches"
        for stage, (matches, factor) in enumerate(steps)
    ]
    return f"Newcomers go {', '.join(stages)}.\n"


def _tables(moves: RatingChanges, frame: pd.DataFrame) -> str:
    """Return who played, how they moved and why, a line a match; and then the whole list."""
    from evenbreak.answers.rating_changes_frame import reasons
    from evenbreak.files.problems import printable

    why, position = reasons(moves), moves.before.position
    rows, told, listed = [["played", "was", "is", "moves"]], ["why"], []
    for rank, row in enumerate(_plain(frame, *COLUMNS), 1):
        name, was, rating, change, games = row
        now = "new" if rating is None else _points(rating)
        listed.append([str(rank), printable(name), now, "" if games is None else str(games)])
        for place, reason in enumerate(why.get(position(name), ())):
            moved = [printable(name), _points(was), now, f"{change:+g}" if change else "0"]
            rows.append(["", "", "", ""] if place else moved)
            told.append(printable(reason))
    columns = aligned(rows).splitlines()
    width = max(map(len, columns)) + 2
    lines = [line.ljust(width) + reason for line, reason in zip(columns, told, strict=True)]
    return (
        "\n"
        + "\n".join(lines)
        + "\n\n"
        + aligned([["", "the list now", "rating", "games"], *listed], left=2)
    )


def _points(rating: float) -> str:
    return f"{rating:.0f}" if rating == round(rating) else f"{rating:.1f}"


def _plain(frame: pd.DataFrame, *columns: str) -> list[list[Any]]:
    """Return the rows of some columns, with None where nothing is known."""
    chosen = frame[list(columns)].astype(object)
    rows: list[list[Any]] = chosen.where(chosen.notna(), None).to_numpy().tolist()
    return rows


def _as_json(moves: RatingChanges, frame: pd.DataFrame, chart: Chart | None) -> dict[str, Any]:
    players = moves.before.players
    columns = list(frame.columns)
    return {
        "system": moves.system.name,
        "scale": moves.system.scale.name,
        "points_per_doubling": moves.system.scale.points_per_doubling,
        "chart": None if chart is None else chart.name,
        "forfeits_left_out": moves.forfeits,
        "empty_left_out": moves.empty,
        "players": [dict(zip(columns, row, strict=True)) for row in _plain(frame, *columns)],
        "matches": [
            {
                "winner": players[match.winner],
                "loser": players[match.loser],
                "games": match.games,
                "race": match.race,
                "race_by_chart": match.by_chart,
                "points": match.points,
            }
            for match in moves.matches
        ],
        "schema_version": SCHEMA_VERSION,
    }
