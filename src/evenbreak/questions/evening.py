"""Questions about the tournament under way, and the entries that are made in it."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from typing import Annotated, Literal, TypeAlias

from evenbreak.errors import InputError
from evenbreak.fields.kinds import NUMBER, Choice, File, Flag, Named, Number, Text, Whole
from evenbreak.fields.question import Field, Question, Says
from evenbreak.questions.common import OnPaper, ScaleOf
from evenbreak.tournaments.evening.format import LONGEST_RACE, Discipline, Tables


def minutes_of_day(text: str) -> int:
    """Return a time of day in minutes after midnight.

    >>> minutes_of_day("19:30")
    1170
    """
    match = re.fullmatch(r"\s*(\d{1,2})[:.h](\d{2})\s*", text)
    hours, minutes = (int(match[1]), int(match[2])) if match else (24, 0)
    if hours > 23 or minutes > 59:
        raise InputError(f"{text!r} isn't a time of day. Give 0:00 to 23:59, such as 19:30.")
    return 60 * hours + minutes


TIME_OF_DAY = Named(minutes_of_day, "HH:MM")

At: TypeAlias = Annotated[
    int | None, Field(TIME_OF_DAY, "When it happened.", usual="now", section="File")
]
EveningFile: TypeAlias = Annotated[
    str | None,
    Field(
        File("FILE.db"),
        "The file with the tournament under way.",
        usual="tonight.db",
        section="File",
        more="You can also set it in the environment, as `EVENBREAK_TOURNAMENT`.",
    ),
]
Prizes: TypeAlias = Annotated[
    str | None,
    Field(
        Text("MONEY,..."),
        "The money for first place, second, ..., such as 500,300,150.",
        more="The answer then also has each player's average prize.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class UnderWay(Question):
    """A question about the tournament under way."""

    file: EveningFile = None
    event: Annotated[
        int, Field(Whole(1, 99), "Which of tonight's events, by number.", section="File")
    ] = 1

    @property
    def path(self) -> str:
        """The file of the tournament."""
        return self.file or os.environ.get("EVENBREAK_TOURNAMENT") or "tonight.db"


@dataclass(frozen=True, kw_only=True)
class TimedUnderWay(UnderWay):
    """A question about the tournament under way at a time of day."""

    at: At = None


@dataclass(frozen=True, kw_only=True)
class SecondChance(TimedUnderWay):
    """Start a second event on the same tables for players already knocked out.

    It is a single elimination, and the last player knocked out is the top seed. More players can
    enter until its draw is made. To use the other commands on this event, give its number, such as
    {event} 2.
    """

    race: Annotated[
        int | None,
        Field(Whole(1, LONGEST_RACE), "Games to win.", usual="same as the losers' side"),
    ] = None


@dataclass(frozen=True, kw_only=True)
class Show(TimedUnderWay, OnPaper):
    """Show the bracket: each match with its players, its score and its table.

    For a chip tournament, show the tables, the line and everyone's chips.
    """

    out: Annotated[
        str | None,
        Field(
            File(),
            "Also draw the bracket in FILE: .html for phones and screens, .pdf for paper, .svg "
            "or .png for a picture.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class Programs(TimedUnderWay):
    """Create a token for another program, such as a scoreboard; without NAME, list all tokens.

    The token is shown only once. The program uses it to enter what happens, at the addresses that
    evenbreak serve has under /api/v1/tonight; the program's name is shown in the history.
    """

    examples = """\
  evenbreak tournament token scoreboard
  evenbreak tournament token "stream table" --may table:4
  evenbreak tournament token scoreboard --revoke
"""
    name: Annotated[str | None, Field(Text("NAME"), metavar="[NAME]", argument=True)] = None
    may: Annotated[
        str,
        Field(
            Text("scores|table:T|director"),
            "What the program may enter: scores, results and calls; one table's score and "
            "result; or anything a director can enter.",
        ),
    ] = "scores"
    revoke: Annotated[bool, Field(Flag(), "Revoke NAME's token at once.")] = False

    def check(self) -> None:
        """Refuse to revoke the token of nobody."""
        if self.revoke and self.name is None:
            self.refuse("{revoke} needs a program's name, as listed by evenbreak tournament token")


@dataclass(frozen=True, kw_only=True)
class Next(TimedUnderWay):
    """Show what is on the tables, and which match to call next so that the night ends soonest.

    Each match that can be played is listed with what it decides: how much of the title odds its
    result moves from some players to others. The list also shows how much later the tournament
    would end if that match were called first. In a chip tournament, the command shows who is at
    each table and who is next in line.
    """

    examples = """\
  evenbreak tournament next
  evenbreak tournament next --prizes 500,300,150
"""
    prizes: Annotated[
        Prizes, Says(more="The answer then also shows how much prize money each match decides.")
    ] = None


@dataclass(frozen=True, kw_only=True)
class Export(UnderWay):
    """List the matches that were played, as CSV that evenbreak rate reads.

    Matches that no longer count in the bracket after a correction are included, because they were
    played.
    """

    examples = """\
  evenbreak tournament export --out matches.csv
  evenbreak rate matches.csv
  evenbreak tournament export --events --out cup.csv
  evenbreak tournament export --story --out story.svg
  evenbreak tournament export --out night.html
