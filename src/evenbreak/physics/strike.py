"""Effect of the tip on the cue ball, on or off center (section 3), and the best break cue.

The cue is level and moves freely while the tip touches the ball, and the hit loses no energy.
With b the distance of the tip from the center in units of R, the ball gets

    V = 2 V_s / (1 + m/M_s + 5/2 b^2),   J_y = 5/2 up,   J_z = 5/2 right

and the stick keeps V_s - m/M_s V.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import FloatOrArray, Floats
from evenbreak.checks import kind_or_usual, plain, together
from evenbreak.errors import InputError
from evenbreak.physics.friction import miscue_offset
from evenbreak.physics.objects import Ball, Cue
from evenbreak.physics.offset import ball_speed_ratio, spin_of_offset
from evenbreak.physics.rolling import Energy, kinetic_energy
from evenbreak.physics.units import numbers, positive


@dataclass(frozen=True, eq=False)
class Strike:
    """A cue ball just after the hit of the tip: floats, or arrays for several strikes.

    Parameters
    ----------
    stick_speed
        of the cue just before the hit, in m/s.
    offset, side_offset
        of the tip from the ball's center over R: up and to the right.
    """

    ball: Ball
    cue: Cue
    stick_speed: Any
    offset: Any
    side_offset: Any

    @property
    def off_center(self) -> Any:
        """How far from the center the tip meets the ball, over R."""
        return plain(np.hypot(self.offset, self.side_offset))

    @property
    def miscue(self) -> Any:
        """Whether the tip slips, so that the other results do not apply (P1.7)."""
        slips = np.asarray(self.off_center) > miscue_offset(self.cue.tip_friction)
        return bool(slips) if slips.ndim == 0 else slips

    @property
    def speed(self) -> Any:
        """The speed of the ball, in m/s (P3.10)."""
        ratio = self.ball.mass / self.cue.mass
        return plain(self.stick_speed * ball_speed_ratio(self.off_center, ratio))

    @property
    def stick_speed_after(self) -> Any:
        """The speed of the cue after the hit, in m/s; below 0 if it bounces back."""
        return plain(self.stick_speed - self.ball.mass / self.cue.mass * self.speed)

    @property
    def topspin(self) -> Any:
        """J_y, below 0 for draw (P3.4)."""
        return spin_of_offset(self.offset)

    @property
    def side(self) -> Any:
        """J_z, above 0 for right english (P3.6)."""
        return spin_of_offset(self.side_offset)

    @property
    def velocity(self) -> Floats:
        """The ball's velocity ahead and to the left, in m/s; shape (..., 2)."""
        return np.stack(np.broadcast_arrays(self.speed, 0.0), axis=-1)

    @property
    def spin(self) -> Floats:
        """The ball's angular velocity, in rad/s; shape (..., 3)."""
        around = np.asarray(self.speed) / self.ball.radius
        parts = np.broadcast_arrays(0.0, around * self.topspin, around * self.side)
        return np.stack(parts, axis=-1)

    @property
    def energy(self) -> Energy:
        """The ball's kinetic energy, in joules."""
        return kinetic_energy(self.ball, self.speed, 2.5 * self.off_center * self.speed)


def strike(
    stick_speed: Any,
    offset: Any = 0.0,
    side_offset: Any = 0.0,
    *,
    ball: Ball | None = None,
    cue: Cue | None = None,
) -> Strike:
    """Strike a ball with a cue that moves at a given speed.

    Parameters
    ----------
    stick_speed
        of the cue just before the hit, in m/s.
    offset, side_offset
        of the tip from the ball's center over R: above 0 up and to the right. Their squares
        sum to 1 at most.
    ball, cue
        by default a pool ball of 6 ounces and a cue of 18 ounces.

    Raises
    ------
    InputError
        if a number is not finite or the tip misses the ball.

    Notes
    -----
    Source: P3.4, P3.6 and P3.10. If the tip slips, `miscue` is true.

    >>> hit = strike(2.0, -0.3)
    >>> round(hit.speed, 4), hit.topspin, round(hit.stick_speed_after, 4), hit.miscue
    (2.5668, -0.75, 1.1444, False)
    """
    speed = numbers(stick_speed, "stick_speed", low=0.0)
    up, right = _on_the_ball(offset, side_offset, stick_speed=speed)
    ball, cue = kind_or_usual(ball, "ball", Ball), kind_or_usual(cue, "cue", Cue)
    return Strike(ball, cue, plain(speed), plain(up), plain(right))


def strike_for_speed(
    ball_speed: Any,
    offset: Any = 0.0,
    side_offset: Any = 0.0,
    *,
    ball: Ball | None = None,
    cue: Cue | None = None,
) -> Strike:
    """Strike a ball so that it leaves at a given speed.

    Parameters
    ----------
    ball_speed
        of the ball just after the hit, in m/s.
    offset, side_offset, ball, cue
        as for `strike`.

    Raises
    ------
    InputError
        as `strike` does.

    >>> hit = strike_for_speed(3.0)
    >>> round(hit.stick_speed, 9), round(hit.speed, 9)
    (2.0, 3.0)
    """
    ball, cue = kind_or_usual(ball, "ball", Ball), kind_or_usual(cue, "cue", Cue)
    wanted = numbers(ball_speed, "ball_speed", low=0.0)
    up, right = _on_the_ball(offset, side_offset, ball_speed=wanted)
    ratio = ball_speed_ratio(np.hypot(up, right), ball.mass / cue.mass)
    return Strike(ball, cue, plain(wanted / ratio), plain(up), plain(right))


