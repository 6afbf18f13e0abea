"""Collision of a cue ball with a ball at rest (section 4, P4.1 to P4.12).

The balls are equal, the hit is elastic along the line of centers, and friction acts across it as
described in `throw`. With x along the line of centers, y to its left, and the cue ball moving at
the cut angle to the left of x before the hit:

    V_b = (V_0 cos(cut), V_by, V_bz)
    V_c = (0, V_0 sin(cut) - V_by, ...)
    omega_b = 5/(2R) (0, V_bz, -V_by),   omega_c = omega_0 + omega_b

The table keeps the balls from moving down. If friction pushes the object ball up (draw), the cue
ball stays on the cloth; if it pushes the object ball down (topspin), the cue ball jumps instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import kind_or_usual, plain
from evenbreak.physics.friction import BALL_FRICTION, checked_friction, friction_of_slip
from evenbreak.physics.objects import Ball
from evenbreak.physics.throw import hand_of, shot_of, slip_of, thrown
from evenbreak.physics.units import GRAVITY, numbers, positive


class Jump(NamedTuple):
    """A ball's short flight: its time in seconds, and its height and distance in meters.

    Parameters
    ----------
    time
        seconds in the air.
    height, distance
        meters: how high and how far.
    """

    time: Any
    height: Any
    distance: Any


@dataclass(frozen=True, eq=False)
class Collision:
    """Result of a hit: floats, or arrays for several hits.

    Vectors have their components last, in the frame of the shot: x' in the direction of the cue
    ball before the hit, y' to the left, z up.

    Parameters
    ----------
    cut, topspin, side, speed
        the shot: cut angle in radians, to the left below 0; J_y, J_z, and V_0 in m/s.
    mu
        the coefficient of friction between the balls in this hit.
    ahead, sideways, upward
        the velocity that the object ball gets, in m/s: V_bx along the line of centers, V_by to its
        left, and V_bz, which is below 0 if the table absorbs it.
    """

    ball: Ball
    cut: Any
    topspin: Any
    side: Any
    speed: Any
    mu: Any
    ahead: Any
    sideways: Any
    upward: Any

    @property
    def throw(self) -> Any:
        """The angle from the line of centers to the object ball's path, in radians (P4.2).

        Above 0 if the ball is thrown forward, toward the direction of the shot.
        """
        forward = hand_of(np.asarray(self.cut)) * self.sideways
        return plain(np.arctan2(forward, np.maximum(self.ahead, 1e-300)))

    @property
    def departure(self) -> Any:
        """The angle between the two paths just after the hit, in radians.

        A right angle minus the throw (P4.11), or plus the throw if friction turns the cue ball
        back across the line of centers. Exercise 4.1 measures it in stun caroms.
        """
        on = hand_of(np.asarray(self.cut)) * self._cue_across >= 0.0
        return plain(np.where(on, 0.5 * np.pi - self.throw, 0.5 * np.pi + self.throw))

    @property
    def object_velocity(self) -> Floats:
        """The object ball's velocity, in m/s; shape (..., 3)."""
        return self._turned(self.ahead, self.sideways, np.maximum(self.upward, 0.0))

    @property
    def cue_velocity(self) -> Floats:
        """The cue ball's velocity, in m/s; shape (..., 3)."""
        return self._turned(0.0, self._cue_across, np.maximum(-np.asarray(self.upward), 0.0))

    @property
    def object_spin(self) -> Floats:
        """The object ball's angular velocity, in rad/s; shape (..., 3) (P4.7)."""
        scale = 2.5 / self.ball.radius
        return self._turned(0.0, scale * self.upward, -scale * self.sideways)

    @property
    def cue_spin(self) -> Floats:
        """The cue ball's angular velocity, in rad/s; shape (..., 3)."""
        return self._spin_before + self.object_spin

    @property
    def slip(self) -> tuple[Any, Any]:
        """V_cpy and V_cpz, the initial slip to the left and up, in m/s."""
        topspin, side = np.asarray(self.topspin), np.asarray(self.side)
        left, up = slip_of(np.sin(self.cut), np.cos(self.cut), topspin, side)
        return plain(self.speed * left), plain(self.speed * up)

    @property
    def delta_elastic(self) -> Any:
        """Twice the energy that goes into spin over M, from horizontal friction alone (P4.11).

        In m^2/s^2; above 0 if both balls then spin the same way, below 0 if not (P4.1).
        """
        spin = self.side * self.speed
        return plain(-2.0 * spin * self.sideways + 5.0 * np.square(self.sideways))

    @property
    def delta_inelastic(self) -> Any:
        """Twice the energy lost over M, in m^2/s^2, from horizontal friction alone (P4.11)."""
        return plain(2.0 * self.sideways * self.slip[0] - 7.0 * np.square(self.sideways))

    @property
    def delta_total(self) -> Any:
        """V_0^2 - V_b^2 - V_c^2 of the horizontal speeds, the sum of the two (P4.11).

        In m^2/s^2; above 0 the paths part at less than a right angle, below 0 at more.
        """
        across = self.speed * np.sin(self.cut)
        return plain(2.0 * self.sideways * across - 2.0 * np.square(self.sideways))

    @property
    def energy_lost(self) -> Any:
        """The energy that friction turns into heat, in joules, including vertical friction.

        Notes
        -----
        Source: P4.10. The vertical part takes 3 V_bz^2 and not 7/2, since only one of the two
        balls can move up.
        """
        upright = self.upward * self.slip[1] - 3.0 * np.square(self.upward)
        return plain(self.ball.mass * (0.5 * self.delta_inelastic + upright))

    @property
    def angular_momentum_change(self) -> Any:
        """The angular momentum that the table adds about y, in kg m^2/s (P4.12).

        Notes
        -----
        Source: P4.12, 2 I omega_by about the center of the cue ball, for topspin, where the
        table holds the object ball up. For draw the flight of the object ball carries just as
        much, and the table adds nothing.
        """
        pushed = np.minimum(self.upward, 0.0)
        return plain(2.0 * self.ball.mass * self.ball.radius * pushed)

    def jump(self, *, gravity: float = GRAVITY) -> Jump:
        """Return the object ball's flight; all 0 if it does not jump (P4.9).

        >>> from evenbreak.physics.units import INCH
        >>> jump = collide(0.0, -1.0, speed=36.0 * INCH).jump()
        >>> round(jump.height / INCH, 5), round(jump.distance / INCH, 3)
        (0.00518, 0.373)
        """
        up = np.maximum(self.upward, 0.0)
        pull = positive(gravity, "gravity")
        time = 2.0 * up / pull
        level = np.hypot(self.ahead, self.sideways)
        return Jump(plain(time), plain(up**2 / (2.0 * pull)), plain(level * time))

    @property
    def _cue_across(self) -> Any:
        """The cue ball's speed to the left of the line of centers, in m/s."""
        return self.speed * np.sin(self.cut) - self.sideways

    @property
    def _spin_before(self) -> Floats:
        around = np.asarray(self.speed) / self.ball.radius
        parts = np.broadcast_arrays(0.0, around * self.topspin, around * self.side)
        return np.stack(parts, axis=-1)

    def _turned(self, x: Any, y: Any, z: Any) -> Floats:
        """Convert a vector from the frame of the line of centers to the frame of the shot."""
        sin, cos = np.sin(self.cut), np.cos(self.cut)
        parts = np.broadcast_arrays(x * cos + y * sin, y * cos - x * sin, z)
        return np.stack(parts, axis=-1)


