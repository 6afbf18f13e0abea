"""Questions that enter something in the tournament under way: a class for each move."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal, TypeAlias

from evenbreak.fields.kinds import Choice, Flag, Named, Number, Text, Whole
from evenbreak.fields.question import Field, Says
from evenbreak.questions.common import SCORE, Seed
from evenbreak.questions.evening import TIME_OF_DAY, TimedUnderWay
from evenbreak.tournaments.evening.format import (
    LONGEST_RACE,
    FinalRace,
    LosersRace,
    NamedTables,
    names_in,
)


def score_or_name(text: str) -> tuple[int, int] | str:
    """Return a score, or in a chip tournament the name of the winner.

    >>> score_or_name("7:5"), score_or_name("ann")
    ((7, 5), 'ann')
    """
    return text if text.strip()[:1].isalpha() else SCORE.read(text)


@dataclass(frozen=True)
class _ScoreOrName(Named):
    """A score, or in a chip tournament the name of the winner; in JSON a score is a list too."""

    def load(self, value: Any) -> Any:
        """Return what JSON has for it."""
        return SCORE.load(value) if isinstance(value, list) else super().load(value)

    def schema(self) -> dict[str, Any]:
        """Return what a JSON schema says of such a value."""
        return {"anyOf": [SCORE.schema(), {"type": "string"}]}


PLAYER = Text("PLAYER")
"""The name of somebody who has entered; on the terminal its beginning will do."""
Winner: TypeAlias = Annotated[
    str | None, Field(PLAYER, "The winner, instead of a score; needs {games}.")
]
Games: TypeAlias = Annotated[
    int | None, Field(Whole(0, LONGEST_RACE - 1), "Games the loser has won; needs {winner}.")
]
Match: TypeAlias = Annotated[
    str,
    Field(
        Named(metavar="MATCH", number=True),
        "The match, by its number, such as 12; in a chip tournament, the table's number.",
        argument=True,
    ),
]
Player: TypeAlias = Annotated[
    str,
    Field(PLAYER, "A player in the tournament; the start of the name is enough.", argument=True),
]
NewName: TypeAlias = Annotated[str, Field(Text("NAME"), "The player's full name.", argument=True)]
YES = Choice({"yes": True, "no": False})
Result: TypeAlias = Annotated[
    tuple[int, int] | str,
    Field(
        _ScoreOrName(score_or_name, "SCORE"),
        "Games each player has won, first player first; in a chip tournament, the winner's name.",
        argument=True,
    ),
]
Rating: TypeAlias = Annotated[
    float | None,
    Field(
        Number(-1e6, 1e6, " isn't a rating. Give a number of points, such as 80", metavar="R"),
        "Their rating.",
    ),
]
Lots: TypeAlias = Annotated[
    Seed, Says("The seed for drawing lots.", usual="a new one each time", rare=False)
]


@dataclass(frozen=True, kw_only=True)
class Entry(TimedUnderWay):
    """An entry that may take away a match in play or a result."""

    yes: Annotated[
        bool,
        Field(
            Flag(),
            "Enter it even if that takes a match off its table or voids a result.",
        ),
    ] = False


@dataclass(frozen=True, kw_only=True)
class MakeDraw(Entry):
    """Make the draw, using the {seeding} chosen in evenbreak tournament new.

    Later, the command draws the next stage: the next Swiss round once a round is over or, with
    {placement} redraw, the knockout places of the qualifiers from the losers' side.
    """

    seed: Annotated[Lots | None, Says("The seed for a blind draw.")] = None
    here: Annotated[
        bool, Field(Flag(), "Draw only players who have checked in; others can enter late.")
    ] = False


@dataclass(frozen=True, kw_only=True)
class Call(TimedUnderWay):
    """Call a match to a table, or move it; without MATCH, call the next matches to all free tables.

    In a chip tournament, players go to the tables without being called, in the order of the line.

    The times at which matches are called and end show how fast this evening is going, and so when
    it will be over.
    """

    match: Annotated[Match | None, Says(metavar="[MATCH]")] = None
    table: Annotated[
        str | None,
        Field(
            Named(metavar="TABLE", number=True),
            "The table, by its name or number.",
            usual="a free one",
        ),
    ] = None

    def check(self) -> None:
        """Refuse a table without a match."""
        if self.match is None and self.table is not None:
            self.refuse("{table} is for one match. Name the match, such as 12.")


@dataclass(frozen=True, kw_only=True)
class Uncall(TimedUnderWay):
    """Take a match off its table; it keeps its score and can be called again later."""

    match: Match


@dataclass(frozen=True, kw_only=True)
class Ended(TimedUnderWay):
    """How a match ended: its score, or its winner and the games of its loser."""

    match: Match
    score: Annotated[Result | None, Says(metavar="[SCORE]")] = None
    winner: Winner = None
    games: Games = None
    ended: Annotated[
        Literal["time", "conceded"] | None,
        Field(
            Choice(("time", "conceded")),
            "Why the match wasn't finished; needs SCORE, and {winner} if the score doesn't show "
            "who won.",
        ),
    ] = None

    def check(self) -> None:
        """Refuse a result that is not stated, or stated twice."""
        if (self.score is None) == (self.winner is None) and not (self.score and self.ended):
            if self.score:
                self.refuse("give a score or {winner}, not both")
            self.refuse("give a score, such as 7-5, or {winner} with {games}")
        if self.winner is None and self.games is not None:
            self.refuse("{games} needs {winner} NAME. Add it, or give a score such as 7-5.")


@dataclass(frozen=True, kw_only=True)
class EnterResult(Ended):
    """Enter a match result: the first player's games, a hyphen, and the second player's games.

    In a chip tournament, give the table number and the winner's name; a first name is enough if no
    other player has it.

    For a forfeit, use evenbreak tournament forfeit.
    """

    examples = """\
  evenbreak tournament result 12 7-5
  evenbreak tournament result 12 --winner ann --games 5
  evenbreak tournament result 12 7-5 --at 20:15
  evenbreak tournament result 3 ann            (a chip tournament: Ann won the rack on table 3)
