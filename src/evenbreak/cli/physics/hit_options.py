"""The options that say how tip, cue ball and object ball meet."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.physics.measures import measure_option

if TYPE_CHECKING:
    from evenbreak.answers.hit import Hit
    from evenbreak.cli.kit.options import Command

_MOST_SPIN = 100.0
"""The largest spin J that an option takes; a cue seldom gives more than 2."""


def friction_options(command: Command) -> Command:
    """Add the options --mu and --friction."""
    command = click.option(
        "--friction",
        type=click.Choice(["limited", "shepard"]),
        default="limited",
        show_default=True,
        help="limited: it ends when the balls no longer slip; shepard: the law of the source "
        "text, without that limit.",
    )(command)
    return measure_option(
        "--mu",
        "MU",
        0.0,
        1.0,
        "0.06",
        "Friction between the two balls.  [default: 4/72 = 0.0556]",
        default=4.0 / 72.0,
    )(command)


def hit_options(command: Command) -> Command:
    """Add the options --cut, --topspin, --side, --mu and --friction; see `hit_of`."""
    for option in (
        friction_options,
        measure_option(
            "--side",
            "J",
            -_MOST_SPIN,
            _MOST_SPIN,
            "-0.3",
            "Sidespin: right english above 0, left english below.",
            default=0.0,
            show_default=True,
        ),
        measure_option(
            "--topspin",
            "J",
            -_MOST_SPIN,
            _MOST_SPIN,
            "1",
            "1 is natural roll, 0 stun, below 0 draw.",
            default=1.0,
            show_default=True,
        ),
        measure_option(
            "--cut",
            "DEGREES",
            -90.0,
            90.0,
            "30",
            "Cut angle, to the left below 0; 90 is the limit of thin cuts.",
            required=True,
        ),
    ):
        command = option(command)
    return command


def hit_of(*, cut: float, topspin: float, side: float, mu: float, friction: str) -> Hit:
    """Return the hit that the options describe."""
    from evenbreak.answers.hit import Hit

    return Hit(cut, topspin, side, mu, friction)


def tip_options(**offset: Any) -> Callable[[Command], Command]:
    """Return a decorator that adds --offset and --side-offset; `offset` is more about the first."""

    def add(command: Command) -> Command:
        command = measure_option(
            "--side-offset",
            "B",
            -1.0,
            1.0,
            "0.2",
            "How far the tip hits to the right of the centre; below 0 to the left.",
            default=0.0,
            show_default=True,
        )(command)
        return measure_option(
            "--offset",
            "B",
            -1.0,
            1.0,
            "0.4",
            "How far the tip hits above the centre, in ball radii; below 0 for draw.",
            **offset,
        )(command)

    return add
