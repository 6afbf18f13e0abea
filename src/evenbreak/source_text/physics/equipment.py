"""Section 1, P1.1 to P1.7: balls, friction, the speed of a table, the miscue."""

from __future__ import annotations

import math

import numpy as np

from evenbreak.physics.friction import (
    friction_of_incline,
    friction_of_stop,
    friction_of_throw,
    miscue_offset,
    sliding_distance,
    sliding_power,
    sliding_speed,
    tip_friction_of,
)
from evenbreak.physics.objects import (
    BALL_SETS,
    LIQUIDS,
    Ball,
    Cloth,
    PoolTable,
    density_range,
    floats_in,
    volume_range,
)
from evenbreak.physics.rolling import (
    TABLE_SPEEDS,
    kinetic_energy,
    lag_distance,
    lag_speed,
    roll_time,
    table_speed,
)
from evenbreak.physics.throw import throw_angle
from evenbreak.physics.units import (
    CENTIMETRE,
    DEGREE,
    GRAM,
    GRAVITY,
    INCH,
    OUNCE,
)
from evenbreak.source_text.inputs import Answers, Inputs

_POOL = BALL_SETS["pool"]
_CUBIC_INCH, _CUBIC_CENTIMETRE = INCH**3, CENTIMETRE**3
_DENSITY = GRAM / _CUBIC_CENTIMETRE
_ENERGY = OUNCE * INCH**2
"""One oz in^2/s^2 in joules."""

_LONG = 1e3
"""Seconds after which any block has stopped."""


def _second_moment(first: int, second: int) -> float:
    """Return the mass integral of the product of two coordinates, over M R^2, by quadrature."""
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


ANSWERS: Answers = {
    ("P1.1", "R_min, in"): lambda _: 0.5 * (_POOL.diameters[0] - _POOL.tolerance) / INCH,
    ("P1.1", "R_max, in"): lambda _: 0.5 * (_POOL.diameters[0] + _POOL.tolerance) / INCH,
    ("P1.1", "V, in^3"): lambda i: Ball(radius=i["R"]).volume / _CUBIC_INCH,
    ("P1.1", "V_min, in^3"): lambda _: volume_range(_POOL)[0] / _CUBIC_INCH,
    ("P1.1", "V_min, cm^3"): lambda _: volume_range(_POOL)[0] / _CUBIC_CENTIMETRE,
    ("P1.1", "V_max, in^3"): lambda _: volume_range(_POOL)[1] / _CUBIC_INCH,
    ("P1.1", "V_max, cm^3"): lambda _: volume_range(_POOL)[1] / _CUBIC_CENTIMETRE,
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
    ("P1.5", "way of the centre between the cushions, in"): lambda _: (
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
}
"""How each quantity of these problems is computed."""
