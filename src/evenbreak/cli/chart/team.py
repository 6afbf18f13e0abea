"""`evenbreak chart team`: the points that the weaker of two teams gets."""

from __future__ import annotations

import click

from evenbreak import handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import scale_option
from evenbreak.cli.kit.values import Number, Whole
from evenbreak.ratings.scale import Scale

RATING = Number(-1e6, 1e6, " is not a rating; give a team's average, such as 447")
POINTS = Number(0.0, 1e6, "; give 0 or more points")

EXAMPLES = """\b
Examples:
  evenbreak chart team 417 447
  evenbreak chart team 510 462 --match-ups 5 --games 1 --won 10 --lost 3.5
"""


@click.command("team", epilog=EXAMPLES)
@click.argument("average_1", type=RATING)
@click.argument("average_2", type=RATING)
@click.option(
    "--match-ups",
    type=Whole(1, 1000),
    metavar="K",
    default=3,
    help="How many pairs of players meet in a round.",
)
@click.option(
    "--games",
    type=Whole(1, 1000),
    metavar="K",
    default=2,
    help="How many games each pair plays in a round.",
)
@click.option(
    "--won",
    type=POINTS,
    metavar="POINTS",
    default=13.19,
    help="What the winner of a game scores on average.",
)
@click.option(
    "--lost",
    type=POINTS,
    metavar="POINTS",
    default=3.81,
    help="What the loser of a game scores on average.",
)
@scale_option("fargo")
@faces()
def command(
    average_1: float,
    average_2: float,
    match_ups: int,
    games: int,
    won: float,
    lost: float,
    scale: Scale,
) -> Answer:
    """Find the points that the weaker of two teams gets in a round, as CSI does.

    AVERAGE_1 and AVERAGE_2 are the average ratings of the two teams. The averages of --won
    and --lost are those of 17-point scoring.
    """
    from evenbreak.answers.chart.show import team_handicap_answer

    found = handicaps.team_handicap(
        average_1,
        average_2,
        match_ups=match_ups,
        games=games,
        points_won=won,
        points_lost=lost,
        scale=scale,
    )
    return team_handicap_answer((average_1, average_2), found, match_ups=match_ups, scale=scale)
