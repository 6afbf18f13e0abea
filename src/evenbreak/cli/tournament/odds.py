"""`evenbreak tournament odds`: each player's odds of winning tonight's tournament."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import Number, refuse
from evenbreak.cli.tournament.evening import or_under_way, outlook_of
from evenbreak.cli.tournament.options import tournament_options
from evenbreak.cli.tournament.prize_money import paid_places, prizes_option

if TYPE_CHECKING:
    from evenbreak.answers.tournament.tournament import Tournament

WALKOVERS = Number(0.0, 1.0, " is not a probability; give a number from 0 to 1, such as 0.047")

EXAMPLES = """\b
Examples:
  evenbreak tournament odds entrants.csv --race 7 --losers-race 5 --scale fargo
  evenbreak tournament odds entrants.csv --format single --chart npl_10
  evenbreak tournament odds entrants.csv --race-to 5 --seeding rating --prizes 500,300,150
  evenbreak tournament odds --file tonight.db
"""


def under_way(file: str, at: str, prizes: str | None, sure: bool, walkovers: float) -> Answer:
    """Find each player's odds in the tournament under way."""
    from evenbreak.answers.tournament.under_way import odds_under_way

    outlook = replace(outlook_of(file, at), walkovers=walkovers)
    paid = paid_places(prizes, len(outlook.state.order))
    return odds_under_way(outlook, sure=sure, prizes=paid, source=PurePath(file).name)


@click.command("odds", epilog=EXAMPLES)
@or_under_way(under_way)
@tournament_options
@click.option(
    "--sure",
    is_flag=True,
    help="Take the ratings as right, even if they have standard errors.",
)
@click.option(
    "--before-draw",
    is_flag=True,
    help="The odds before a blind draw: every draw is equally likely.",
)
@click.option(
    "--fairest",
    is_flag=True,
    help="With --race-to or --chart: also list the races by side and by round that make the "
    "tournament fairest for about as many games.",
)
@click.option(
    "--walkovers",
    metavar="P",
    type=WALKOVERS,
    default="0",
    help="The chance that a match is a walkover; in real double eliminations it is 0.047.",
)
@prizes_option("each player's average prize")
@faces()
def command(
    *,
    tournament: Tournament,
    warnings: list[str],
    sure: bool,
    fairest: bool,
    walkovers: float,
    prizes: str | None,
    seed: int,
) -> Answer:
    """Find each player's odds of winning the tournament, and of each other place.

    ENTRANTS.csv has a row for each entrant, with the columns player and rating and, if you
    have them, standard_error and games. Where standard errors are given, the odds are averaged over
    how far the ratings may be off; new players are taken as very uncertain.

    Without ENTRANTS.csv, the answer is about the tournament under way in --file: its results so
    far, and the scores of the matches in play.
    """
    import numpy as np

    from evenbreak.answers.tournament.odds import tournament_odds_answer

    if np.isnan(tournament.file.roster.rating).all():
        refuse(f"{tournament.file.source} has no ratings, so everybody's odds are the same")
    if fairest and isinstance(tournament.races.race, int):
        refuse("--fairest is for handicapped races; give --race-to N or --chart NAME, not --race")
    return tournament_odds_answer(
        tournament,
        sure=sure,
        walkovers=walkovers,
        prizes=paid_places(prizes, len(tournament.roster)),
        fairest=fairest,
        seed=seed,
        warnings=warnings,
    )
