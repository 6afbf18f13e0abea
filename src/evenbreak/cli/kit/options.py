"""Options shared by several commands, each declared once, and commands that take ratings."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import click

from evenbreak.cli.kit.values import CHANCE, LONGEST, NUMBER, SPAN, Whole, meant, refuse

if TYPE_CHECKING:
    from evenbreak.ratings.scale import Scale

Command = TypeVar("Command", bound=Callable[..., Any])
Decorator = Callable[[Command], Command]

HIGHEST_SEED = 2**32 - 1


class PlainCommand(click.Command):
    """A command that reads -20 as a number, where click alone sees an unknown option."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments, and refuse words that only begin like a number."""
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


class ScaleName(click.ParamType):  # type: ignore[type-arg]
    """A scale, by its name or by the points that double the odds."""

    name = "scale"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> Scale:
        """Return the scale."""
        from evenbreak.errors import InputError
        from evenbreak.ratings.scale import scale_of

        try:
            scale: Scale = scale_of(value)
        except InputError as error:
            self.fail(str(error), param, ctx)
        return scale


def scale_option(without: str = "npl", *, fixed: bool = True) -> Decorator[Any]:
    """Return the option --scale.

    Parameters
    ----------
    without
        what applies if the option is not given, in words.
    fixed
        whether those words name a scale, which the command then gets; otherwise it gets
        None.
    """
    return click.option(
        "--scale",
        type=ScaleName(),
        default=without if fixed else None,
        metavar="npl|fargo|elo|POINTS",
        help="What ratings mean: POINTS of difference double the odds of winning a game.  "
        f"[default: {without}]",
    )


def seed_option(what: str = "The seed of all random draws.", *, default: int = 1) -> Decorator[Any]:
    """Return the option --seed; `what` says what is drawn."""
    return click.option(
        "--seed",
        type=Whole(0, HIGHEST_SEED),
        default=default,
        show_default=True,
        metavar="N",
        help=what,
    )


def chart_option(
    what: str = "The chart that sets the races.  [default: the system's own]",
) -> Decorator[Any]:
    """Return the option --chart; `what` says what the chart is for."""
    return click.option("--chart", metavar="NAME|FILE", help=what)


aliases_option = click.option(
    "--aliases",
    metavar="ALIASES.csv",
    help="Which names mean the same player: a file with the columns name and means.",
)
"""The option --aliases of every command that reads results."""


safety_option = click.option(
    "--safety",
    metavar="ALPHA",
    type=CHANCE,
    default="1",
    show_default=True,
    help="The first shot of an inning goes in ALPHA times as often as the others.",
)
"""The option --safety of the commands about straight pool."""


def which_races(command: Command) -> Command:
    """Add the options that limit the races: --games or --race-to."""
    command = click.option(
        "--race-to",
        type=Whole(1, LONGEST),
        metavar="N",
        help="Races in which the stronger player needs N games.",
    )(command)
    return click.option(
        "--games",
        metavar="LO..HI",
        type=SPAN,
        help="Races whose longest possible match has LO to HI games.",
    )(command)


def refuse_both(games: tuple[int, int] | None, race_to: int | None) -> None:
    """Refuse --games together with --race-to."""
    if games is not None and race_to is not None:
        refuse("--games and --race-to exclude each other; leave one out")
