"""Section 3, P3.1 to P3.11: the cue tip and the cue ball."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from evenbreak.physics import (
    NATURAL_ROLL_OFFSET,
    Ball,
    CenterHit,
    Cloth,
    ContactPoint,
    Slide,
    ball_speed_ratio,
    best_lag_offset,
    best_stick_ratio,
    break_energy_share,
    center_hit,
    effective_contact,
    energy_share,
    kinetic_energy,
    largest_roll_side,
    miscue_offset,
    offset_for,
    roll_side,
    roll_speed,
    roll_speed_ratio,
    small_circle_point,
    spin_of_offset,
    strike_side,
    stroke_energy,
    stroke_speed,
)
from evenbreak.physics.units import OUNCE
from evenbreak.source_text.published import Answers, Inputs

_P1 = ContactPoint(-math.sqrt(0.5), 1.0)
_P2 = ContactPoint(-0.5, 0.5)
_POINTS = {"P1": _P1, "P2": _P2}
"""The contact points in P3.8, to the right of the center, where y is negative."""


def _hit(i: Inputs) -> CenterHit:
    return center_hit(i["M_s"] / i["M_b"])


def _least_gain() -> float:
    hits = center_hit(np.geomspace(1.0 / 60.0, 100.0, 500))
    return float(np.min(hits.ball - hits.stick))


def _stroke_energy(i: Inputs) -> Any:
    stick = 0.5 * i["M_s"] * (i["L"] * i["w"]) ** 2
    return stroke_energy(stick, i["M_s"], i["M_f"])


def _best_stick(i: Inputs) -> Any:
    return best_stick_ratio(i["M_f"] / i["M_b"])


def _spin(i: Inputs) -> tuple[float, float]:
    """Return V_0 = p/M, and R omega_0y."""
    speed = i["p"] / i["M"]
    return speed, spin_of_offset(i["z/R"] - 1.0) * speed


def _nearest(i: Inputs) -> ContactPoint:
    """Return the nearest point on the line through a point of the small circle."""
    height = i["z_0/R"]
    return small_circle_point(roll_side(math.sqrt(height * (1.0 - height)), height))


def _distance(point: ContactPoint) -> float:
    return math.hypot(point.y, point.z - 1.0)


def _searched_side() -> float:
    around, offset = np.linspace(0.0, 2.0 * math.pi, 100_001), math.sqrt(0.5)
    return float(np.max(roll_side(offset * np.sin(around), 1.0 + offset * np.cos(around))))


def _contact_slopes(i: Inputs) -> float:
    """Return the spread of z/y during a slide, from the ball's motion and spin."""
    ball, speed = Ball(), 1.0
    struck = ContactPoint(i["y/R"], i["z/R"])
    around = speed / ball.radius
    spin = [0.0, around * spin_of_offset(struck.z - 1.0), around * strike_side(struck.y)]
    shot = Slide(ball, Cloth(), np.zeros(2), np.array([speed, 0.0]), np.array(spin))
    time = np.linspace(0.0, 1.0, 6) * shot.slide_time
    now = ball.radius * shot.spin_at(time) / shot.velocity_at(time)[:, :1]
    return float(np.ptp((1.0 + offset_for(now[:, 1])) / -offset_for(now[:, 2])))


def _line_end(i: Inputs) -> float:
    late = effective_contact(ContactPoint(i["y/R"], i["z/R"]), 1.0, 1e3, Cloth())
    return float(late.z) - 1.0


