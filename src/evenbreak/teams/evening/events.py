"""What happens on a team night: events, which are only ever added.

An event is a frozen value; `as_dict` and `event_of` turn it into plain data and back.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, TypeAlias

from evenbreak.errors import InputError
from evenbreak.teams.evening.plan import NightPlan, TeamSheet

Pick: TypeAlias = tuple[str, ...]
"""Who plays a set: one player, or the pair of a doubles set."""

Score: TypeAlias = tuple[int, int]
"""The games of team A and team B."""


@dataclass(frozen=True)
class Begun:
    """A night begins; one that was under way is put aside."""

    plan: NightPlan


@dataclass(frozen=True)
class PutUp:
    """A team (0: A, 1: B) puts up a pick in a set, counted from 1."""

    team: int
    number: int
    pick: Pick


@dataclass(frozen=True)
class HandedIn:
    """A team hands in its whole line-up, where line-ups are sealed."""

    team: int
    picks: tuple[Pick, ...]


@dataclass(frozen=True)
class Proposed:
    """A team says how a set ended; it counts once the other says the same."""

    team: int
    number: int
    score: Score


@dataclass(frozen=True)
class Result:
    """The director says how a set ended, for the first time or as a correction."""

    number: int
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


def event_of(kind: str, data: Mapping[str, Any]) -> What:
    """Return what happened from plain data.

    Raises
    ------
    InputError
        if it is no event.

    >>> event_of("handed in", {"team": 1, "picks": [["Cy"], ["Di"]]})
    HandedIn(team=1, picks=(('Cy',), ('Di',)))
    """
    try:
        values = {name: _frozen(value) for name, value in data.items()}
        if kind == "begun":
            plan = dict(values["plan"])
            teams = tuple(
                TeamSheet(**{name: _frozen(value) for name, value in team.items()})
                for team in plan.pop("teams")
            )
            plan = {name: _frozen(value) for name, value in plan.items()}
            return Begun(NightPlan(teams, **plan))  # type: ignore[arg-type]
        make: Any = KINDS[kind]
        made: What = make(**values)
        return made
    except (AttributeError, KeyError, TypeError) as error:
        raise InputError(f"{kind!r} with {data!r} is not an event of a team night") from error


def _frozen(value: Any) -> Any:
    return tuple(map(_frozen, value)) if isinstance(value, list) else value
