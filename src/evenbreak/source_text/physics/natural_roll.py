"""Section 2, P2.1 to P2.6: from slide to natural roll, and rolling."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from evenbreak.physics.objects import Ball, Cloth, PoolTable
from evenbreak.physics.rolling import (
    MOON_GRAVITY,
    SHAPES,
    Energy,
    SpinStop,
    kinetic_energy,
    lag_distance,
    rolling_friction,
    rolling_time,
    spin_stop,
    table_speed,
)
from evenbreak.physics.slide import (
    Slide,
    drag_distance,
    parabola,
    roll_speed,
    sliding_ball_speed,
)
from evenbreak.physics.units import GRAVITY, INCH
from evenbreak.source_text.inputs import Answers, Inputs

_MU = 0.1
"""Any coefficient would do: the answers do not depend on it."""


def _rolling_energy() -> Energy:
    return kinetic_energy(Ball(), 1.0, 1.0)


def _shares() -> tuple[float, float]:
    energy = _rolling_energy()
    return energy.translational / energy.total, energy.rotational / energy.total


def _stopped_spin() -> float:
    """Return the J at which V_NR, linear in J, is 0."""
    without, each = roll_speed(1.0, 0.0), roll_speed(0.0, 1.0)
    return float(-without / each)


def _mean_drag_speed(i: Inputs) -> float:
    ball, cloth = Ball(), Cloth()
    shot = Slide(ball, cloth, [0.0, 0.0], [1.0, 0.0], [0.0, i["J"] / ball.radius, 0.0])  # type: ignore[arg-type]
    return float(drag_distance(1.0, i["J"], cloth)) / float(shot.slide_time)


def _time_saved(i: Inputs) -> float:
    """Return the share of time saved, compared with rolling at the speed of arrival."""
    return 1.0 - float(roll_speed(1.0, i["J"])) / _mean_drag_speed(i)


def _drift_saved(i: Inputs) -> float:
    """Return the share of sideways drift saved on a table that is not level.

    Compared with rolling at the speed of arrival. A rolling ball accelerates down a slope beta by
    5/7 g sin(beta). For a ball that slides for a time T, the sideways slip grows as gravity makes
    it and falls as friction uses it up, 7/2 as fast as friction pulls: with s = T - t left,

        slip = g sin(beta) s ln(T/s),   acceleration = g sin(beta) (1 - 2/7 ln(T/s))

    and the integral of s times the acceleration is (1/2 - 1/14) g sin(beta) T^2.
    """
    sliding, rolling = 0.5 - 2.0 / 7.0 / 4.0, 0.5 * _shares()[0]
    return 1.0 - sliding / rolling * (1.0 - _time_saved(i)) ** 2


def _masse(i: Inputs) -> Slide:
    velocity = np.array([i["V_x"], i["V_y"]])
    spin = np.array([i["w_x"], i["w_y"], i["w_z"]])
    return Slide(Ball(), Cloth(), np.zeros(2), velocity, spin)


def _spread(i: Inputs) -> float:
    shot = _masse(i)
    time = np.linspace(0.0, 0.95, 20) * shot.slide_time
    spin = shot.spin_at(time)
    rim = shot.ball.radius * np.stack([spin[:, 1], -spin[:, 0]], axis=-1)
    slip = shot.velocity_at(time) - rim
    return float(np.ptp(np.arctan2(slip[:, 1], slip[:, 0])))


def _parabola(i: Inputs) -> float:
    """Return the distance along the force, from that across it at the end of the slide."""
    shot = _masse(i)
    along = -shot.slip / np.hypot(*shot.slip)
    across = np.array([along[1], -along[0]])
    velocity = np.array([shot.velocity @ across, shot.velocity @ along])
    return float(parabola(shot.at(shot.slide_time) @ across, velocity, shot.cloth)) / INCH


def _moon_time(i: Inputs, shape: str) -> float:
    friction = i.get("mu_rolling")
    if friction is None:
        friction = rolling_friction(1.0 / table_speed(i["t"]))
    way = lag_distance(PoolTable(), Ball())
    return float(rolling_time(way, friction, shape=SHAPES[shape], gravity=MOON_GRAVITY))


def _spin_stop(i: Inputs) -> SpinStop:
    return spin_stop(i["Rw_0"], Cloth(mu_slide=i["mu_s"], mu_roll=i["mu_eff"]))


def _of_stop(name: str, unit: float) -> Callable[[Inputs], Any]:
    return lambda i: getattr(_spin_stop(i), name) / unit


ANSWERS: Answers = {
    ("P2.1", "V, in/s"): lambda i: sliding_ball_speed(i["V_0"], i["Rw_0"], i["Rw"]) / INCH,
    ("P2.2", "V_NR, in/s"): lambda i: roll_speed(i["V_0"], i["Rw_0"]) / INCH,
    ("P2.2", "V_NR/V_0"): lambda i: roll_speed(1.0, i["J"]),
    ("P2.2", "J at which V_NR is 0"): lambda _: _stopped_spin(),
    ("Exercise 2.1", "mean speed of a drag shot over V_0"): _mean_drag_speed,
    ("Exercise 2.1", "how far the mean speed is below V_0, %"): lambda i: (
        100.0 * (1.0 - _mean_drag_speed(i))
    ),
    (
        "Exercise 2.1",
        "by how much off-level drift falls against natural roll all the way, %",
    ): lambda i: 100.0 * _drift_saved(i),
    (
        "Exercise 2.1",
        "by how much the time falls against natural roll all the way, %",
    ): lambda i: 100.0 * _time_saved(i),
    ("P2.3", "spread of the direction of friction during a slide, rad"): _spread,
    ("P2.3", "y of the parabola where the slide ends, in"): _parabola,
    ("P2.4", "T/(M V^2) in natural roll"): lambda _: _rolling_energy().total / Ball().mass,
    ("P2.4", "T_trans/T in natural roll"): lambda _: _shares()[0],
    ("P2.4", "T_rot/T in natural roll"): lambda _: _shares()[1],
    # dT/dt = -M g sin(alpha) V, and only this share of T is motion.
    ("Section 2", "dV/dt over g sin(alpha), rolling up a slope"): lambda _: -_shares()[0],
    ("Section 2", "force at the point of contact over M g sin(alpha)"): lambda _: (
        1.0 - _shares()[0]
    ),
    ("Section 2", "mu_eff/mu_rolling"): lambda _: _MU / rolling_friction(_MU),
    ("P2.5", "mu_rolling"): lambda i: rolling_friction(1.0 / i["table_speed"]),
    ("P2.5", "g on the moon over g"): lambda _: MOON_GRAVITY / GRAVITY,
    ("P2.5", "lag time of a cylinder on the moon, s"): lambda i: _moon_time(i, "cylinder"),
    ("P2.5", "lag time of a ball on the moon, s"): lambda i: _moon_time(i, "ball"),
    ("P2.5", "sqrt(g/g on the moon)"): lambda _: math.sqrt(GRAVITY / MOON_GRAVITY),
    ("P2.6", "V_NR, in/s"): _of_stop("roll_speed", INCH),
    ("P2.6", "t_NR, s"): _of_stop("slide_time", 1.0),
    ("P2.6", "d_NR, in"): _of_stop("slide_distance", INCH),
    ("P2.6", "t_R, s"): _of_stop("roll_time", 1.0),
    ("P2.6", "d_R, in"): _of_stop("roll_distance", INCH),
    ("P2.6", "d_total, in"): _of_stop("distance", INCH),
    # Numbers that the text takes as given.
    ("P2.5", "g on the moon, in/s^2"): lambda _: MOON_GRAVITY / INCH,
}
"""How each quantity of these problems is computed."""
