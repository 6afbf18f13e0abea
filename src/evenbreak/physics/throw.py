"""Throw: how friction between the balls turns the object ball (section 4, P4.2 to P4.6).

The point of the cue ball that touches the object ball slips across it at

    V_cp = V_0 (sin(cut) + J_z, -J_y cos(cut))

to the left and up. Friction pushes the object ball in that direction, with mu times the impulse
along the line of centers: tan(throw) = mu cos(gamma), where gamma is the angle of the slip above
the horizontal. That holds only as long as the balls slip. The hit uses up horizontal slip at seven
times the speed that it gives, and vertical slip at six times, since the table holds one of the
balls down. So, in size,

    V_b,sideways <= V_cp,sideways / 7,   V_b,upward <= V_cp,upward / 6

and a stun shot has its full throw only where tan(cut) >= 7 mu. `friction="limited"` includes this
limit; `friction="shepard"` is the law of the source text without it, which can create energy.

A cut to the left, an angle below 0, is the mirror image of one to the right: it slips and throws
with the other sidespin. Throw above 0 is forward for both.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import FloatOrArray, Floats
from evenbreak.checks import one_of, plain, together
from evenbreak.errors import InputError
from evenbreak.physics.friction import (
    BALL_FRICTION,
    SlipFriction,
    checked_friction,
    friction_of_slip,
)
from evenbreak.physics.units import numbers

_ROUNDING = 4.0 * np.finfo(float).eps

FRICTION_LAWS = ("limited", "shepard")
"""The laws of friction: limited by the slip, or the law of the source text."""


def throw_factor(
    cut: FloatOrArray, topspin: FloatOrArray = 1.0, side: FloatOrArray = 0.0
) -> FloatOrArray:
    """Return cos(gamma), the share of the friction that acts sideways (P4.2).

    Parameters
    ----------
    cut
        cut angle in radians, to the left below 0, at most pi/2.
    topspin
        J_y, 1 in natural roll, 0 for stun, below 0 for draw.
    side
        J_z, below 0 for outside english on a cut to the right.

    Returns
    -------
    from -1, where english throws the ball backward, to 1; 0 if nothing slips

    Notes
    -----
    Source: P4.2. For stun it is 1 or -1 at every cut (P4.3); without english, in natural roll or
    reverse natural roll, it is the sine of the cut (P4.4, P4.6).

    >>> throw_factor(math.pi / 6.0), throw_factor(0.4, 0.0), throw_factor(0.4, 0.0, -0.8)
    (0.49999999999999994, 1.0, -1.0)
    """
    cut, topspin, side = shot_of(cut, topspin, side)
    left, up = slip_of(np.sin(cut), np.cos(cut), topspin, side)
    return plain(hand_of(cut) * left / _length(left, up))


def throw_angle(
    cut: FloatOrArray,
    topspin: FloatOrArray = 1.0,
    side: FloatOrArray = 0.0,
    *,
    mu: Any = BALL_FRICTION,
    friction: str = "limited",
    speed: Any = None,
) -> FloatOrArray:
    """Return the angle between the object ball's path and the line of centers, in radians (P4.2).

    Parameters
    ----------
    cut, topspin, side
        as for `throw_factor`.
    mu
        coefficient of friction between the balls; `SlipFriction()` for one that falls with the
        speed of the slip.
    friction
        'limited' or 'shepard'.
    speed
        of the cue ball at the hit, in m/s; needed for `SlipFriction`, else it does not matter.

    Returns
    -------
    above 0 if the ball is thrown forward, as in a cut without english: it misses thick

    Raises
    ------
    InputError
        if a number is not finite or out of range, `friction` is neither of the two, or the
        speed is missing.

    Notes
    -----
    Source: P4.2; for stun P4.3, for natural roll P4.4.

    >>> round(math.degrees(throw_angle(math.radians(30.0))), 3)
    1.591
    >>> round(math.degrees(throw_angle(math.radians(10.0), 0.0)), 3)
    1.443
    >>> round(math.degrees(throw_angle(math.radians(10.0), 0.0, friction="shepard")), 3)
    3.18
    >>> speeds = [0.5, 2.0, 4.0]
    >>> np.degrees(throw_angle(math.pi / 6.0, 0.0, mu=SlipFriction(), speed=speeds)).round(1)
    array([4.7, 2.7, 1.3])
    """
    mu, speed = checked_friction(mu, speed)
    cut, topspin, side = shot_of(cut, topspin, side, mu=mu, speed=speed)
    # cos(pi/2) rounds to 6e-17, so the throw at a right angle is the limit of thin cuts.
    sin, cos = np.sin(cut), np.cos(cut)
    slip = slip_of(sin, cos, topspin, side)
    sideways, _ = thrown(cos, *slip, friction_of_slip(mu, speed, *slip), friction)
    return plain(np.arctan2(hand_of(cut) * sideways, cos))


def full_throw_cut(mu: FloatOrArray = BALL_FRICTION) -> FloatOrArray:
    """Return the smallest cut angle at which a stun shot has its full throw, in radians.

    In fuller hits the slip ends before the hit does, and tan(throw) = tan(cut) / 7. From here on
    the answer of P4.3, full throw at every cut, holds.

    Parameters
    ----------
    mu
        coefficient of friction between the balls.

    >>> round(math.degrees(full_throw_cut()), 2)
    21.25
    """
    return plain(np.arctan(7.0 * numbers(mu, "mu", low=0.0)))


def gearing_side(cut: FloatOrArray) -> FloatOrArray:
    """Return the sidespin J_z that leaves no sideways slip, and so no throw (P4.26).

    The cut angle is in radians, to the left below 0.

    >>> round(gearing_side(math.radians(20.0)), 4)
    -0.342
    """
    return plain(-np.sin(cut_of(cut)))


def throw_sensitivity(cut: FloatOrArray, topspin: FloatOrArray, side: FloatOrArray) -> FloatOrArray:
    """Return how fast cos(gamma) changes with the spin: the length of its gradient (P4.5).

    Parameters
    ----------
    cut, topspin, side
        as for `throw_factor`; the gradient is with respect to J_y and J_z.

    Returns
    -------
    0 or more; infinite if nothing slips

    >>> round(throw_sensitivity(math.pi / 6.0, 0.5, 0.1), 4)
    0.723
    """
    cut, topspin, side = shot_of(cut, topspin, side)
    cos = np.cos(cut)
    left, up = slip_of(np.sin(cut), cos, topspin, side)
    length = _length(left, up)
    across, along = np.abs(up / length), left / length
    with np.errstate(over="ignore"):
        slope = across * np.hypot(along * cos, across) / length
    return plain(np.where((left == 0.0) & (up == 0.0), np.inf, slope))


class Aim(NamedTuple):
    """The allowance for throw.

    Parameters
    ----------
    cut
        the cut angle to aim for, in radians, to the left below 0.
    throw
        the throw at that cut, in radians, above 0 toward a fuller hit; the object ball then
        leaves at the angle wanted.
    offset
        distance from the target at which the line of centers points, toward the thinner cut, in the
        unit of the distance.
    offset_of_text
        the offset by the rule of P4.6, mu D cos(gamma) at the angle wanted.
    """

    cut: Any
    throw: Any
    offset: Any
    offset_of_text: Any


def aim(
    cut: Any,
    distance: Any,
    topspin: Any = 1.0,
    side: Any = 0.0,
    *,
    mu: Any = BALL_FRICTION,
    friction: str = "limited",
    speed: Any = None,
) -> Aim:
    """Return where to aim so that the thrown object ball goes where it should (P4.6).

    Parameters
    ----------
    cut
        the angle at which the object ball should leave, in radians, to the left below 0.
    distance
        from the object ball to its target, in any unit of length.
    topspin, side, mu, friction, speed
        as for `throw_angle`.

    Raises
    ------
    InputError
        if no cut sends the ball there: it would take a cut of more than a right angle.

    >>> found = aim(math.asin(0.25), 36.0)
    >>> round(found.offset_of_text, 3), round(found.offset, 3)
    (0.5, 0.528)
    """
    distance = numbers(distance, "distance", low=0.0)
    mu, speed = checked_friction(mu, speed)
    wanted, topspin, side = shot_of(cut, topspin, side, distance=distance, mu=mu, speed=speed)

    def throw(angle: Floats) -> Any:
        """Return the throw to the left, as the angles are to the right."""
        forward = throw_angle(angle, topspin, side, mu=mu, friction=friction, speed=speed)
        return hand_of(angle) * forward

    largest = np.arctan(mu.slow if isinstance(mu, SlipFriction) else mu)
    low, high = np.broadcast_arrays(
        np.maximum(wanted - largest, -math.pi / 2.0), np.minimum(wanted + largest, math.pi / 2.0)
    )
    if np.any((low - throw(low) > wanted + 1e-12) | (high - throw(high) < wanted - 1e-12)):
        raise InputError(
            "cut is too thin: allowing for throw, it would be more than a right angle. Give a "
            "smaller cut angle, or different spin."
        )
    for _ in range(60):
        middle = 0.5 * (low + high)
        short = middle - throw(middle) < wanted
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    # For stun the law of the text jumps where nothing slips; a cut without throw is a solution.
    cuts = np.where(throw(wanted) == 0.0, wanted, 0.5 * (low + high))
    slip = slip_of(np.sin(wanted), np.cos(wanted), topspin, side)
    rule = friction_of_slip(mu, speed, *slip) * distance * throw_factor(wanted, topspin, side)
    hand = hand_of(wanted)
    return Aim(
        plain(cuts),
        plain(hand * throw(cuts)),
        plain(hand * distance * np.tan(cuts - wanted)),
        plain(rule),
    )


def cut_of(cut: Any) -> Floats:
    """Return a cut angle as an array, if it is from -pi/2 to pi/2."""
    return numbers(cut, "cut", low=-math.pi / 2.0, high=math.pi / 2.0)


def hand_of(cut: Floats) -> Any:
    """Return 1 for a cut to the right and for a full hit, -1 for a cut to the left."""
    return np.where(cut < 0.0, -1.0, 1.0)


def shot_of(cut: Any, topspin: Any, side: Any, **others: Any) -> tuple[Floats, Floats, Floats]:
    """Return cut angle, J_y and J_z as arrays, if they and the others broadcast together."""
    cut, topspin, side = cut_of(cut), numbers(topspin, "topspin"), numbers(side, "side")
    together(cut=cut, topspin=topspin, side=side, **others)
    return cut, topspin, side


def slip_of(sin: Any, cos: Any, topspin: Any, side: Any) -> tuple[Any, Any]:
    """Return the slip to the left and up over the cue ball's speed, from sin and cos of the cut."""
    left = sin + side
    # A slip that is only rounding counts as 0: the law of the text would give it full throw.
    return np.where(np.abs(left) <= _ROUNDING * np.abs(side), 0.0, left), -topspin * cos


def thrown(cos: Any, left: Any, up: Any, mu: Any, friction: str) -> tuple[Any, Any]:
    """Return the speed that friction gives the object ball, to the left and up, over V_0."""
    law = one_of(friction, "friction", FRICTION_LAWS)
    length = _length(left, up)
    pull = mu * cos
    if law == "shepard":
        return left / length * pull, up / length * pull
    return left / length * np.minimum(pull, length / 7.0), (
        up / length * np.minimum(pull, length / 6.0)
    )


def _length(left: Any, up: Any) -> Any:
    """Return the length of the slip; 1 where there is none, so that it can be divided by."""
    length = np.sqrt(left * left + up * up)
    if length.size and length.min() < 1e-140:
        # Squares of such small slips lose their digits, or are 0; `hypot` is slower.
        length = np.hypot(left, up)
        length = np.where(length > 0.0, length, 1.0)
    return length
