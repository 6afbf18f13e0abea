"""Sections 1 and 2, P1.1 to P2.6: balls, friction, table speed, miscues; sliding and rolling."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from evenbreak.physics import (
    BALL_SETS,
    LIQUIDS,
    MOON_GRAVITY,
    SHAPES,
    TABLE_SPEEDS,
    Ball,
    Cloth,
    Energy,
    PoolTable,
    Slide,
    density_range,
    drag_distance,
    floats_in,
    friction_of_incline,
    friction_of_stop,
    friction_of_throw,
    kinetic_energy,
    lag_distance,
    lag_speed,
    miscue_offset,
    parabola,
    roll_speed,
    roll_time,
    rolling_friction,
    rolling_time,
    sliding_ball_speed,
    sliding_distance,
    sliding_power,
    sliding_speed,
    spin_stop,
    table_speed,
    throw_angle,
    tip_friction_of,
    volume_range,
)
from evenbreak.physics.units import (
    CENTIMETER,
    DEGREE,
    GRAM,
    GRAVITY,
    INCH,
    OUNCE,
)
from evenbreak.source_text.published import Answers, Inputs

_POOL = BALL_SETS["pool"]
_CUBIC_INCH, _CUBIC_CENTIMETER = INCH**3, CENTIMETER**3
_DENSITY = GRAM / _CUBIC_CENTIMETER
_ENERGY = OUNCE * INCH**2
"""One oz in^2/s^2 in joules."""

_LONG = 1e3
"""A time in seconds by which any block has stopped."""


def _second_moment(first: int, second: int) -> float:
    """Return the mass integral of two coordinates' product, over M R^2, by quadrature."""
    ball = Ball()
    nodes, weights = np.polynomial.legendre.leggauss(12)
    radius = 0.5 * ball.radius * (nodes + 1.0)[:, None, None]
    height = nodes[None, :, None]
    around = math.pi * (nodes + 1.0)[None, None, :]
    across = radius * np.sqrt(1.0 - height**2)
    each = (
        0.5 * ball.radius * weights[:, None, None] * weights[None, :, None] * math.pi * weights
    ) * radius**2
    where = across * np.cos(around), across * np.sin(around), radius * height
    whole = ball.density * np.sum(each * where[first] * where[second])
    return float(whole) / (ball.mass * ball.radius**2)


def _sinks_and_floats() -> float:
    sinks, floats = (
        all(LIQUIDS[name] < density_range(_POOL)[0] for name in ("water", "sugar solution")),
        all(floats_in(_POOL, name) for name in ("caesium chloride solution", "mercury")),
    )
    return float(sinks and floats)


def _speed(i: Inputs) -> float:
    return float(sliding_speed(i["V_0"], i["mu"], i["t"]))


def _stopped(speed: float, mu: float) -> float:
    return float(sliding_distance(speed, mu, _LONG))


def _stop_friction(i: Inputs) -> float:
    time = i["V_0"] / (i["mu"] * GRAVITY)
    return float(friction_of_stop(_stopped(i["V_0"], i["mu"]), time))


def _times_as_far(i: Inputs, factor: float) -> float:
    return _stopped(factor * i["V_0"], i["mu"]) / _stopped(i["V_0"], i["mu"])


def _full_throw(i: Inputs) -> float:
    # By the text's law every stun shot has the full throw.
    return float(throw_angle(0.5, 0.0, mu=i["mu"], friction="shepard")) / DEGREE


_MU = 0.1
"""Any coefficient would do: the answers don't depend on it."""


def _rolling_energy() -> Energy:
    return kinetic_energy(Ball(), 1.0, 1.0)


def _shares() -> tuple[float, float]:
    energy = _rolling_energy()
    return energy.translational / energy.total, energy.rotational / energy.total


def _stopped_spin() -> float:
    """Return the J at which V_NR, which is linear in J, is 0."""
    without, each = roll_speed(1.0, 0.0), roll_speed(0.0, 1.0)
    return float(-without / each)


def _mean_drag_speed(i: Inputs) -> float:
    ball, cloth = Ball(), Cloth()
    shot = Slide(ball, cloth, [0.0, 0.0], [1.0, 0.0], [0.0, i["J"] / ball.radius, 0.0])  # type: ignore[arg-type]
    return float(drag_distance(1.0, i["J"], cloth)) / float(shot.slide_time)


def _time_saved(i: Inputs) -> float:
    """Return the share of time saved, compared with rolling at the arrival speed."""
    return 1.0 - float(roll_speed(1.0, i["J"])) / _mean_drag_speed(i)


