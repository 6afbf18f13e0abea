"""From slide to natural roll (section 2, P2.1 to P2.3).

A ball slides as long as the point that touches the cloth moves. With velocity V and spin omega
about a horizontal axis, that point slips over the cloth at

    u = V + omega x (-R k) = (V_x - R omega_y, V_y + R omega_x)

and the cloth decelerates it by mu g against u. The slip u keeps its direction and shrinks at
7/2 mu g. So the force is constant, the path is a parabola, and natural roll starts after the
time 2/7 abs(u) / (mu g), at

    V_NR = 5/7 V + 2/7 R (omega_y, -omega_x)

regardless of the friction.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from evenbreak.arrays import FloatOrArray, Floats, own_arrays
from evenbreak.checks import kind_of, plain, together
from evenbreak.errors import InputError
from evenbreak.physics.objects import Ball, Cloth
from evenbreak.physics.units import numbers


def sliding_ball_speed(speed: Any, rim_speed: Any, rim_speed_now: Any) -> Any:
    """Return the speed of a sliding ball when its rim has a given speed (P2.1).

    Parameters
    ----------
    speed, rim_speed
        V_0 and R omega_0 at the start, in m/s; R omega is below 0 for backspin.
    rim_speed_now
        R omega now, in m/s.

    >>> sliding_ball_speed(60.0, -45.0, 30.0)
    30.0
    """
    speed, before = numbers(speed, "speed"), numbers(rim_speed, "rim_speed")
    now = numbers(rim_speed_now, "rim_speed_now")
    together(speed=speed, rim_speed=before, rim_speed_now=now)
    return plain(speed - 0.4 * (now - before))


def roll_speed(speed: FloatOrArray, rim_speed: FloatOrArray) -> FloatOrArray:
    """Return the speed of natural roll that a ball with topspin or draw reaches (P2.2).

    Parameters
    ----------
    speed, rim_speed
        V_0 and R omega_0, in m/s; R omega_0 is below 0 for backspin.

    >>> round(roll_speed(1.0, 0.0), 4), round(roll_speed(1.0, -1.0), 4)
    (0.7143, 0.4286)
    """
    speed, rim_speed = numbers(speed, "speed"), numbers(rim_speed, "rim_speed")
    together(speed=speed, rim_speed=rim_speed)
    return plain((5.0 * speed + 2.0 * rim_speed) / 7.0)


def roll_velocity(velocity: Any, rim_velocity: Any) -> Floats:
    """Return the velocity of natural roll, in m/s; shape (..., 2).

    Parameters
    ----------
    velocity
        V in m/s, shape (..., 2).
    rim_velocity
        R omega in m/s, shape (..., 3) or (..., 2); the component about the vertical axis does
        not matter.

    >>> roll_velocity([0.0, 1.0], [0.0, 1.75, 9.0])
    array([0.5       , 0.71428571])
    """
    moving, forward = _vectors(velocity, "velocity", 2), _forward(rim_velocity, "rim_velocity")
    together(**{"velocity[..., 0]": moving[..., 0], "rim_velocity[..., 0]": forward[..., 0]})
    return np.asarray((5.0 * moving + 2.0 * forward) / 7.0)


def parabola(ahead: Any, velocity: Any, cloth: Cloth) -> Any:
    """Return where a sliding ball is on its parabola, in meters along the force (P2.3).

    Parameters
    ----------
    ahead
        x: meters across the force of the cloth.
    velocity
        (V_0x, V_0y) in m/s: across the force, not 0, and along it.
    cloth
        on which the ball slides.

    Notes
    -----
    Source: P2.3, y = (V_0y / V_0x) x + mu g x^2 / (2 V_0x^2), with y along the force.

    >>> parabola(1.0, (2.0, -1.0), Cloth(mu_slide=0.2, gravity=10.0))
    -0.25
    """
    velocity, x = _vectors(velocity, "velocity", 2), numbers(ahead, "ahead")
    across, along = velocity[..., 0], velocity[..., 1]
    together(**{"ahead": x, "velocity[..., 0]": across})
    if not np.all(across):
        raise InputError(
            "velocity is 0 across the force, so the path is a straight line, not a parabola"
        )
    return plain(along / across * x + 0.5 * _pull_of(cloth) * (x / across) ** 2)


def stun_distance(speed: FloatOrArray, spin: FloatOrArray, cloth: Cloth) -> FloatOrArray:
    """Return how far a ball slides until its backspin is gone, in meters: a stun shot from there.

    Parameters
    ----------
    speed
        V_0 in m/s.
    spin
        J = R omega_0 / V_0, from -5/2, where the ball stops at the same moment, to 0.
    cloth
        on which the ball slides.

    Notes
    -----
    Source: section 2 (draw, stun and drag shots), R omega = R omega_0 + 5/2 mu g t; exercise 2.2.

    >>> round(stun_distance(2.0, -0.5, Cloth(mu_slide=0.2, gravity=10.0)), 9)
    0.36
    """
    speed = numbers(speed, "speed", low=0.0)
    spin = numbers(spin, "spin", low=-2.5, high=0.0)
    together(speed=speed, spin=spin)
    time = -0.4 * spin * speed / _pull_of(cloth)
    return plain(speed * time * (1.0 + 0.2 * spin))


def drag_distance(speed: FloatOrArray, spin: FloatOrArray, cloth: Cloth) -> FloatOrArray:
    """Return how far a ball slides until natural roll starts, in meters.

    Parameters
    ----------
    speed
        V_0 in m/s.
    spin
        J = R omega_0 / V_0, -5/2 or more, so that the ball never goes backwards.
    cloth
        on which the ball slides.

    Notes
    -----
    Source: section 2, and exercise 2.1 for a drag shot.

    >>> round(drag_distance(2.0, -1.0, Cloth(mu_slide=0.2, gravity=10.0)), 9)
    0.816326531
    """
    speed = numbers(speed, "speed", low=0.0)
    spin = numbers(spin, "spin", low=-2.5)
    together(speed=speed, spin=spin)
    slip = 1.0 - spin
    time = 2.0 * np.abs(slip) * speed / (7.0 * _pull_of(cloth))
    return plain(speed * time * (1.0 - slip / 7.0))


@own_arrays
@dataclass(frozen=True, eq=False)
class Slide:
    """A ball from the start of its slide until it stops; arrays are several balls.

    Parameters
    ----------
    position, velocity
        at time 0, in meters and m/s; shape (..., 2).
    spin
        angular velocity at time 0, in rad/s; shape (..., 3).

    Raises
    ------
    InputError
        if they are not finite numbers of these shapes, or the shapes do not broadcast.

    Notes
    -----
    Source: P2.3. In this model sidespin, about the vertical axis, neither bends the path nor
    wears off.

    >>> shot = Slide(Ball(), Cloth(), [0.0, 0.0], [0.0, 1.0], [0.0, 35.0, 0.0])
    >>> shot.roll_velocity.round(4)
    array([0.2858, 0.7143])
    """

    ball: Ball
    cloth: Cloth
    position: Floats
    velocity: Floats
    spin: Floats

    def __post_init__(self) -> None:
        kind_of(self.ball, "ball", Ball)
        kind_of(self.cloth, "cloth", Cloth)
        names = {"position": 2, "velocity": 2, "spin": 3}
        for name, size in names.items():
            array = _vectors(getattr(self, name), name, size).copy()
            array.flags.writeable = False  # values computed from it are cached
            object.__setattr__(self, name, array)
        together(**{f"{name}[..., 0]": getattr(self, name)[..., 0] for name in names})

    @cached_property
    def slip(self) -> Floats:
        """The velocity of the point that touches the cloth, at time 0, in m/s; shape (..., 2)."""
        return self.velocity - self.ball.radius * _forward(self.spin)

    @cached_property
    def slide_time(self) -> Any:
        """Seconds until natural roll starts."""
        slip = np.hypot(self.slip[..., 0], self.slip[..., 1])
        return plain(2.0 * slip / (7.0 * self.cloth.slide_deceleration))

    @cached_property
    def roll_velocity(self) -> Floats:
        """The velocity at which natural roll starts, in m/s; shape (..., 2)."""
        return roll_velocity(self.velocity, self.ball.radius * self.spin)

    @cached_property
    def stop_time(self) -> Any:
        """Seconds until the ball stops."""
        speed = np.hypot(self.roll_velocity[..., 0], self.roll_velocity[..., 1])
        return plain(self.slide_time + speed / self.cloth.roll_deceleration)

    @property
    def stop_position(self) -> Floats:
        """Where the ball stops on an endless table, in meters; shape (..., 2)."""
        return self.at(self.stop_time)

    def at(self, time: Any) -> Floats:
        """Return where the ball is at a time, in meters; shape (..., 2).

        Parameters
        ----------
        time
            seconds; its shape must broadcast with that of the balls.
        """
        sliding, rolling = self._since(time)
        pull, resistance = self.cloth.slide_deceleration, self.cloth.roll_deceleration
        slid = self.velocity * sliding - 0.5 * pull * _direction(self.slip) * sliding**2
        start = self.roll_velocity
        rolled = start * rolling - 0.5 * resistance * _direction(start) * rolling**2
        return np.asarray(self.position + slid + rolled)

    def velocity_at(self, time: Any) -> Floats:
        """Return the velocity at a time, in m/s; shape (..., 2)."""
        sliding, rolling = self._since(time)
        now: Floats = (
            self.velocity
            - self.cloth.slide_deceleration * _direction(self.slip) * sliding
            - self.cloth.roll_deceleration * _direction(self.roll_velocity) * rolling
        )
        return now

    def spin_at(self, time: Any) -> Floats:
        """Return the angular velocity at a time, in rad/s; shape (..., 3)."""
        sliding, _ = self._since(time)
        pull = self.cloth.slide_deceleration
        gain = 2.5 * pull / self.ball.radius * sliding * _direction(self.slip)
        # The cloth's force -u at -R k turns the ball by R (-k) x (-u) = R k x u.
        level = self.spin[..., :2] + np.stack([-gain[..., 1], gain[..., 0]], axis=-1)
        rolling = (np.asarray(time) > self.slide_time)[..., None]
        now = self.velocity_at(time) / self.ball.radius
        level = np.where(rolling, np.stack([-now[..., 1], now[..., 0]], axis=-1), level)
        upright = np.broadcast_to(self.spin[..., 2:], (*level.shape[:-1], 1))
        return np.concatenate([level, upright], axis=-1)

    def _since(self, time: Any) -> tuple[Floats, Floats]:
        """Return for how long each ball has slid and rolled at a time; shape (..., 1)."""
        times = numbers(time, "time", low=0.0)
        together(time=times, **{"slip[..., 0]": self.slip[..., 0]})
        rolled = np.clip(times - self.slide_time, 0.0, self.stop_time - self.slide_time)
        return np.minimum(times, self.slide_time)[..., None], rolled[..., None]


def _pull_of(cloth: Cloth) -> float:
    """Return how fast a ball loses speed while it slides on a cloth, in m/s^2."""
    return kind_of(cloth, "cloth", Cloth).slide_deceleration


def _vectors(value: Any, name: str, size: int) -> Floats:
    """Return vectors as a float array, if they have `size` components along the last axis."""
    array = numbers(value, name)
    if array.ndim == 0 or array.shape[-1] != size:
        raise InputError(
            "{name} must have shape (..., {size}); its shape is {array_shape}",
            name=name,
            array_shape=array.shape,
            size=size,
        )
    return array


def _forward(spin: Any, name: str = "spin") -> Floats:
    """Return the velocity of natural roll for a spin, per meter of the radius."""
    spin = numbers(spin, name)
    if spin.ndim == 0 or spin.shape[-1] not in (2, 3):
        raise InputError(
            "{name} must have shape (..., 3); its shape is {spin_shape}",
            name=name,
            spin_shape=spin.shape,
        )
    return np.stack([spin[..., 1], -spin[..., 0]], axis=-1)


def _direction(vector: Floats) -> Floats:
    """Return unit vectors, and 0 for 0."""
    length = np.hypot(vector[..., 0], vector[..., 1])[..., None]
    return np.divide(vector, length, out=np.zeros_like(vector), where=length > 0.0)
