"""What happens on a night: entries that are only ever added, and undone and redone by number.

Each rule set has its own kinds of entries: frozen dataclasses, which are stored as JSON.
"""

from __future__ import annotations

import json
import math
import re
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, Generic, NamedTuple, TypeAlias, TypeVar

import msgspec

from evenbreak.errors import InputError
from evenbreak.words import Parameter

Number: TypeAlias = Annotated[int, msgspec.Meta(ge=1, le=1_000_000_000)]
What = TypeVar("What")

PROGRAM = "program: "
"""The prefix of an entry's author if another program made it; the program's name follows."""


@dataclass(frozen=True)
class Event:
    """Something that happened, when (local time, such as 2025-03-01T19:30:00), and who entered it.

    Commands don't say who entered something; their entries are the director's, like the desk's.
    """

    at: str
    what: Any
    by: str = ""

    @property
    def by_phones(self) -> bool:
        """Whether players entered it on their phones."""
        return self.by.startswith("phone")

    @property
    def by_program(self) -> bool:
        """Whether another program entered it, using a token that the director created."""
        return self.by.startswith(PROGRAM)

    @property
    def by_directors(self) -> bool:
        """Whether it was entered at the desk or with a command."""
        return not (self.by_phones or self.by_program)


Entered = TypeVar("Entered", bound=Event)


@dataclass(frozen=True)
class Undone:
    """An entry is undone: the one with a number, or else the last one not undone yet."""

    entry: Number | None = None


@dataclass(frozen=True)
class Redone:
    """An undone entry counts again."""

    entry: Number


class TakenBack(NamedTuple, Generic[Entered]):
    """An undone entry, and the number of the entry that undid it."""

    event: Entered
    by: int


class Log(Generic[Entered]):
    """Entries in order, some undone; the first `fixed` entries can't be.

    >>> log = Log()
    >>> for number, what in enumerate(["a", "b", Undone(), Undone(1), Redone(2)], 1):
    ...     _ = log.take(number, Event("19:30", what))
    >>> [event.what for event in log.kept.values()], list(log.undone)
    (['b'], [1])
    """

    def __init__(self, fixed: int = 0) -> None:
        self.fixed = fixed
        self.kept: dict[int, Entered] = {}
        self.undone: dict[int, TakenBack[Entered]] = {}

    def take(self, number: int, event: Entered) -> int | None:
        """Add an entry; return the number of the entry it undoes or redoes, if any.

        Raises InputError if there is no such entry, or it hasn't been undone.
        """
        match event.what:
            case Undone(entry=entry):
                entry = max(self.kept, default=0) if entry is None else entry
                if entry <= self.fixed or entry not in self.kept:
                    raise InputError("there's nothing to undo")
                self.undone[entry] = TakenBack(self.kept.pop(entry), number)
            case Redone(entry=entry):
                if entry not in self.undone:
                    raise InputError("entry {entry} hasn't been undone", entry=entry)
                self.kept[entry] = self.undone.pop(entry).event
                self.kept = dict(sorted(self.kept.items()))
            case _:
                self.kept[number] = event
                return None
        return entry


class Kinds(Generic[What]):
    """A rule set's kinds of entries, by the names under which they are stored.

    >>> kinds = Kinds({"undone": Undone, "redone": Redone})
    >>> kinds.text(Redone(3)), kinds.read("redone", '{"entry": 3}')
    ('{"entry": 3}', Redone(entry=3))
    >>> kinds.read("redone", '{"entry": "three"}')
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: entry must be a whole number; it is 'three'
    """

    def __init__(self, kinds: Mapping[str, type[What]]) -> None:
        self.kinds = dict(kinds)

    @cached_property
    def names(self) -> dict[type[What], str]:
        """Each kind's name."""
        return {kind: name for name, kind in self.kinds.items()}

    def name(self, what: What) -> str:
        """Return the name of an entry's kind."""
        return self.names[type(what)]

    def text(self, what: What) -> str:
        """Return what happened as JSON."""
        return json.dumps(msgspec.to_builtins(what))

    def read(self, kind: str, text: str) -> What:
        """Return an entry from its kind and JSON; InputError names the invalid field."""
        if kind not in self.kinds:
            raise InputError("{kind!r} isn't a type of entry", kind=kind[:40])
        return read_json(self.kinds[kind], text)


def read_json(kind: type[What], text: str) -> What:
    """Return a class's value from its JSON; raise InputError if a field is missing or invalid."""
    try:
        data = json.loads(text, parse_constant=_lowest)
        json.dumps(data, ensure_ascii=False).encode()  # no half of a letter is in it
    except (ValueError, RecursionError):
        raise InputError("the data is damaged JSON") from None
    try:
        found = msgspec.convert(data, kind)
    except msgspec.ValidationError as error:
        if isinstance(error.__cause__, InputError):  # of the class itself
            raise error.__cause__ from None
        raise _refusal(str(error), data) from None
    if unknown := _unknown(data, msgspec.to_builtins(found)):
        raise InputError("{unknown} isn't known. Leave it out.", unknown=reprlib.repr(unknown))
    return found


def _lowest(text: str) -> float:
    """Return -inf, where the first of some ranges starts; JSON has no other way to write it."""
    if text != "-Infinity":
        raise ValueError(text)
    return -math.inf


def _unknown(data: Any, read: Any) -> str | None:
    """Return the first name in data that wasn't read."""
    if isinstance(data, dict) and isinstance(read, dict):
        each = [key if key not in read else _unknown(one, read[key]) for key, one in data.items()]
    elif isinstance(data, list) and isinstance(read, list | tuple):
        each = [_unknown(*pair) for pair in zip(data, read, strict=False)]
    else:
        return None
    return next(filter(None, each), None)


_PATH = re.compile(r"\.(\w+)|\[(\d+|\.\.\.)\]")
_MISSING = re.compile(r"Object missing required field `(\w+)`")


_WORDS = {
    "`int`": "a whole number",
    "`float`": "a number",
    "`str`": "text",
    "`bool`": "true or false",
    "`array`": "a list",
    "`object`": "names and values",
    " <= ": " up to ",
    " >= ": " from ",
    "Expected ": "",
}


def _wanted(why: str) -> str:
    """Return what would be valid, based on msgspec's error message."""
    said = why.partition(", got")[0]
    for theirs, ours in _WORDS.items():
        said = said.replace(theirs, ours)
    return said.replace("`", "")


def _refusal(why: str, value: Any) -> InputError:
    """Return the error for a rejected value, given the reason and its path."""
    wanted, _, path = why.partition(" - at `$")
    names: list[str] = []
    for name, place in _PATH.findall(path):
        if place.isdigit():
            names.append(str(int(place) + 1))
            value = value[int(place)]
        elif name:
            names.append(name)
            value = value.get(name) if isinstance(value, dict) else value
    if missing := _MISSING.match(wanted):
        names.append(missing[1])
        return InputError("{missing} is missing. Add it.", missing=Parameter(" ".join(names)))
    return InputError(
        "{what} must be {wanted}; it is {shown}",
        what=Parameter(" ".join(names) or "it"),
        shown=reprlib.repr(value),
        wanted=_wanted(wanted),
    )
