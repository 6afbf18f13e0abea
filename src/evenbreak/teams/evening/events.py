"""What happens on a team night: events, which are only ever added.

An event is a frozen value; `as_dict` and `event_of` turn it into plain data and back.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Annotated, Any, TypeAlias

from evenbreak.checks import Between, made
from evenbreak.errors import InputError
from evenbreak.teams.evening.plan import NightPlan

Pick: TypeAlias = tuple[str, ...]
"""Who plays a set: one player, or the pair of a doubles set."""

Team: TypeAlias = Annotated[int, Between(0, 1)]
Number: TypeAlias = Annotated[int, Between(1, 100)]
Games: TypeAlias = Annotated[int, Between(0, 10_000)]

Score: TypeAlias = tuple[Games, Games]
"""The games of team A and team B."""


@dataclass(frozen=True)
class Begun:
    """A night begins; one that was under way is put aside."""

    plan: NightPlan


@dataclass(frozen=True)
class PutUp:
    """A team (0: A, 1: B) puts up a pick in a set, counted from 1."""

    team: Team
    number: Number
    pick: Pick


@dataclass(frozen=True)
class HandedIn:
    """A team hands in its whole line-up, where line-ups are sealed."""

    team: Team
    picks: tuple[Pick, ...]


@dataclass(frozen=True)
class Proposed:
    """A team says how a set ended; it counts once the other says the same."""

    team: Team
    number: Number
    score: Score


@dataclass(frozen=True)
class Result:
    """The director says how a set ended, for the first time or as a correction."""

    number: Number
    score: Score


@dataclass(frozen=True)
class Undone:
    """The last event that has not been undone yet is undone."""


What: TypeAlias = Begun | PutUp | HandedIn | Proposed | Result | Undone
KINDS: dict[str, type[What]] = {
    "begun": Begun,
    "put up": PutUp,
    "handed in": HandedIn,
    "proposed": Proposed,
    "result": Result,
    "undone": Undone,
}
NAMES = {kind: name for name, kind in KINDS.items()}


@dataclass(frozen=True)
class Event:
    """Something that happened, when (such as 2025-03-01T19:30:00), and who entered it."""

    at: str
    what: What
    by: str = ""


def as_dict(what: What) -> dict[str, Any]:
    """Return what happened as plain data.

    >>> as_dict(PutUp(0, 2, ("Ann",)))
    {'team': 0, 'number': 2, 'pick': ('Ann',)}
    """
    return asdict(what)


def event_of(kind: str, data: Any) -> What:
    """Return what happened from plain data.

    Raises
    ------
    InputError
        if it is no event; the message names the field.

    >>> event_of("handed in", {"team": 1, "picks": [["Cy"], ["Di"]]})
    HandedIn(team=1, picks=(('Cy',), ('Di',)))
    """
    if kind not in KINDS:
        raise InputError("{kind!r} is not an entry of a team night", kind=kind[:40])
    return made(KINDS[kind], data)
