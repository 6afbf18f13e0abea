"""`evenbreak tournament time`: when tonight's tournament ends, and when each match starts."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.paces import TURNOVER, pace_options, stated_pace
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.tournament.options import tournament_options

if TYPE_CHECKING:
    from evenbreak.answers.tournament import Tournament

EXAMPLES = """\b
Examples:
  evenbreak tournament time entrants.csv --race 5 --tables 4 --discipline 9-ball
  evenbreak tournament time entrants.csv --race 7 --losers-race 5 --tables 6 \\
      --discipline 8-ball --start 19:00
"""


class TimeOfDay(click.ParamType):  # type: ignore[type-arg]
    """A time of day such as 19:30; its value is in minutes after midnight."""

    name = "time"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the minutes."""
        match = re.fullmatch(r"\s*(\d{1,2})[:.h](\d{2})\s*", value)
        hours, minutes = (int(match[1]), int(match[2])) if match else (24, 0)
        if hours > 23 or minutes > 59:
            self.fail(
                f"{value!r}; give a time of day from 0:00 to 23:59, such as 19:30", param, ctx
            )
        return 60 * hours + minutes


@click.command("time", epilog=EXAMPLES)
@tournament_options
@click.option(
    "--tables", type=Whole(1, 1000), metavar="T", required=True, help="The number of tables."
)
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
    tables: int,
    discipline: str | None,
    minutes_per_game: float | None,
    turnover: float | None,
    start: int | None,
    seed: int,
) -> Answer:
    """Find when the tournament ends, and when each match starts.

    ENTRANTS.csv has a row for each entrant, with the columns player and rating; a plain list of
    names is taken as equal players. JSON and CSV have minutes from the start of the tournament.
    """
    from evenbreak.answers.tournament_time import tournament_time_answer
    from evenbreak.matches import Turnover

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