"""


@dataclass(frozen=True, kw_only=True)
class EnterScore(TimedUnderWay):
    """Enter the score of a match in play; it then counts in the odds and the finish time.

    It's optional: the result alone is enough.
    """

    match: Match
    score: Annotated[
        tuple[int, int],
        Field(SCORE, "Games each player has won so far.", metavar="SCORE", argument=True),
    ]


@dataclass(frozen=True, kw_only=True)
class Correct(Ended, Entry):
    """Correct the result of a match, at any time.

    If this changes who moves on, later matches that the wrong players have played are open again,
    and matches they are playing leave their tables. In that case, the correction needs {yes} or
    {follow}. Results and scores are kept, and count again if the correction is undone or corrected.

    In a chip tournament, name the winner and the rack; for a table's last rack, name the table
    instead. The chip goes back to its owner. Racks played since then still count, unless a player
    had no chips left by then.
    """

    examples = """\
  evenbreak tournament correct 12 5-7
  evenbreak tournament correct 12 5-7 --at 20:15
  evenbreak tournament correct R12 bo          (a chip tournament: Bo won rack R12)
"""
    follow: Annotated[
        Literal["stop", "keep"] | None,
        Field(
            Choice(("stop", "keep")),
            "What to do with later matches in play: stop them, or keep their players.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class Stand(Entry):
    """Keep the result of a match that was played before a correction sent someone else into it.

    The corrected score is kept, but players who have played on stay where they are.
    """

    match: Match


@dataclass(frozen=True, kw_only=True)
class Change(Entry):
    """Change the tables, the pace, or the races of matches that haven't started.

    If a table is closed, its match goes back to the queue and keeps its score.

    To see what a change would do, look under What if in evenbreak tournament time.
    """

    examples = """\
  evenbreak tournament change --tables 5
  evenbreak tournament change --tables 5-8,TV --reserved TV
  evenbreak tournament change --losers-race 4
"""
    tables: NamedTables | None = None
    race: Annotated[int | None, Field(Whole(1, LONGEST_RACE), "Games to win.")] = None
    losers_race: Annotated[
        LosersRace, Says("Games to win on the losers' side.", usual="", section="")
    ] = None
    final_race: Annotated[FinalRace, Says("Games to win in the final.", usual="", section="")] = (
        None
    )
    name: Annotated[str | None, Field(Text("NAME"), "Name of the tournament.")] = None
    date: Annotated[str | None, Field(Text("DATE"), "The tournament's date.")] = None
    reserved: Annotated[
        tuple[str, ...] | None,
        Field(Named(names_in, "TABLE,...", number=True), "Tables assigned only by name, or none."),
    ] = None
    streamed: Annotated[
        tuple[str, ...] | None,
        Field(Named(names_in, "TABLE,...", number=True), "Tables shown on a stream, or none."),
    ] = None
    slower: Annotated[
        float | None,
        Field(
            Number(0.5, 2.0, metavar="X"),
            "How long matches take here compared with usual: 1.2 is 20% longer.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class Undo(Entry):
    """Undo the director's last entry; run it again to undo the one before.

    Scores that players tap on their phones stay. An older entry, or one that both players made, is
    undone only if {entry} names it and nothing depends on it.
    """

    entry: Annotated[
        int | None,
        Field(
            Whole(2, 10**7),
            "The entry, by its number in the history.",
            usual="the director's last entry",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class LetIn(TimedUnderWay):
    """Enter PLAYER: before the draw, or later in place of an open bye.

    In a chip tournament, they get the number of chips in the chart and go to the end of the line.
    """

    player: Annotated[NewName, Says(metavar="PLAYER")]
    rating: Annotated[Rating, Says(usual="a new player's rating")] = None


@dataclass(frozen=True, kw_only=True)
class Edit(TimedUnderWay):
    """Correct PLAYER's name or rating before the draw; they keep their place in the list."""

    player: Player
    name: Annotated[str, Field(Text("NAME"), "The right name.")] = ""
    rating: Annotated[Rating, Says("The right rating.")] = None


