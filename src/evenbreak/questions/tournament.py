"""Questions about a tournament: its plan and who enters, before its first match or under way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

from evenbreak.fields.kinds import File, Flag, Text
from evenbreak.fields.question import Field, Says
from evenbreak.questions.common import CHANCE, ScaleOf, Seed, Starters, Sure
from evenbreak.questions.evening import TIME_OF_DAY, At, Prizes, TimedUnderWay
from evenbreak.questions.pace import EarlierNights, Pace, Turnover
from evenbreak.questions.plan import TournamentPlan, refuse_lines
from evenbreak.tournaments.evening.format import Discipline, HouseTables, NamedTables, Tables
from evenbreak.words import Parameter

_FOUR = HouseTables(4)
_DRAW = "The seed for the draw and for simulations."
Draw: TypeAlias = Annotated[Seed, Says(_DRAW, section="Details")]


@dataclass(frozen=True, kw_only=True)
class NewTournament(TournamentPlan, Starters):
    """Start a tournament: write its entrants, format and races to a new file.

    Then make the draw with evenbreak tournament draw. Players can enter until then; after that,
    they can replace a bye or, in a chip tournament, join the end of the line. Without a list,
    everyone enters through evenbreak tournament late or from their phones. The other commands read
    and write tonight.db unless --file or the environment variable EVENBREAK_TOURNAMENT names
    another file.
    """

    examples = """\
  evenbreak tournament new entrants.csv --race 7 --losers-race 5 --tables 1-3,TV
  evenbreak tournament new entrants.csv --format single --race-to 5 --out saturday.db
  evenbreak tournament new --like tonight.db --out next.db
"""
    entrants: Annotated[
        str | None, Field(File("ENTRANTS.csv"), metavar="[ENTRANTS.csv]", argument=True)
    ] = None
    like: Annotated[
        str | None,
        Field(
            File("FILE.db"),
            "Use the same options as the tournament in FILE.db and, without a list, the same "
            "players.",
            rare=True,
        ),
    ] = None
    tables: NamedTables = _FOUR
    name: Annotated[str, Field(Text("NAME"), "Name of the tournament.", rare=True)] = ""
    discipline: Discipline = "9-ball"
    pace: EarlierNights = ()
    scale: ScaleOf = None
    seed: Draw = 0
    out: Annotated[str, Field(File("FILE.db"), "The tournament's file; it must not exist yet.")] = (
        "tonight.db"
    )
    beside: Annotated[
        bool,
        Field(
            Flag(),
            "Run this event alongside the tournament in {out}, on the same tables.",
            rare=True,
        ),
    ] = False
    at: At = None

    def check(self) -> None:
        """Refuse what another tournament says already, and a draw on paper where there is none."""
        if self.like is not None:
            for one in self.given:
                if one not in ("like", "entrants", "name", "out", "at"):
                    self.refuse("{like} already sets that. Leave out {part}.", part=Parameter(one))
            return None
        if self.entrants is None and (self.scale is None or self.seeding == "drawn"):
            self.refuse(
                "missing list of entrants: name the file, or use {like}, or {scale} if "
                "no one has entered yet"
            )
        return refuse_lines(self)

    @property
    def planned(self) -> bool:
        """Whether the plan is asked for, and not another tournament's."""
        return self.like is None


@dataclass(frozen=True, kw_only=True)
class OfEntrants(TournamentPlan, Starters, TimedUnderWay):
    """A question about a list of entrants, or about the tournament under way."""

    entrants: Annotated[
        str | None, Field(File("ENTRANTS.csv"), metavar="[ENTRANTS.csv]", argument=True)
    ] = None
    scale: ScaleOf = None
    seed: Draw = 0
    under_way: ClassVar[tuple[str, ...]] = ()
    """What can be asked about the tournament under way."""

    @property
    def planned(self) -> bool:
        """Whether there is a list of entrants."""
        return self.entrants is not None

    def check(self) -> None:
        """Refuse options of a list for the tournament under way, and the other way round."""
        if self.entrants is not None:
            for name in ("file", "at"):
                if name in self.given:
                    self.refuse(
                        "{part} is for the tournament under way. Leave out {list} or {part}.",
                        part=Parameter(name),
                        list=self.entrants,
                    )
            if self.form == "chips":
                self.refuse(
                    "for a chip tournament before its first rack, use evenbreak chips odds; for "
                    "one under way, leave out ENTRANTS.csv"
                )
            return refuse_lines(self)
        for name in self.given:
            if name not in ("file", "at", *self.under_way):
                self.refuse(
                    "{part} is for a list of entrants. Name one, or leave the option out "
                    "to ask about the tournament in {place}.",
                    part=Parameter(name),
                    place=self.file or "tonight.db",
                )
        return None


