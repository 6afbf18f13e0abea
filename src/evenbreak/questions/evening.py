"""Questions about the tournament under way, and the entries that are made in it."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from typing import Annotated, Literal, TypeAlias

from evenbreak.errors import InputError
from evenbreak.fields.kinds import NUMBER, Choice, File, Flag, Named, Number, Text, Whole
from evenbreak.fields.question import Field, Question, Says
from evenbreak.questions.common import SCORE, OnPaper, ScaleOf, Seed
from evenbreak.tournaments.evening.format import (
    LONGEST_RACE,
    MOST_TABLES,
    Discipline,
    FinalRace,
    LosersRace,
    Tables,
)


def minutes_of_day(text: str) -> int:
    """Return a time of day in minutes after midnight.

    >>> minutes_of_day("19:30")
    1170
    """
    match = re.fullmatch(r"\s*(\d{1,2})[:.h](\d{2})\s*", text)
    hours, minutes = (int(match[1]), int(match[2])) if match else (24, 0)
    if hours > 23 or minutes > 59:
        raise InputError(f"{text!r}; give a time of day from 0:00 to 23:59, such as 19:30")
    return 60 * hours + minutes


TIME_OF_DAY = Named(minutes_of_day, "HH:MM")

At: TypeAlias = Annotated[
    int | None, Field(TIME_OF_DAY, "When it happened.", usual="now", section="File")
]
EveningFile: TypeAlias = Annotated[
    str | None,
    Field(
        File("FILE.db"),
        "The file of the tournament under way.",
        usual="tonight.db",
        section="File",
        more="Also in the environment: `EVENBREAK_TOURNAMENT`.",
    ),
]
Prizes: TypeAlias = Annotated[
    str | None,
    Field(
        Text("MONEY,..."),
        "The money for first place, second, ..., such as 500,300,150.",
        more="Adds each player's average prize.",
    ),
]


def score_or_name(text: str) -> tuple[int, int] | str:
    """Return a score, or in a chip tournament the name of the winner.

    >>> score_or_name("7:5"), score_or_name("ann")
    ((7, 5), 'ann')
    """
    return text if text.strip()[:1].isalpha() else SCORE.read(text)


Match: TypeAlias = Annotated[str, Field(Text("MATCH"), argument=True)]
Player: TypeAlias = Annotated[str, Field(Text("PLAYER"), argument=True)]
Result: TypeAlias = Annotated[
    tuple[int, int] | str, Field(Named(score_or_name, "SCORE"), argument=True)
]
Rating: TypeAlias = Annotated[
    float | None,
    Field(
        Number(-1e6, 1e6, " is not a number of rating points; give one such as 80", metavar="R"),
        "Their rating.",
    ),
]
Lots: TypeAlias = Annotated[
    Seed, Says("The seed of the lots.", usual="a new one each time", rare=False)
]


@dataclass(frozen=True, kw_only=True)
class UnderWay(Question):
    """A question about the tournament under way."""

    file: EveningFile = None

    @property
    def path(self) -> str:
        """The file of the tournament."""
        return self.file or os.environ.get("EVENBREAK_TOURNAMENT") or "tonight.db"


@dataclass(frozen=True, kw_only=True)
class TimedUnderWay(UnderWay):
    """A question about the tournament under way at a time of day."""

    at: At = None


@dataclass(frozen=True, kw_only=True)
class Entry(TimedUnderWay):
    """An entry that may take away a match in play or a result."""

    yes: Annotated[
        bool,
        Field(
            Flag(),
            "Enter it even if a match in play leaves its table, or a result no longer counts.",
        ),
    ] = False


@dataclass(frozen=True, kw_only=True)
class MakeDraw(TimedUnderWay):
    """Make the draw, in the way that {seeding} of evenbreak tournament new said.

    Later it draws what comes next: the next round of a Swiss once a round is over, or, with
    {placement} redraw, the losers' side's qualifiers for the knock-out.
    """

    seed: Annotated[Lots | None, Says("The seed of a blind draw.")] = None


@dataclass(frozen=True, kw_only=True)
class Call(TimedUnderWay):
    """Call a match to a table, or move it; without MATCH, call the next to all free tables.

    With {back} a match is taken off its table. It can be called again later.

    In a chip tournament players come to the tables by themselves, in the order of the line.

    The times of calls and results show how fast this evening is, and so when it ends.
    """

    match: Annotated[Match | None, Says(metavar="[MATCH]")] = None
    table: Annotated[int | None, Field(Whole(1, MOST_TABLES), "The table.", usual="a free one")] = (
        None
    )
    back: Annotated[bool, Field(Flag(), "Take MATCH off its table; it keeps its score.")] = False

    def check(self) -> None:
        """Refuse options for one match without a match."""
        if self.match is None and self.table is not None:
            self.refuse("{table} is for one match; name it, such as W1.1")
        if self.back and (self.match is None or self.table is not None):
            self.refuse("{back} takes one match off its table; name it alone, such as W1.1")


@dataclass(frozen=True, kw_only=True)
class EnterResult(TimedUnderWay):
    """Enter the result of a match: the games of its first player, a colon, those of the second.

    In a chip tournament the number of the table and the winner's name will do; a first name is
    enough if no other player has it.

    If a forfeit was meant, use evenbreak tournament forfeit.
    """

    examples = """\
  evenbreak tournament result W1.1 7:5
  evenbreak tournament result W1.1 7:5 --at 20:15
  evenbreak tournament result 3 ann            (a chip tournament: Ann won the rack on table 3)
