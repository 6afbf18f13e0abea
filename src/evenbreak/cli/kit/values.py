"""The values of options: numbers, probabilities, pairs such as 7:5, spans such as 7..13.

Each is a click type: it returns the value of a text, or says how to write it.
"""

from __future__ import annotations

import math
import re
from typing import Any, NoReturn

import click

LONGEST = 1000
"""The most games that a race, a lead or a score can have here."""

MOST_BALLS = 100_000
"""The most balls that an option can name."""

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
"""A finite number, as text."""


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
        found = float(value) if NUMBER.fullmatch(str(value).strip()) else math.nan
        if not self.low <= found <= self.high:
            hint = meant(str(value), self.low, self.high)
            self.fail(f"{str(value)!r}{self.wanted}{hint}", param, ctx)
        return found


CHANCE = Number(0.0, 1.0, " is not a probability; give a number from 0 to 1")


class _TwoWhole(click.ParamType):  # type: ignore[type-arg]
    """Two whole numbers with a sign between them, such as 7:5."""

    name = "pair"

    def __init__(self, sign: str, low: int, wanted: str, *, one: bool = False) -> None:
        self.low, self.wanted, self.one = low, wanted, one
        self.pattern = re.compile(rf"\s*(\d{{1,9}})\s*(?:{sign}\s*(\d{{1,9}}))?\s*", re.ASCII)

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, int]:
        """Return the two numbers."""
        match = self.pattern.fullmatch(value)
        m, n = (int(match[1]), int(match[2] or match[1])) if match else (-1, -1)
        if match is None or not (self.one or match[2]) or not self.fits(m, n):
            self.fail(f"{value!r}; {self.wanted}", param, ctx)
        return m, n

    def fits(self, m: int, n: int) -> bool:
        """Return whether both numbers are within the limits."""
        return self.low <= min(m, n) and max(m, n) <= LONGEST


class _Rising(_TwoWhole):
    def fits(self, m: int, n: int) -> bool:
        return super().fits(m, n) and m <= n


PAIR = _TwoWhole(
    ":",
    1,
    f"give a whole number from 1 to {LONGEST}, such as 7, "
    "or one for each player with a colon between them, such as 7:5",
    one=True,
)
"""The games that each player needs, such as 7:5; 7 alone means 7:7."""

SCORE = _TwoWhole(
    ":",
    0,
    f"give two whole numbers from 0 to {LONGEST} with a colon between them, such as 3:0",
)
"""A score, such as 3:0."""

SPAN = _Rising(
    r"\.\.",
    1,
    f"give the least and the most games, from 1 to {LONGEST}, "
    "with two dots between them, such as 7..13",
)
"""A range of numbers of games, such as 7..13."""


def meant(value: str, low: float, high: float) -> str:
    """Return how to write a number typed with a decimal comma or as a percentage, or nothing.

    >>> meant("80%", 0, 1), meant("95", 0, 1), meant("24,5", 0, 100), meant("half", 0, 1)
    (' (80 % is 0.8)', ' (95 % is 0.95)', ' (with a decimal point: 24.5)', '')
    """
    text = value.strip().replace(",", ".")
    plain = text.removesuffix("%").rstrip()
    if not NUMBER.fullmatch(plain):
        return ""
    found = float(plain)
    if (low, high) == (0.0, 1.0) and (plain != text or found > 1.0):
        return f" ({found:.12g} % is {found / 100.0:.12g})" if 0.0 <= found <= 100.0 else ""
    if "," in value and plain == text and low <= found <= high:
        return f" (with a decimal point: {plain})"
    return ""


def refuse(message: str) -> NoReturn:
    """End the command with exit code 2; the message says how to correct it."""
    raise click.UsageError(message, ctx=click.get_current_context(silent=True))