@dataclass(frozen=True, kw_only=True)
class TournamentOdds(OfEntrants):
    """Find each player's odds of winning the tournament and of finishing in every other place.

    ENTRANTS.csv has a row for each entrant, with the columns player and rating and, if you have
    them, standard_error and games. Without it, the answer is for the tournament under way in
    {file}, based on its results so far and on the scores of the matches in play.
    """

    examples = """\
  evenbreak tournament odds entrants.csv --race 7 --losers-race 5 --scale fargo
  evenbreak tournament odds entrants.csv --race-to 5 --prizes 500,300,150
  evenbreak tournament odds --file tonight.db
"""
    under_way = ("sure", "walkovers", "prizes")
    sure: Sure = False
    before_draw: Annotated[
        bool,
        Field(Flag(), "Odds before a blind draw: every draw is equally likely.", section="Details"),
    ] = False
    fairest: Annotated[
        bool,
        Field(
            Flag(),
            "With {race_to} or {chart}: also list fairer races of about the same length.",
            section="Details",
            more="These are the races for each side and each round that make the tournament "
            "fairest with about the same number of games.",
        ),
    ] = False
    walkovers: Annotated[
        float,
        Field(
            CHANCE,
            "The chance that a match is a walkover; in real double eliminations it is 0.047.",
            section="Details",
        ),
    ] = 0.0
    prizes: Prizes = None

    def check(self) -> None:
        """Refuse what a draw that has not been made cannot have."""
        if not self.before_draw or self.entrants is None:
            return
        if self.seeded not in ("listed", "blind"):
            self.refuse(
                "{before_draw} is for a blind draw. Leave out {seeding} {order}.", order=self.seeded
            )
        if self.form in ("round-robin", "swiss"):
            self.refuse("{before_draw} is for formats with a draw, not {asked}", asked=self.form)
        if self.placement == "redraw":
            self.refuse("{before_draw} takes {placement} half-shift, not redraw")


@dataclass(frozen=True, kw_only=True)
class TournamentTime(OfEntrants, Pace):
    """Find when the tournament ends and when each match starts.

    ENTRANTS.csv has a row for each entrant, with the columns player and rating; in a plain list of
    names, all players are equal. Without it, the answer is for the tournament under way in {file},
    based on its results, the matches on its tables and its pace so far. In JSON and CSV output,
    times are minutes from the start of the tournament.
    """

    examples = """\
  evenbreak tournament time entrants.csv --race 5 --tables 4 --discipline 9-ball
  evenbreak tournament time entrants.csv --race 7 --tables 6 --discipline 8-ball --start 19:00
  evenbreak tournament time --file tonight.db
"""
    under_way = ("tables", "turnover")
    tables: Tables | None = None
    pace: EarlierNights = ()
    turnover: Annotated[
        Turnover,
        Says(
            usual="as in real events",
            section="Details",
            more="In real events, most matches start right away, and the average is 4 minutes.",
        ),
    ] = None
    start: Annotated[
        int | None,
        Field(
            TIME_OF_DAY,
            "Start time of the tournament; times are then shown as times of day.",
            section="Details",
        ),
    ] = None

    def check(self) -> None:
        """Refuse a list without tables or a pace."""
        if self.entrants is None:
            return
        if self.tables is None:
            self.refuse("missing number of tables: add {tables} N, such as 4")
        if self.discipline is None and self.minutes_per_game is None:
            self.refuse(
                "missing game length: give {discipline}, such as 9-ball, or {minutes_per_game}, "
                "such as 8"
            )
        if self.pace and self.minutes_per_game is not None:
            self.refuse(
                "{pace} corrects the usual pace of a game. Use it with {discipline}, not "
                "with {minutes_per_game}."
            )
