"""`evenbreak caps`: what a cap and the order of nomination do to a team league."""

from __future__ import annotations

import click

from evenbreak import files, ratings, teams
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import OF_LIST, scale_option
from evenbreak.cli.kit.starters import starter_options, with_starters
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.team.lists import caps_of, race_of, race_options, scale_of_teams
from evenbreak.ratings.scale import Scale

MOST_TEAMS = 40

EXAMPLES = """\b
Examples:
  evenbreak caps teams.csv --race 5 --cap 23
  evenbreak caps teams.csv --race 5 --cap 23 --at-most 2:6 --order ABABA
  evenbreak caps teams.csv --race-to 7 --sets 4
"""


@click.command("caps", epilog=EXAMPLES)
@click.argument("roster", metavar="TEAMS.csv")
@race_options
@click.option(
    "--sets",
    type=Whole(1, 9),
    metavar="K",
    help="How many sets are played.  [default: 5, or as many as the smallest team has players]",
)
@click.option(
    "--order",
    default="alternate",
    metavar="PATTERN",
    help="The order of nomination of your league, as for evenbreak lineup.",
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
@starter_options
@scale_option(OF_LIST, fixed=False)
@faces()
def command(
    roster: str,
    race: int | None,
    race_to: int | None,
    chart: str | None,
    sets: int | None,
    order: str,
    cap: float | None,
    at_most: str | None,
    starter: float | None,
    starter_sd: float | None,
    scale: Scale | None,
) -> Answer:
    """Find what a cap and the order of nomination do to a team league.

    TEAMS.csv has the columns team, player and rating, and for caps a column level. Every team meets
    every other; each night is solved exactly, with both captains at their best.
    """
    from evenbreak.answers.league.prior import starters_words
    from evenbreak.answers.team.round import LeagueRules, team_rules_answer

    lists = files.read_squads(roster)
    if len(lists) > MOST_TEAMS:
        refuse(f"{roster} has {len(lists)} teams; ask about at most {MOST_TEAMS}")
    points, warnings = scale_of_teams(list(lists.values()), scale)
    rosters: dict[str, ratings.Roster] = {}
    for team, one in lists.items():
        rosters[team] = with_starters(one.file.roster, points, starter, starter_sd)
        warnings += filter(None, [starters_words(one.file.roster, rosters[team])])
    played = sets or min(5, *(len(one) for one in rosters.values()))
    capped = {
        team: teams.Squad(rosters[team].players, caps_of(one, cap, at_most))
        for team, one in lists.items()
    }
    rules = LeagueRules(
        rosters,
        capped,
        {team: one.levels for team, one in lists.items()},
        race_of(race, race_to, chart),
        points,
        played,
        teams.order_of(order, played),
    )
    return team_rules_answer(rules, source=roster, warnings=warnings)
