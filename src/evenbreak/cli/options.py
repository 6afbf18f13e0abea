"""What people type: pairs such as 7:5, spans such as 7..13, negative ratings.

`pair`, `span` and `chance` are callbacks of click options: they read the text of an
option and return its value, or None where the option is absent.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from typing import Any, NoReturn, TypeVar

import click

__all__ = [
    "LONGEST",
    "NUMBER",
    "Command",
    "PlainCommand",
    "chance",
    "pair",
    "refuse",
    "refuse_both",
    "score",
    "span",
    "wants_aliases",
    "wants_json",
    "which_races",
]

Command = TypeVar("Command", bound=Callable[..., Any])

LONGEST = 1000
"""The most games that a race, a lead or a score can have here."""

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
"""What reads as a finite number."""


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
            refuse(f"{word!r} is not a rating; give two numbers, such as 612 521")
        return rest


def pair(
    ctx: click.Context,
    param: click.Parameter,
    value: str | None,
    *,
    at_least: int = 1,
) -> tuple[int, int] | None:
    """Return the two whole numbers of a race or a lead, such as 7:5."""
    if value is None:
        return None
    match = re.fullmatch(r"\s*(\d{1,9}):(\d{1,9})\s*", value, re.ASCII)
    if match:
        m, n = int(match[1]), int(match[2])
        if at_least <= min(m, n) and max(m, n) <= LONGEST:
            return m, n
    raise click.BadParameter(
        f"{value!r}; give two whole numbers from {at_least} to {LONGEST} "
        "with a colon between them, such as 7:5",
        ctx=ctx,
        param=param,
    )


def score(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[int, int] | None:
    """Return the two whole numbers of a score, such as 3:0."""
    return pair(ctx, param, value, at_least=0)


def span(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[int, int] | None:
    """Return the two whole numbers of a span, such as 7..13."""
    if value is None:
        return None
    match = re.fullmatch(r"\s*(\d{1,9})\.\.(\d{1,9})\s*", value, re.ASCII)
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
    number = float(value) if NUMBER.fullmatch(value.strip()) else math.nan
    if not 0.0 <= number <= 1.0:
        message = f"{value!r} is not a probability; give a number from 0 to 1"
        raise click.BadParameter(message, ctx=ctx, param=param)
    return number


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
        type=click.IntRange(1, LONGEST),
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
