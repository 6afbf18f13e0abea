"""Section 4, P4.1 to P4.12 and P4.26, P4.27: hits with and without friction between the balls."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import brentq

from evenbreak.physics.collision import Collision, axis_tilt, collide
from evenbreak.physics.friction import BALL_FRICTION
from evenbreak.physics.objects import Ball, Cloth, PoolTable
from evenbreak.physics.offset import NATURAL_ROLL_OFFSET, gearing_tip, offset_for
from evenbreak.physics.slide import roll_velocity
from evenbreak.physics.throw import (
    aim,
    full_throw_cut,
    gearing_side,
    throw_angle,
    throw_factor,
    throw_sensitivity,
)
from evenbreak.physics.units import DEGREE, FOOT, GRAVITY, INCH
from evenbreak.source_text.inputs import Answers, Inputs

_HALF_BALL = math.asin(0.5)


def _spins(i: Inputs) -> tuple[float, float, float]:
    return i["alpha"], i["Jy"], i["Jz"]


def _hit(i: Inputs) -> Collision:
    """Return the hit by the text's law of friction."""
    return collide(*_spins(i), speed=i.get("V_0", 1.0), friction="shepard")


def _factor(i: Inputs) -> float:
    return float(throw_factor(*_spins(i)))


def _straight(i: Inputs) -> Collision:
    return collide(0.0, i["Jy"], speed=i.get("V_0", 1.0), friction="shepard")


def _upward_share(hit: Collision) -> float:
    """Return sin(gamma), the k component of e."""
    left, up = hit.slip
    return float(up) / math.hypot(left, up)


def _along_centres(hit: Collision, vector: Any) -> Any:
    """Turn a vector from the frame of the shot to that of the line of centres."""
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
    """Return the derivative of a smooth function, to nine digits or more."""
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
    gained = 0.4 * _along_centres(hit, spin) - 0.4 * _along_centres(hit, before)
    return np.cross(arm, flat), gained, np.cross(arm, flight)


def _object_spin(i: Inputs, axis: int) -> float:
    hit = _hit(i)
    return float(_along_centres(hit, hit.object_spin)[axis])


def _spin_reaction(i: Inputs) -> float:
    return -0.8 * Ball().radius * _object_spin(i, 2)


def _gained(i: Inputs, *, jump: bool) -> Any:
    orbit, spin, flight = _momenta(i)
    return orbit + spin + (flight if jump else 0.0)


def _contact(i: Inputs) -> float:
    """Return y/R of the point of the cue ball that touches: to the right of its centre."""
    return -math.sin(i["alpha"])


def _of_hit(name: str, *, scale: float = 1.0) -> Callable[[Inputs], Any]:
    return lambda i: scale * getattr(_hit(i), name)


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
    ("P4.12", "L_b = -2 I omega_bz over M R V_0"): _spin_reaction,
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
}
"""How each quantity of these problems is computed."""