def collide(
    cut: Any,
    topspin: Any = 1.0,
    side: Any = 0.0,
    *,
    speed: Any = 1.0,
    mu: Any = BALL_FRICTION,
    friction: str = "limited",
    ball: Ball | None = None,
) -> Collision:
    """Return what happens when a cue ball hits a ball at rest.

    Parameters
    ----------
    cut
        cut angle in radians, -pi/2 to pi/2: above 0 the object ball is cut to the right.
    topspin
        J_y just before the hit: 1 in natural roll, 0 for stun, below 0 for draw.
    side
        J_z just before the hit; outside english is below 0 on a cut to the right.
    speed
        V_0, the speed of the cue ball, in m/s.
    mu
        coefficient of friction between the balls; `SlipFriction()` for a coefficient that falls
        with the slip speed.
    friction
        'limited': friction stops when the slip stops; 'shepard': the text's law, without that
        limit.
    ball
        both balls; default: a pool ball.

    Raises
    ------
    InputError
        if a number is not finite or out of range, or `friction` is neither of the two.

    Notes
    -----
    Source: P4.2 to P4.12. A cut to the left with the other `side` is the mirror image.

    >>> hit = collide(np.radians(30.0), 0.0, speed=2.0)
    >>> round(float(np.degrees(hit.throw)), 2), hit.object_velocity.round(3)
    (3.18, array([ 1.548, -0.783,  0.   ]))
    >>> bool(hit.energy_lost > 0.0)
    True
    """
    mu, speed = checked_friction(mu, speed)
    cut, topspin, side = shot_of(cut, topspin, side, speed=speed, mu=mu)
    sin, cos = np.sin(cut), np.cos(cut)
    slip = slip_of(sin, cos, topspin, side)
    mu = friction_of_slip(mu, speed, *slip)
    left, up = thrown(cos, *slip, mu, friction)
    numbers = (cut, topspin, side, speed, mu, speed * cos, speed * left, speed * up)
    return Collision(kind_or_usual(ball, "ball", Ball), *map(plain, numbers))


def axis_tilt(throw: Any) -> Any:
    """Return the tilt of the axis of a thrown ball once it rolls, in radians.

    Seen from behind, with horizontal friction alone: beta, about -7/2 of the throw.

    Parameters
    ----------
    throw
        epsilon, in radians.

    Notes
    -----
    Source: P4.8, tan(beta) = -7/2 sin(epsilon).

    >>> round(axis_tilt(0.01) / 0.01, 2)
    -3.5
    """
    return plain(np.arctan(-3.5 * np.sin(numbers(throw, "throw"))))
