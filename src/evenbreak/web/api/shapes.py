"""The API's answers about tonight: dataclasses that define the JSON and its schema."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal, TypeAlias

from msgspec import Meta

Chance: TypeAlias = Annotated[float, Meta(ge=0, le=1)]
Number: TypeAlias = Annotated[
    str, Meta(pattern="^[0-9]+$", description="The match number that people use.", examples=["12"])
]
When: TypeAlias = Annotated[
    str,
    Meta(
        pattern=r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d$",
        description="Local time.",
        examples=["2026-03-01T19:40:00"],
    ),
]
EventNumber: TypeAlias = Annotated[
    int, Meta(ge=1, le=99, description="The event's number that night.")
]
Stage: TypeAlias = Annotated[
    Literal["registered", "under_way", "finished"],
    Meta(description="registered: the draw hasn't been made yet."),
]
State: TypeAlias = Annotated[
    Literal["waits", "ready", "called", "playing", "done", "forfeit"],
    Meta(
        description="waits: its players aren't known yet; ready: it is waiting for a table; "
        "called: its players are on their way to the table."
    ),
]
Known: TypeAlias = Annotated[
    bool,
    Meta(
        description="False if this hasn't been worked out yet (ask again in a few "
        "seconds), or if there is nothing left to play."
    ),
]
Older: TypeAlias = Annotated[
    bool, Meta(description="Whether this was worked out before the last entry.")
]


@dataclass(frozen=True)
class Times:
    """When something happens: eight times out of ten, between early and late."""

    early: When
    middle: When
    late: When


@dataclass(frozen=True)
class Side:
    """A player in a match."""

    name: Annotated[str, Meta(description="'' until the player is known.")]
    comes_from: Annotated[
        str,
        Meta(
            description="Where a player who isn't known yet will come from.",
            examples=["winner of 12"],
        ),
    ]
    needs: Annotated[
        int | None,
        Meta(
            description="How many games this player needs to win the match; null "
            "until the race is known."
        ),
    ]
    games: Annotated[int | None, Meta(description="Games won so far; null before the first score.")]
    won: bool
    chance: Annotated[
        Chance | None, Meta(description="The chance of winning the match from the current score.")
    ]


@dataclass(frozen=True)
class Match:
    """A match in the bracket, or a rack in a chip tournament."""

    number: Number
    name: Annotated[
        str,
        Meta(
            description="The match's name in the file and in the stream of changes.",
            examples=["W1.2"],
        ),
    ]
    event: EventNumber
    part: Annotated[str, Meta(description="The part of the bracket.", examples=["Winners"])]
    round: Annotated[str, Meta(examples=["Quarterfinals"])]
    column: Annotated[int, Meta(ge=0, description="The round's place among `rounds` of its part.")]
    players: Annotated[tuple[Side, Side], Meta(description="The match's two players.")]
    state: State
    hill_hill: Annotated[bool, Meta(description="Whether both need one more game.")]
    disputed: Annotated[bool, Meta(description="Whether the players have sent different scores.")]
    table: Annotated[
        str, Meta(description="The house's name for the table; '' if the match isn't on one.")
    ]
    called: When | None
    ended: When | None
    starts: Annotated[Times | None, Meta(description="When the match is expected to start.")]
    winner_to: Annotated[Number | None, Meta(description="The winner's next match.")]
    loser_to: Annotated[Number | None, Meta(description="The loser's next match.")]


@dataclass(frozen=True)
class Player:
    """A player in the tournament."""

    name: str
    rating: float
    provisional: Annotated[bool, Meta(description="Whether the rating rests on too few games.")]
    arrived: bool


@dataclass(frozen=True)
class Event:
    """One of the night's events."""

    event: EventNumber
    name: str
    format: Annotated[str, Meta(examples=["double"])]
    state: Stage


@dataclass(frozen=True)
class Tonight(Event):
    """A tournament: what is played, by whom, and what is on the tables."""

    format_words: Annotated[str, Meta(examples=["double elimination"])]
    races: Annotated[str, Meta(description="The races, in words.")]
    discipline: Annotated[str, Meta(examples=["9-ball"])]
    scale: Annotated[str, Meta(description="The scale of the ratings.", examples=["fargo"])]
    date: Annotated[str, Meta(description="The date the director has set; '' if there is none.")]
    begun: Annotated[When, Meta(description="When the tournament was started on the page.")]
    matches: Annotated[int, Meta(description="How many matches the tournament will have.")]
    played: Annotated[int, Meta(description="How many matches are over.")]
    champion: Annotated[str, Meta(description="'' until it is over.")]
    players: list[Player]
    under_way: Annotated[list[Match], Meta(description="The matches on the tables.")]
    events: Annotated[list[Event], Meta(description="All of the night's events.")]


@dataclass(frozen=True)
class Part:
    """A part of the bracket: a side, a group, or a list of matches."""

    title: Annotated[str, Meta(examples=["Winners"])]
    linked: Annotated[
        bool, Meta(description="Whether winners move on from one column to the next.")
    ]
    rounds: Annotated[list[str], Meta(description="The heading of each column.")]
    matches: Annotated[
        list[Match], Meta(description="The matches of each column, from top to bottom.")
    ]


