"""Questions about teams: who to put up, who wins a round, what a cap does, how a season ends."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, File, Flag, Named, Text, Whole
from evenbreak.fields.question import Field, Question, Says
from evenbreak.files.league.values import CAP, MOST_SETS, SETS, STRONG, names_in
from evenbreak.league.tables.rules import USUAL_RULES
from evenbreak.questions.common import (
    SCORE,
    ChartOfRaces,
    EvenRace,
    HandicappedRace,
    Jobs,
    LevelResults,
    ScaleOf,
    Seed,
    Starters,
    Sure,
)
from evenbreak.questions.results import Columns
from evenbreak.questions.tables import TablePoints, TeamsFile, Ties
from evenbreak.teams.set_laws import COUNTS
from evenbreak.tournaments.evening.format import Discipline, Tables
from evenbreak.words import say

_RULES, _SO_FAR = "Rules", "The match so far"

ORDERS = {
    "alternate": say("Taking turns"),
    "home": say("Always the first team"),
    "loser": say("The loser of the last set"),
    "winner": say("The winner of the last set"),
    "blind": say("Both at once, blind"),
    "sealed": say("Sealed: both lineups before the match starts"),
}
"""Who names first, by a name of the order, with its words."""


USUAL_SETS = 5
"""The number of sets in a night under a cap, as in APA leagues."""


def usual_sets(most: int, cap: float | None) -> int:
    """Return how many sets a night has if nobody says it, where both teams can fill so many."""
    return min(most, MOST_SETS if cap is None else USUAL_SETS)


def sets_in(text: str) -> tuple[int, ...]:
    """Return the numbers of sets in a text, each once.

    >>> sets_in("5, 1")
    (1, 5)
    """
    if not re.fullmatch(r"\s*\d{1,3}\s*(,\s*\d{1,3}\s*)*", text, re.ASCII):
        raise InputError(
            "{value!r} doesn't name any sets. List their numbers, such as 1,5.", value=text
        )
    return tuple(sorted({int(part) for part in text.split(",")}))


def _pair_in(text: str) -> tuple[str, ...]:
    """Return the player in a text, or the two of a pair."""
    return tuple(part.strip() for part in re.split(r",|&|\band\b", text) if part.strip())


def set_in_play(text: str) -> InPlay:
    """Return who plays who at what score.

    >>> set_in_play("Ann and Bo v Xi and Yu 3:2")
    (('Ann', 'Bo'), ('Xi', 'Yu'), (3, 2))
    """
    match = re.fullmatch(
        r"\s*(.+?)\s+(?:v|vs|-)\.?\s+(.+?)\s+(\d+)\s*[:/-]\s*(\d+)\s*", text, re.ASCII
    )
    if match is None:
        message = f'{text!r}; write your player, theirs and the score, such as "Ann v Xi 3-2"'
        raise InputError(message)
    return _pair_in(match[1]), _pair_in(match[2]), (int(match[3]), int(match[4]))


InPlay: TypeAlias = tuple[tuple[str, ...], tuple[str, ...], tuple[int, int]]
Sets: TypeAlias = Annotated[int | None, Field(SETS, "Number of sets.")]
Order: TypeAlias = Annotated[
    str,
    Field(
        Text("PATTERN"),
        "Who names first in each set: A (you), B (them), = (both, blind), W or L (whoever won "
        "or lost the last set), such as ABABA; or alternate, home, blind, winner, loser or sealed.",
        titles=ORDERS,
        more="A shorter pattern is repeated. `sealed`: both lineups are handed in before the "
        "match.",
    ),
]


Count: TypeAlias = Annotated[
    str,
    Field(
        Choice(COUNTS),
        "What decides the match: sets won, all games won, or match points as in APA 8-ball (3-0 "
        "for a shutout, 2-1 if hill-hill, otherwise 2-0) and 9-ball (20 shared by points made).",
        label=say("What decides the match"),
        titles={
            "sets": say("Sets won"),
            "games": say("All games won"),
            "points": say(
                "Match points: 3-0 for a shutout, 2-1 if hill-hill, otherwise 2-0; in APA "
                "9-ball, 20 shared"
            ),
        },
        section=_RULES,
    ),
]


Squads: TypeAlias = Annotated[
    str | None,
    Field(
        File("TEAMS.csv"),
        "A list of all teams: OURS and THEIRS can then be team names from the list.",
        section=_RULES,
        more="The list has the columns team, player, and rating or level.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class OfTeams(Starters):
    """A question about the matches between teams: their ratings, and what is raced to."""

    lengths: ClassVar[tuple[str, ...]] = ("race", "race_to", "chart")
    """The fields of which one says how long a match is."""

    race: EvenRace = None
    race_to: HandicappedRace = None
    chart: Annotated[
        ChartOfRaces,
        Says(
            "Use the races in this chart instead: a chart of rating differences, or of skill "
            "levels.",
            more="With a chart of skill levels, such as apa_8ball or apa_9ball, the lists need "
            "a `level` column; the chances come from the ratings if all players have "
            "them, otherwise from the levels.",
        ),
    ] = None
    scale: ScaleOf = None
    results: Annotated[LevelResults, Says(section="Ratings")] = None

    def check(self) -> None:
        """Refuse races that are missing, or given twice."""
        stated = [name for name in self.lengths if getattr(self, name) is not None]
        if len(stated) != 1:
            template = (
                "the races are given twice. Use only one of {every}."
                if stated
                else "Add a race: one of {every}."
            )
            *first, last = (f"{{{name}}}" for name in self.lengths)
            self.refuse(template.replace("{every}", f"{', '.join(first)} and {last}"))


@dataclass(frozen=True, kw_only=True)
class Capped(Question):
    """Who names first, and what limits a lineup."""

    order: Order = "alternate"
    cap: Annotated[
        float | None,
        Field(
            CAP,
            "The largest sum of skill levels in a lineup, such as 23.",
            label=say("Cap: the largest sum of skill levels, such as 23 (blank: none)"),
            more="Without a `level` column, it is the largest sum of ratings.",
        ),
    ] = None
    at_most: Annotated[
        tuple[int, float] | None,
        Field(
            STRONG,
            "At most K players of this level or above, such as 2:6.",
            label=say(
                "Limit on strong players: how many at which level or above, such as 2:6 (blank: "
                "none)"
            ),
            section=_RULES,
        ),
    ] = None
    count: Count = "sets"


@dataclass(frozen=True, kw_only=True)
class Lineup(OfTeams, Capped):
    """Find who to put up in a team match, and what each choice is worth.

    Each file has the columns player and rating, or level; caps use the levels. Both captains are
    assumed to choose optimally. Each time a player is put up, ask again with {used}, {score} and
    {named}.
    """

    examples = """\
  evenbreak lineup ours.csv theirs.csv --scale fargo --race 5 --sets 5 --order ABABA
  evenbreak lineup ours.csv theirs.csv --chart apa_8ball --cap 23 --at-most 2:6 --count points
  evenbreak lineup ours.csv theirs.csv --race 5 --used "Ann,Xi" --score 1:0 --named Yu
  evenbreak lineup ours.csv theirs.csv --race 5 --playing "Ann v Xi 3:2" --named Bo
