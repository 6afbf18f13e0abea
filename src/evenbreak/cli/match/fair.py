"""`evenbreak fair`: the races that come nearest to a target chance."""

from __future__ import annotations

from typing import Any

import click

from evenbreak.cli.kit.options import (
    PlainCommand,
    Whole,
    chance,
    refuse,
    refuse_both,
    wants_json,
    which_races,
)
from evenbreak.cli.kit.output import chance_text, print_json, print_table, to_terminal
from evenbreak.cli.kit.players import Players, player_options

COLUMNS = ("race_a", "race_b", "p_win_a", "mean_games", "games_p90")
HEADINGS = ("A needs", "B needs", "A wins", "games, mean", "9 of 10 within")

MOST = 300
"""The most races that are printed, so that no answer takes more than some seconds."""

EXAMPLES = """\b
Examples:
  evenbreak fair 612 521 --scale fargo --race-to 7
  evenbreak fair 85 40 --games 7..13 --top 3
  evenbreak fair --p1 0.6 --p2 0.5 --breaks alternate --games 5..9
"""


@click.command("fair", cls=PlainCommand, epilog=EXAMPLES)
@player_options
@which_races
@click.option(
    "--target",
    metavar="P",
    callback=chance,
    default="0.5",
    show_default=True,
    help="The chance that A should have to win the match.",
)
@click.option(
    "--top",
    type=Whole(1, MOST),
    metavar="K",
    default=5,
    show_default=True,
    help="How many.",
)
@wants_json
def command(
    games: tuple[int, int] | None,
    race_to: int | None,
    target: float,
    top: int,
    as_json: bool,
    **who: Any,
) -> None:
    """Find the races that come nearest to an even chance, the nearest first.

    Who plays: two ratings A B; or --p; or --p1, --p2 and --breaks. How long: --games
    or --race-to.
    """
    from evenbreak.handicaps.charts.fair import fair_races

    refuse_both(games, race_to)
    players = Players.of(**who)
    if games is None and race_to is None:
        refuse("how long is missing; give --games LO..HI or --race-to N")
    races = fair_races(
        players.rack,
        games=games,
        race_to=race_to,
        target=target,
        top=top,
        breaks=players.breaks,
        first_breaker=players.first_breaker,
    )
    rows = [
        (race.race_1, race.race_2, race.p_win_1, race.mean_games, race.games_p90) for race in races
    ]
    if as_json:
        print_json([dict(zip(COLUMNS, row, strict=True)) for row in rows])
        return
    if players.scale is not None and not to_terminal():
        click.echo(players.description, err=True)
    print_table(COLUMNS, rows, headings=HEADINGS, heading=players.description, text=_text)


def _text(column: str, value: float) -> str:
    if column == "p_win_a":
        return chance_text(value)
    return f"{value:.2f}" if isinstance(value, float) else str(value)
