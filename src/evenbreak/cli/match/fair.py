"""`evenbreak fair`: the races that come nearest to a target chance."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand, refuse_both, which_races
from evenbreak.cli.kit.players import player_options, players_of
from evenbreak.cli.kit.values import CHANCE, Whole, refuse

if TYPE_CHECKING:
    from evenbreak.answers.answer import Answer

MOST = 300
"""The most races that are listed, so that every answer takes seconds."""

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
    type=CHANCE,
    default=0.5,
    show_default=True,
    help="The chance that A should have to win the match.",
)
@click.option(
    "--top",
    type=Whole(1, MOST),
    metavar="K",
    default=5,
    show_default=True,
    help="How many races to list.",
)
@faces()
def command(
    games: tuple[int, int] | None,
    race_to: int | None,
    target: float,
    top: int,
    **who: Any,
) -> Answer:
    """Find the fairest races for two players, the fairest first.

    The players: two ratings A B; or --p; or --p1, --p2 and --breaks. The length: --games
    or --race-to.
    """
    from evenbreak.answers.fair import fair_answer
    from evenbreak.handicaps.charts.fair import fair_races

    refuse_both(games, race_to)
    players = players_of(**who)
    if games is None and race_to is None:
        refuse("the length of the race is missing; give --games LO..HI or --race-to N")
    races = fair_races(
        players.rack,
        games=games,
        race_to=race_to,
        target=target,
        top=top,
        breaks=players.break_format,
        first_breaker=players.first_breaker,
    )
    return fair_answer(players, races, target=target)