"""
    ours: Annotated[str, Field(File("OURS.csv"), argument=True)]
    theirs: Annotated[str, Field(File("THEIRS.csv"), argument=True)]
    roster: Squads = None
    sets: Annotated[
        Sets,
        Says(
            usual="as many as the smaller team can fill, but at most 5 under a cap",
            label=say("Sets (blank: one per player of the smaller team; under a cap at most 5)"),
        ),
    ] = None
    absent: Annotated[
        tuple[str, ...],
        Field(
            Named(names_in, "NAME,..."),
            "Players on either team who are absent tonight.",
            section=_RULES,
        ),
    ] = ()
    used: Annotated[
        tuple[str, ...],
        Field(
            Named(names_in, "NAME,..."),
            "Players on either team who have already played.",
            more="If both teams have a player with that name, write `ours:Ann` or `theirs:Ann`.",
        ),
    ] = ()
    score: Annotated[
        tuple[int, int] | None,
        Field(
            SCORE,
            "The match score so far, yours first: sets, games or points, whichever count.",
            metavar="A:B",
        ),
    ] = None
    named: Annotated[
        tuple[str, ...],
        Field(Named(_pair_in, "NAME"), "The player just named by the team naming first."),
    ] = ()
    playing: Annotated[
        tuple[InPlay, ...],
        Field(
            Named(set_in_play, '"A v B 3-2"'),
            "A set that is being played: your player, theirs, and the score so far.",
            many=True,
            section=_SO_FAR,
        ),
    ] = ()
    last: Annotated[
        str | None,
        Field(
            Choice(("won", "lost")),
            "Whether you won the last set, if its winner or loser names first.",
            section=_SO_FAR,
        ),
    ] = None
    doubles: Annotated[
        tuple[int, ...],
        Field(
            Named(sets_in, "K,...", spelled=lambda sets: ",".join(map(str, sets))),
            "The sets that are doubles, by number, such as 5 or 1,5.",
            label=say("Sets that are doubles, such as 5 or 1,5"),
            section=_RULES,
        ),
    ] = ()
    times: Annotated[
        int,
        Field(
            Whole(1, MOST_SETS),
            "How many sets a player may play.",
            label=say("How often a player may be put up"),
            metavar="K",
            section=_RULES,
        ),
    ] = 1
    sure: Annotated[
        Sure,
        Says(
            section="Ratings",
            label=say("Treat the ratings as exact, even if the lists give their errors"),
        ),
    ] = False
    seed: Annotated[
        Seed,
        Says(
            "The seed for drawing ratings that have standard errors.",
            section="Ratings",
        ),
    ] = 1


@dataclass(frozen=True, kw_only=True)
class OnTables:
    """What a team night asks for, to say when it ends."""

    discipline: Discipline = "8-ball"
    tables: Annotated[Tables, Says(label=say("Tables for this match"))] = 1


@dataclass(frozen=True, kw_only=True)
class Round(OfTeams):
    """Find who wins a round between two teams, and the head start that makes it even.

    The games in all matches are added up; with {count}, match points or sets are added up instead.
    The files have the columns player and rating, or level; the first player in one file meets the
    first in the other, and so on.
    """

    examples = """\
  evenbreak round ours.csv theirs.csv --single-games 2
  evenbreak round ours.csv theirs.csv --single-games 1 --everybody --scale fargo
  evenbreak round ours.csv theirs.csv --chart apa_8ball --count points