"""
    match: Match
    score: Result


@dataclass(frozen=True, kw_only=True)
class EnterScore(TimedUnderWay):
    """Enter the score of a match in play; the odds and the finish go by it from then on.

    It is not needed: the result alone will do.
    """

    match: Match
    score: Annotated[tuple[int, int], Field(SCORE, metavar="SCORE", argument=True)]


@dataclass(frozen=True, kw_only=True)
class Correct(Entry):
    """Correct the result of a match, at any time.

    If others move on because of it, later matches that the wrong players have played are open
    again, and those that they are playing leave their tables: it is then refused without {yes}.
    Results and scores are kept, and count again if the correction is undone or corrected.

    In a chip tournament name the winner, and the rack or, for the last rack on a table, the table.
    The chip goes back to its owner; racks that were played since still count, unless a player had
    no chips left by then.
    """

    examples = """\
  evenbreak tournament correct W1.1 5:7
  evenbreak tournament correct W1.1 5:7 --at 20:15
  evenbreak tournament correct R12 bo          (a chip tournament: Bo won rack R12)
"""
    match: Match
    score: Result


@dataclass(frozen=True, kw_only=True)
class Stand(Entry):
    """Let a match stand that was played before a correction sent somebody else into it.

    The corrected score is kept, but those who have played on stay where they are.
    """

    match: Match


@dataclass(frozen=True, kw_only=True)
class Change(TimedUnderWay):
    """Change the number of tables, or the races of the matches that have not begun.

    What it would bring is in evenbreak tournament time, under What if.
    """

    examples = """\
  evenbreak tournament change --tables 5
  evenbreak tournament change --losers-race 4
"""
    tables: Tables | None = None
    race: Annotated[int | None, Field(Whole(1, LONGEST_RACE), "What is raced to.")] = None
    losers_race: Annotated[
        LosersRace, Says("The same on the losers' side.", usual="", section="")
    ] = None
    final_race: Annotated[FinalRace, Says("The same in the final.", usual="", section="")] = None


@dataclass(frozen=True, kw_only=True)
class Undo(Entry):
    """Take back the director's last entry; once more takes back the one before that.

    Scores that players tap on their phones stay. A result that both players entered is taken back
    only if {entry} names it, or corrected.
    """

    entry: Annotated[
        int | None,
        Field(
            Whole(2, 10**7),
            "A result that both players entered, by its number in the history.",
            usual="the director's last entry",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class LetIn(TimedUnderWay):
    """Let PLAYER in: before the draw, or afterwards in place of a bye that is still open.

    In a chip tournament they get chips by the chart and go to the end of the line.
    """

    player: Player
    rating: Annotated[Rating, Says(usual="that of a new player")] = None


@dataclass(frozen=True, kw_only=True)
class Edit(TimedUnderWay):
    """Correct PLAYER's name or rating before the draw; they keep their place in the list."""

    player: Player
    name: Annotated[str, Field(Text("NAME"), "The right name.")] = ""
    rating: Annotated[Rating, Says("The right rating.")] = None


