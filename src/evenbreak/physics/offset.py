"""Where the tip meets the ball, and the resulting spin (section 3, P3.4 to P3.11).

Seen from behind the cue ball, a contact point is (y, z): y to the left and z above the cloth,
both in units of the ball's radius R, so the center is (0, 1). An offset from the center is b / R,
below 0 for draw. Spin is J = R omega / V, with the signs of a right-handed frame: J_y above 0 is
topspin; J_z above 0, counterclockwise from above, comes from a tip to the right, y below 0.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import FloatOrArray
from evenbreak.checks import kind_of, plain, together
from evenbreak.errors import InputError
from evenbreak.physics.friction import tip_friction_of
from evenbreak.physics.objects import Cloth
from evenbreak.physics.throw import gearing_side
from evenbreak.physics.units import LEAST, numbers, positive

NATURAL_ROLL_OFFSET = 0.4
"""The height above the center, over R, at which a hit gives natural roll at once (P3.5).

In exercise 3.1 a stripe struck there, with the cue in its plane, seems to stand still.
"""


MOST_ENGLISH_OFFSET = 0.5
"""The offset to the side, over R, of 100% english: beyond it, the tip usually slips."""

TIPS_OF_MOST_ENGLISH = 1.4
"""How many tip widths the cue is then to the side of the ball's center.

D. G. Alciatore ("Dr. Dave"), frequently asked questions on english, billiards.colostate.edu. This
is for a usual tip; thin or flat tips give less english by the tip.
"""

SQUIRTS = {"regular": 2.5, "low": 1.8}
"""Squirt in degrees from the line of a level cue at 100% english, by type of shaft.

