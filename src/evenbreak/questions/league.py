"""Questions about a list of rated players: tonight's races, and a season of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from evenbreak.fields.kinds import File, Flag, Named, Number, Whole
from evenbreak.fields.question import Field, Says
from evenbreak.questions.common import (
    RACE_TO,
    ChartName,
    Dask,
    EntrantsFile,
    FormOfDay,
    Jobs,
    Lengths,
    LevelResults,
    OutFolder,
    ScaleOf,
    Seed,
    Starters,
    has_levels,
    refuse_workers,
)
from evenbreak.questions.pace import MINUTES, Pace, Turnover
from evenbreak.questions.results import ON_STDIN, ROSTER
from evenbreak.questions.systems import ANY_SYSTEM, DAY_SD, BySystem
from evenbreak.tournaments.evening.format import Discipline, Tables

if TYPE_CHECKING:
    from evenbreak.handicaps.systems.system import System
else:
    System = Any

MOST_WEEKS, MOST_REPLICAS, MOST_MATCHES = 10_000, 10_000_000, 100

WEEKS = 30
"""The length of a season where neither an option nor a schedule says it."""

_WHO, _LEAGUE, _WORK = "Who plays who", "The league", "The work"

SHARE_OF = Number(
    0.0, 1.0, " isn't a share. Give a number from 0 to 1, such as 0.2", metavar="SHARE"
)


def _systems(text: str) -> tuple[System, ...]:
    return tuple(ANY_SYSTEM.read(name.strip()) for name in text.split(",") if name.strip())


def _spelled(systems: tuple[System, ...]) -> str:
    return ", ".join(ANY_SYSTEM.words(system) for system in systems)


@dataclass(frozen=True, kw_only=True)
class Matchups(Lengths, Starters, Pace):
    """Find the race for each pair of players tonight, and how often each player wins it.

    ROSTER.csv has a row for each player, with the columns player and rating and, if you have them,
    standard_error and games; - reads standard input. {chart} looks up the races, and {games} or
    {race_to} finds the fairest ones; if you give both, you see them side by side. If not everyone
    has entered, {players_file} says who has; players missing from ROSTER.csv are new. If there are
    standard errors, the chances are averaged over the rating errors.
    """

    examples = """\
  evenbreak matchups roster.csv --chart npl_10
  evenbreak matchups roster.csv --games 7..13 --pairs tonight.csv --html tonight.html
  evenbreak matchups roster.csv --race-to 7 --players-file entrants.txt
  evenbreak matchups roster.csv --race-to 7 --discipline 9-ball --tables 4
