"""`evenbreak why`: which matches made two ratings, and what would change them."""

from __future__ import annotations

from typing import Any

import click

from evenbreak import answers, files
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit import completion
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import race_limit_options, results_options, scale_option
from evenbreak.cli.kit.terminal import say
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.league.rate_options import how_to_rate, offered_races, rated
from evenbreak.ratings.scale import Scale

MANY = 2_000_000
"""Matches in all refits together that take so long that a person wonders."""

EXAMPLES = """\b
Examples:
  evenbreak why "Ann Lee" "Bo Diaz" --from season.csv
  evenbreak why "Ann Lee" "Bo Diaz" --from season.csv --race-to 9 --scale fargo
"""


@click.command("why", epilog=EXAMPLES)
@click.argument("player_a", metavar="A", shell_complete=completion.players)
@click.argument("player_b", metavar="B", shell_complete=completion.players)
@click.option(
    "--from",
    "results",
    required=True,
    multiple=True,
    metavar="RESULTS.csv",
    help="The results; may be repeated for several seasons.",
)
@scale_option()
@how_to_rate
@race_limit_options
@results_options
@faces()
def command(
    player_a: str,
    player_b: str,
    results: tuple[str, ...],
    scale: Scale,
    games: tuple[int, int] | None,
    race_to: int | None,
    reading: dict[str, Any],
    **how: Any,
) -> Answer:
    """Explain two ratings: the matches behind them, and what one more match would change.

    A and B are two players in RESULTS.csv, which is read as by `report` and `rate`. Each match of
    the two is left out in turn, to see what it is worth to the rating; and one more match between
    them is added, won by either.
    """
    from evenbreak.ratings.usual import rated_alike

    offered = offered_races(games, race_to)
    file = files.read_seasons(results, **reading)
    pair = answers.find_players(file.results, (player_a, player_b), said="why", where=file.source)
    if len(pair) < 2:
        refuse(f"{player_a!r} and {player_b!r} are one player; name two")
    ratings, choice = rated(file, scale, **how)
    played = int(ratings.games[pair].sum())
    if played * len(file.results) > MANY:
        say("Rating the league again without each of their matches")
    return answers.why_answer(
        file, ratings, (pair[0], pair[1]), offered, rated_alike(ratings, file.results), choice
    )
