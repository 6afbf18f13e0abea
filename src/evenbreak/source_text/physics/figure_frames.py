"""The numbers behind the plots of sections 3 and 4."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

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
from evenbreak.source_text.section5.rows import fixed_cell, number_cell

if TYPE_CHECKING:
    import pandas as pd

_SPINS = [k / 10 for k in range(-20, 21)]
_OFFSETS = [k / 100 for k in range(-round(100 * LARGEST_OFFSET), round(100 * LARGEST_OFFSET) + 1)]


def figure_frames() -> Mapping[str, pd.DataFrame]:
    """Return the numbers behind each plot of sections 3 and 4, by the name of the figure.

    Lengths are over the ball's radius, y to the left and z above the cloth; angles are in
    degrees; `m` is the mass of the ball over that of the stick.

    >>> figure_frames()["figure_3_4_best"].astype(str).to_dict("records")[2]
    {'m': '0.3333333333', 'offset': '0.238278', 'roll_speed_ratio': '1.199078'}
    """
    frames = {
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
    return {name: _frame(rows) for name, rows in frames.items()}


Rows = Iterable[Mapping[str, Any]]


def _same_sidespin() -> Rows:
    """Yield the two ends of each straight line of Fig. 3.1, on the outline of the ball."""
    for side in SIDES_AFTER_TIP:
        y = -offset_for(side)
        half = math.sqrt(1.0 - y * y)
        yield _line("a", side, ContactPoint(y, 1.0 - half), ContactPoint(y, 1.0 + half))
    for side in SIDES_IN_ROLL:
        yield _line("b", side, ContactPoint(0.0, 0.0), roll_chord(small_circle_point(side)))


def _line(panel: str, side: float, low: ContactPoint, high: ContactPoint) -> Mapping[str, Any]:
    ends = zip(("y_from", "z_from", "y_to", "z_to"), (*low, *high), strict=True)
    return {
        "panel": panel,
        "sidespin": number_cell(side),
        **{name: fixed_cell(value) for name, value in ends},
    }


def _small_circle() -> Rows:
    """Yield the points of the small circle, and how far they are from the centre of the ball."""
    for side in (quarter / 4 for quarter in range(-40, 41)):
        y, z = small_circle_point(side)
        yield {
            "sidespin": number_cell(side),
            "y": fixed_cell(y),
            "z": fixed_cell(z),
            "offset": fixed_cell(math.hypot(y, z - 1.0)),
        }


def _by_offset(ratio_of: Any) -> Rows:
    for offset in _OFFSETS:
        yield {
            "offset": number_cell(offset),
            **{
                f"m_{str(ratio).replace('/', '_')}": fixed_cell(ratio_of(offset, float(ratio)))
                for ratio in MASS_RATIOS
            },
        }


def _best_lags() -> Rows:
    for ratio in map(float, MASS_RATIOS):
        offset = best_lag_offset(ratio)
        yield {
            "m": number_cell(ratio),
            "offset": fixed_cell(offset),
            "roll_speed_ratio": fixed_cell(roll_speed_ratio(offset, ratio)),
        }


def _throw_factors() -> Rows:
    """Yield Fig. 4.4; a stun shot has no value where it steps from -1 to 1."""
    for side in _SPINS:
        row: dict[str, Any] = {"sidespin": number_cell(side)}
        for topspin in TOPSPINS:
            steps = topspin == 0.0 and math.isclose(side, gearing_side(HALF_BALL))
            factor = throw_factor(HALF_BALL, topspin, side)
            row[f"topspin_{f'{topspin:g}'.replace('.', '_')}"] = (
                None if steps else fixed_cell(factor)
            )
        yield row


def _sensitivities() -> Rows:
    """Yield Fig. 4.5 for topspin; draw has the same values, and a stun shot 0."""
    for topspin in (spin for spin in _SPINS if spin > 0.0):
        for side in _SPINS:
            yield {
                "sidespin": number_cell(side),
                "topspin": number_cell(topspin),
                "sensitivity": fixed_cell(throw_sensitivity(HALF_BALL, topspin, side)),
            }


def _deflections() -> Rows:
    spins = {"natural_roll": 1.0, "stun": 0.0, "reverse_natural_roll": -1.0}
    for degrees in range(91):
        cut = math.radians(degrees)
        yield {
            "cut_degrees": degrees,
            **{
                f"{name}_degrees": fixed_cell(math.degrees(deflection(cut, spin)))
                for name, spin in spins.items()
            },
            "natural_roll_slope": fixed_cell(deflection_slope(cut)),
        }


def _points() -> Rows:
    for point in marked_points():
        yield {
            "point": point.letter,
            "name": point.name,
            "topspin": number_cell(point.topspin),
            "cut_degrees": fixed_cell(math.degrees(point.cut)),
            "deflection_degrees": fixed_cell(math.degrees(point.deflection)),
            "slope": fixed_cell(point.slope),
        }


def _tip_line() -> Rows:
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
        yield {"point": name, "y": fixed_cell(y), "z": fixed_cell(z)}
    touched = {"y": fixed_cell(-math.sin(TIP_LINE_CUT)), "z": fixed_cell(1.0)}
    yield {"point": "touches the object ball", **touched}


def _frame(rows: Rows) -> pd.DataFrame:
    import pandas as pd

    return pd.DataFrame(list(rows), dtype=object)
