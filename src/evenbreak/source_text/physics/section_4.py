"""Section 4, P4.1 to P4.27: two balls colliding, and where the cue ball goes once it rolls."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import brentq

from evenbreak.physics import (
    BALL_FRICTION,
    NATURAL_ROLL_OFFSET,
    Ball,
    Cloth,
    Collision,
    PoolTable,
    aim,
    axis_tilt,
    collide,
    deflection,
    deflection_slope,
    energy_after_hit,
    energy_in_roll,
    full_throw_cut,
    gearing_side,
    gearing_tip,
    kinetic_energy,
    largest_deflection_cut,
    offset_for,
    right_angle_cut,
    roll_velocity,
    split_cut,
    split_roll_cut,
    throw_angle,
    throw_factor,
    throw_sensitivity,
    unit_slope_cut,
)
from evenbreak.physics.units import DEGREE, FOOT, GRAVITY, INCH
from evenbreak.source_text.published import Answers, Inputs

_HALF_BALL = math.asin(0.5)


def _spins(i: Inputs) -> tuple[float, float, float]:
    return i["alpha"], i["Jy"], i["Jz"]


def _hit(i: Inputs) -> Collision:
    """Return the hit under the text's friction law."""
    return collide(*_spins(i), speed=i.get("V_0", 1.0), friction="shepard")


def _factor(i: Inputs) -> float:
    return float(throw_factor(*_spins(i)))


def _straight(i: Inputs) -> Collision:
    return collide(0.0, i["Jy"], speed=i.get("V_0", 1.0), friction="shepard")


def _upward_share(hit: Collision) -> float:
    """Return sin(gamma), the k component of e."""
    left, up = hit.slip
    return float(up) / math.hypot(left, up)


def _along_centers(hit: Collision, vector: Any) -> Any:
    """Transform a vector from the shot's frame to that of the line of centers."""
    sin, cos = math.sin(hit.cut), math.cos(hit.cut)
    x, y, z = vector
    return np.array([x * cos - y * sin, x * sin + y * cos, z])


def _half_ball_holds() -> float:
    hit = collide(_HALF_BALL, 0.0)
    return float(
        hit.delta_elastic > 0.0 and hit.delta_inelastic > 0.0 and hit.departure < 0.5 * math.pi
    )


def _momentum_gained(i: Inputs) -> float:
    hit = _hit(i)
    gained = hit.object_velocity + hit.cue_velocity - np.array([hit.speed, 0.0, 0.0])
    return float(np.max(np.abs(gained[:2])))


def _spin_energy(i: Inputs) -> float:
    """Return 4/5 R^2 omega_b omega_c."""
    hit = _hit(i)
    return 0.8 * hit.ball.radius**2 * float(hit.object_spin[2] * hit.cue_spin[2])


def _spin_gained(i: Inputs) -> float:
    hit = _hit(i)
    return hit.ball.radius * float(hit.cue_spin[2] - hit.object_spin[2])


def _spin_left(i: Inputs) -> float:
    side = 2.5 * BALL_FRICTION * math.cos(i["alpha"])
    hit = collide(i["alpha"], 0.0, side, friction="shepard")
    return hit.ball.radius * float(hit.cue_spin[2])


def _slope(function: Callable[[float], float], at: float) -> float:
    """Return a smooth function's derivative, to at least nine digits."""
    step = 3e-4
    near = function(at + step) - function(at - step)
    far = function(at + 2.0 * step) - function(at - 2.0 * step)
    return (8.0 * near - far) / (12.0 * step)


def _by_topspin(i: Inputs) -> float:
    return _slope(lambda topspin: float(throw_factor(i["alpha"], topspin, i["Jz"])), i["Jy"])


def _by_side(i: Inputs) -> float:
    return _slope(lambda side: float(throw_factor(i["alpha"], i["Jy"], side)), i["Jz"])


def _aim(i: Inputs) -> float:
    # P4.6 calls sin(alpha) the impact parameter over R.
    return float(aim(math.asin(i["b/R"]), i["D"], mu=i["mu"]).offset_of_text)


def _rolling(i: Inputs) -> tuple[Any, Any, float]:
    """Return the object ball's velocity before and in natural roll, and its sidespin R omega."""
    hit = _hit(i)
    rim = hit.ball.radius * hit.object_spin
    return hit.object_velocity[:2], roll_velocity(hit.object_velocity[:2], rim), float(rim[2])


