"""The friction between two balls: a number, or a curve that falls with the speed of the slip.

The source text takes a number, which its throw test measures (P1.6). Measured at several speeds,
the friction falls as the balls slip faster on each other:

    mu(v) = a + b exp(-c v)

A hit keeps the friction of the slip with which it begins.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.checks import number, plain
from evenbreak.errors import InputError
from evenbreak.physics.arrays import LARGEST, numbers

BALL_FRICTION = 4.0 / 72.0
"""The coefficient of friction between two balls, as measured in P1.6."""


@dataclass(frozen=True)
class SlipFriction:
    """Friction between balls that falls with the speed at which they slip on each other.

    Parameters
    ----------
    fast
        a, the coefficient at a very fast slip.
    more
        b, by how much it is higher at a very slow slip.
    decay
        c, how quickly it falls, in seconds per metre.

    Raises
    ------
    InputError
        if one is not a number from 0 to 1e50.

    Notes
    -----
    Source of the defaults: D. G. Alciatore, technical proof TP A.14 (billiards.colostate.edu),
    a fit to the measurements in W. C. Marlow, *The Physics of Pocket Billiards*. pooltool uses
    the same curve.

    >>> [round(SlipFriction().at(slip), 4) for slip in (0.1, 1.0, 10.0)]
    [0.1068, 0.0463, 0.01]
    """

    fast: float = 9.951e-3
    more: float = 0.108
    decay: float = 1.088

    def __post_init__(self) -> None:
        for name in ("fast", "more", "decay"):
            found = number(getattr(self, name), name, low=0.0, high=LARGEST)
            object.__setattr__(self, name, found)

    @property
    def slow(self) -> float:
        """The coefficient at a very slow slip, the largest."""
        return self.fast + self.more

    def at(self, slip: Any) -> Any:
        """Return the coefficient for a speed of the slip in m/s."""
        slip = numbers(slip, "slip", low=0.0, high=np.inf)
        with np.errstate(over="ignore"):
            return plain(self.fast + self.more * np.exp(-self.decay * slip))


BallFriction: TypeAlias = ArrayLike | SlipFriction
"""A coefficient of friction between balls, several, or one that depends on the slip."""


def checked_friction(mu: Any, speed: Any) -> tuple[Floats | SlipFriction, Floats]:
    """Return friction and speed of a hit, checked; friction that needs a speed must have one."""
    if speed is None:
        if isinstance(mu, SlipFriction):
            raise InputError("mu depends on the speed of the slip; give the speed of the cue ball")
        speed = 1.0
    speed = numbers(speed, "speed", low=0.0)
    return mu if isinstance(mu, SlipFriction) else numbers(mu, "mu", low=0.0), speed


def one_friction(mu: Any) -> float | SlipFriction:
    """Return the friction of one hit, checked."""
    return mu if isinstance(mu, SlipFriction) else number(mu, "mu", low=0.0, high=LARGEST)


def friction_of_slip(
    mu: Floats | SlipFriction, speed: Floats, left: Floats, up: Floats
) -> Floats | float:
    """Return the coefficient for a slip to the left and up that is given over the speed."""
    if not isinstance(mu, SlipFriction):
        return mu
    return np.asarray(mu.at(speed * np.hypot(left, up)))