"""
    roster: Annotated[str, ROSTER, Says(argument=True)]
    chart: Annotated[
        ChartName,
        Says(
            "The league's chart, by name or in a file.",
            more="To look up a race, ratings are rounded to whole points. In a chart by skill "
            "level, such as apa_8ball, races are looked up by the `level` column; the "
            "chances come from the ratings if there are any, otherwise from the levels.",
        ),
    ] = None
    race_to: Annotated[int | None, RACE_TO] = None
    players_file: EntrantsFile = None
    pairs: Annotated[str | None, Field(File("PAIRS.csv"), "Who plays who.", usual="all pairs")] = (
        None
    )
    results: LevelResults = None
    scale: Annotated[
        ScaleOf,
        Says(
            usual="the file's own, otherwise the chart's, otherwise inferred from the ratings",
            more="See [the scale of a list](../files.md#the-scale-of-a-list).",
        ),
    ] = None
    discipline: Annotated[
        Discipline | None, Says("Show lengths in minutes, at the usual pace of this game.")
    ] = None
    minutes_per_game: Annotated[
        float | None, MINUTES, Says("Show lengths in minutes, at this average pace.")
    ] = None
    tables: Annotated[Tables | None, Says("Show when the round ends if there are T tables.")] = None
    turnover: Annotated[Turnover, Says(usual="10.8", section="Details")] = None
    form: FormOfDay = None
    seed: Annotated[Seed, Says("The seed of the simulated evenings.")] = 0

    def check(self) -> None:
        """Refuse what lacks something else."""
        if self.chart is None and self.games is None and self.race_to is None:
            self.refuse("Add a race: {chart} NAME, {games} LO..HI or {race_to} N.")
        if self.results is not None and not has_levels(self.chart):
            self.refuse(
                "{results} is for chances based on skill levels. Add a chart of levels, such as "
                "{chart} apa_8ball."
            )
        paced = self.discipline is not None or self.minutes_per_game is not None
        if self.tables is not None and not paced:
            self.refuse(
                "{tables} needs to know how long games take. Add {discipline}, such as "
                "9-ball, or {minutes_per_game}, such as 8."
            )
        if self.turnover is not None and self.tables is None:
            self.refuse(
                "{turnover} is the time between two matches on a table. Add {tables} N too."
            )
        if [self.roster, self.pairs, self.chart].count("-") > 1:
            self.refuse("only one list can come from standard input. Name a file for the other.")


@dataclass(frozen=True, kw_only=True)
class Simulate(BySystem):
    """Simulate a season many times: how accurate ratings are, how fair matches are, and who gains.

    ROSTER.csv has one player per row, with the columns player and rating (or level) and,
    optionally, standard_error, matches, skill, day_sd, drift, joins, leaves, absence and team; -
    reads standard input. For a player without a skill, one is drawn for each season from the rating
    and standard error. If not everyone plays, {players_file} says who does; players missing from
    ROSTER.csv are new. {compare} puts handicap systems side by side, with the same players, nights
    and luck under each system. matches.csv is one full season, which `rate` and `validate` can
    read.
    """

    examples = """\
  evenbreak simulate roster.csv --compare npl --compare fargo-like
  evenbreak simulate levels.csv --chart apa_8ball --compare "level review, none"
  evenbreak simulate roster.csv --chart npl_10 --weeks 30 --out season
  evenbreak simulate roster.csv --random --day-sd 5 --system "step 2" --out step2
