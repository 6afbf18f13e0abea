"""Questions of a league's office: its table, its fixtures, one clean list of its matches."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, timedelta
from datetime import time as daytime
from typing import Annotated, ClassVar, Literal, TypeAlias

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, File, Named, Text, Whole
from evenbreak.fields.question import Field, Says
from evenbreak.files.league.values import COUNT, TABLE_POINTS, TIES
from evenbreak.league.tables.fixtures import MOST_MEETINGS
from evenbreak.league.tables.rules import USUAL_RULES, TableRules
from evenbreak.questions.results import Day, Reading, Results

_WHEN, _WHERE = "When", "Where"
_WEEKDAYS = ("mon", "tue", "wed", "thu", "fri", "sat", "sun")
_LONGEST_BREAK = 366


def weekdays_in(text: str) -> tuple[int, ...]:
    """Return days of the week, Monday being 0.

    >>> weekdays_in("Tuesday, thu")
    (1, 3)
    """
    words = [word.strip().lower() for word in text.split(",")]
    found = {k for word in words for k, day in enumerate(_WEEKDAYS) if word[:3] == day}
    if not found or len(found) < len(words):
        raise InputError("{value!r} isn't a day. Name days such as tue or tue,thu.", value=text)
    return tuple(sorted(found))


def weekdays_spelled(days: tuple[int, ...]) -> str:
    """Return days of the week as they are typed."""
    return ",".join(_WEEKDAYS[day] for day in days)


def days_in(text: str) -> tuple[date, ...]:
    """Return the days of a list of days and ranges.

    >>> [day.day for day in days_in("2026-12-24..2026-12-26, 2027-01-01")]
    [24, 25, 26, 1]
    """
    found: list[date] = []
    for part in text.split(","):
        first, sign, last = (piece.strip() for piece in part.partition(".."))
        try:
            begins = date.fromisoformat(first)
            ends = date.fromisoformat(last) if sign else begins
        except ValueError:
            raise InputError(
                "{value!r} isn't a day. Give days such as 2026-12-24, or 2026-12-24..2027-01-02.",
                value=part.strip(),
            ) from None
        many = (ends - begins).days + 1
        if not 1 <= many <= _LONGEST_BREAK:
            raise InputError("{value!r} isn't a date range of a year or less", value=part.strip())
        found += [begins + timedelta(days=k) for k in range(many)]
    return tuple(found)


def days_spelled(days: tuple[date, ...]) -> str:
    """Return days as they are typed."""
    return ",".join(map(str, days))


def time_in(text: str) -> daytime:
    """Return a time of day."""
    try:
        return daytime.fromisoformat(text.strip())
    except ValueError:
        raise InputError("{value!r} isn't a time. Give one such as 19:00.", value=text) from None


Whose: TypeAlias = Annotated[
    Literal["players", "teams"] | None, Field(Choice(("players", "teams")), "Whose table.")
]

TablePoints: TypeAlias = Annotated[
    TableRules,
    Field(
        TABLE_POINTS,
        "Points for a win, a draw and a loss; or sets, for a point per set or game won; or the "
        "APA's points.",
        old=("points",),
        more="A fourth number gives points for each set or game won (`1,0,0,1`: one per game "
        "and one for the match), and a fifth gives points for a shutout. `apa_8ball` "
        "splits 3 points per set (3-0 for a shutout, 2-1 if the loser was on the hill, "
        "otherwise 2-0); `apa_9ball` splits 20.",
    ),
]
Ties: TypeAlias = Annotated[
    tuple[str, ...],
    Field(
        TIES,
        "Tiebreakers, in this order: difference and scored (sets or "
        "games), wins, head-to-head, win-share, forfeits.",
        more="`head-to-head` counts points from the matches between everyone who is tied, then "
        "again for those who still are; it isn't used until they have all met equally "
        "often. `win-share` is the share of matches won, and `forfeits` puts whoever has "
        "fewer ahead. With `points` in the list, points count in that position: "
        "`win-share,points`.",
    ),
]

TeamScore: TypeAlias = Annotated[
    str,
    Field(
        COUNT,
        "A team's score: the sets its players won, or all their games. Match points come from "
        "{table_points}.",
    ),
]
TeamsFile: TypeAlias = Annotated[
    str | None,
    Field(
        File("TEAMS.csv"),
        "All teams or players, with any extra points they have.",
        more="The columns are `team` (or `name`) and, for deductions, bonuses and byes, `points`.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class LeagueTable(Results):
    """Make a league's standings for players or teams.

    RESULTS.csv has the players' matches, with team_a and team_b in a team league, or the teams' own
    matches (home, away, home_score, away_score). Rows without a score are left out, since those
    matches weren't played; a forfeit counts as a win. {ties} says how ties on points are broken;
    anyone still tied shares a place.
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
        Whose,
        Says(
            "Whose standings to show; teams is also for results in which each row is a match "
            "between two teams.",
            usual="teams if the results have the columns team_a and team_b",
        ),
    ] = None
    until: Annotated[Day, Says("Show the table as of this day.")] = None
    side: Annotated[
        Literal["both", "home", "away"],
        Field(
            Choice(("both", "home", "away")),
            "Count home matches, away matches, or both; the side named first is at home.",
        ),
    ] = "both"
    count: TeamScore = "sets"
    teams: TeamsFile = None


