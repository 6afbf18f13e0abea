"""What happens on a tournament evening: events, which are only ever added.

An event is a frozen value; `KINDS` turns it into JSON and back.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Annotated, Any, TypeAlias

from msgspec import Meta

from evenbreak.evenings import log
from evenbreak.evenings.log import Kinds
from evenbreak.evenings.log import Redone as Redone
from evenbreak.evenings.log import Undone as Undone
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.matches.form import MOST_FORM
from evenbreak.ratings.scale import DEFAULT_SCALE
from evenbreak.tournaments.brackets.drafts import Draft
from evenbreak.tournaments.chips.chip_charts import ChipChart
from evenbreak.tournaments.clock.event_pace import EarlierNight
from evenbreak.tournaments.evening.format import (
    Discipline,
    Format,
    Occasion,
    Race,
    Slower,
    Table,
)
from evenbreak.words import Sentence, race, say, tally

Games: TypeAlias = Annotated[int, Meta(ge=0, le=10_000)]
Seat: TypeAlias = Annotated[int, Meta(ge=0, le=255)]
Points: TypeAlias = Annotated[float, Meta(ge=-1_000_000, le=1_000_000)]
Error: TypeAlias = Annotated[float, Meta(ge=0, le=1_000_000)]


BY_ITSELF = "by itself"
"""The author stored with calls that follow from a result."""


@dataclass(frozen=True)
class Plan(Format, Occasion):
    """What is played: the format, the races, the tables; and the occasion.

    `form` is double, single, pods, consolation, groups, round-robin, swiss, king-of-the-hill,
    chips, or the format of a bracket from another program, in words; that bracket is in `layout`.
    `final`, `drops` and `third_place` are as in `double_elimination` and `single_elimination`;
    `qualifiers` is the number from a double elimination, or from each group or pod, paired by
    `placement`: half shift or redraw. `knockout_size` is how many advance from all groups together,
    and `pod_size` is the number of lines in a pod. `seeding` is listed, rating, blind or drawn.
    `handicapped`: the stronger player needs `race` games, the weaker gets the fairest number; with
    a `chart`, `race` isn't used. `starter` is a new player's rating, and `starter_error` its
    standard error. `earlier` nights at this venue set the pace. `match_form` is the standard
    deviation of a game's log-odds from match to match.
    """

    form: str
    race: Race
    seeding: str = "listed"
    handicapped: bool = False
    chart: Chart | None = field(default=None, hash=False)
    scale: str = DEFAULT_SCALE
    starter: Points = 0.0
    starter_error: Error = 0.0
    discipline: Discipline = "9-ball"
    layout: tuple[Draft, ...] = ()
    by_match: Mapping[str, Race] = field(default_factory=dict, hash=False)
    chips: ChipChart | None = field(default=None, hash=False)
    earlier: tuple[EarlierNight, ...] = ()
    match_form: Annotated[float, Meta(ge=0, le=MOST_FORM)] = 0.0

    def at_tables_of(self, house: Occasion) -> Plan:
        """Return the plan with another plan's tables, table names and pace."""
        names = [one.name for one in fields(Occasion) if one.name not in ("name", "date")]
        return replace(self, **{name: getattr(house, name) for name in names})

    def newcomer(self, name: str) -> Entrant:
        """Return a player whose rating isn't known."""
        return Entrant(name, self.starter, self.starter_error, provisional=True)


@dataclass(frozen=True)
class Entrant:
    """A player with a rating, its error, and whether it is based on too few games."""

    name: str
    rating: Points
    standard_error: Error = 0.0
    provisional: bool = False


@dataclass(frozen=True)
class Opened:
    """The evening starts: what is played, and who has entered."""

    plan: Plan
    entrants: tuple[Entrant, ...]


@dataclass(frozen=True)
class Drawn:
    """The draw: the players in seed order; other entrants go on the list of late players.

    For an elimination, it also has the position of the player on each first-round line (None: bye).
    """

    order: tuple[str, ...]
    lines: tuple[Seat | None, ...] | None


@dataclass(frozen=True)
class Late:
    """A late entry: before the draw, onto a bye's line, or to the end of a line of players."""

    entrant: Entrant
    line: Seat | None = None


@dataclass(frozen=True)
class Edited:
    """A new name or rating before the draw; the player, found by `name`, keeps their place."""

    name: str
    entrant: Entrant


@dataclass(frozen=True)
class Renamed:
    """A player's correct name, at any time: everything entered before is read with it."""

    name: str
    to: str


@dataclass(frozen=True)
class Substituted:
    """Someone replaces a player who hasn't played yet."""

    name: str
    entrant: Entrant


@dataclass(frozen=True)
class Swapped:
    """Two players trade places in the draw, before a match of either has started."""

    one: str
    other: str


@dataclass(frozen=True)
class CheckedIn:
    """Whether a player is here, and whether they have paid; None: unchanged."""

    name: str
    arrived: bool | None = None
    paid: bool | None = None


@dataclass(frozen=True)
class Registered:
    """Someone wants to play: accepted like a late entry, or declined."""

    name: str
    rating: Points | None = None


@dataclass(frozen=True)
class Declined:
    """Someone who wanted to play no longer does."""

    name: str


@dataclass(frozen=True)
class Dropped:
    """A player goes home; their remaining matches are lost by forfeit."""

    name: str


@dataclass(frozen=True)
class Called:
    """A match is called to a table."""

    match: str
    table: Table
    players: tuple[str, str]


@dataclass(frozen=True)
class CalledBack:
    """A match is taken off its table before it is over; its score is kept."""

    match: str
    players: tuple[str, str]