"""
    lengths = ("single_games", *OfTeams.lengths)
    ours: Annotated[str, Field(File("OURS.csv"), argument=True)]
    theirs: Annotated[str, Field(File("THEIRS.csv"), argument=True)]
    roster: Squads = None
    single_games: Annotated[
        int | None,
        Field(Whole(1, 100), "Each match is K single games.", metavar="K", old=("games",)),
    ] = None
    everybody: Annotated[
        bool, Field(Flag(), "Every player meets every player on the other team.")
    ] = False
    count: Annotated[Count, Says("What is added up: games, match points, or sets.", more="")] = (
        "games"
    )
    sure: Sure = False

    def check(self) -> None:
        """Refuse what `OfTeams` refuses, and another count than that of games where they are."""
        super().check()
        if self.single_games is not None and self.count != "games":
            self.refuse("{count} is for races; with {single_games} the games count. Leave it out.")


@dataclass(frozen=True, kw_only=True)
class Caps(OfTeams, Capped):
    """Find how a cap and the put-up order affect a team league.

    TEAMS.csv has the columns team, player and rating, and a level column for caps. Every team meets
    every other; each match is solved exactly, with both captains choosing optimally.
    """

    examples = """\
  evenbreak caps teams.csv --race 5 --cap 23
  evenbreak caps teams.csv --race 5 --cap 23 --at-most 2:6 --order ABABA
  evenbreak caps teams.csv --race-to 7 --sets 4