def _slowing(i: Inputs) -> float:
    before, after, _ = _rolling(i)
    return float(np.hypot(*after) / np.hypot(*before))


def _tilt(i: Inputs) -> float:
    _, after, side = _rolling(i)
    return side / float(np.hypot(*after))


def _energy_made(cut: float) -> float:
    return float(collide(cut, 0.0, friction="shepard").delta_inelastic)


def _momenta(i: Inputs) -> tuple[Any, Any, Any]:
    """Return the orbit's part with the jump, spin gained, and a jump's part: over M R V_0."""
    hit = _hit(i)
    arm = np.array([2.0, 0.0, 0.0])
    flat = np.array([hit.ahead, hit.sideways, 0.0])
    flight = np.array([0.0, 0.0, max(hit.upward, 0.0)])
    before = np.array([0.0, hit.topspin, hit.side]) * hit.speed
    spin = hit.ball.radius * (hit.object_spin + hit.cue_spin)
    gained = 0.4 * _along_centers(hit, spin) - 0.4 * _along_centers(hit, before)
    return np.cross(arm, flat), gained, np.cross(arm, flight)


def _object_spin(i: Inputs, axis: int) -> float:
    hit = _hit(i)
    return float(_along_centers(hit, hit.object_spin)[axis])


def _gained(i: Inputs, *, jump: bool) -> Any:
    orbit, spin, flight = _momenta(i)
    return orbit + spin + (flight if jump else 0.0)


def _contact(i: Inputs) -> float:
    """Return y/R for the cue ball's contact point, to the right of its center."""
    return -math.sin(i["alpha"])


def _of_hit(name: str, *, scale: float = 1.0) -> Callable[[Inputs], Any]:
    return lambda i: scale * getattr(_hit(i), name)


_SMALL = 1e-5
"""A cut, in radians, that stands for the limit of small cuts."""

_FULL = 1e-9
"""A cut, in radians, for a nearly full hit."""

_NATURAL, _STUN, _REVERSE = 1.0, 0.0, -1.0


def _topspin(i: Inputs) -> float:
    return float(i.get("Jy", _NATURAL))


def _theta(i: Inputs) -> float:
    return float(deflection(i["alpha"], _topspin(i)))


def _velocity(i: Inputs, ball: str, axis: int) -> float:
    """Return a velocity just after a frictionless hit, divided by V_0."""
    hit = collide(i["alpha"], _NATURAL, mu=0.0)
    return float(getattr(hit, f"{ball}_velocity")[axis])


def _rolling_velocity(i: Inputs, ball: str, axis: int) -> float:
    """Return the same once the ball rolls."""
    hit = collide(i["alpha"], _NATURAL, mu=0.0)
    velocity, spin = getattr(hit, f"{ball}_velocity"), getattr(hit, f"{ball}_spin")
    return float(roll_velocity(velocity[:2], hit.ball.radius * spin)[axis])


def _small_slope(i: Inputs) -> float:
    spin = _topspin(i)
    limit = math.pi if spin < 0.0 else 0.0
    return abs(limit - float(deflection(_SMALL, spin))) / _SMALL


def _largest(unit: float = 1.0) -> float:
    return float(deflection(largest_deflection_cut())) / unit


def _half(topspin: float, unit: float = 1.0) -> float:
    return float(split_roll_cut(topspin)) / unit


def _tangent(cut: float, topspin: float) -> float:
    return math.tan(cut + float(deflection(cut, topspin)))


def _share_after() -> float:
    shares = energy_after_hit(split_cut(_NATURAL), _NATURAL)
    return float(shares.object_ball / (shares.object_ball + shares.cue_ball))


def _common_splits() -> list[float]:
    """Return every J at which some cut splits the energy just after the hit and in natural roll."""

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
    """Return where twice a stun shot's deflection is a right angle."""
    return float(
        brentq(lambda cut: 2.0 * deflection(cut, _STUN) - 0.5 * math.pi, 0.1, 1.5, xtol=1e-15)
    )


def _estimate_error(i: Inputs) -> float:
    return 100.0 * (1.0 - float(right_angle_cut(i["Jy"])) / _estimated_right_angle())


