"""Section 4, P4.13 to P4.25: where the cue ball goes once it rolls."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import brentq

from evenbreak.physics.collision import collide
from evenbreak.physics.deflection import (
    deflection,
    deflection_slope,
    energy_after_hit,
    energy_in_roll,
    largest_deflection_cut,
    right_angle_cut,
    split_cut,
    split_roll_cut,
    unit_slope_cut,
)
from evenbreak.physics.objects import Ball
from evenbreak.physics.rolling import kinetic_energy
from evenbreak.physics.slide import roll_velocity
from evenbreak.physics.units import DEGREE
from evenbreak.source_text.inputs import Answers, Inputs

_SMALL = 1e-5
"""A cut, in radians, that stands for the limit of small cuts."""

_FULL = 1e-9
"""A cut, in radians, of a nearly full hit."""

_NATURAL, _STUN, _REVERSE = 1.0, 0.0, -1.0


def _spin(i: Inputs) -> float:
    return float(i.get("Jy", _NATURAL))


def _theta(i: Inputs) -> float:
    return float(deflection(i["alpha"], _spin(i)))


def _velocity(i: Inputs, ball: str, axis: int) -> float:
    """Return a velocity just after a hit without friction, over V_0."""
    hit = collide(i["alpha"], _NATURAL, mu=0.0)
    return float(getattr(hit, f"{ball}_velocity")[axis])


def _rolling(i: Inputs, ball: str, axis: int) -> float:
    """Return the same once the ball rolls."""
    hit = collide(i["alpha"], _NATURAL, mu=0.0)
    velocity, spin = getattr(hit, f"{ball}_velocity"), getattr(hit, f"{ball}_spin")
    return float(roll_velocity(velocity[:2], hit.ball.radius * spin)[axis])


def _small_slope(i: Inputs) -> float:
    spin = _spin(i)
    limit = math.pi if spin < 0.0 else 0.0
    return abs(limit - float(deflection(_SMALL, spin))) / _SMALL


def _largest(unit: float = 1.0) -> float:
    return float(deflection(largest_deflection_cut())) / unit


def _searched_largest() -> float:
    return float(brentq(deflection_slope, 0.1, 1.0, xtol=1e-15))


def _half(topspin: float, unit: float = 1.0) -> float:
    return float(split_roll_cut(topspin)) / unit


def _tangent(cut: float, topspin: float) -> float:
    return math.tan(cut + float(deflection(cut, topspin)))


def _share_after() -> float:
    shares = energy_after_hit(split_cut(_NATURAL), _NATURAL)
    return float(shares.object_ball / (shares.object_ball + shares.cue_ball))


def _total_energy() -> float:
    return float(kinetic_energy(Ball(), 1.0, 1.0).total) / Ball().mass


def _common_splits() -> list[float]:
    """Return every J at which one cut splits the energy just after the hit and in natural roll."""

    def apart(spin: float) -> float:
        return float(split_cut(spin)) - float(split_roll_cut(spin))

    grid = np.linspace(-1.58, 1.58, 318)
    signs = np.sign([apart(float(spin)) for spin in grid])
    changes = np.flatnonzero(signs[1:] != signs[:-1])
    return [float(brentq(apart, grid[k], grid[k + 1], xtol=1e-15)) for k in changes]


def _always_over(i: Inputs) -> float:
    cut = np.linspace(0.0, 0.5 * math.pi, 4002)[1:-1]
    return float(np.all(2.0 * deflection(cut, _STUN) > deflection(cut, i["Jy"])))


def _mean_slope(topspin: float) -> float:
    fall = deflection(_FULL, topspin) - deflection(0.5 * math.pi, topspin)
    return float(fall) / (0.5 * math.pi)


def _estimated_right_angle() -> float:
    """Return where twice the deflection of a stun shot is a right angle."""
    return float(
        brentq(lambda cut: 2.0 * deflection(cut, _STUN) - 0.5 * math.pi, 0.1, 1.5, xtol=1e-15)
    )


def _estimate_error(i: Inputs) -> float:
    return 100.0 * (1.0 - float(right_angle_cut(i["Jy"])) / _estimated_right_angle())


def _in(unit: float, function: Callable[[float], Any]) -> Callable[[Inputs], Any]:
    """Return how to compute an angle that depends on the topspin alone."""
    return lambda i: function(i["Jy"]) / unit


ANSWERS: Answers = {
    ("P4.13", "V_b j'/V_0"): lambda i: _velocity(i, "object", 1),
    ("P4.13", "V_c i'/V_0"): lambda i: _velocity(i, "cue", 0),
    ("P4.13", "V_bNR j'/V_0 as printed"): lambda i: _rolling(i, "object", 1),
    ("P4.13", "V_cNR i'/V_0"): lambda i: _rolling(i, "cue", 0),
    ("P4.13", "V_cNR j'/V_0"): lambda i: _rolling(i, "cue", 1),
    ("P4.13", "tan(theta)"): lambda i: math.tan(_theta(i)),
    ("P4.14", "tan(alpha + theta)"): lambda i: _tangent(i["alpha"], _NATURAL),
    ("P4.15", "dtheta/dalpha"): lambda i: deflection_slope(i["alpha"]),
    ("P4.15", "alpha_max, by search, rad"): lambda _: _searched_largest(),
    ("P4.15", "alpha_max, rad"): lambda _: largest_deflection_cut(),
    ("P4.15", "pi/alpha_max"): lambda _: math.pi / largest_deflection_cut(),
    ("P4.15", "alpha_max, deg"): lambda _: largest_deflection_cut() / DEGREE,
    ("P4.16", "theta_max, exact, rad"): lambda _: _largest(),
    ("P4.16", "theta_max, rad"): lambda _: _largest(),
    ("P4.16", "pi/theta_max"): lambda _: math.pi / _largest(),
    ("P4.16", "theta_max, deg"): lambda _: _largest(DEGREE),
    ("P4.17", "theta, deg"): lambda i: _theta(i) / DEGREE,
    ("P4.17", "theta_max - theta, deg"): lambda i: (_largest() - _theta(i)) / DEGREE,
    ("P4.18", "theta/alpha for small alpha"): _small_slope,
    ("P4.19", "T/(M V_0^2)"): lambda _: _total_energy(),
    ("P4.19", "alpha_half, rad"): lambda _: _half(_NATURAL),
    ("P4.19", "pi/alpha_half"): lambda _: math.pi / _half(_NATURAL),
    ("P4.19", "alpha_half, deg"): lambda _: _half(_NATURAL, DEGREE),
    ("P4.19", "theta at alpha_half, rad"): lambda _: deflection(_half(_NATURAL)),
    ("P4.19", "tan(alpha + theta) at alpha_half"): lambda _: _tangent(_half(_NATURAL), _NATURAL),
    ("P4.19", "T_bNR/T_0 at alpha_half"): lambda _: energy_in_roll(_half(_NATURAL)).object_ball,
    ("P4.19", "T_cNR/T_0 at alpha_half"): lambda _: energy_in_roll(_half(_NATURAL)).cue_ball,
    ("P4.19", "T_bNR/T_0 = 25/49 cos^2(alpha)"): lambda i: energy_in_roll(i["alpha"]).object_ball,
    ("P4.19", "T_cNR/T_0 as printed"): lambda i: energy_in_roll(i["alpha"]).cue_ball,
    ("P4.19", "T_cNR/T_0 = (45 sin^2(alpha) + 4)/49"): lambda i: (
        energy_in_roll(i["alpha"]).cue_ball
    ),
    ("P4.19", "object ball's share of T just after, at alpha_half"): lambda _: _share_after(),
    ("P4.19", "dtheta/dalpha"): lambda i: deflection_slope(i["alpha"]),
    ("P4.19", "alpha_crit, rad"): lambda _: unit_slope_cut(),
    ("P4.19", "alpha_crit, deg"): lambda _: unit_slope_cut() / DEGREE,
    ("P4.20", "alpha_half of stun, deg"): lambda _: _half(_STUN, DEGREE),
    ("P4.20", "T_b/T_0 just after, at alpha_half of stun"): lambda _: (
        energy_after_hit(split_cut(_STUN), _STUN).object_ball
    ),
    ("P4.20", "T_bNR/T_0 at alpha_half of stun"): lambda _: (
        energy_in_roll(_half(_STUN), _STUN).object_ball
    ),
    ("P4.20", "theta of stun as alpha goes to 0, deg"): lambda _: deflection(_FULL, _STUN) / DEGREE,
    ("P4.20", "theta of stun, rad"): lambda i: deflection(i["alpha"], _STUN),
    ("P4.21", "tan(theta)"): lambda i: math.tan(_theta(i)),
    ("P4.21", "tan(alpha + theta)"): lambda i: _tangent(i["alpha"], _spin(i)),
    ("P4.22", "cos^2(alpha) that splits T just after"): lambda i: math.cos(split_cut(i["Jy"])) ** 2,
    ("P4.22", "cos^2(alpha) that splits T in natural roll"): lambda i: (
        math.cos(split_roll_cut(i["Jy"])) ** 2
    ),
    ("P4.22", "least J at which one cut splits both"): lambda _: _common_splits()[0],
    ("P4.22", "largest J at which one cut splits both"): lambda _: _common_splits()[-1],
    ("P4.23", "tan(alpha + theta)/tan(alpha)"): lambda i: (
        _tangent(i["alpha"], i["Jy"]) / math.tan(i["alpha"])
    ),
    ("P4.23", "theta, rad"): _theta,
    ("P4.23", "(pi - theta)/alpha for small alpha"): _small_slope,
    ("P4.24", "theta where T splits in natural roll, rad"): lambda i: deflection(
        _half(i["Jy"]), i["Jy"]
    ),
    ("P4.24", "alpha_half, rad"): _in(1.0, split_roll_cut),
    ("P4.24", "pi/alpha_half"): lambda i: math.pi / _half(i["Jy"]),
    ("P4.24", "alpha_half, deg"): _in(DEGREE, split_roll_cut),
    ("P4.24", "alpha_half of J_y = -1 and 1 together, rad"): lambda _: (
        _half(_REVERSE) + _half(_NATURAL)
    ),
    ("P4.24", "theta/pi as alpha goes to 0"): lambda i: deflection(_FULL, i["Jy"]) / math.pi,
    ("P4.24", "theta, rad"): _theta,
    ("P4.24", "twice the angle of stun is always too large (1: so it is)"): _always_over,
    ("P4.24", "mean slope of theta over that of stun"): lambda i: (
        _mean_slope(i["Jy"]) / _mean_slope(_STUN)
    ),
    ("P4.24", "theta_max is more than pi/6 (1: so it is)"): lambda _: float(
        _largest() > math.pi / 6.0
    ),
    ("P4.25", "cut of a right angle, rad"): _in(1.0, right_angle_cut),
    ("P4.25", "pi/cut of a right angle"): lambda i: math.pi / right_angle_cut(i["Jy"]),
    ("P4.25", "cut of a right angle, deg"): _in(DEGREE, right_angle_cut),
    ("P4.25", "cut of a right angle by twice the angle of stun, deg"): lambda _: (
        _estimated_right_angle() / DEGREE
    ),
    ("P4.25", "error of that, %"): _estimate_error,
    ("P4.25", "cut of a right angle, about midway between a half-ball hit and 45, deg"): _in(
        DEGREE, right_angle_cut
    ),
}
"""How each quantity of these problems is computed."""
