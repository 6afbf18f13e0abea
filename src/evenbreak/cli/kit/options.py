"""Options shared by several commands, each declared once."""

from collections.abc import Callable
from typing import Any, TypeVar

import click

from evenbreak.cli.kit import completion
from evenbreak.cli.kit.said import said
from evenbreak.cli.kit.values import Whole
from evenbreak.errors import InputError
from evenbreak.ratings.scale import DEFAULT_SCALE, Scale, scale_of

Command = TypeVar("Command", bound=Callable[..., Any])
Decorator = Callable[[Command], Command]


def with_options(command: Command, *options: Decorator[Any]) -> Command:
    """Return a command with more options, the last of them first in its help."""
    for option in options:
        command = option(command)
    return command


HIGHEST_SEED = 2**32 - 1


def _scale(name: str) -> Scale:
    try:
        scale: Scale = scale_of(name)
    except InputError as error:
        raise click.BadParameter(said(error.sentence)) from None
    return scale


OF_LIST = "the one that the file states, else the only one that the ratings can be on"
"""What applies without --scale to a list of ratings."""

SAY_WHICH = "say which with --scale npl, --scale fargo or --scale elo"
"""What to do about ratings that do not show their scale."""


def scale_option(without: str = DEFAULT_SCALE, *, fixed: bool = True) -> Decorator[Any]:
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
        type=_scale,
        shell_complete=completion.scales,
        default=without if fixed else None,
        show_default=False,
        metavar="npl|fargo|elo|POINTS",
        help="The scale of the ratings: POINTS double the odds of winning a game.  "
        f"[default: {without}]",
    )


def seed_option(
    what: str = "The seed of all random draws.", *, default: int | None = 1
) -> Decorator[Any]:
    """Return the option --seed; `what` says what is drawn."""
    return click.option(
        "--seed",
        type=Whole(0, HIGHEST_SEED),
        default=default,
        metavar="N",
        help=what,
    )


def chart_option(
    what: str = "The chart that sets the races.  [default: the system's own]",
) -> Decorator[Any]:
    """Return the option --chart; `what` says what the chart is for."""
    return click.option("--chart", metavar="NAME|FILE", help=what)
