"""The types of value that a field can have: numbers, pairs such as 7:5, choices, files.

A kind parses a string, or rejects it and says how to write it; it also gives the JSON schema. The
terminal and the page use the same kinds, so they have the same limits.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from evenbreak.errors import InputError
from evenbreak.words import say

LONGEST = 1000
"""The most games in a race, a lead or a score."""

BETWEEN = r"[:/\-–—−]"
"""Separators allowed between the two numbers of a race or a score, as a regular expression."""

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
"""A finite number, as a string."""

_SHOWN = 60
"""The longest part of an invalid JSON value that an error message repeats."""

_WHOLE = re.compile(r"[+-]?\d{1,40}", re.ASCII)


class Kind:
    """A type of value."""

    metavar: str
    """The placeholder for a value in help texts."""

    def read(self, text: str) -> Any:
        """Return a string's value, or raise an `InputError` that says how to write it."""
        return text

    def load(self, value: Any) -> Any:
        """Return the value that JSON stands for; reject what `schema` forbids.

        >>> Whole(1, 9).load(7), TwoWhole().load([7, 5]), Choice(("npl", "fargo")).load("npl")
        (7, (7, 5), 'npl')
        """
        if not isinstance(value, str):
            raise InputError("{value} isn't text. Put it in quotes.", value=_as_json(value))
        return self.read(value)

    def words(self, value: Any) -> str:
        """Return a value in typed form."""
        return f"{value:g}" if isinstance(value, float) else str(value)

    def from_afar(self) -> Kind | None:
        """Return the kind for values from other computers; None if they may not give it."""
        return self

    @property
    def limits(self) -> str:
        """The limits in words, such as '1 to 100', or ''."""
        return ""

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema for such a value."""
        return {"type": "string"}


@dataclass(frozen=True)
class Text(Kind):
    """Any text."""

    metavar: str = "TEXT"


@dataclass(frozen=True)
class File(Kind):
    """The name of a file, or one of `names`, which is all that other computers may give."""

    metavar: str = "FILE"
    names: Callable[[], Iterable[str]] | None = None

    def from_afar(self) -> Kind | None:
        """Return the choice of built-in names."""
        return None if self.names is None else Choice(tuple(self.names()))


@dataclass(frozen=True)
class Flag(Kind):
    """Yes or no; no if not given."""

    metavar: str = ""

    def read(self, text: str) -> bool:
        """Return True, unless a string is empty or says no."""
        return text.strip().lower() not in ("", "0", "no", "off", "false")

    def load(self, value: Any) -> bool:
        """Return the value that JSON stands for."""
        if not isinstance(value, bool):
            raise InputError("{value} is neither true nor false", value=_as_json(value))
        return value

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema for such a value."""
        return {"type": "boolean"}


