"""What people type: pairs such as 7:5, spans such as 7..13, chances, negative ratings.

`pair`, `score`, `span` and `chance` are callbacks of click options: they read the text of
an option and return its value, or None where the option is absent.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from typing import Any, NoReturn, TypeVar

import click

Command = TypeVar("Command", bound=Callable[..., Any])

LONGEST = 1000
"""The most games that a race, a lead or a score can have here."""

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
"""What reads as a finite number."""


class Whole(click.IntRange):
    """A whole number from `min` to `max`, refused in the words of the other refusals."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number that was typed."""
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            wanted = f"give a whole number from {self.min} to {self.max}"
            self.fail(f"{str(value)!r}; {wanted}", param, ctx)


class PlainCommand(click.Command):
    """A command that reads -20 as a number, where click alone sees an unknown option."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments; what only looked like a number is refused here."""
        ctx.ignore_unknown_options = any(
            word.startswith("-") and NUMBER.fullmatch(word) for word in args
        )
        rest = super().parse_args(ctx, args)
        words: Sequence[str] = ctx.params.get("ratings", ())
        for word in words:
            if NUMBER.fullmatch(word):
                continue
            if word.startswith("-"):
                known = [name for option in self.params for name in option.opts]
                raise click.NoSuchOption(word.split("=")[0], possibilities=known, ctx=ctx)
            wanted = "give two numbers, such as 612 521"
            refuse(f"{word!r} is not a rating; {wanted}{meant(word, -math.inf, math.inf)}")
        return rest


def pair(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[int, int] | None:
    """Return what each player needs, such as 7:5; 7 alone is 7:7."""
    if value is None:
        return None
    match = re.fullmatch(r"\s*(\d{1,9})(?:\s*:\s*(\d{1,9}))?\s*", value, re.ASCII)
    if match:
        m = int(match[1])
        n = int(match[2] or m)
        if min(m, n) >= 1 and max(m, n) <= LONGEST:
            return m, n
    raise click.BadParameter(
        f"{value!r}; give a whole number from 1 to {LONGEST}, such as 7, "
        "or one for each player with a colon between them, such as 7:5",
        ctx=ctx,
        param=param,
    )


def score(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[int, int] | None:
    """Return the two whole numbers of a score, such as 3:0."""
    if value is None:
        return None
    match = re.fullmatch(r"\s*(\d{1,9})\s*:\s*(\d{1,9})\s*", value, re.ASCII)
    if match and max(int(match[1]), int(match[2])) <= LONGEST:
        return int(match[1]), int(match[2])
    raise click.BadParameter(
        f"{value!r}; give two whole numbers from 0 to {LONGEST} "
        "with a colon between them, such as 3:0",
        ctx=ctx,
        param=param,
    )


def span(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[int, int] | None:
    """Return the two whole numbers of a span, such as 7..13."""
    if value is None:
        return None
    match = re.fullmatch(r"\s*(\d{1,9})\s*\.\.\s*(\d{1,9})\s*", value, re.ASCII)
    if match:
        low, high = int(match[1]), int(match[2])
        if 1 <= low <= high <= LONGEST:
            return low, high
    raise click.BadParameter(
        f"{value!r}; give the least and the most games, from 1 to {LONGEST}, "
        "with two dots between them, such as 7..13",
        ctx=ctx,
        param=param,
    )


def chance(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    """Return a probability."""
    if value is None:
        return None
    wanted = " is not a probability; give a number from 0 to 1"
    return number(value, 0.0, 1.0, wanted, ctx=ctx, param=param)


def number(
    value: str,
    low: float,
    high: float,
    wanted: str,
    *,
    ctx: click.Context | None = None,
    param: click.Parameter | None = None,
) -> float:
    """Return the number from `low` to `high` that a word is, or refuse it as not `wanted`."""
    found = float(value) if NUMBER.fullmatch(value.strip()) else math.nan
    if not low <= found <= high:
        raise click.BadParameter(
            f"{value!r}{wanted}{meant(value, low, high)}",
            ctx=ctx or click.get_current_context(silent=True),
            param=param,
        )
    return found


def meant(value: str, low: float, high: float) -> str:
    """Return what to write where a decimal comma or percent was meant, else nothing.

    >>> meant("80%", 0, 1), meant("95", 0, 1), meant("24,5", 0, 100), meant("half", 0, 1)
    (' (80% is 0.8)', ' (95% is 0.95)', ' (with a decimal point: 24.5)', '')
    """
    text = value.strip().replace(",", ".")
    plain = text.removesuffix("%").rstrip()
    if not NUMBER.fullmatch(plain):
        return ""
    found = float(plain)
    if (low, high) == (0.0, 1.0) and (plain != text or found > 1.0):
        return f" ({found:.12g}% is {found / 100.0:.12g})" if 0.0 <= found <= 100.0 else ""
    if "," in value and plain == text and low <= found <= high:
        return f" (with a decimal point: {plain})"
    return ""


def refuse(message: str) -> NoReturn:
    """End the command as wrongly used; the message says how to mend it."""
    raise click.UsageError(message, ctx=click.get_current_context(silent=True))


wants_aliases = click.option(
    "--aliases",
    metavar="ALIASES.csv",
    help="Which names mean whom: a file with the columns name and means.",
)
"""The option --aliases of every command that reads results."""


wants_json = click.option(
    "--json", "as_json", is_flag=True, help="Print JSON, with floats in full precision."
)
"""The option --json of every command."""


def which_races(command: Command) -> Command:
    """Add the options that say which races are offered: --games or --race-to."""
    command = click.option(
        "--race-to",
        type=Whole(1, LONGEST),
        metavar="N",
        help="Races in which the stronger player needs N games.",
    )(command)
    return click.option(
        "--games",
        metavar="LO..HI",
        callback=span,
        help="Races of which the longest possible match has LO to HI games.",
    )(command)


def refuse_both(games: tuple[int, int] | None, race_to: int | None) -> None:
    """Refuse --games together with --race-to."""
    if games is not None and race_to is not None:
        refuse("--games and --race-to exclude each other; leave one out")
