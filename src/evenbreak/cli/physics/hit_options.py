"""The options that say how tip, cue ball and object ball meet."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.options import Command, with_options
from evenbreak.cli.physics.measures import CUT, FRICTION, OFFSET, SPIN

if TYPE_CHECKING:
    from evenbreak.answers.hit import Hit


_FRICTION = (
    click.option(
        "--friction",
        type=click.Choice(["limited", "shepard"]),
        default="limited",
        help="limited: it ends when the balls no longer slip; shepard: the law of the source "
        "text, without that limit.",
    ),
    click.option(
        "--mu",
        type=FRICTION,
        default=4.0 / 72.0,
        show_default=False,
        help="Friction between the two balls.  [default: 4/72 = 0.0556]",
    ),
)
_HIT = (
    *_FRICTION,
    click.option(
        "--side",
        type=SPIN,
        default=0.0,
        help="Sidespin: right english above 0, left english below.",
    ),
    click.option(
        "--topspin",
        type=SPIN,
        default=1.0,
        help="1 is natural roll, 0 stun, below 0 draw.",
    ),
    click.option(
        "--cut",
        type=CUT,
        required=True,
        help="Cut angle, to the left below 0; 90 is the limit of thin cuts.",
    ),
)


def friction_options(command: Command) -> Command:
    """Add the options --mu and --friction."""
    return with_options(command, *_FRICTION)


def hit_options(command: Command) -> Command:
    """Add the options --cut, --topspin, --side, --mu and --friction; see `hit_of`."""
    return with_options(command, *_HIT)


def hit_of(*, cut: float, topspin: float, side: float, mu: float, friction: str) -> Hit:
    """Return the hit that the options describe."""
    from evenbreak.answers.hit import Hit

    return Hit(cut, topspin, side, mu, friction)


def tip_options(**offset: Any) -> Callable[[Command], Command]:
    """Return a decorator that adds --offset and --side-offset; `offset` is more about the first."""
    side = "How far the tip hits to the right of the centre; below 0 to the left."
    up = "How far the tip hits above the centre, in ball radii; below 0 for draw."
    options = (
        click.option("--side-offset", type=OFFSET, default=0.0, help=side),
        click.option("--offset", type=OFFSET, help=up, **offset),
    )
    return lambda command: with_options(command, *options)