@dataclass(frozen=True)
class Whole(Kind):
    """A whole number from `low` to `high`."""

    low: int = 1
    high: int = LONGEST
    metavar: str = "N"

    def read(self, text: str) -> int:
        """Return the number."""
        typed = text.strip()
        if _WHOLE.fullmatch(typed) and self.low <= int(typed) <= self.high:
            return int(typed)
        raise InputError(
            "{text!r} isn't a whole number from {low} to {high}",
            text=text,
            low=self.low,
            high=self.high,
        )

    def load(self, value: Any) -> int:
        """Return the number that JSON has; 7.0 becomes 7."""
        whole = isinstance(value, float) and value.is_integer()
        return self.read(_number_typed(int(value) if whole else value))

    @property
    def limits(self) -> str:
        """The limits in words; a limit that hardly restricts anything is left out."""
        return f"{self.low:,} to {self.high:,}" if self.high < 10**9 else ""

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema for such a value."""
        return {"type": "integer", "minimum": self.low, "maximum": self.high}


@dataclass(frozen=True)
class Number(Kind):
    """A number from `low` to `high`; `wanted` and `example` complete the error message."""

    low: float = 0.0
    high: float = 1.0
    wanted: str = ""
    example: str = ""
    metavar: str = "X"

    def read(self, text: str) -> float:
        """Return the number; -0 is 0."""
        typed = text.strip()
        number = float(typed) + 0.0 if NUMBER.fullmatch(typed) else math.nan
        if not self.low <= number <= self.high:
            raise InputError(
                "{text!r}{wanted}{hint}",
                text=text,
                wanted=self.wanted or say(" isn't {needed}", needed=self.needed),
                hint=meant(text, self.low, self.high),
            )
        return number

    def load(self, value: Any) -> float:
        """Return the number that JSON has."""
        return self.read(_number_typed(value))

    @property
    def needed(self) -> str:
        """What to write, in words."""
        return say(
            "a number from {low:,.12g} to {high:,.12g}{such}",
            low=self.low,
            high=self.high,
            such=say(", such as {example}", example=self.example) if self.example else "",
        )

    @property
    def limits(self) -> str:
        """The limits in words; limits so wide that they hardly restrict anything are left out."""
        is_plain = (self.low, self.high) == (0.0, 1.0) or abs(self.high) >= 1e5
        return "" if is_plain else f"{self.low:g} to {self.high:g}"

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema for such a value."""
        return {"type": "number", "minimum": self.low, "maximum": self.high}


@dataclass(frozen=True)
class NumberOr(Kind):
    """A number, or a word in place of it.

    >>> kind = NumberOr("best", 0.0, 1e6, "a number of points")
    >>> kind.read("20"), kind.read("best")
    (20.0, 'best')
    """

    word: str = "none"
    low: float = 0.0
    high: float = 1e6
    wanted: str = "a number of points"
    metavar: str = "X"

    def read(self, text: str) -> float | str:
        """Return the number, or the word."""
        if text.strip().lower() == self.word:
            return self.word
        return Number(self.low, self.high, f" isn't {self.wanted}, or {self.word}").read(text)

    def load(self, value: Any) -> float | str:
        """Return the number or the word that JSON has."""
        if isinstance(value, str) and value != self.word:
            raise InputError("{value!r} isn't {wanted}, or {word}", value=value[:_SHOWN],
                             wanted=self.wanted, word=self.word)  # fmt: skip
        return self.read(value if value == self.word else _number_typed(value))

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema for such a value."""
        return {"anyOf": [Number(self.low, self.high).schema(), {"const": self.word}]}


@dataclass(frozen=True)
class TwoWhole(Kind):
    """Two whole numbers with a separator between them, such as 7:5.

    `sign` is a regular expression for the separator; with `one`, a single number may stand for
    both; with `rising`, the second must not be below the first.
    """

    sign: str = BETWEEN
    low: int = 1
    high: int = LONGEST
    wanted: str = ""
    metavar: str = "M:N"
    one: bool = False
    rising: bool = False

    def read(self, text: str) -> tuple[int, int]:
        """Return the two numbers."""
        pattern = rf"\s*(\d{{1,9}})\s*(?:{self.sign}\s*(\d{{1,9}}))?\s*"
        match = re.fullmatch(pattern, text, re.ASCII)
        m, n = (int(match[1]), int(match[2] or match[1])) if match else (-1, -1)
        both = match is not None and (self.one or match[2] is not None)
        within = self.low <= min(m, n) and max(m, n) <= self.high
        if not (both and within) or (self.rising and m > n):
            raise InputError("{text!r} {wanted}", text=text, wanted=self.wanted)
        return m, n

    def load(self, value: Any) -> tuple[int, int]:
        """Return the two numbers that JSON has in a list."""
        limits = Whole(self.low, self.high)
        if not isinstance(value, list) or len(value) != 2:
            raise InputError("{value} isn't a list of two numbers", value=_as_json(value))
        m, n = map(limits.load, value)
        return self.read(self.words((m, n)))

    def words(self, value: tuple[int, int]) -> str:
        """Return a value in typed form."""
        m, n = value
        return f"{m}..{n}" if self.rising else f"{m}:{n}"

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema for such a value."""
        limits = {"type": "integer", "minimum": self.low, "maximum": self.high}
        return {"type": "array", "items": limits, "minItems": 2, "maxItems": 2}