@dataclass(frozen=True)
class Waits:
    """A match waits until it is called, or until another `Waits` without a reason.

    `absent` players forfeit it at the time `until` ('': they don't).
    """

    match: str
    players: tuple[str, str]
    absent: tuple[str, ...] = ()
    until: str = ""
    reason: str = ""

    def __bool__(self) -> bool:
        """Whether it waits; otherwise, it no longer waits."""
        return bool(self.absent or self.until or self.reason)


@dataclass(frozen=True)
class Scored:
    """The score of a match in play."""

    match: str
    players: tuple[str, str]
    score: tuple[Games, Games]


@dataclass(frozen=True)
class Result:
    """A match was played by these players, or forfeited by the loser (with the score 0:0).

    A correction is a result too: if a match has two results with the same players, the later one
    counts. After a correction, the director may let matches played since then stand: in that case,
    `winner` is the player who moved on, even though the score says otherwise. `race` is the games
    each player needed, if they differ from the plan's: with another program's head starts, for
    example. `ended` says why the race wasn't played out: "time" or "conceded"; "": it was.
    """

    match: str
    players: tuple[str, str]
    score: tuple[Games, Games]
    winner: str
    forfeit: bool = False
    corrects: bool = False
    stands: bool = False
    race: tuple[Race, Race] | None = None
    ended: str = ""

    @property
    def loser(self) -> str:
        """The loser."""
        return self.players[self.winner == self.players[0]]

    @property
    def games(self) -> dict[str, int]:
        """The games each player won."""
        return dict(zip(self.players, self.score, strict=True))


@dataclass(frozen=True)
class Ranked:
    """A tie was broken: a group's players in their final order."""

    group: str
    order: tuple[str, ...]


@dataclass(frozen=True)
class LaterDraw:
    """Something was drawn during the evening.

    The stage is R1, R2, ... for a Swiss round, whose order is the players in pairs (None: a bye),
    or K1 for the losers'-side qualifiers in a knockout: the matches they come from, in the order of
    the matches they go into.
    """

    stage: str
    order: tuple[str | None, ...]


@dataclass(frozen=True)
class Changed:
    """A different part of the plan from now on; None: unchanged.

    Races change in the matches that have not started.
    """

    tables: Table | None = None
    race: Race | None = None
    losers_race: Race | None = None
    final_race: Race | None = None
    name: str | None = None
    date: str | None = None
    labels: tuple[str, ...] | None = None
    reserved: tuple[Table, ...] | None = None
    streamed: tuple[Table, ...] | None = None
    slower: Slower | None = None


What: TypeAlias = (
    Opened
    | Drawn
    | Late
    | Edited
    | Renamed
    | Substituted
    | Swapped
    | CheckedIn
    | Registered
    | Declined
    | Dropped
    | Called
    | CalledBack
    | Waits
    | Scored
    | Result
    | Ranked
    | Changed
    | LaterDraw
    | Undone
    | Redone
)
KINDS: Kinds[What] = Kinds(
    {
        "opened": Opened,
        "drawn": Drawn,
        "late": Late,
        "edited": Edited,
        "renamed": Renamed,
        "substituted": Substituted,
        "swapped": Swapped,
        "checked in": CheckedIn,
        "registered": Registered,
        "declined": Declined,
        "dropped": Dropped,
        "called": Called,
        "called back": CalledBack,
        "waits": Waits,
        "scored": Scored,
        "result": Result,
        "ranked": Ranked,
        "later draw": LaterDraw,
        "changed": Changed,
        "undone": Undone,
        "redone": Redone,
    }
)
"""What can happen, each kind by the name under which it is stored."""


@dataclass(frozen=True)
class Event(log.Event):
    """Something that happened in a tournament."""

    what: What


def score_words(found: Result, needs: tuple[int, int] | None = None) -> Sentence:
    """Return a result in words, including the players' targets if they differ.

    >>> score_words(Result("W1.1", ("Ann", "Bo"), (5, 7), "Bo"))
    'Bo beat Ann 7-5'
    >>> score_words(Result("W1.1", ("Ann", "Bo"), (3, 2), "Ann", ended="time"))
    'Ann beat Bo 3-2 on time'
    >>> score_words(Result("W1.1", ("Ann", "Bo"), (2, 2), "Bo"), (4, 2))
    'Bo beat Ann 2-2 (race 2:4)'
    """
    names: dict[str, Any] = {"winner": found.winner, "loser": found.loser}
    if found.forfeit:
        return say("{loser} forfeited to {winner}", **names)
    if found.stands:
        beaten = replace(found, winner=found.loser, stands=False)
        return say(
            "{result}, but {winner} keeps the winner's place",
            result=score_words(beaten, needs),
            **names,
        )
    if needs is not None and needs[0] != needs[1] and not found.ended:
        each = dict(zip(found.players, needs, strict=True))
        played = race_words((each[found.winner], each[found.loser]))
        even = score_words(found)
        return say("{result} ({race})", result=even, race=played)
    names["score"] = tally((found.games[found.winner], found.games[found.loser]))
    if found.ended == "time":
        return say("{winner} beat {loser} {score} on time", **names)
    if found.ended:
        return say("{loser} conceded to {winner} at {score}", **names)
    return say("{winner} beat {loser} {score}", **names)


def race_words(needs: tuple[int, int]) -> Sentence:
    """Return a race in words.

    >>> race_words((7, 7)), race_words((7, 5))
    ('race to 7', 'race 7:5')
    """
    if needs[0] == needs[1]:
        return say("race to {n}", n=needs[0])
    return say("race {race}", race=race(needs))