def _in(unit: float, function: Callable[[float], Any]) -> Callable[[Inputs], Any]:
    """Return a function for an angle that depends only on the topspin."""
    return lambda i: function(i["Jy"]) / unit


ANSWERS: Answers = {
    ("Section 4", "deviation of 4 degrees over 8 feet, in"): lambda _: (
        8.0 * FOOT * math.tan(4.0 * DEGREE) / INCH
    ),
    ("Section 4", "half a diamond, in"): lambda _: PoolTable().length / 16.0 / INCH,
    ("Section 4", "departure angle below 90, deg"): lambda _: (
        90.0 - collide(_HALF_BALL, 0.0).departure / DEGREE
    ),
    ("Section 4", "Delta_elastic > 0, Delta_inelastic > 0 and D < 90 (1: so it is)"): lambda _: (
        _half_ball_holds()
    ),
    ("Section 4", "cos D = Delta_total/(2 V_b V_c)"): lambda i: math.cos(_hit(i).departure),
    ("Section 4", "momentum gained in the plane over M V_0"): _momentum_gained,
    ("Section 4", "departure angle without friction, deg"): lambda i: (
        collide(i["alpha"], mu=0.0).departure / DEGREE
    ),
    ("P4.1", "Delta_elastic/V_0^2 = 4/5 R^2 omega_b omega_c/V_0^2"): _spin_energy,
    ("P4.1", "R (omega_c - omega_b)/V_0"): _spin_gained,
    ("P4.1", "R omega_c/V_0 after J_z = 5/2 mu cos(alpha)"): _spin_left,
    ("P4.2", "cos(gamma)"): _factor,
    ("P4.2", "tan(epsilon)"): lambda i: math.tan(_hit(i).throw),
    ("Section 4", "k component of e, first line"): lambda i: _upward_share(_hit(i)),
    ("Section 4", "cut angle of a half-ball hit, deg"): lambda _: (
        math.asin(Ball().radius / Ball().diameter) / DEGREE
    ),
    ("P4.3", "cos(gamma)"): _factor,
    ("P4.3", "tan(epsilon) of stun"): lambda i: math.tan(throw_angle(i["alpha"], 0.0)),
    ("P4.3", "cut from which stun has its full throw, deg"): lambda _: full_throw_cut() / DEGREE,
    ("P4.4", "cos(gamma)"): _factor,
    ("P4.5", "dcos(gamma)/dJ_0y"): _by_topspin,
    ("P4.5", "dcos(gamma)/dJ_0z as printed"): _by_side,
    ("P4.5", "dcos(gamma)/dJ_0z"): _by_side,
    ("P4.5", "F(J_0)"): lambda i: throw_sensitivity(*_spins(i)),
    ("P4.5", "dcos(gamma)/dJ_0z for small J_0y"): _by_side,
    ("P4.5", "dcos(gamma)/dJ_0z where V_cpy = 0"): _by_side,
    ("P4.6", "cos(gamma)"): _factor,
    ("P4.6", "largest throw, in"): lambda i: (
        i["D"] * math.tan(throw_angle(_HALF_BALL, 0.0, mu=i["mu"])) / INCH
    ),
    ("P4.6", "s, in"): lambda i: _aim(i) / INCH,
    ("P4.6", "throw, deg"): lambda i: throw_angle(*_spins(i)) / DEGREE,
    ("P4.7", "omega_bz, rad/s"): lambda i: _object_spin(i, 2),
    ("P4.7", "omega_by, rad/s"): lambda i: _object_spin(i, 1),
    ("P4.8", "V_bNR/V_b"): _slowing,
    ("P4.8", "level spin in natural roll, rad/s"): lambda i: (
        float(np.hypot(*_rolling(i)[1])) / Ball().radius
    ),
    ("P4.8", "tan(beta)"): _tilt,
    ("P4.8", "beta/epsilon for small epsilon"): lambda _: axis_tilt(1e-6) / 1e-6,
    ("P4.8", "F_s/F_avg"): lambda i: (
        Cloth(mu_slide=i["mu_s"]).mu_slide * GRAVITY * i["t"] / i["V_bx"]
    ),
    ("P4.8", "F_grav/F_avg"): lambda i: GRAVITY * i["t"] / i["V_bx"],
    ("P4.9", "sin(gamma) of straight draw"): lambda i: _upward_share(_straight(i)),
    ("P4.9", "V_bz, in/s"): lambda i: _straight(i).upward / INCH,
    # The ball falls for as long as it rises.
    ("P4.9", "t_max, s"): lambda i: 0.5 * _straight(i).jump().time,
    ("P4.9", "z_max, in"): lambda i: _straight(i).jump().height / INCH,
    ("P4.9", "x when it lands, in"): lambda i: _straight(i).jump().distance / INCH,
    ("P4.10", "E_inelastic/(M V_0^2)"): _of_hit("delta_inelastic", scale=0.5),
    ("P4.10", "least E_inelastic/(M V_0^2)"): _of_hit("delta_inelastic", scale=0.5),
    ("P4.10", "stun cut below which the text's law makes energy, deg"): lambda _: (
        brentq(_energy_made, 0.01, 0.5, xtol=1e-15) / DEGREE
    ),
    ("P4.11", "Delta_inelastic/V_0^2"): _of_hit("delta_inelastic"),
    ("P4.11", "Delta_elastic/V_0^2"): _of_hit("delta_elastic"),
    ("P4.11", "Delta_total/V_0^2"): _of_hit("delta_total"),
    ("P4.11", "D, rad"): _of_hit("departure"),
    ("P4.11", "D where V_cpy = 0, deg"): lambda i: (
        collide(i["alpha"], i["Jy"], gearing_side(i["alpha"])).departure / DEGREE
    ),
    ("P4.12", "L_b of the orbit over M R V_0"): lambda i: _momenta(i)[0][2],
    ("P4.12", "L_b = -2 I omega_bz over M R V_0"): lambda i: (
        -0.8 * Ball().radius * _object_spin(i, 2)
    ),
    ("P4.12", "L_y - L_0y without the jump over M R V_0"): lambda i: _gained(i, jump=False)[1],
    ("P4.12", "L_x and L_z gained over M R V_0"): lambda i: np.max(
        np.abs(_gained(i, jump=True)[[0, 2]])
    ),
    ("P4.12", "L_y - L_0y with the jump over M R V_0"): lambda i: _gained(i, jump=True)[1],
    ("P4.26", "J_0z for no level friction"): lambda i: gearing_side(i["alpha"]),
    ("P4.27", "y_tip/R just after the tip"): lambda i: -offset_for(gearing_side(i["alpha"])),
    ("P4.27", "y_cp/R"): _contact,
    ("P4.27", "y_tip = -2/5 y_cp, over R"): lambda i: -NATURAL_ROLL_OFFSET * _contact(i),
    ("P4.27", "y_tip/R in natural roll"): lambda i: gearing_tip(i["alpha"], i["z/R"]).y,
    ("P4.27", "y_tip/(-y_cp) at z = 7/5 R"): lambda i: gearing_tip(i["alpha"]).y / -_contact(i),
    ("P4.13", "V_b j'/V_0"): lambda i: _velocity(i, "object", 1),
    ("P4.13", "V_c i'/V_0"): lambda i: _velocity(i, "cue", 0),
    ("P4.13", "V_bNR j'/V_0 as printed"): lambda i: _rolling_velocity(i, "object", 1),
    ("P4.13", "V_cNR i'/V_0"): lambda i: _rolling_velocity(i, "cue", 0),
    ("P4.13", "V_cNR j'/V_0"): lambda i: _rolling_velocity(i, "cue", 1),
    ("P4.13", "tan(theta)"): lambda i: math.tan(_theta(i)),
    ("P4.14", "tan(alpha + theta)"): lambda i: _tangent(i["alpha"], _NATURAL),
    ("P4.15", "dtheta/dalpha"): lambda i: deflection_slope(i["alpha"]),
    ("P4.15", "alpha_max, by search, rad"): lambda _: brentq(
        deflection_slope, 0.1, 1.0, xtol=1e-15
    ),
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
    ("P4.19", "T/(M V_0^2)"): lambda _: kinetic_energy(Ball(), 1.0, 1.0).total / Ball().mass,
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
    ("P4.21", "tan(alpha + theta)"): lambda i: _tangent(i["alpha"], _topspin(i)),
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
"""How each quantity in these problems is computed."""