def _drift_saved(i: Inputs) -> float:
    """Return the share of sideways drift saved on a table that isn't level.

    The comparison is with rolling at the arrival speed. A rolling ball accelerates down a slope
    beta by 5/7 g sin(beta). For a ball that slides for a time T, the sideways slip increases due to
    gravity and decreases due to friction, 7/2 as fast as friction pulls: with s = T - t left,

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
    """Return the distance along the force, given the distance across it at the end of the slide."""
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


def _of_stop(name: str, unit: float) -> Callable[[Inputs], Any]:
    def answer(i: Inputs) -> Any:
        stop = spin_stop(i["Rw_0"], Cloth(mu_slide=i["mu_s"], mu_roll=i["mu_eff"]))
        return getattr(stop, name) / unit

    return answer


ANSWERS: Answers = {
    ("P1.1", "R_min, in"): lambda _: 0.5 * (_POOL.diameters[0] - _POOL.tolerance) / INCH,
    ("P1.1", "R_max, in"): lambda _: 0.5 * (_POOL.diameters[0] + _POOL.tolerance) / INCH,
    ("P1.1", "V, in^3"): lambda i: Ball(radius=i["R"]).volume / _CUBIC_INCH,
    ("P1.1", "V_min, in^3"): lambda _: volume_range(_POOL)[0] / _CUBIC_INCH,
    ("P1.1", "V_min, cm^3"): lambda _: volume_range(_POOL)[0] / _CUBIC_CENTIMETER,
    ("P1.1", "V_max, in^3"): lambda _: volume_range(_POOL)[1] / _CUBIC_INCH,
    ("P1.1", "V_max, cm^3"): lambda _: volume_range(_POOL)[1] / _CUBIC_CENTIMETER,
    ("P1.2", "M_min, g"): lambda _: _POOL.masses[0] / GRAM,
    ("P1.2", "M_max, g"): lambda _: _POOL.masses[1] / GRAM,
    ("P1.2", "M_min in the line of rho_min, g"): lambda _: _POOL.masses[0] / GRAM,
    ("P1.2", "rho_min, g/cm^3"): lambda _: density_range(_POOL)[0] / _DENSITY,
    ("P1.2", "rho_max, g/cm^3"): lambda _: density_range(_POOL)[1] / _DENSITY,
    ("P1.2", "density, g/cm^3"): lambda i: LIQUIDS[i["liquid"]] / _DENSITY,
    ("P1.2", "sinks in water and sugar, floats in the other two (1: so it is)"): lambda _: (
        _sinks_and_floats()
    ),
    ("P1.3", "S_zz/(M R^2), integrated"): lambda _: _second_moment(2, 2),
    ("P1.3", "I/(M R^2)"): lambda _: Ball().inertia / (Ball().mass * Ball().radius ** 2),
    ("P1.3", "I_xy/(M R^2), integrated"): lambda _: -_second_moment(0, 1),
    ("Section 1", "T_rot/(M R^2 omega^2)"): lambda _: (
        kinetic_energy(Ball(), 0.0, 1.0).rotational / Ball().mass
    ),
    ("P1.4", "mu = tan(alpha)"): lambda i: friction_of_incline(i["alpha"]),
    ("Section 1", "V of a block, in/s"): lambda i: _speed(i) / INCH,
    ("Section 1", "x of a block, in"): lambda i: sliding_distance(i["V_0"], i["mu"], i["t"]) / INCH,
    ("Section 1", "T of a block, oz in^2/s^2"): lambda i: 0.5 * i["M"] * _speed(i) ** 2 / _ENERGY,
    ("Section 1", "distance, when the energy doubles, over the one before"): lambda i: (
        _times_as_far(i, math.sqrt(2.0))
    ),
    ("Section 1", "distance, when the velocity doubles, over the one before"): lambda i: (
        _times_as_far(i, 2.0)
    ),
    ("Section 1", "dT/dt of a block, oz in^2/s^3"): lambda i: (
        sliding_power(_speed(i), i["mu"], i["M"]) / _ENERGY
    ),
    ("Section 1", "mu from the distance and the time of a stop"): _stop_friction,
    ("Section 1", "dV/dt of a rolling ball, in/s^2"): lambda i: (
        -1.0 / roll_time(1.0, Cloth(mu_roll=i["mu_eff"])) / INCH
    ),
    ("P1.5", "way of the center between the cushions, in"): lambda _: (
        lag_distance(PoolTable(), Ball()) / INCH
    ),
    ("P1.5", "table speed over t^2, 1/s^2"): lambda _: table_speed(1.0),
    ("P1.5", "table speed"): lambda i: table_speed(i["t"]),
    ("P1.5", "table speed over t^2, rule of thumb, 1/s^2"): lambda _: table_speed(1.0),
    ("P1.5", "V_0 off the last cushion, in/s"): lambda i: lag_speed(i["t"]) / INCH,
    ("P1.5", "V_0 over the mean speed"): lambda i: (
        lag_speed(i["t"]) * i["t"] / lag_distance(PoolTable(), Ball())
    ),
    ("P1.6", "mu of two balls"): lambda i: friction_of_throw(i["s"], i["D"]),
    ("P1.6", "full throw, deg"): _full_throw,
    ("P1.7", "mu of a tip that slips at b/R"): lambda i: tip_friction_of(i["b/R"]),
    ("P1.7", "b_max/R"): lambda i: miscue_offset(i["mu"]),
    # Numbers that the text takes as given.
    ("Section 1", "diameter, in"): lambda i: (
        BALL_SETS[i["balls"]].diameters[int(i["n"]) - 1] / INCH
    ),
    ("Section 1", "tolerance of the diameter, in"): lambda i: (
        BALL_SETS[i["balls"]].tolerance / INCH
    ),
    ("Section 1", "least mass, oz"): lambda i: BALL_SETS[i["balls"]].masses[0] / OUNCE,
    ("Section 1", "largest mass, oz"): lambda i: BALL_SETS[i["balls"]].masses[1] / OUNCE,
    ("P1.2", "grams in an ounce"): lambda _: OUNCE / GRAM,
    ("Section 1", "table speed, least"): lambda i: TABLE_SPEEDS[i["class"]][0],
    ("Section 1", "table speed, most"): lambda i: TABLE_SPEEDS[i["class"]][1],
    ("P1.5", "length of the playing area, in"): lambda _: PoolTable().length / INCH,
    ("P1.5", "width of the playing area, in"): lambda _: PoolTable().width / INCH,
    ("P1.5", "g, in/s^2"): lambda _: GRAVITY / INCH,
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
"""How each quantity in these problems is computed."""
