"""`evenbreak fair`: the races that come nearest to a target chance."""

import math
from typing import Any

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.two_players import TwoPlayers
from evenbreak.chains.ways import Way
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import (
    PlainCommand,
    form_option,
    race_limit_options,
    refuse_both,
    via_option,
)
from evenbreak.cli.kit.players import player_options, players_of, refuse_uncertain
from evenbreak.cli.kit.values import CHANCE, Whole, refuse
from evenbreak.ratings.scale import Scale

MOST = 300
"""The most races that are listed, so that every answer takes seconds."""

MOST_GRAPHS, MOST_GAMES = 20, 99
"""The most races whose graph is built with --via, and the most games in them."""

EXAMPLES = """\b
Examples:
  evenbreak fair 612 521 --scale fargo --race-to 7
  evenbreak fair "Ann Lee" "Bo Diaz" --from ratings.csv --race-to 7
  evenbreak fair 85 40 --games 7..13 --top 3
  evenbreak fair --p1 0.6 --p2 0.5 --breaks alternate --games 5..9
"""


@click.command("fair", cls=PlainCommand, epilog=EXAMPLES)
@player_options
@race_limit_options
@click.option(
    "--target",
    metavar="P",
    type=CHANCE,
    default=0.5,
    help="The chance of winning that A should have.",
)
@click.option(
    "--top",
    type=Whole(1, MOST),
    metavar="K",
    default=5,
    help="How many races to list.",
)
@form_option
@via_option
@faces()
def command(
    games: tuple[int, int] | None,
    race_to: int | None,
    target: float,
    top: int,
    via: Way | None,
    **who: Any,
) -> Answer:
    """Find the fairest races for two players, the fairest first.

    Describe the players by two ratings A B, by two names with --from, by --p, or by --p1, --p2 and
    --breaks; limit the length by --games or --race-to.
    """
    from evenbreak.answers.match.fair import fair_answer
    from evenbreak.handicaps.charts.fair import fair_races

    refuse_both(games, race_to)
    players = players_of(**who)
    if games is None and race_to is None:
        refuse("the length of the race is missing; give --games LO..HI or --race-to N")
    limits: Any = {"games": games, "race_to": race_to, "target": target, "top": top}
    if via is not None:
        refuse_uncertain(players)
        _refuse_many(games, race_to, top)
    if players.error or players.form:
        from evenbreak.handicaps.charts.given_ratings import nearest_races_given_ratings

        races = nearest_races_given_ratings(
            _difference(players), players.error, scale=_scale(players), form=players.form, **limits
        )
    else:
        races = fair_races(
            players.rack,
            breaks=players.break_format,
            first_breaker=players.first_breaker,
            via=via,
            **limits,
        )
    return fair_answer(players, races, target=target, via=via)


def _scale(players: TwoPlayers) -> Scale:
    """Return the scale of the ratings; without any, one of natural log-odds."""
    return players.scale or Scale("log-odds", math.log(2.0))


def _difference(players: TwoPlayers) -> float:
    if players.scale is not None:
        return players.difference
    p = players.p_game_a
    if p is None:
        refuse("--form knows nothing of the break here; give --p, or two ratings")
    if p in (0.0, 1.0):
        refuse(f"--form changes nothing where --p is {p:g}; leave it out")
    return math.log(p) - math.log1p(-p)


def _refuse_many(games: tuple[int, int] | None, race_to: int | None, top: int) -> None:
    """Refuse to build so many graphs, or such large ones, that it would take minutes."""
    longest = games[1] if games is not None else 2 * (race_to or 1) - 1
    if longest > MOST_GAMES or top > MOST_GRAPHS:
        refuse(
            f"--via builds the graph of each race listed; ask for at most {MOST_GRAPHS} races of "
            f"at most {MOST_GAMES} games"
        )
