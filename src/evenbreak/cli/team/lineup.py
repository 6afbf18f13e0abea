"""`evenbreak lineup`: whom to put up in a team match."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak import files, ratings, teams
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.scales import chart_doubts
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import OF_LIST, scale_option, seed_option
from evenbreak.cli.kit.starters import starter_options, with_starters
from evenbreak.cli.kit.values import SCORE, Whole, refuse
from evenbreak.cli.team.lists import caps_of, race_of, race_options, scale_of_teams
from evenbreak.cli.team.points import point_of

if TYPE_CHECKING:
    from evenbreak.ratings.scale import Scale

MOST_SETS = 25

EXAMPLES = """\b
Examples:
  evenbreak lineup ours.csv theirs.csv --scale fargo --race 5 --sets 5 --order ABABA
  evenbreak lineup ours.csv theirs.csv --race 5 --cap 23 --at-most 2:6
  evenbreak lineup ours.csv theirs.csv --race 5 --used "Ann,Xi" --score 1:0 --named Yu
  evenbreak lineup ours.csv theirs.csv --race 5 --playing "Ann v Xi 3:2" --named Bo
"""


@click.command("lineup", epilog=EXAMPLES)
@click.argument("ours", metavar="OURS.csv")
@click.argument("theirs", metavar="THEIRS.csv")
@race_options
@click.option(
    "--sets",
    type=Whole(1, MOST_SETS),
    metavar="K",
    help="How many sets are played.  [default: as many as the smaller team has players, times K "
    "with --times K]",
)
@click.option(
    "--order",
    default="alternate",
    metavar="PATTERN",
    help="Who names first in each set: A (you), B (they), = (both, unseen), W or L (who won or "
    "lost the last set), such as ABABA. Or alternate, home, blind, winner, loser, or sealed: both "
    "line-ups are handed in before the night.",
)
@click.option(
    "--count",
    type=click.Choice(["sets", "games", "points"]),
    default="sets",
    help="What decides the night: sets won, all games won, or points as in APA 8-ball (3:0 for a "
    "shutout, 2:1 hill-hill, else 2:0).",
)
@click.option(
    "--doubles", metavar="K,...", help="The sets that are doubles, by number, such as 5 or 1,5."
)
@click.option(
    "--cap",
    type=float,
    metavar="TOTAL",
    help="The largest sum of the skill levels (without a column level: of the ratings) of a "
    "line-up, such as 23.",
)
@click.option(
    "--at-most",
    metavar="K:LEVEL",
    help="At most K players of this level or above, such as 2:6.",
)
@click.option(
    "--times",
    type=Whole(1, MOST_SETS),
    default=1,
    metavar="K",
    help="How often a player may be put up.",
)
@click.option(
    "--used",
    metavar="NAME,...",
    help="Who has played already, of both teams. A name that both have: ours:Ann, theirs:Ann.",
)
@click.option(
    "--score",
    type=SCORE,
    help="The score of the night so far, yours first: sets, games or points as they count.",
)
@click.option(
    "--playing",
    multiple=True,
    metavar='"A v B 3:2"',
    help="A match that is being played, yours first, with its score; may be repeated.",
)
@click.option("--named", metavar="NAME", help="Whom the team that names first has just named.")
@click.option(
    "--last",
    type=click.Choice(["won", "lost"]),
    help="Whether you won the last set, where its winner or loser names first.",
)
@click.option(
    "--sure",
    is_flag=True,
    help="Take the ratings as right, even if the files state their standard errors.",
)
@starter_options
@scale_option(OF_LIST, fixed=False)
@seed_option("The seed of the ratings that are drawn, where they have standard errors.")
@faces()
def command(
    ours: str,
    theirs: str,
    race: int | None,
    race_to: int | None,
    chart: str | None,
    sets: int | None,
    order: str,
    count: str,
    doubles: str | None,
    cap: float | None,
    at_most: str | None,
    times: int,
    used: str | None,
    score: tuple[int, int] | None,
    playing: tuple[str, ...],
    named: str | None,
    last: str | None,
    sure: bool,
    starter: float | None,
    starter_sd: float | None,
    scale: Scale | None,
    seed: int,
) -> Answer:
    """Find whom to put up in a team match, and what each choice is worth.

    Each file has the columns player and rating, and for caps a column level. Both captains are
    taken to choose as well as they can. After each nomination, ask again with --used, --score and
    --named.
    """
    from evenbreak.answers.league.prior import starters_words
    from evenbreak.answers.team.lineup import lineup_answer
    from evenbreak.teams.meeting import SEALED, Meeting

    lists = files.read_team(ours), files.read_team(theirs)
    points, doubts = scale_of_teams(lists, scale)
    rosters = [with_starters(each.file.roster, points, starter, starter_sd) for each in lists]
    if sure:
        rosters = [ratings.Roster(each.players, each.rating) for each in rosters]
    played = sets or min(len(each) for each in rosters) * times
    sizes = _sizes(doubles, played)
    squads = [
        teams.Squad(roster.players, caps_of(each, cap, at_most), times)
        for roster, each in zip(rosters, lists, strict=True)
    ]
    meeting = Meeting(
        rosters[0],
        rosters[1],
        (squads[0], squads[1]),
        race_of(race, race_to, chart),
        points,
        sizes,
        order.strip().lower() if order.strip().lower() == SEALED else order,
        teams.Points() if count == "points" else count,  # type: ignore[arg-type]
    )
    asked = any(value is not None and value != () for value in (used, score, playing, named, last))
    point = point_of(meeting, used, score, playing, named, last) if asked else None
    warnings = doubts
    warnings += chart_doubts(meeting.race, points)
    for each, roster in zip(lists, rosters, strict=True):
        warnings += filter(None, [starters_words(each.file.roster, roster)])
    return lineup_answer(meeting, point, seed=seed, warnings=warnings)


def _sizes(doubles: str | None, sets: int) -> tuple[int, ...]:
    if doubles is None:
        return (1,) * sets
    numbers = [part.strip() for part in doubles.split(",")]
    if not all(part.isdigit() and 1 <= int(part) <= sets for part in numbers):
        refuse(f"--doubles {doubles!r}; give numbers of sets from 1 to {sets}, such as 1,3")
    pairs = {int(part) for part in numbers}
    return tuple(2 if k in pairs else 1 for k in range(1, sets + 1))