"""
    roster: Annotated[str, ROSTER, Says(argument=True)]
    out: Annotated[
        OutFolder | None,
        Says("The folder for the tables and pictures; created if needed.", usual="no files"),
    ] = None
    compare: Annotated[
        tuple[tuple[System, ...], ...],
        Field(
            Named(_systems, "SYSTEM", offers="systems", spelled=_spelled),
            "Compare handicap systems, named as for {system}; the first one is the league's own.",
            many=True,
            more='Or give several at once, separated by commas: `--compare "npl, step 2"`. If '
            "`--system` is given, that system comes first. See [compare two "
            "systems](../../how-to/compare-handicap-systems.md).",
        ),
    ] = ()
    players_file: Annotated[
        EntrantsFile,
        Says(
            more="[Players missing from the list](../files.md#entrants) are new, in the "
            "middle of the scale."
        ),
    ] = None
    scale: Annotated[
        ScaleOf,
        Says(
            usual="the system's", more="The ratings [must fit it](../files.md#the-scale-of-a-list)."
        ),
    ] = None
    weeks: Annotated[
        int | None,
        Field(
            Whole(1, MOST_WEEKS),
            "Number of weeks.",
            usual=f"the number in the schedule, or {WEEKS}",
            metavar="W",
        ),
    ] = None
    replicas: Annotated[
        int, Field(Whole(1, MOST_REPLICAS), "Number of simulated seasons.", metavar="R")
    ] = 1000
    schedule: Annotated[
        str | None,
        Field(
            File("FILE"),
            "A file with the columns week, player_a and player_b.",
            section=_WHO,
            more="See [schedule](../files.md#schedule).",
        ),
    ] = None
    round_robin: Annotated[
        bool,
        Field(Flag(), "Round robins, one after another (the default).", section=_WHO),
    ] = False
    random: Annotated[bool, Field(Flag(), "Draw opponents at random each week.", section=_WHO)] = (
        False
    )
    matches: Annotated[
        int | None,
        Field(
            Whole(1, MOST_MATCHES),
            "Matches per player per week, if there is no schedule.",
            usual="1",
            section=_WHO,
        ),
    ] = None
    day_sd: Annotated[
        float,
        DAY_SD,
        Says(
            "Variation of a player's form from day to day (standard deviation) if the "
            "roster doesn't give it.",
            section=_LEAGUE,
            kind=Number(0.0, 1000.0, " isn't 0 to 1,000 points", metavar="POINTS"),
        ),
    ] = 0.0
    seasons: Annotated[
        int,
        Field(Whole(1, 50), "Seasons played in a row, with ratings carried over.", section=_LEAGUE),
    ] = 1
    newcomers: Annotated[
        float, Field(SHARE_OF, "The share of players who are new each season.", section=_LEAGUE)
    ] = 0.2
    sandbaggers: Annotated[
        float,
        Field(
            SHARE_OF,
            "The share of players who hold back in the third quarter of a season, to do better in "
            "the last.",
            section=_LEAGUE,
        ),
    ] = 0.05
    sets: Annotated[
        int, Field(Whole(1, 15), "Matches between two teams in one night.", section=_LEAGUE)
    ] = 5
    cap: Annotated[
        float | None,
        Field(
            Number(0.0, 1000.0, " isn't a sum of levels, such as 23"),
            "The most that the levels of a team's lineup may add up to.",
            section=_LEAGUE,
            metavar="LEVELS",
        ),
    ] = None
    best_line_ups: Annotated[
        bool,
        Field(
            Flag(),
            "Captains field their best lineup by the published numbers, not just anyone present.",
            section=_LEAGUE,
            more="Much slower: a few tenths of a second per season.",
        ),
    ] = False
    discipline: Annotated[
        Discipline | None,
        Says("Show lengths in minutes too, at the usual pace of this game.", section=_LEAGUE),
    ] = None
    minutes_per_game: Annotated[
        float | None,
        MINUTES,
        Says("Show lengths in minutes too, at this average pace.", section=_LEAGUE),
    ] = None
    rack_by_rack: Annotated[
        bool,
        Field(
            Flag(),
            "Play rack by rack instead of drawing the winner of each match.",
            section=_WORK,
            old=("racks",),
            more="The distribution is the same, but this is slower.",
        ),
    ] = False
    no_matches: Annotated[
        bool,
        Field(
            Flag(),
            "Don't write matches.csv and truth.csv.",
            section=_WORK,
            more="For a large league, writing them takes a long time.",
        ),
    ] = False
    seed: Annotated[Seed, Says("The same seed gives the same files.", section=_WORK)] = 1
    jobs: Annotated[Jobs, Says(section=_WORK)] = 1
    dask: Annotated[Dask, Says(section=_WORK)] = None

    @property
    def compared(self) -> tuple[System, ...]:
        """The systems that are compared, each once; the league's own first if it is stated."""
        every = [*([] if self.system is None else [self.system])]
        every += [system for systems in self.compare for system in systems]
        return tuple({system.name: system for system in every}.values())

    def check(self) -> None:
        """Refuse options that exclude each other or are empty."""
        ways = [
            f"{{{name}}}" for name in ("schedule", "round_robin", "random") if name in self.given
        ]
        if len(ways) > 1:
            self.refuse(" and ".join(ways) + " can't be used together. Leave all but one out.")
        if self.schedule is not None and self.matches is not None:
            self.refuse(
                "{schedule} and {matches} can't be used together; the schedule sets the matches"
            )
        if self.compare and self.rack_by_rack:
            self.refuse("{compare} and {rack_by_rack} can't be used together. Leave one out.")
        refuse_workers(self)
        if [self.roster, self.schedule, self.chart].count("-") > 1:
            self.refuse(ON_STDIN)