"""
    out: Annotated[
        str | None,
        Field(
            File("FILE.csv"),
            "Write to this file. An .html file is the whole night as one page to share; with "
            "{story}, an .svg file is a chart.",
        ),
    ] = None
    events: Annotated[
        bool,
        Field(
            Flag(),
            "List everything that happened, in a form that evenbreak tournament import can read.",
        ),
    ] = False
    story: Annotated[
        bool,
        Field(
            Flag(),
            "Tell the story of the night: title odds after each match, the biggest "
            "upset, the closest match.",
        ),
    ] = False

    def check(self) -> None:
        """Refuse two lists at once."""
        if self.events and self.story:
            self.refuse("{events} and {story} print different lists. Use one of them.")


@dataclass(frozen=True, kw_only=True)
class Print(UnderWay, OnPaper):
    """Write score cards, the bracket or the draw as a PDF to print.

    There is one card for each unfinished match whose players are known. It has boxes to check and
    room to sign, and tells where the winner and loser go next. The bracket is printed on one sheet
    if it is readable at that size, otherwise on larger paper. The draw lists everyone by name, with
    their first match.
    """

    examples = """\
  evenbreak tournament print cards
  evenbreak tournament print cards --match 12 --per-page 1 --out final.pdf
  evenbreak tournament print bracket --out wall.pdf
"""
    what: Annotated[
        Literal["cards", "bracket", "draw"],
        Field(Choice(("cards", "bracket", "draw")), argument=True),
    ]
    match: Annotated[str | None, Field(Text("MATCH"), "Print only this match's card.")] = None
    per_page: Annotated[int, Field(Choice({"1": 1, "4": 4}), "Cards per page.")] = 4
    out: Annotated[
        str | None, Field(File("FILE.pdf"), "The file.", usual="cards.pdf, bracket.pdf or draw.pdf")
    ] = None

    def check(self) -> None:
        """Refuse a match for what has all of them."""
        if self.what != "cards" and self.match is not None:
            self.refuse("{match} is for score cards. Leave it out.")


def bid(text: str) -> tuple[str, float]:
    """Return a player who has been sold, and for how much.

    >>> bid("Ann Lee=60")
    ('Ann Lee', 60.0)
    """
    name, _, amount = text.rpartition("=")
    if not NUMBER.fullmatch(amount.strip()) or float(amount) < 0.0:
        raise InputError(
            f"{text!r} isn't a bid. Give a player and an amount, such as 'Ann Lee=60'."
        )
    return name.strip(), float(amount)


MONEY = Number(0.0, 1e9, " isn't an amount of money. Give a number, such as 20", metavar="MONEY")


@dataclass(frozen=True, kw_only=True)
class PayOut(TimedUnderWay):
    """Find what each place pays, and each player's expected prize.

    With {calcutta}, find what each unsold player is worth: their expected share of the pot, and the
    bid at which a buyer breaks even.
    """

    examples = """\
  evenbreak tournament prizes --fee 20 --added 100
  evenbreak tournament prizes --fee 20 --payout 50,30,20 --house 0.1 --keep
  evenbreak tournament prizes --calcutta --sold "Ann Lee=60" --sold "Bo Diaz=25"
"""
    fee: Annotated[float, Field(MONEY, "Entry fee per player.")] = 0.0
    added: Annotated[float, Field(MONEY, "Money added to the pot.")] = 0.0
    house: Annotated[
        float,
        Field(
            Number(
                0.0, 0.99, " isn't a share. Give a number from 0 to 0.99, such as 0.1", metavar="P"
            ),
            "The share of the pot kept by the house.",
        ),
    ] = 0.0
    payout: Annotated[
        str | None,
        Field(
            Text("NAME|P,..."),
            "The payout: hoboken, 40/30/20/10, 40/30/15, 70/30, or percentages such as 50,30,20.",
            usual="70/30 for fewer than 8 players, else 40/30/20/10",
        ),
    ] = None
    unit: Annotated[
        float,
        Field(
            MONEY,
            "Round prizes down to multiples of this amount, such as 5; first place gets the "
            "remainder.",
        ),
    ] = 0.0
    keep: Annotated[
        bool,
        Field(
            Flag(),
            "Save the prizes with the tournament; the page and this command show them from then "
            "on.",
        ),
    ] = False
    calcutta: Annotated[
        bool, Field(Flag(), "Show what each player is worth in the Calcutta.", section="Calcutta")
    ] = False
    sold: Annotated[
        tuple[tuple[str, float], ...],
        Field(
            Named(bid, "NAME=BID"),
            "With {calcutta}: a player already sold, and the price.",
            many=True,
            section="Calcutta",
        ),
    ] = ()

    def check(self) -> None:
        """Refuse what is for the other kind of money."""
        if self.calcutta and (self.fee or self.added or self.keep):
            self.refuse(
                "{fee}, {added} and {keep} are for the prizes; a Calcutta's pot is made up of "
                "its bids. Leave them out."
            )
        if self.sold and not self.calcutta:
            self.refuse("{sold} needs {calcutta}. Add it.")


@dataclass(frozen=True, kw_only=True)
class Import(Question):
    """Import a tournament from a file saved by CueScore, Challonge or brackets-manager.

    The bracket, the results and the times come from FILE; continue with the other commands. FILE
    can also be the CSV from evenbreak tournament export --events. Players without a rating are
    treated as average.
    """

    examples = """\
  evenbreak tournament import cup.json --ratings entrants.csv --tables 6
  evenbreak tournament odds
"""
    saved: Annotated[str, Field(File(), argument=True)]
    ratings: Annotated[str | None, Field(File("ENTRANTS.csv"), "The players' ratings.")] = None
    scale: ScaleOf = None
    race: Annotated[
        int | None, Field(Whole(1, LONGEST_RACE), "Games to win.", usual="as saved")
    ] = None
    tables: Annotated[Tables | None, Says(usual="as saved")] = None
    discipline: Annotated[Discipline | None, Says(usual="as saved, else 9-ball")] = None
    out: Annotated[str, Field(File("FILE.db"), "The tournament's file; it must not exist yet.")] = (
        "tonight.db"
    )
    at: At = None
