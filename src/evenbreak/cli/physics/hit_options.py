"""The options that say how tip, cue ball and object ball meet."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.options import Command, with_options
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.physics.measures import CUT, FRICTION, OFFSET, SPEED, SPIN

if TYPE_CHECKING:
    from evenbreak.answers.physics.hit import Hit
    from evenbreak.answers.physics.units import Units
    from evenbreak.physics import SlipFriction


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
        help="Friction between the two balls: a number for any speed, or by-speed, which falls "
        "with the speed as measured (Alciatore's fit).  [default: 4/72 = 0.0556]",
    ),
)
_HIT = (
    *_FRICTION,
    click.option(
        "--speed",
        type=SPEED,
        help="Speed of the cue ball at the hit; friction then falls with it (--mu by-speed).",
    ),
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
    """Add the options --cut, --topspin, --side, --speed, --mu and --friction; see `hit_of`."""
    return with_options(command, *_HIT)


def hit_of(
    units: Units,
    *,
    cut: float,
    topspin: float,
    side: float,
    speed: float | None,
    mu: float | SlipFriction | None,
    friction: str,
) -> Hit:
    """Return the hit that the options describe."""
    from evenbreak.answers.physics.hit import Hit
    from evenbreak.physics import BALL_FRICTION, SlipFriction

    if mu is None:
        mu = BALL_FRICTION if speed is None else SlipFriction()
    elif isinstance(mu, SlipFriction) and speed is None:
        refuse("--mu by-speed needs the speed of the cue ball at the hit; give --speed too")
    elif not isinstance(mu, SlipFriction) and speed is not None:
        refuse(
            f"--speed {speed:g} changes nothing with --mu {mu:g}, which holds at any speed; leave "
            "one of them out"
        )
    pace = None if speed is None else speed * units.speed.size
    return Hit(cut, topspin, side, mu, friction, pace)


def tip_options(**offset: Any) -> Callable[[Command], Command]:
    """Return a decorator that adds --offset and --side-offset; `offset` is more about the first."""
    side = "How far the tip hits to the right of the centre; below 0 to the left."
    up = "How far the tip hits above the centre, in ball radii; below 0 for draw."
    options = (
        click.option("--side-offset", type=OFFSET, default=0.0, help=side),
        click.option("--offset", type=OFFSET, help=up, **offset),
    )
    return lambda command: with_options(command, *options)
