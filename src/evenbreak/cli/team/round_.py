"""`evenbreak round`: who wins a round between two teams, and the fair head start."""

from __future__ import annotations

from pathlib import PurePath

import click

from evenbreak import files, ratings, teams
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import OF_LIST, scale_option
from evenbreak.cli.kit.starters import starter_options, with_starters
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.team.lists import race_of, race_options, scale_of_teams
from evenbreak.ratings.scale import Scale

EXAMPLES = """\b
Examples:
  evenbreak round ours.csv theirs.csv --games 2
  evenbreak round ours.csv theirs.csv --games 1 --everybody --scale fargo
  evenbreak round ours.csv theirs.csv --race 5
"""


@click.command("round", epilog=EXAMPLES)
@click.argument("ours", metavar="OURS.csv")
@click.argument("theirs", metavar="THEIRS.csv")
@click.option("--games", type=Whole(1, 100), metavar="K", help="Each match is K single games.")
@race_options
@click.option(
    "--everybody",
    is_flag=True,
    help="Every player meets every player of the other team; else the first of one file meets the "
    "first of the other, and so on.",
)
@click.option(
    "--sure",
    is_flag=True,
    help="Take the ratings as right, even if the files state their standard errors.",
)
@starter_options
@scale_option(OF_LIST, fixed=False)
@faces()
def command(
    ours: str,
    theirs: str,
    games: int | None,
    race: int | None,
    race_to: int | None,
    chart: str | None,
    everybody: bool,
    sure: bool,
    starter: float | None,
    starter_sd: float | None,
    scale: Scale | None,
) -> Answer:
    """Find who wins a round between two teams, and the head start that makes it even.

    All games of all matches are added up. The files have the columns player and rating.
    """
    from evenbreak.answers.kit.wording import count_of
    from evenbreak.answers.league.prior import starters_words
    from evenbreak.answers.team.lineup import race_words
    from evenbreak.answers.team.round import team_round_answer

    lists = files.read_team(ours), files.read_team(theirs)
    points, warnings = scale_of_teams(lists, scale)
    rosters = [with_starters(each.file.roster, points, starter, starter_sd) for each in lists]
    if sure:
        rosters = [ratings.Roster(each.players, each.rating) for each in rosters]
    if games is not None and (race or race_to or chart):
        refuse("--games is for single games; leave it out, or the race")
    played = None if games is not None else race_of(race, race_to, chart, or_else="--games K, ")
    if not everybody and len(rosters[0]) != len(rosters[1]):
        refuse(
            f"{ours} has {len(rosters[0])} players and {theirs} {len(rosters[1])}; leave out those "
            "who do not play, or give --everybody"
        )
    if (pairs := len(rosters[0]) * len(rosters[1])) > 400:
        refuse(f"the files have {pairs:,} pairs of players; name the players of one round only")
    law = teams.round_law(
        rosters[0], rosters[1], games=games, race=played, everybody=everybody, scale=points
    )
    for each, roster in zip(lists, rosters, strict=True):
        warnings += filter(None, [starters_words(each.file.roster, roster)])
    names = PurePath(ours).stem, PurePath(theirs).stem
    return team_round_answer(
        (rosters[0], rosters[1]),
        law,
        played=f"{count_of(games or 1, 'game')} a match" if played is None else race_words(played),
        scale=points,
        games=games,
        everybody=everybody,
        names=names if names[0] != names[1] else ("the first team", "the second team"),
        warnings=warnings,
    )