@dataclass(frozen=True)
class Bracket(Event):
    """The whole bracket, with everything needed to draw it."""

    races: Annotated[str, Meta(description="The races, in words.")]
    champion: Annotated[str, Meta(description="'' until it is over.")]
    parts: Annotated[list[Part], Meta(description="Empty before the draw.")]


@dataclass(frozen=True)
class Matches:
    """The matches by number."""

    event: EventNumber
    state: Stage
    matches: list[Match]


@dataclass(frozen=True)
class Table:
    """One of the venue's tables."""

    name: str
    number: Annotated[int, Meta(ge=1)]
    state: Literal["free", "called", "playing"]
    reserved: Annotated[bool, Meta(description="Whether the table is only assigned by hand.")]
    streamed: Annotated[bool, Meta(description="Whether the table is on the stream.")]
    match: Annotated[Match | None, Meta(description="The match on this table.")]
    next: Annotated[
        Match | None, Meta(description="The match that would be called to this table now.")
    ]


@dataclass(frozen=True)
class Tables:
    """The venue's tables, for all the night's events."""

    tables: list[Table]


@dataclass(frozen=True)
class Waiting:
    """A match that can be called now."""

    match: Match
    table: Annotated[
        str, Meta(description="The free table the match would get; '' if none is free.")
    ]


@dataclass(frozen=True)
class Queue:
    """The matches that can be called now, next one first, for all the night's events."""

    queue: list[Waiting]


@dataclass(frozen=True)
class PlaceChance:
    """A place and its chance."""

    place: Annotated[str, Meta(examples=["5-6"])]
    chance: Chance


@dataclass(frozen=True)
class PlayerOdds:
    """A player's chances."""

    name: str
    title: Annotated[Chance, Meta(description="The chance of winning the tournament.")]
    title_low: Annotated[
        Chance | None,
        Meta(description="For a new player, the low end of the range the chance may be in."),
    ]
    title_high: Chance | None
    places: Annotated[
        list[PlaceChance], Meta(description="The places the player can still finish in.")
    ]


@dataclass(frozen=True)
class Odds:
    """Everyone's chances of each place, from here on."""

    event: EventNumber
    known: Known
    older: Older
    exact: Annotated[bool, Meta(description="Whether the odds are exact rather than simulated.")]
    players: Annotated[list[PlayerOdds], Meta(description="The most likely winner first.")]


@dataclass(frozen=True)
class Finish:
    """When the event ends."""

    event: EventNumber
    state: Stage
    known: Known
    older: Older
    ends: Annotated[Times | None, Meta(description="null until it is known.")]
    matches: int
    played: int


@dataclass(frozen=True)
class Placed:
    """Who has finished where."""

    place: Annotated[str, Meta(examples=["5-6"])]
    name: str
    prize: Annotated[float, Meta(ge=0, description="0 if there is none.")]


@dataclass(frozen=True)
class Rank:
    """A player in a group, a Swiss or a chip tournament."""

    rank: Annotated[int, Meta(ge=1, description="Tied players have the same rank.")]
    name: str
    won: Annotated[int, Meta(description="Matches won; in a Swiss, as of the last finished round.")]
    lost: Annotated[int, Meta(description="Matches lost.")]
    buchholz: Annotated[
        int | None, Meta(description="The Buchholz score in a Swiss; null in other formats.")
    ]
    chips: Annotated[
        int | None, Meta(description="Chips left in a chip tournament; null in other formats.")
    ]


@dataclass(frozen=True)
class Group:
    """A group's players, best first."""

    title: str
    players: list[Rank]


@dataclass(frozen=True)
class Standings:
    """Who has finished where, and the group standings."""

    event: EventNumber
    state: Stage
    places: Annotated[list[Placed], Meta(description="The places decided so far.")]
    groups: list[Group]


@dataclass(frozen=True)
class Rating:
    """A player's rating."""

    name: str
    rating: Annotated[float, Meta(description="The rating as it was entered.")]
    error: Annotated[
        float, Meta(ge=0, description="The rating's standard error; 0 if the rating is exact.")
    ]
    provisional: bool
    tonight: Annotated[
        float | None, Meta(description="The rating as adjusted for tonight's games.")
    ]


@dataclass(frozen=True)
class Ratings:
    """The ratings, highest first; players with few games come last."""

    event: EventNumber
    scale: Annotated[str, Meta(examples=["fargo"])]
    players: list[Rating]


@dataclass(frozen=True)
class Racer:
    """A player in a race."""

    name: str
    rating: Annotated[float, Meta(description="The rating as adjusted for tonight's games.")]
    needs: Annotated[int, Meta(ge=1, description="Games.")]
    chance: Chance


@dataclass(frozen=True)
class Race:
    """What two players would race to in this tournament, and their chances."""

    event: EventNumber
    a: Racer
    b: Racer


@dataclass(frozen=True)
class TeamSet:
    """A set in a team night."""

    number: Annotated[int, Meta(ge=1)]
    players: Annotated[
        tuple[str, str], Meta(description="'' until the player is known and may be shown.")
    ]
    needs: tuple[int, int] | None
    score: tuple[int, int] | None


@dataclass(frozen=True)
class TeamNight:
    """A night between two teams, as everyone at the venue sees it."""

    teams: tuple[str, str]
    sets: list[TeamSet]
    chances: Annotated[
        tuple[Chance, Chance] | None,
        Meta(description="Each team's chance of winning the night; null until it is known."),
    ]
    over: bool
