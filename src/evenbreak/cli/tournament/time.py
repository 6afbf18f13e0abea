"""`evenbreak tournament time`: when tonight's tournament ends, and when each match starts."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.paces import TURNOVER, pace_options, stated_pace
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.tournament.evening import or_under_way, outlook_of
from evenbreak.cli.tournament.options import tournament_options
from evenbreak.cli.tournament.times import TimeOfDay

if TYPE_CHECKING:
    from evenbreak.answers.tournament.tournament import Tournament

EXAMPLES = """\b
Examples:
  evenbreak tournament time entrants.csv --race 5 --tables 4 --discipline 9-ball
  evenbreak tournament time entrants.csv --race 7 --losers-race 5 --tables 6 \\
      --discipline 8-ball --start 19:00
  evenbreak tournament time --file tonight.db
"""


def under_way(file: str, at: str, tables: int | None, turnover: float | None) -> Answer:
    """Find when the tournament under way ends."""
    from evenbreak.answers.tournament.under_way import time_under_way
    from evenbreak.matches import Turnover

    return time_under_way(
        outlook_of(file, at),
        tables=tables,
        turnover=None if turnover is None else Turnover(turnover),
        source=PurePath(file).name,
    )


@click.command("time", epilog=EXAMPLES)
@or_under_way(under_way)
@tournament_options
@click.option("--tables", type=Whole(1, 1000), metavar="T", help="The number of tables.")
@pace_options
@click.option(
    "--turnover",
    metavar="MINUTES",
    type=TURNOVER,
    help="The time between two matches on a table, on average.  [default: as in real events, where "
    "most matches start at once and the average is 4]",
)
@click.option(
    "--start",
    metavar="HH:MM",
    type=TimeOfDay(),
    help="When the tournament starts: shows times of day.",
)
@faces()
def command(
    *,
    tournament: Tournament,
    warnings: list[str],
    tables: int | None,
    discipline: str | None,
    minutes_per_game: float | None,
    turnover: float | None,
    start: int | None,
    seed: int,
) -> Answer:
    """Find when the tournament ends, and when each match starts.

    ENTRANTS.csv has a row for each entrant, with the columns player and rating; a plain list of
    names is taken as equal players. Without it, the answer is about the tournament under way in
    --file: its results, the matches on its tables and its pace so far. JSON and CSV have minutes
    from the start of the tournament.
    """
    from evenbreak.answers.tournament.time import tournament_time_answer
    from evenbreak.matches import Turnover

    if tables is None:
        refuse("the number of tables is missing; give it with --tables, such as --tables 4")
    pace = stated_pace(discipline, minutes_per_game)
    if pace is None:
        refuse(
            "say how long games take; give --discipline, such as 9-ball, or --minutes-per-game, "
            "such as 8"
        )
    return tournament_time_answer(
        tournament,
        tables=tables,
        pace=pace,
        turnover=None if turnover is None else Turnover(turnover),
        start=start,
        seed=seed,
        warnings=warnings,
    )
