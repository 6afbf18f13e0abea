"""The numbers behind the plots of sections 3 and 4."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from evenbreak.physics.deflection import (
    deflection,
    deflection_slope,
    largest_deflection_cut,
    right_angle_cut,
    split_roll_cut,
    unit_slope_cut,
)
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
from evenbreak.plots.picture import LINES, label_on, new_axes, note
from evenbreak.source_text.cells import Records, Tables, record
from evenbreak.source_text.physics.tip_figures import (
    HALF_BALL,
    LARGEST_OFFSET,
    MASS_RATIOS,
    SIDES_AFTER_TIP,
    SIDES_IN_ROLL,
    TIP_LINE_CUT,
    TOPSPINS,
    roll_chord,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


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


# Fig. 4.7: where the cue ball goes by the cut angle, with the points that the text names.


_CUT = np.linspace(0.0, 0.5 * np.pi, 361)


class MarkedPoint(NamedTuple):
    """A point of Fig. 4.7: a cut angle, and the curve on which it is special.

    Parameters
    ----------
    letter
        beside the point.
    name
        what is special there.
    topspin
        J_y of the curve: 1 in natural roll, 0 for stun, -1 in reverse natural roll.
    cut
        cut angle in radians.
    """

    letter: str
    name: str
    topspin: float
    cut: float

    @property
    def deflection(self) -> float:
        """The deflection there, in radians."""
        return float(deflection(self.cut, self.topspin))

    @property
    def slope(self) -> float:
        """How fast the deflection changes there, d theta / d cut."""
        return float(deflection_slope(self.cut, self.topspin))


def marked_points() -> tuple[MarkedPoint, ...]:
    """Return the points that are marked in Fig. 4.7, curve by curve.

    >>> [(point.letter, round(math.degrees(point.cut), 3)) for point in marked_points()][-3:]
    [('G', 45.0), ('H', 39.232), ('I', 56.789)]
    """
    even = "both energies equal"
    return (
        MarkedPoint("A", "full hit", 1.0, 0.0),
        MarkedPoint("B", "slope 1", 1.0, unit_slope_cut()),
        MarkedPoint("C", "largest deflection", 1.0, largest_deflection_cut()),
        MarkedPoint("D", "half-ball hit", 1.0, HALF_BALL),
        MarkedPoint("E", even, 1.0, split_roll_cut(1.0)),
        MarkedPoint("F", "thinnest cut", 1.0, 0.5 * math.pi),
        MarkedPoint("G", even, 0.0, split_roll_cut(0.0)),
        MarkedPoint("H", "right angle", -1.0, right_angle_cut(-1.0)),
        MarkedPoint("I", even, -1.0, split_roll_cut(-1.0)),
    )


def deflections() -> Figure:
    """Fig. 4.7: deflection in natural roll, stun and reverse natural roll; the first's slope."""
    figure, axes = new_axes(
        r"cut angle $\alpha$, degrees", r"deflection $\theta$, degrees", size=(7.6, 7.8)
    )
    cut = np.degrees(_CUT)
    lines = (LINES[0], LINES[2], LINES[7])
    for spin, line in zip((1.0, 0.0, -1.0), lines, strict=True):
        axes.plot(cut, np.degrees(deflection(_CUT, spin)), **line._asdict(), lw=1.6)
    axes.plot([0.0, 90.0], [0.0, 90.0], **LINES[8]._asdict(), lw=1.2)
    axes.axhline(0.0, color="0.75", lw=0.7, zorder=0)
    low, high = -50.0, 184.0
    axes.set(xlim=(0.0, 90.0), ylim=(low, high))
    axes.set(xticks=range(0, 91, 15), yticks=range(-30, 181, 30))
    # An angle in degrees over one in degrees: the scales agree where that of theta is in radians.
    slope = axes.twinx()
    slope.plot(cut, deflection_slope(_CUT), **LINES[1]._asdict(), lw=1.4)
    slope.set(ylim=(math.radians(low), math.radians(high)), yticks=(-0.5, 0, 0.5, 1, 1.5, 2, 2.5))
    slope.set_ylabel(r"slope $d\theta_{NR}/d\alpha$ (dashed)")
    axes.tick_params(right=False)
    slope.tick_params(direction="in")
    _mark(axes, slope)
    _name_curves(axes, slope)
    _key(axes)
    return figure


def _name_curves(axes: Axes, slope: Axes) -> None:
    for spin, at, name in ((1.0, 75.0, "NR"), (0.0, 66.0, "Stun"), (-1.0, 20.0, "RNR")):
        here = math.degrees(deflection(math.radians(at), spin))
        label_on(axes, at, here, rf"$\theta_{{{name}}}$")
    label_on(axes, 75.0, 75.0, r"$\theta = \alpha$")
    label_on(slope, 9.0, deflection_slope(math.radians(9.0)), r"$d\theta_{NR}/d\alpha$")


_BESIDE = {
    "B": (-8, 8),
    "C": (-5, 10),
    "D": (1, 10),
    "E": (7, 9),
    "G": (0, 11),
    "H": (8, 7),
    "I": (9, 6),
}
"""Where a letter stands beside its point, in points of the page; the others are on the slope."""


def _mark(axes: Axes, slope: Axes) -> None:
    for point in marked_points():
        if point.letter in _BESIDE:
            _letter(axes, point, math.degrees(point.deflection), _BESIDE[point.letter])
        if point.topspin == 1.0:
            _letter(slope, point, point.slope, (8, 7) if point.cut < 1.0 else (-9, 8))


def _letter(axes: Axes, point: MarkedPoint, height: float, beside: tuple[float, float]) -> None:
    cut = math.degrees(point.cut)
    axes.plot([cut], [height], "ko", ms=4.5, zorder=5, clip_on=False)
    bold = {"fontsize": 9, "weight": "bold", "ha": "center", "va": "center"}
    note(axes, point.letter, (cut, height), beside, **bold)


def _key(axes: Axes) -> None:
    """Say what the letters stand for, column by column."""
    points = marked_points()
    columns = [
        (0.44, "left", "", [point.letter for point in points]),
        (0.48, "left", "", [point.name for point in points]),
        (0.79, "right", "α", [f"{math.degrees(point.cut):.2f}°" for point in points]),
        (0.885, "right", "θ", [f"{math.degrees(point.deflection):.2f}°" for point in points]),
        (0.98, "right", "slope", [_slope(point) for point in points]),
    ]
    for x, ha, head, cells in columns:
        text = "\n".join([head, *cells])
        axes.text(
            x, 0.975, text, transform=axes.transAxes, fontsize=9, ha=ha, va="top", linespacing=1.35
        )


def _slope(point: MarkedPoint) -> str:
    """Return a slope with three decimals, a true minus sign, and no sign of zero."""
    return f"{round(point.slope, 3) + 0.0:.3f}".replace("-", "\N{MINUS SIGN}")
