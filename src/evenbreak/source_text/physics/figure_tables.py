"""The numbers behind the plots of sections 3 and 4."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from evenbreak.physics.deflection import deflection, deflection_slope
from evenbreak.physics.offset import (
    ContactPoint,
    ball_speed_ratio,
    best_lag_offset,
    gearing_tip,
    offset_for,
    roll_speed_ratio,
    small_circle_point,
)
from evenbreak.physics.throw import gearing_side, throw_factor, throw_sensitivity
from evenbreak.source_text.cells import Records, Tables, record
from evenbreak.source_text.physics.ball_view import roll_chord
from evenbreak.source_text.physics.chosen import (
    HALF_BALL,
    LARGEST_OFFSET,
    MASS_RATIOS,
    SIDES_AFTER_TIP,
    SIDES_IN_ROLL,
    TIP_LINE_CUT,
    TOPSPINS,
)
from evenbreak.source_text.physics.deflection_figure import marked_points

_SPINS = [k / 10 for k in range(-20, 21)]
_OFFSETS = [k / 100 for k in range(-round(100 * LARGEST_OFFSET), round(100 * LARGEST_OFFSET) + 1)]


def figure_tables() -> Tables:
    """Return the numbers behind each plot of sections 3 and 4, by the name of the figure.

    Lengths are in ball radii, y to the left and z above the cloth; angles are in degrees; `m`
    is the mass of the ball over that of the stick.

    >>> [str(cell) for cell in figure_tables()["figure_3_4_best"][2].values()]
    ['0.3333333333', '0.238278', '1.199078']
    """
    tables = {
        "figure_3_1": _same_sidespin(),
        "figure_3_2": _small_circle(),
        "figure_3_3": _by_offset(ball_speed_ratio),
        "figure_3_4": _by_offset(roll_speed_ratio),
        "figure_3_4_best": _best_lags(),
        "figure_4_4": _throw_factors(),
        "figure_4_5": _sensitivities(),
        "figure_4_7": _deflections(),
        "figure_4_7_points": _points(),
        "figure_4_8": _tip_line(),
    }
    return {name: list(rows) for name, rows in tables.items()}


def _same_sidespin() -> Records:
    """Yield the two ends of each straight line of Fig. 3.1, on the outline of the ball."""
    for side in SIDES_AFTER_TIP:
        y = -offset_for(side)
        half = math.sqrt(1.0 - y * y)
        yield _line("a", side, ContactPoint(y, 1.0 - half), ContactPoint(y, 1.0 + half))
    for side in SIDES_IN_ROLL:
        yield _line("b", side, ContactPoint(0.0, 0.0), roll_chord(small_circle_point(side)))


def _line(panel: str, side: float, low: ContactPoint, high: ContactPoint) -> Mapping[str, Any]:
    ends = {"y_from": low.y, "z_from": low.z, "y_to": high.y, "z_to": high.z}
    return record({"panel": panel, "sidespin": side}, ends)


def _small_circle() -> Records:
    """Yield the points of the small circle, and how far they are from the centre of the ball."""
    for side in (quarter / 4 for quarter in range(-40, 41)):
        y, z = small_circle_point(side)
        yield record({"sidespin": side}, {"y": y, "z": z, "offset": math.hypot(y, z - 1.0)})


def _by_offset(ratio_of: Any) -> Records:
    for offset in _OFFSETS:
        ratios = {
            f"m_{str(ratio).replace('/', '_')}": ratio_of(offset, float(ratio))
            for ratio in MASS_RATIOS
        }
        yield record({"offset": offset}, ratios)


def _best_lags() -> Records:
    for ratio in map(float, MASS_RATIOS):
        offset = best_lag_offset(ratio)
        speed = roll_speed_ratio(offset, ratio)
        yield record({"m": ratio}, {"offset": offset, "roll_speed_ratio": speed})


def _throw_factors() -> Records:
    """Yield Fig. 4.4; a stun shot has no value where it steps from -1 to 1."""
    for side in _SPINS:
        factors: dict[str, float | None] = {
            f"topspin_{f'{topspin:g}'.replace('.', '_')}": throw_factor(HALF_BALL, topspin, side)
            for topspin in TOPSPINS
        }
        if math.isclose(side, gearing_side(HALF_BALL)):
            factors["topspin_0"] = None
        yield record({"sidespin": side}, factors)


def _sensitivities() -> Records:
    """Yield Fig. 4.5 for topspin; draw has the same values, and a stun shot 0."""
    for topspin in (spin for spin in _SPINS if spin > 0.0):
        for side in _SPINS:
            found = throw_sensitivity(HALF_BALL, topspin, side)
            yield record({"sidespin": side, "topspin": topspin}, {"sensitivity": found})


def _deflections() -> Records:
    spins = {"natural_roll": 1.0, "stun": 0.0, "reverse_natural_roll": -1.0}
    for degrees in range(91):
        cut = math.radians(degrees)
        angles = {
            f"{name}_degrees": math.degrees(deflection(cut, spin)) for name, spin in spins.items()
        }
        slope = {"natural_roll_slope": deflection_slope(cut)}
        yield record({"cut_degrees": degrees}, angles | slope)


def _points() -> Records:
    for point in marked_points():
        inputs = {"point": point.letter, "name": point.name, "topspin": point.topspin}
        angles = {
            "cut_degrees": math.degrees(point.cut),
            "deflection_degrees": math.degrees(point.deflection),
        }
        yield record(inputs, angles | {"slope": point.slope})


def _tip_line() -> Records:
    """Yield the points of the line of Fig. 4.8, from the cloth to the edge of the ball."""
    nearest = small_circle_point(gearing_side(TIP_LINE_CUT))
    heights = {
        "on the cloth": 0.0,
        "nearest to the centre": nearest.z,
        "rolls at once": gearing_tip(TIP_LINE_CUT).z,
        "edge of the ball": roll_chord(nearest).z,
    }
    for name, z in heights.items():
        y = gearing_tip(TIP_LINE_CUT, z).y if z else 0.0
        yield record({"point": name}, {"y": y, "z": z})
    touched = {"y": -math.sin(TIP_LINE_CUT), "z": 1.0}
    yield record({"point": "touches the object ball"}, touched)