def _on_the_ball(offset: Any, side_offset: Any, **speed: Floats) -> tuple[Floats, Floats]:
    """Return both offsets as arrays, if the tip meets the ball and all of them broadcast."""
    up = numbers(offset, "offset", low=-1.0, high=1.0)
    right = numbers(side_offset, "side_offset", low=-1.0, high=1.0)
    together(offset=up, side_offset=right, **speed)
    if np.any(np.hypot(up, right) > 1.0):
        raise InputError(
            "offset and side_offset make the tip miss the ball. Give two whose squares add up "
            "to at most 1."
        )
    return up, right


class CenterHit(NamedTuple):
    """The speeds after a hit in the center, over the speed of the stick before it.

    Parameters
    ----------
    ball, stick
        of the ball and the stick; the stick's is below 0 if it bounces back.
    """

    ball: Any
    stick: Any


def stroke_speed(force: Any, length: Any, mass: Any) -> Any:
    """Return the speed of a stick pushed by a constant force along a stroke, in m/s (P3.1).

    Parameters
    ----------
    force, length, mass
        newtons, meters and kilograms, or any consistent units.

    >>> round(stroke_speed(10.0, 12.0, 18.0), 4)
    3.6515
    """
    force, length = numbers(force, "force", low=0.0), numbers(length, "length", low=0.0)
    mass = positive(mass, "mass")
    together(force=force, length=length, mass=mass)
    return plain(np.sqrt(2.0 * force * length / mass))


def center_hit(stick_ratio: Any) -> CenterHit:
    """Return the speeds after a hit in the center (P3.2).

    Parameters
    ----------
    stick_ratio
        mass of the stick over mass of the ball, such as 3 for 18 and 6 ounces.

    >>> center_hit(3.0)
    CenterHit(ball=1.5, stick=0.5)
    """
    ratio = numbers(stick_ratio, "stick_ratio", low=0.0)
    return CenterHit(plain(2.0 * ratio / (1.0 + ratio)), plain((ratio - 1.0) / (ratio + 1.0)))


def energy_share(stick_ratio: FloatOrArray) -> FloatOrArray:
    """Return the share of the stick's energy that a hit in the center gives the ball (P3.3).

    Parameters
    ----------
    stick_ratio
        mass of the stick over mass of the ball, such as 3 for 18 and 6 ounces.

    >>> energy_share(3.0), energy_share(1.0)
    (0.75, 1.0)
    """
    ratio = numbers(stick_ratio, "stick_ratio", low=0.0)
    return plain(4.0 * ratio / (1.0 + ratio) ** 2)


def stroke_energy(stick_energy: Any, stick_ratio: Any, forearm_ratio: Any) -> Any:
    """Return the energy of stick and forearm together, from the stick's energy (P3.3).

    The forearm is a thin uniform rod turning about the elbow; the stick moves with its end.

    Parameters
    ----------
    stick_energy
        in any unit.
    stick_ratio, forearm_ratio
        the masses of stick and forearm over that of the ball.

    Notes
    -----
    Source: P3.3, T = T_0 (1 + M_f / (3 M_s)); the text drops the factor T_0.

    >>> stroke_energy(3.0, 3.0, 6.0)
    5.0
    """
    stick = positive(stick_ratio, "stick_ratio")
    forearm = numbers(forearm_ratio, "forearm_ratio", low=0.0)
    energy = numbers(stick_energy, "stick_energy", low=0.0)
    together(stick_energy=energy, stick_ratio=stick, forearm_ratio=forearm)
    return plain(energy * (1.0 + forearm / (3.0 * stick)))


def break_energy_share(stick_ratio: FloatOrArray, forearm_ratio: FloatOrArray) -> FloatOrArray:
    """Return the share of the energy of stick and forearm that goes into the ball (P3.3).

    Parameters
    ----------
    stick_ratio
        mass of the stick over mass of the ball, such as 3 for 18 and 6 ounces.
    forearm_ratio
        mass of the forearm over that of the ball, such as 6 for 36 ounces.

    >>> break_energy_share(3.0, 6.0)
    0.45
    """
    stick = positive(stick_ratio, "stick_ratio")
    forearm = numbers(forearm_ratio, "forearm_ratio", low=0.0)
    together(stick_ratio=stick, forearm_ratio=forearm)
    return plain(4.0 * stick**2 / ((1.0 + stick) ** 2 * (stick + forearm / 3.0)))


def best_stick_ratio(forearm_ratio: FloatOrArray) -> FloatOrArray:
    """Return the mass of the best break stick, relative to the ball's mass (P3.3).

    Parameters
    ----------
    forearm_ratio
        mass of the forearm over that of the ball, such as 6 for 36 ounces; of the whole arm
        for a stroke from the shoulder.

    >>> round(6.0 * best_stick_ratio(36.0 / 6.0), 1), round(6.0 * best_stick_ratio(25.0), 1)
    (15.4, 27.7)
    """
    forearm = numbers(forearm_ratio, "forearm_ratio", low=0.0)
    return plain(0.5 + np.sqrt(0.25 + 2.0 / 3.0 * forearm))