@dataclass(frozen=True)
class Choice(Kind):
    """One of several words; with a mapping, also what each word means to the program."""

    of: tuple[str, ...] | Mapping[str, Any] = ()
    metavar: str = ""

    def read(self, text: str) -> Any:
        """Return the word, or what it means."""
        word = text.strip()
        if word not in self.of:
            words = ", ".join(map(repr, self.of))
            raise InputError("{text!r} isn't one of {words}", text=word, words=words)
        return self.of[word] if isinstance(self.of, Mapping) else word

    def words(self, value: Any) -> str:
        """Return a value in typed form."""
        if isinstance(self.of, Mapping):
            return next((word for word, meaning in self.of.items() if meaning == value), str(value))
        return str(value)

    def load(self, value: Any) -> Any:
        """Return the value that JSON stands for; true and false may stand for yes and no."""
        return value if isinstance(value, bool) and self._is_yes_or_no else super().load(value)

    @property
    def _is_yes_or_no(self) -> bool:
        return isinstance(self.of, Mapping) and {*map(type, self.of.values())} == {bool}

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema for such a value."""
        words = {"type": "string", "enum": list(self.of)}
        return {"anyOf": [{"type": "boolean"}, words]} if self._is_yes_or_no else words


@dataclass(frozen=True)
class Named(Kind):
    """Something that a function reads, such as a scale or a system by name.

    `reader` raises an `InputError`; `offers` is a function in `cli.kit.completion` for the shell;
    `spelled` returns a value in typed form; with `number`, JSON may have it without quotes.
    """

    reader: Callable[[str], Any] = str
    metavar: str = "NAME"
    offers: str = ""
    spelled: Callable[[Any], str] = str
    number: bool = False

    def load(self, value: Any) -> Any:
        """Return the value that JSON stands for."""
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        return super().load(_as_json(value) if self.number and is_number else value)

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema for such a value."""
        return {"type": ["string", "number"] if self.number else "string"}

    def read(self, text: str) -> Any:
        """Return the value that a string stands for."""
        return self.reader(text)

    def from_afar(self) -> Kind | None:
        """Return the kind itself, unless it names a file."""
        return None if self.offers == "files" else self

    def words(self, value: Any) -> str:
        """Return a value in typed form."""
        return self.spelled(value)


def _number_typed(value: Any) -> str:
    """Return a JSON number in typed form; reject anything else."""
    if isinstance(value, str):
        raise InputError("{value} is text. Leave out the quotes.", value=_as_json(value))
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError("{value} isn't a number", value=_as_json(value))
    return _as_json(value)


def _as_json(value: Any) -> str:
    """Return a value in JSON form: a string in quotes, except for numbers."""
    try:
        import json

        text = json.dumps(value, ensure_ascii=False)
    except RecursionError:  # lists in lists without end
        return "…"
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 1]}…"


def meant(text: str, low: float, high: float) -> str:
    """Return how to write a number typed with a decimal comma or as a percentage, or nothing.

    >>> meant("80%", 0, 1), meant("95", 0, 1), meant("24,5", 0, 100), meant("half", 0, 1)
    (' (80% is 0.8)', ' (95% is 0.95)', ' (with a decimal point: 24.5)', '')
    """
    typed = text.strip().replace(",", ".")
    plain = typed.removesuffix("%").rstrip()
    if not NUMBER.fullmatch(plain):
        return ""
    number = float(plain)
    if (low, high) == (0.0, 1.0) and (plain != typed or number >= 10.0):
        inside, x = 0.0 <= number <= 100.0, f"{number / 100.0:.12g}"
        return say(" ({p:.12g}% is {x})", p=number, x=x) if inside else ""
    if "," in text and plain == typed and low <= number <= high:
        return say(" (with a decimal point: {plain})", plain=plain)
    return ""