"""
    roster: Annotated[str, Field(File("TEAMS.csv"), argument=True)]
    order: Annotated[
        Order, Says("Your league's put-up order, as for evenbreak lineup.", more="")
    ] = "alternate"
    sets: Annotated[
        Sets, Says(kind=Whole(1, 9), usual="5, or as many as the smallest team has players")
    ] = None


_TEAMS, _SETS = Whole(1, 100), Whole(1, 100)
_TABLE, _WORK = "The table", "How it is worked out"


@dataclass(frozen=True, kw_only=True)
class Season(Question):
    """Find each team's chances of the title, promotion and relegation, and what is at stake next.

    RESULTS.csv has the columns home, away, home_score and away_score (sets). SCHEDULE.csv has home
    and away, plus a round column if you like. Without a schedule, matches in RESULTS.csv with no
    score, or with a score of 0-0, are still to be played. Team strengths are estimated from the
    sets they have won.
    """

    examples = """\
  evenbreak season results.csv schedule.csv --up 2 --down 1
  evenbreak season results.csv --meetings 2 --table-points sets
  evenbreak season results.csv schedule.csv --table-points 3,1,0 --ties head-to-head,difference
"""
    results: Annotated[str, Field(File("RESULTS.csv"), argument=True)]
    schedule: Annotated[
        str | None, Field(File("SCHEDULE.csv"), metavar="[SCHEDULE.csv]", argument=True)
    ] = None
    meetings: Annotated[
        int | None,
        Field(
            Whole(1, 10),
            "Instead of a schedule: each pair of teams meets K times, counting the matches "
            "already played.",
            metavar="K",
            old=("round-robin",),
        ),
    ] = None
    up: Annotated[int | None, Field(_TEAMS, "Teams promoted.", metavar="K")] = None
    down: Annotated[int | None, Field(_TEAMS, "Teams relegated.", metavar="K")] = None
    sets: Annotated[
        int | None,
        Field(
            _SETS,
            "A match has N sets, and all of them are played.",
            usual="as in the results",
            rare=True,
        ),
    ] = None
    race: Annotated[
        int | None, Field(_SETS, "A match goes to the first to win N sets.", rare=True)
    ] = None
    columns: Columns = ()
    teams: Annotated[TeamsFile, Says(section=_TABLE)] = None
    table_points: Annotated[TablePoints, Says(section=_TABLE)] = USUAL_RULES
    ties: Annotated[Ties, Says(section=_TABLE)] = USUAL_RULES.ties
    sure: Annotated[
        Sure, Says("Treat the strengths as exact instead of averaging over them.", section=_WORK)
    ] = False
    seasons: Annotated[
        int,
        Field(
            Whole(1000, 10_000_000),
            "Number of seasons to simulate.",
            section=_WORK,
            more="With `--sure` and few possible endings, the chances are exact instead.",
        ),
    ] = 100_000
    jobs: Annotated[Jobs, Says(section=_WORK)] = 1
    seed: Annotated[Seed, Says(section=_WORK)] = 1

    def check(self) -> None:
        """Refuse two lists of matches to come, two lengths of a match, and points by the set."""
        if self.table_points.split:
            self.refuse(
                "{table_points} {split} counts individual players' sets, which team scores "
                "don't show. Leave it out, or give sets.",
                split=self.table_points.split,
            )
        if self.schedule is not None and self.meetings is not None:
            self.refuse("a schedule and {meetings} can't be used together. Leave one out.")
        if self.sets is not None and self.race is not None:
            self.refuse("{sets} and {race} can't be used together. Leave one out.")