Alciatore's figures for a usual and for a common low-deflection shaft. R. Shepard (2001, "Everything
you always wanted to know about cue ball squirt") has 0.5 to 2.3 degrees, and robots 1.3 to 2.3.
Squirt is nearly in proportion to the offset, and the same at any speed.
"""


class ContactPoint(NamedTuple):
    """A point of the ball seen from behind: y to the left and z above the cloth, over R.

    Parameters
    ----------
    y
        how far left of the center, over R.
    z
        the height above the cloth, over R: 1 is the center.
    """

    y: Any
    z: Any


def spin_of_offset(offset: FloatOrArray) -> FloatOrArray:
    """Return the spin J = R omega / V that an offset b/R gives (P3.4).

    Parameters
    ----------
    offset
        b/R, -1 to 1.

    >>> spin_of_offset(0.4), spin_of_offset(-0.2)
    (1.0, -0.5)
    """
    return plain(2.5 * _offset(offset))


def offset_for(spin: FloatOrArray) -> FloatOrArray:
    """Return the offset b/R that gives a spin J; beyond 1 the tip misses the ball (P3.4).

    Parameters
    ----------
    spin
        J = R omega / V, without a unit.

    >>> offset_for(1.0)
    0.4
    """
    return plain(numbers(spin, "spin") / 2.5)


def tips_of_side(side: FloatOrArray) -> FloatOrArray:
    """Return how many tips of english give a sidespin J with a level cue.

    Parameters
    ----------
    side
        J_z just after the hit, above 0 for right english; beyond 1.4 tips the tip slips.

    >>> tips_of_side(1.25), round(tips_of_side(-0.5), 2)
    (1.4, -0.56)
    """
    return plain(np.asarray(offset_for(side)) * TIPS_OF_MOST_ENGLISH / MOST_ENGLISH_OFFSET)


def squirt_angle(side: FloatOrArray, most: FloatOrArray = SQUIRTS["regular"]) -> FloatOrArray:
    """Return the squirt: degrees that the cue ball starts off the cue's line, away from the side.

    Parameters
    ----------
    side
        J_z just after the hit; beyond 100% english, the result is the same as at 100%.
    most
        the degrees at 100% english, as in `SQUIRTS`.

    >>> squirt_angle(0.5), squirt_angle(-1.25, 1.8)
    (1.0, -1.8)
    """
    share = np.clip(np.asarray(offset_for(side)) / MOST_ENGLISH_OFFSET, -1.0, 1.0)
    return plain(numbers(most, "most", low=0.0, high=90.0) * share)


def strike_side(y: FloatOrArray) -> FloatOrArray:
    """Return the sidespin J_z just after a hit at y, at any height (P3.6).

    Parameters
    ----------
    y
        how far left of the center the tip hits, over R, -1 to 1.

    >>> strike_side(-0.4)
    1.0
    """
    return plain(-2.5 * _offset(y, "y"))


def roll_side(y: FloatOrArray, z: FloatOrArray) -> FloatOrArray:
    """Return the sidespin J_z of a ball struck at (y, z), once it rolls (P3.6).

    Parameters
    ----------
    y
        how far left of the center the tip hits, over R, -1 to 1.
    z
        the height above the cloth at which it hits, over R, above 0 to 2.

    Notes
    -----
    Source: P3.6, where the size is 7/2 y/z: points of equal sidespin lie on straight lines
    through (0, 0), where the ball touches the cloth.

    >>> roll_side(-0.5, 0.5)
    3.5
    """
    y, z = _offset(y, "y"), _height(z)
    together(y=y, z=z)
    return plain(-3.5 * y / z)


def small_circle_point(side: Any) -> ContactPoint:
    """Return the contact point nearest to the center for a sidespin in natural roll (P3.7).

    It lies on the circle of radius R/2 through the center of the ball and the cloth.

    Parameters
    ----------
    side
        J_z in natural roll.

    >>> small_circle_point(3.5)
    ContactPoint(y=-0.5, z=0.5)
    """
    slope = numbers(side, "side") / 3.5
    z = 1.0 / (1.0 + slope**2)
    return ContactPoint(plain(-slope * z), plain(z))


def largest_roll_side(offset: FloatOrArray) -> FloatOrArray:
    """Return the largest sidespin in natural roll for an offset from the center (P3.8).

    At the miscue limit of a tip it is 7/2 of the tip's friction.

    Parameters
    ----------
    offset
        b/R, from the center in any direction, 0 to 1.

    >>> round(largest_roll_side(2.0**-0.5), 9)
    3.5
    """
    return plain(3.5 * tip_friction_of(offset))


def effective_contact(contact: ContactPoint, speed: Any, time: Any, cloth: Cloth) -> ContactPoint:
    """Return where to strike a ball at rest for it to move as this one does now (P3.9).

    While the ball slides, this point moves along a straight line through (0, 0), outwards from
    a low point and inwards from a high one, until natural roll starts at z = 7/5.

    Parameters
    ----------
    contact
        where the ball was struck.
    speed
        V_0 just after that, in m/s, above 0.
    time
        seconds since then.
    cloth
        on which the ball slides.

    >>> now = effective_contact(ContactPoint(0.2, 0.8), 2.0, 0.1, Cloth(gravity=10.0))
    >>> round(now.y, 4), round(now.z, 4)
    (0.2222, 0.8889)
    """
    kind_of(contact, "contact", ContactPoint)
    y, z = _offset(contact.y, "y"), _height(contact.z)
    speed, time = positive(speed, "speed"), numbers(time, "time", low=0.0)
    together(y=y, z=z, speed=speed, time=time)
    slowing = kind_of(cloth, "cloth", Cloth).slide_deceleration
    # Natural roll ends it at 5/7 z of the speed, slower or faster than the ball began.
    rolls = 5.0 / 7.0 * z
    lost = np.minimum(slowing * time / speed, np.abs(1.0 - rolls))
    now = 1.0 - np.sign(1.0 - rolls) * lost
    # By then all of the speed may be lost to rounding, so it is kept on its side of `rolls`.
    stretch = 1.0 / np.where(rolls < 1.0, np.maximum(now, rolls), np.minimum(now, rolls))
    return ContactPoint(plain(y * stretch), plain(z * stretch))


def contact_for_later(later: ContactPoint, z: Any) -> ContactPoint:
    """Return where to strike at a height z so that the ball later moves as if struck at `later`.

    The two points and (0, 0) lie on one line (P3.9).

    Parameters
    ----------
    later
        the contact point that the hit should be equivalent to later.
    z
        the height above the cloth at which it hits, over R, above 0 to 2.

    >>> contact_for_later(ContactPoint(0.3, 1.0), 0.7)
    ContactPoint(y=0.21, z=0.7)
    """
    kind_of(later, "later", ContactPoint)
    z, height, y = _height(z), _height(later.z, "later.z"), numbers(later.y, "later.y")
    together(**{"later.y": y, "later.z": height, "z": z})
    # Where sidespin lasts, `later` may lie beyond the ball; what the tip can strike may not.
    y = _offset(y * z / height, "y")
    return ContactPoint(plain(y), plain(z))


def gearing_tip(cut: Any, z: Any = 1.0 + NATURAL_ROLL_OFFSET) -> ContactPoint:
    """Return where to strike so that the ball, once it rolls, throws nothing (P4.27).

    The points for one cut lie on a straight line through (0, 0). If the ball hits at once, before
    the cloth slows it, strike at the y of z = 7/5, at any height.

    Parameters
    ----------
    cut
        cut angle to the right, in radians.
    z
        the height at which to strike, over R; by default 7/5, natural roll at once.

    >>> tip = gearing_tip(np.pi / 6.0)
    >>> round(tip.y, 9), round(tip.z, 9)
    (0.2, 1.4)
    """
    z, side = _height(z), gearing_side(cut)
    together(cut=np.asarray(side), z=z)
    return ContactPoint(plain(-side * z / 3.5), plain(z))


def stun_offset(speed: FloatOrArray, distance: FloatOrArray, cloth: Cloth) -> FloatOrArray:
    """Return the offset below the center at which the backspin is gone after a distance.

    Parameters
    ----------
    speed
        of the ball just after the tip, in m/s.
    distance
        meters to where the ball should be a stun shot.
    cloth
        on which the ball slides.

    Returns
    -------
    b/R, 0 or below

    Raises
    ------
    InputError
        if the ball stops before that at any offset.

    Notes
    -----
    Source: P3.4 and P3.9: with t from d = V_0 t - mu g t^2 / 2, b/R = -mu g t / V_0.

    >>> round(stun_offset(2.0, 0.36, Cloth(mu_slide=0.2, gravity=10.0)), 9)
    -0.2
    """
    speed = positive(speed, "speed")
    distance = numbers(distance, "distance", low=0.0)
    together(speed=speed, distance=distance)
    slowing = kind_of(cloth, "cloth", Cloth).slide_deceleration
    lost = 2.0 * slowing * distance / speed**2
    if np.any(lost > 1.0):
        raise InputError(
            "distance is farther than a ball slides at this speed. Give a higher speed, or a "
            "distance of less than {speed:.4g} m.",
            speed=float(np.min(speed)) ** 2 / (2.0 * slowing),
        )
    # 1 - sqrt(1 - lost), written so that small offsets keep their digits.
    return plain(-lost / (1.0 + np.sqrt(1.0 - lost)))


def ball_speed_ratio(offset: FloatOrArray, ball_ratio: FloatOrArray) -> FloatOrArray:
    """Return the ratio of ball speed to stick speed, for a hit off center (P3.10).

    Parameters
    ----------
    offset
        b/R, in any direction.
    ball_ratio
        mass of the ball over mass of the stick, such as 1/3 for 6 and 18 ounces.

    >>> round(ball_speed_ratio(0.0, 1 / 3), 9), round(ball_speed_ratio(0.3, 1 / 3), 4)
    (1.5, 1.2834)
    """
    ratio, offset = numbers(ball_ratio, "ball_ratio", low=0.0), _offset(offset)
    together(offset=offset, ball_ratio=ratio)
    return plain(2.0 / (1.0 + ratio + 2.5 * offset**2))


def roll_speed_ratio(offset: FloatOrArray, ball_ratio: FloatOrArray) -> FloatOrArray:
    """Return the ratio of natural-roll speed to stick speed, by offset up or down (P3.11).

    Parameters
    ----------
    offset
        b/R, -1 to 1: above the center, or below it if negative.
    ball_ratio
        mass of the ball over mass of the stick, such as 1/3 for 6 and 18 ounces.

    >>> round(roll_speed_ratio(0.3, 1 / 3), 4)
    1.1917
    """
    ratio = ball_speed_ratio(offset, ball_ratio)
    return plain((5.0 + 5.0 * _offset(offset)) / 7.0 * ratio)


def best_lag_offset(ball_ratio: FloatOrArray) -> FloatOrArray:
    """Return the offset above the center, b/R, at which a ball rolls farthest (P3.11).

    There the length of a lag depends least on where the tip meets the ball.

    Parameters
    ----------
    ball_ratio
        mass of the ball over mass of the stick, such as 1/3 for 6 and 18 ounces.

    >>> round(best_lag_offset(1 / 3), 3), round(best_lag_offset(1 / 4), 3)
    (0.238, 0.225)
    """
    return plain(np.sqrt(1.4 + 0.4 * numbers(ball_ratio, "ball_ratio", low=0.0)) - 1.0)


def _height(value: Any, name: str = "z") -> Any:
    return numbers(value, name, low=LEAST, high=2.0)


def _offset(value: Any, name: str = "offset") -> Any:
    return numbers(value, name, low=-1.0, high=1.0)