@dataclass(frozen=True, kw_only=True)
class Drop(Entry):
    """Withdraw PLAYER: they forfeit all their remaining matches.

    In a Swiss tournament, they aren't paired in later rounds. In a chip tournament, they are out,
    and the next player in line takes their place at the table.
    """

    player: Player


@dataclass(frozen=True, kw_only=True)
class Forfeit(Entry):
    """Forfeit PLAYER's next match; they stay in the tournament if the format lets them.

    MATCH is needed only if they have several matches to play, as in a round robin.
    """

    player: Player
    match: Annotated[Match | None, Says(metavar="[MATCH]")] = None


@dataclass(frozen=True, kw_only=True)
class TieBreak(TimedUnderWay):
    """Break the ties of a round robin when all its matches are played.

    Players are ranked by matches won; players who are level are then ranked by the matches between
    them, by games won minus games lost, and finally by lot.
    """

    lot: Annotated[bool, Field(Flag(), "Break ties by lot alone; games don't count.")] = False
    seed: Lots | None = None


@dataclass(frozen=True, kw_only=True)
class Redo(Entry):
    """Redo the last entry that was undone."""

    entry: Annotated[
        int | None,
        Field(Whole(2, 10**7), "The entry's number in the history.", usual="the last one"),
    ] = None


@dataclass(frozen=True, kw_only=True)
class SwapTables(TimedUnderWay):
    """Swap the tables of two called matches."""

    one: Annotated[Match, Says(metavar="MATCH")]
    other: Annotated[Match, Says(metavar="MATCH2")]


@dataclass(frozen=True, kw_only=True)
class Wait(TimedUnderWay):
    """Take a match off its table and put it on hold; without an option, take it off hold."""

    examples = """\
  evenbreak tournament wait 12 --absent ann --until 20:15
"""
    match: Match
    absent: Annotated[
        tuple[str, ...], Field(PLAYER, "Which of the match's players isn't here.", many=True)
    ] = ()
    until: Annotated[
        int | None, Field(TIME_OF_DAY, "When the absent player forfeits the match.", usual="never")
    ] = None
    reason: Annotated[str, Field(Text("TEXT"), "Another reason.")] = ""


@dataclass(frozen=True, kw_only=True)
class Rename(TimedUnderWay):
    """Rename PLAYER at any time: their seed and results stay."""

    player: Player
    to: NewName


@dataclass(frozen=True, kw_only=True)
class Substitute(Entry):
    """Replace PLAYER, who hasn't played yet, with NAME."""

    player: Player
    to: NewName
    rating: Annotated[Rating, Says(usual="a new player's rating")] = None


@dataclass(frozen=True, kw_only=True)
class Swap(Entry):
    """Swap two players in the draw before either has played."""

    one: Annotated[Player, Says(metavar="PLAYER")]
    other: Annotated[Player, Says(metavar="PLAYER2")]


@dataclass(frozen=True, kw_only=True)
class CheckIn(TimedUnderWay):
    """Note that PLAYER is here or has paid."""

    examples = """\
  evenbreak tournament check-in ann --paid yes
"""
    player: Player
    arrived: Annotated[
        bool | None, Field(YES, "Whether the player is here.", usual="yes without {paid}")
    ] = None
    paid: Annotated[bool | None, Field(YES, "Whether the player has paid.", usual="as before")] = (
        None
    )


@dataclass(frozen=True, kw_only=True)
class Accept(TimedUnderWay):
    """Accept NAME, who asked to play or wasn't here for the draw."""

    name: NewName
    unrated: Annotated[bool, Field(Flag(), "Ignore the rating they entered.")] = False


@dataclass(frozen=True, kw_only=True)
class Decline(TimedUnderWay):
    """Decline NAME's request to play."""

    name: NewName


COMMANDS: dict[str, tuple[type[TimedUnderWay], str]] = {
    "draw": (MakeDraw, "Make the draw."),
    "call": (Call, "Call matches to tables."),
    "uncall": (Uncall, "Take a match off its table."),
    "swap-tables": (SwapTables, "Swap the tables of two matches."),
    "wait": (Wait, "Put a match on hold."),
    "result": (EnterResult, "Enter the result of a match."),
    "score": (EnterScore, "Enter the score of a match in play."),
    "correct": (Correct, "Correct the result of a match."),
    "stand": (Stand, "Keep a result even though the wrong player played."),
    "change": (Change, "Change the tables or the remaining races."),
    "undo": (Undo, "Take back the last entry."),
    "redo": (Redo, "Redo an entry that was undone."),
    "late": (LetIn, "Add a late entry."),
    "edit": (Edit, "Correct a name or a rating before the draw."),
    "drop": (Drop, "Withdraw a player."),
    "forfeit": (Forfeit, "Forfeit a match for a player."),
    "rename": (Rename, "Rename a player."),
    "substitute": (Substitute, "Replace a player with a substitute."),
    "swap": (Swap, "Swap two players in the draw."),
    "check-in": (CheckIn, "Note who is here, and who has paid."),
    "accept": (Accept, "Accept a request to play."),
    "decline": (Decline, "Decline a request to play."),
    "tiebreak": (TieBreak, "Break the ties of a round robin."),
}
"""The command of each move: what it asks, and its line in the help of the group."""