ANSWERS: Answers = {
    ("P3.1", "T = F d"): lambda i: 0.5 * i["M_s"] * stroke_speed(i["F"], i["d"], i["M_s"]) ** 2,
    ("P3.1", "V = sqrt(2 F d/M_s)"): lambda i: stroke_speed(i["F"], i["d"], i["M_s"]),
    ("P3.2", "V_b/V_0"): lambda i: _hit(i).ball,
    ("P3.2", "V_s/V_0"): lambda i: _hit(i).stick,
    ("P3.2", "V_b/V_s"): lambda i: _hit(i).ball / _hit(i).stick,
    ("P3.2", "least (V_b - V_s)/V_0"): lambda _: _least_gain(),
    ("P3.3", "T_b/T_0"): lambda i: energy_share(i["alpha_s"]),
    ("P3.3", "stick of the best hit, oz"): lambda i: best_stick_ratio(0.0) * i["M_b"] / OUNCE,
    ("P3.3", "T as printed"): _stroke_energy,
    ("P3.3", "T = T_0 (1 + M_f/(3 M_s))"): _stroke_energy,
    ("P3.3", "T_b/T"): lambda i: break_energy_share(i["M_s"] / i["M_b"], i["M_f"] / i["M_b"]),
    ("P3.3", "alpha_s(opt), exact"): _best_stick,
    ("P3.3", "alpha_s(opt)"): _best_stick,
    ("P3.3", "stick that breaks best, oz"): lambda i: _best_stick(i) * i["M_b"] / OUNCE,
    ("P3.3", "alpha_f"): lambda i: i["M_f"] / Ball(mass=i["M_b"]).mass,
    ("P3.4", "J/(b/R)"): lambda _: spin_of_offset(0.5) / 0.5,
    ("P3.5", "b_NR/R"): lambda _: offset_for(1.0),
    ("P3.5", "z_NR/R"): lambda _: 1.0 + NATURAL_ROLL_OFFSET,
    ("P3.5", "z_NR/D"): lambda _: (1.0 + NATURAL_ROLL_OFFSET) / 2.0,
    ("P3.6", "omega_0y"): lambda i: _spin(i)[1] / i["R"],
    ("P3.6", "V_NR as printed"): lambda i: roll_speed(*_spin(i)),
    ("P3.6", "V_NR"): lambda i: roll_speed(*_spin(i)),
    ("P3.6", "J_z"): lambda i: strike_side(-i["y/R"]),
    ("P3.6", "J_z,NR"): lambda i: roll_side(-i["y/R"], i["z/R"]),
    ("P3.7", "z_0/R of the point nearest to the center"): lambda i: _nearest(i).z,
    ("P3.7", "(y_0^2 + (z_0 - R/2)^2)/R^2"): lambda i: (
        _nearest(i).y ** 2 + (_nearest(i).z - 0.5) ** 2
    ),
    ("P3.8", "J_z,NR"): lambda i: roll_side(*_POINTS[i["point"]]),
    ("P3.8", "offset from the center/R"): lambda i: _distance(_POINTS[i["point"]]),
    ("P3.8", "more spin at P2 than at P1, %"): lambda _: (
        100.0 * (roll_side(*_P2) / roll_side(*_P1) - 1.0)
    ),
    ("P3.8", "P2 is on the small circle (1: so it is)"): lambda _: float(
        np.allclose(small_circle_point(roll_side(*_P2)), _P2, rtol=1e-12)
    ),
    ("P3.8", "largest J_z,NR at the offset R/sqrt(2), by search"): lambda _: _searched_side(),
    ("P3.8", "largest J_z,NR of a tip"): lambda i: largest_roll_side(miscue_offset(i["mu_static"])),
    ("P3.8", "y_3/R"): lambda i: offset_for(i["J_z"]),
    ("P3.8", "P3 is off the ball (1: so it is)"): lambda _: float(
        offset_for(roll_side(*_P2)) > 1.0
    ),
    ("P3.9", "spread of z/y of the effective contact points"): _contact_slopes,
    ("P3.9", "b_z/R where their line ends"): _line_end,
    ("P3.10", "V_b/V_0"): lambda i: ball_speed_ratio(i["b/R"], i["M_b"] / i["M_s"]),
    ("P3.10", "T_b/(M_b V_b^2)"): lambda i: (
        kinetic_energy(Ball(), 1.0, spin_of_offset(i["b/R"])).total / Ball().mass
    ),
    ("P3.11", "(b/R)_opt, exact"): lambda i: best_lag_offset(1.0 / i["M_s/M_b"]),
    ("P3.11", "(b/R)_opt"): lambda i: best_lag_offset(1.0 / i["M_s/M_b"]),
    ("P3.11", "V_NR/V_0"): lambda i: roll_speed_ratio(i["b/R"], i["M_b/M_s"]),
    ("P3.11", "share of the speed lost to sliding"): lambda i: (
        1.0 - roll_speed(1.0, spin_of_offset(i["b/R"]))
    ),
}
"""How each quantity in these problems is computed."""
