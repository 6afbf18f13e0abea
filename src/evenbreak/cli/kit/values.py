"""The values of options: numbers, probabilities, pairs such as 7:5, spans such as 7..13.

Each is a click type: it returns the value of a text, or says how to write it.
"""

import math
import re
from collections.abc import Callable
from typing import Any, NoReturn

import click

from evenbreak.cli.kit.said import said
from evenbreak.matches.formats import BETWEEN, LONGEST
from evenbreak.words import say

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
"""A finite number, as text."""


def number_of(text: str) -> float:
    """Return the number that a text means; -0 is 0.

    >>> number_of("1.5"), number_of("-0")
    (1.5, 0.0)
    """
    return float(text) + 0.0


class Whole(click.IntRange):
    """A whole number from `min` to `max`."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number."""
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            wanted = f"give a whole number from {self.min} to {self.max}"
            self.fail(f"{str(value)!r}; {wanted}", param, ctx)


class Number(click.ParamType):  # type: ignore[type-arg]
    """A number from `low` to `high`; `wanted` completes the message that refuses a value."""

    name = "number"

    def __init__(self, low: float, high: float, wanted: str) -> None:
        self.low, self.high, self.wanted = low, high, wanted

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Return the number."""
        if isinstance(value, float):  # a default
            return value
        found = number_of(value) if NUMBER.fullmatch(str(value).strip()) else math.nan
        if not self.low <= found <= self.high:
            hint = meant(str(value), self.low, self.high)
            self.fail(f"{str(value)!r}{self.wanted}{hint}", param, ctx)
        return found


SHARE = Number(0.0, 1.0, "; give a number from 0 to 1")
"""A number from 0 to 1 that is no probability."""


class TwoWhole(click.ParamType):  # type: ignore[type-arg]
    """Two whole numbers with a sign between them, such as 7:5."""

    name = "pair"

    def __init__(
        self,
        sign: str,
        low: int,
        most: int,
        wanted: str,
        *,
        one: bool = False,
        rising: bool = False,
    ) -> None:
        self.low, self.most, self.wanted, self.one, self.rising = low, most, wanted, one, rising
        self.pattern = re.compile(rf"\s*(\d{{1,9}})\s*(?:{sign}\s*(\d{{1,9}}))?\s*", re.ASCII)

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, int]:
        """Return the two numbers."""
        match = self.pattern.fullmatch(value)
        m, n = (int(match[1]), int(match[2] or match[1])) if match else (-1, -1)
        both = match is not None and (self.one or match[2] is not None)
        within = self.low <= min(m, n) and max(m, n) <= self.most
        if not (both and within) or (self.rising and m > n):
            self.fail(f"{value!r}; {self.wanted}", param, ctx)
        return m, n


SCORE = TwoWhole(
    BETWEEN,
    0,
    LONGEST,
    f"give two whole numbers from 0 to {LONGEST} with a colon between them, such as 3:0",
)
"""A score: 3:0, 3-0 or 3/0."""


SPAN = TwoWhole(
    r"\.\.",
    1,
    LONGEST,
    f"give the least and the most games, from 1 to {LONGEST}, "
    "with two dots between them, such as 7..13",
    rising=True,
)
"""A range of numbers of games, such as 7..13."""


def numbers(
    sign: str, counts: range, low: float, high: float, wanted: str
) -> Callable[[str], tuple[float, ...]]:
    """Return a reader of so many numbers from low to high, with a sign between them."""

    def read(value: str) -> tuple[float, ...]:
        parts = [part.strip() for part in re.split(sign, value)]
        found = tuple(number_of(part) for part in parts if NUMBER.fullmatch(part))
        fit = all(low <= number <= high for number in found)
        if len(parts) not in counts or len(found) < len(parts) or not fit:
            raise click.BadParameter(f"{value!r}; {wanted}")
        return found

    return read


def meant(value: str, low: float, high: float) -> str:
    """Return how to write a number typed with a decimal comma or as a percentage, or nothing.

    >>> meant("80%", 0, 1), meant("95", 0, 1), meant("24,5", 0, 100), meant("half", 0, 1)
    (' (80% is 0.8)', ' (95% is 0.95)', ' (with a decimal point: 24.5)', '')
    """
    text = value.strip().replace(",", ".")
    plain = text.removesuffix("%").rstrip()
    if not NUMBER.fullmatch(plain):
        return ""
    found = float(plain)
    if (low, high) == (0.0, 1.0) and (plain != text or found >= 10.0):
        return f" ({found:.12g}% is {found / 100.0:.12g})" if 0.0 <= found <= 100.0 else ""
    if "," in value and plain == text and low <= found <= high:
        return f" (with a decimal point: {plain})"
    return ""


def refuse(template: str, /, **values: Any) -> NoReturn:
    """End the command with exit code 2; the message says how to correct it, as errors do."""
    message = said(say(template, **values) if values else template)
    raise click.UsageError(message, ctx=click.get_current_context(silent=True))