@dataclass(frozen=True, kw_only=True)
class Drop(Entry):
    """Let PLAYER go home: they forfeit all their matches to come.

    In the next rounds of a Swiss they are not paired. In a chip tournament they are out, and the
    next in the line takes their place at the table.
    """

    player: Player


@dataclass(frozen=True, kw_only=True)
class Forfeit(Entry):
    """Let PLAYER forfeit the match they are to play; they play on if the format lets them.

    MATCH is needed only if they have several to play, as in a round robin.
    """

    player: Player
    match: Annotated[Match | None, Says(metavar="[MATCH]")] = None


@dataclass(frozen=True, kw_only=True)
class TieBreak(TimedUnderWay):
    """Break the ties of a round robin when all its matches are played.

    Players are ranked by matches won, and those who are level by the matches among them. Who is
    still level is ranked by games won minus games lost, and finally by lot.
    """

    lot: Annotated[bool, Field(Flag(), "Break them by lot alone; games do not count.")] = False
    seed: Lots | None = None


@dataclass(frozen=True, kw_only=True)
class Show(TimedUnderWay, OnPaper):
    """Show the bracket: each match with its players, its score and its table.

    Of a chip tournament it shows the tables, the line and everybody's chips.
    """

    out: Annotated[
        str | None,
        Field(
            File(),
            "Also draw the bracket to FILE: .html for phones and screens, .pdf for paper, .svg or "
            ".png as a picture.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class Next(TimedUnderWay):
    """Show what is on the tables and which match to call next, so that it ends soonest.

    Each match that can be played is listed with what it decides: the title odds that its result
    moves from some players to others, and how much later the tournament would end if it were
    called first. In a chip tournament it shows who is at which table and who is next in the line.
    """

    examples = """\
  evenbreak tournament next
  evenbreak tournament next --prizes 500,300,150
"""
    prizes: Annotated[Prizes, Says(more="Adds what each match decides in money.")] = None


@dataclass(frozen=True, kw_only=True)
class Export(UnderWay):
    """List the matches that were played, as CSV that evenbreak rate reads.

    Matches that no longer count in the bracket after a correction are in it: they were played.
    """

    examples = """\
  evenbreak tournament export --out matches.csv
  evenbreak rate matches.csv
  evenbreak tournament export --events --out cup.csv
"""
    out: Annotated[str | None, Field(File("FILE.csv"), "Write them to this file.")] = None
    events: Annotated[
        bool,
        Field(Flag(), "List all that happened instead, which evenbreak tournament import reads."),
    ] = False


@dataclass(frozen=True, kw_only=True)
class Print(UnderWay, OnPaper):
    """Write score cards, the bracket or the draw as a PDF to print.

    Cards are made for all matches whose players are known and that are not over: one each, with
    boxes to tick, where winner and loser go next, and room to sign. The bracket is on one sheet if
    it can be read there, else on larger paper. The draw lists everybody by name, with their first
    match.
    """

    examples = """\
  evenbreak tournament print cards
  evenbreak tournament print cards --match W1.2 --per-page 1 --out final.pdf
  evenbreak tournament print bracket --out wall.pdf
"""
    what: Annotated[
        Literal["cards", "bracket", "draw"],
        Field(Choice(("cards", "bracket", "draw")), argument=True),
    ]
    match: Annotated[str | None, Field(Text("MATCH"), "The card of this match alone.")] = None
    per_page: Annotated[int, Field(Choice({"1": 1, "4": 4}), "How many cards are on a page.")] = 4
    out: Annotated[
        str | None,
        Field(File("FILE.pdf"), "The file.", usual="cards.pdf, bracket.pdf or draw.pdf"),
    ] = None

    def check(self) -> None:
        """Refuse a match for what has all of them."""
        if self.what != "cards" and self.match is not None:
            self.refuse("{match} is for cards")


def bid(text: str) -> tuple[str, float]:
    """Return a player who has been sold, and for how much.

    >>> bid("Ann Lee=60")
    ('Ann Lee', 60.0)
    """
    name, _, amount = text.rpartition("=")
    if not NUMBER.fullmatch(amount.strip()) or float(amount) < 0.0:
        raise InputError(f"{text!r}; give a player and a bid, such as 'Ann Lee=60'")
    return name.strip(), float(amount)


MONEY = Number(0.0, 1e9, " is not an amount of money; give a number such as 20", metavar="MONEY")


@dataclass(frozen=True, kw_only=True)
class PayOut(TimedUnderWay):
    """Find what each place is paid, and what each player may expect.

    With {calcutta}, find what each player still to be sold is worth: the share of the pot, and the
    bid at which it wins back what it costs.
    """

    examples = """\
  evenbreak tournament prizes --fee 20 --added 100
  evenbreak tournament prizes --fee 20 --payout 50,30,20 --house 0.1 --keep
  evenbreak tournament prizes --calcutta --sold "Ann Lee=60" --sold "Bo Diaz=25"
"""
    fee: Annotated[float, Field(MONEY, "What each player pays to enter.")] = 0.0
    added: Annotated[float, Field(MONEY, "Money added to the pot.")] = 0.0
    house: Annotated[
        float,
        Field(
            Number(
                0.0, 0.99, " is not a part; give a number from 0 to 0.99, such as 0.1", metavar="P"
            ),
            "The part of the pot that the house keeps.",
        ),
    ] = 0.0
    payout: Annotated[
        str | None,
        Field(
            Text("NAME|P,..."),
            "What the places get: hoboken, 40/30/20/10, 40/30/15, 70/30, or percentages such as "
            "50,30,20.",
            usual="70/30 for fewer than 8 players, else 40/30/20/10",
        ),
    ] = None
    keep: Annotated[
        bool,
        Field(
            Flag(),
            "Keep them with the tournament: the page shows them, and this command unless it is "
            "given others.",
        ),
    ] = False
    calcutta: Annotated[
        bool, Field(Flag(), "What each player is worth in the Calcutta.", section="Calcutta")
    ] = False
    sold: Annotated[
        tuple[tuple[str, float], ...],
        Field(
            Named(bid, "NAME=BID"),
            "With {calcutta}: a player who has been sold, and for how much.",
            many=True,
            section="Calcutta",
        ),
    ] = ()

    def check(self) -> None:
        """Refuse what is for the other kind of money."""
        if self.calcutta and (self.fee or self.added or self.keep):
            self.refuse(
                "{fee}, {added} and {keep} are for the prizes; the pot of a Calcutta is its bids"
            )
        if self.sold and not self.calcutta:
            self.refuse("{sold} is for {calcutta}")


@dataclass(frozen=True, kw_only=True)
class Import(Question):
    """Import a tournament from a file that CueScore, Challonge or brackets-manager has saved.

    The bracket, the results and the times are those of FILE; go on with the other commands. FILE
    may also be the CSV of evenbreak tournament export --events. Players without a rating are taken
    as average ones.
    """

    examples = """\
  evenbreak tournament import cup.json --ratings entrants.csv --tables 6
  evenbreak tournament odds
"""
    saved: Annotated[str, Field(File(), argument=True)]
    ratings: Annotated[str | None, Field(File("ENTRANTS.csv"), "The players' ratings.")] = None
    scale: ScaleOf = None
    race: Annotated[
        int | None, Field(Whole(1, LONGEST_RACE), "What is raced to.", usual="as saved")
    ] = None
    tables: Annotated[Tables | None, Says(usual="as saved")] = None
    discipline: Annotated[Discipline | None, Says(usual="as saved, else 9-ball")] = None
    out: Annotated[
        str,
        Field(File("FILE.db"), "The file of the tournament, which must not exist yet."),
    ] = "tonight.db"
    at: At = None
