"""Questions about a league's table and its fixtures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal, TypeAlias

from evenbreak.fields.kinds import Choice, File, Flag
from evenbreak.fields.question import Field, Says
from evenbreak.files.league.values import TABLE_POINTS, TIES
from evenbreak.league.tables.rules import USUAL_RULES, TableRules
from evenbreak.questions.results import Day, Results

TablePoints: TypeAlias = Annotated[
    TableRules,
    Field(
        TABLE_POINTS,
        "The points of a win, a draw and a loss; or sets: a point for each set or game won; or "
        "the APA's.",
        old=("points",),
        more="A fourth number gives points for each set or game won (`1,0,0,1`: one a game and one "
        "for the match), a fifth for a win to nil. `apa_8ball` splits 3 points a set (3-0 to nil, "
        "2-1 if the loser was on the hill, else 2-0), `apa_9ball` 20.",
    ),
]
Ties: TypeAlias = Annotated[
    tuple[str, ...],
    Field(
        TIES,
        "What separates those with equal points, in this order: difference and scored (sets or "
        "games), wins, head-to-head, win-share, forfeits.",
        more="`head-to-head` counts the points of the meetings of all who are level, and again of "
        "those who still are; it waits until they have met equally often. `win-share` is the share "
        "of matches won, `forfeits` puts those with fewer ahead. With `points` in the list, points "
        "count in that turn: `win-share,points`.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class LeagueTable(Results):
    """Make the table of a league, of its players or of its teams.

    RESULTS.csv has the matches of the players, with team_a and team_b in a league of teams, or the
    matches of the teams themselves (home, away, home_score, away_score). Rows without a score are
    left out as not played; a forfeit counts as a win for its winner. {ties} says what separates
    those with equal points; who is still level shares a place.
    """

    examples = """\
  evenbreak league table results.csv
  evenbreak league table results.csv --table-points 3,1,0 --ties head-to-head,difference
  evenbreak league table sets.csv --table-points apa_8ball --until 2026-10-06
  evenbreak league table results.csv --table-points 1,0,0,1 --side home
"""
    table_points: TablePoints = USUAL_RULES
    ties: Ties = USUAL_RULES.ties
    of: Annotated[
        Literal["players", "teams"] | None,
        Field(
            Choice(("players", "teams")),
            "Whose table; teams also where the two of each row are teams.",
            usual="teams where the results have the columns team_a and team_b",
        ),
    ] = None
    until: Annotated[Day, Says("The table after this day.")] = None
    side: Annotated[
        Literal["both", "home", "away"],
        Field(
            Choice(("both", "home", "away")),
            "Count matches at home, away, or both; the first named is at home.",
        ),
    ] = "both"
    count_games: Annotated[
        bool,
        Field(Flag(), "A team's score is the games its players won.", usual="the sets they won"),
    ] = False
    teams: Annotated[
        str | None,
        Field(
            File("TEAMS.csv"),
            "All teams or players, with points they have besides.",
            more="The columns are `team` (or `name`) and, for deductions, bonuses and byes, "
            "`points`.",
        ),
    ] = None