@dataclass(frozen=True, kw_only=True)
class Fixtures(Reading):
    """Make a league's fixtures: who plays who, at home or away, on which night and table.

    LIST.csv names the players or teams, with one name per line or the columns of a roster. With the
    columns venue and tables, teams that share a venue with too few tables take turns playing at
    home. Everyone meets everyone once, or as often as {meetings} says; home and away alternate, and
    a second half mirrors the first. {left} lists the matches still to be played.
    """

    examples = """\
  evenbreak league fixtures teams.csv --meetings 2 --begins 2026-09-01 --skip 2026-12-22 --csv
  evenbreak league fixtures players.csv --begins 2026-09-01 --rounds-a-night 2 --tables 4
  evenbreak league fixtures teams.csv --begins 2026-09-01 --time 19:00 --ics fixtures.ics
  evenbreak league fixtures --schedule fixtures.csv --left results.csv
"""
    names: Annotated[str | None, Field(File("LIST.csv"), metavar="[LIST.csv]", argument=True)] = (
        None
    )
    schedule: Annotated[
        str | None, Field(File("FIXTURES.csv"), "Existing fixtures, to use instead of LIST.")
    ] = None
    meetings: Annotated[
        int, Field(Whole(1, MOST_MEETINGS), "How often each pair meets.", metavar="K")
    ] = 1
    left: Annotated[
        tuple[str, ...],
        Field(
            File("RESULTS.csv"),
            "List the matches still to be played after these results.",
            many=True,
        ),
    ] = ()
    begins: Annotated[Day, Says("The first night.", section=_WHEN)] = None
    ends: Annotated[Day, Says("The last possible night.", section=_WHEN)] = None
    weekdays: Annotated[
        tuple[int, ...],
        Field(
            Named(weekdays_in, "DAY,...", spelled=weekdays_spelled),
            "The days of the week, such as tue or tue,thu.",
            usual="the first night's day of the week",
            section=_WHEN,
        ),
    ] = ()
    skip: Annotated[
        tuple[date, ...],
        Field(
            Named(days_in, "DATES", spelled=days_spelled),
            "Days without matches, such as 2026-12-22..2027-01-02,2027-02-14.",
            section=_WHEN,
        ),
    ] = ()
    rounds_a_night: Annotated[int, Field(Whole(1, 20), "Rounds per night.", section=_WHEN)] = 1
    time: Annotated[
        daytime | None,
        Field(Named(time_in, "HH:MM"), "Start time of a night, for the calendar.", section=_WHEN),
    ] = None
    minutes: Annotated[
        int, Field(Whole(1, 1440), "Minutes per match, for the calendar.", section=_WHEN)
    ] = 180
    venue: Annotated[
        str | None, Field(Text("PLACE"), "Venue, if the list doesn't give one.", section=_WHERE)
    ] = None
    tables: Annotated[
        int | None,
        Field(Whole(1, 1000), "Number of tables; each match gets one.", section=_WHERE),
    ] = None
    tables_a_match: Annotated[int, Field(Whole(1, 100), "Tables per match.", section=_WHERE)] = 1
    of: Annotated[Whose, Says("Who plays.", usual="teams if LIST has the column team")] = None
    only: Annotated[
        str | None, Field(Text("NAME"), "List only this team's or player's matches.")
    ] = None
    draw: Annotated[
        int | None,
        Field(
            Whole(0, 2**32 - 1),
            "Seed for the random draw.",
            usual="the order of the list",
            metavar="SEED",
        ),
    ] = None
    title: Annotated[
        str, Field(Text("NAME"), "The name of the league, for the calendar.", section=_WHEN)
    ] = "League matches"
    ics: Annotated[
        str | None, Field(File("FILE.ics"), "Write a calendar that phones can open.")
    ] = None

    def check(self) -> None:
        """Refuse two lists of fixtures or none, and dates without a first one."""
        if (self.names is None) == (self.schedule is None):
            self.refuse("give {names}, or use {schedule} to name existing fixtures")
        for name in ("ends", "weekdays", "skip"):
            if self.begins is None and name in self.given:
                self.refuse(f"{{{name}}} needs the first night. Add {{begins}} 2026-09-01.")
        if self.ics is not None and self.schedule is None and self.begins is None:
            self.refuse("{ics} needs dates. Add {begins} 2026-09-01.")


@dataclass(frozen=True, kw_only=True)
class LeagueTidy(Results):
    """Make one clean list of matches from all results, and list what was changed.

    RESULTS.csv can be any number of files that evenbreak reads: CSV, workbooks, or JSON from other
    programs. Leave them out to use the files in league.toml. A match in two files counts once; byes
    and unreadable rows are left out and listed with file, line and reason. Names that may belong to
    the same player are never merged silently: on a terminal, you are asked; otherwise, they are
    listed with lines that you can add to [aliases] in league.toml.
    """

    of_form: ClassVar[bool] = True
    """It describes how the league's files are written, which other commands don't repeat."""
    examples = """\
  evenbreak league tidy
  evenbreak league tidy autumn.csv spring.xlsx cuescore.json --out season.csv
  evenbreak league tidy --csv > changes.csv
"""
    out: Annotated[str, Field(File("FILE"), "Where to write the matches, as CSV.")] = "tidy.csv"
