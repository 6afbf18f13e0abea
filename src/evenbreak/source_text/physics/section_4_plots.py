"""The plots in section 4 and their numbers: throw, its sensitivity, the cue ball's deflection."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.physics import (
    ContactPoint,
    deflection,
    deflection_slope,
    gearing_side,
    gearing_tip,
    largest_deflection_cut,
    right_angle_cut,
    small_circle_point,
    split_roll_cut,
    throw_factor,
    throw_sensitivity,
    unit_slope_cut,
)
from evenbreak.plots.picture import LINES, label_on, new_axes, note
from evenbreak.source_text.cells import Records, Tables, record
from evenbreak.source_text.physics.section_3_plots import (
    ball_view,
    draw_line,
    draw_small_circle,
    name_point,
    roll_chord,
    roll_height,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


HALF_BALL = math.pi / 6.0
"""Figs. 4.4 and 4.5: the half-ball cut, as in the text."""

TOPSPINS = (0.0, 0.1, 0.25, 0.5, 1.0)
"""Fig. 4.4: the topspins or draws `|J_y|`; stun and natural roll are named in the text."""

LARGEST_SPIN = 2.0
"""Figs. 4.4 and 4.5: both spins range from minus this value to plus this value."""

LEVELS = tuple(2.0**power for power in range(-4, 7))
"""Fig. 4.5: the contours' sensitivities; each is twice the previous one."""

INSET = 0.1
"""Fig. 4.5: how far the inset reaches from the point where nothing slips."""

TIP_LINE_CUT = math.pi / 6.0
"""Fig. 4.8: the cut angle, chosen as a half-ball hit's."""

_SPINS = [k / 10 for k in range(-20, 21)]

_CUT = np.linspace(0.0, 0.5 * np.pi, 361)

_ENDS = np.array([-1.0, 1.0])

_NAMES = {0.0: ", stun", 1.0: ", natural roll"}


_SIDE = r"sidespin $J_{0z}$ = $R\omega_{0z}/V_0$"
_TOPSPIN = r"topspin $J_{0y}$ = $R\omega_{0y}/V_0$"
_POINTS = 121
"""The number of grid points from the contour plot's center to its edge."""
_LARGEST_DRAWN = 8.0
"""Contours above this would crowd the whole plot; the inset shows them."""
_SMALLEST_ENLARGED = 2.0
_NEAR = 1e-9
"""How close to its step a stun shot's curve is drawn."""


def throw_factors() -> Axes:
    """Fig. 4.4: the throw factor by sidespin, for stun and for increasing topspin or draw."""
    axes = new_axes(
        _SIDE,
        r"throw factor $\cos\gamma$",
        title=r"Half-ball cut, $\alpha$ = π/6; values of $|J_{0y}|$ chosen",
        size=(7.2, 5.2),
    )
    step = gearing_side(HALF_BALL)
    side = np.linspace(-LARGEST_SPIN, LARGEST_SPIN, 401)
    # At the step itself a stun shot slips nowhere; the curve jumps from side to side of it.
    side = np.unique(np.concatenate([side[np.abs(side - step) > 1e-6], step + _NEAR * _ENDS]))
    for topspin, line in zip(TOPSPINS, LINES, strict=False):
        axes.plot(
            side,
            throw_factor(HALF_BALL, topspin, side),
            **line._asdict(),
            lw=1.5,
            label=f"{topspin:g}" + _NAMES.get(topspin, ""),
        )
    axes.plot([step], [0.0], "ko", ms=4, zorder=4)
    note(axes, r"$J_{0z}$ = $-\sin\alpha$", (step, 0.0), (12, -14), fontsize=10)
    axes.axhline(0.0, color="0.7", lw=0.7, zorder=0)
    axes.set(xlim=(-LARGEST_SPIN, LARGEST_SPIN), ylim=(-1.08, 1.08))
    axes.legend(title="$|J_{0y}|$", loc="lower right", frameon=False, handlelength=3.5)
    return axes


def sensitivity() -> Figure:
    """Fig. 4.5: how fast the throw factor changes with spin; contours are a factor of 2 apart."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.3, 5.1), layout="constrained")
    axes, inset = figure.subplots(1, 2, width_ratios=(5, 4.2))
    figure.suptitle(
        r"Sensitivity $F(J_0)$ of $\cos\gamma$, half-ball cut $\alpha$ = π/6; "
        "levels and spins chosen"
    )
    step = gearing_side(HALF_BALL)
    whole = [level for level in LEVELS if level <= _LARGEST_DRAWN]
    _contours(axes, (-LARGEST_SPIN, LARGEST_SPIN), LARGEST_SPIN, whole)
    near = [level for level in LEVELS if level >= _SMALLEST_ENLARGED]
    _contours(inset, (step - INSET, step + INSET), INSET, near)
    ticks = INSET * np.array([-0.5, 0.0, 0.5])
    inset.set(xticks=step + ticks, yticks=ticks)
    axes.indicate_inset_zoom(inset, edgecolor="0.5")
    return figure


def _contours(axes: Axes, across: tuple[float, float], up: float, levels: list[float]) -> None:
    """Draw contours around the point where nothing slips, where the grid is finest."""
    step = gearing_side(HALF_BALL)
    left, right = across
    side = step + np.concatenate([-_spread(step - left)[::-1], _spread(right - step)])
    topspin = np.concatenate([-_spread(up)[::-1], _spread(up)])
    values = throw_sensitivity(HALF_BALL, topspin[:, None], side)
    # Between grid points logarithms are closer to linear than the values themselves.
    lines = axes.contour(
        side, topspin, np.log2(values), levels=np.log2(levels), colors="black", linewidths=0.9
    )
    lines.set_linestyle("-")
    axes.set(xlim=across, ylim=(-up, up), aspect="equal", xlabel=_SIDE, ylabel=_TOPSPIN)
    axes.tick_params(direction="in", top=True, right=True)
    # The smallest contour of the whole plot has no room for its level; the inset names it.
    named = [level for level in levels if level != _LARGEST_DRAWN or up == INSET]
    places = [_place(level, up, right) for level in named]
    axes.clabel(lines, fmt=_power, fontsize=8.5, manual=places)


def _place(level: float, up: float, right: float) -> tuple[float, float]:
    """Return where to write a level: straight above the point where nothing slips, or next to it.

    The lower the level, the closer to the horizontal, so that the names don't overlap.

    The sensitivity falls as 1/r along every ray from there, so each contour is the next one at
    twice the size.
    """
    step = gearing_side(HALF_BALL)
    for degrees in (90.0, 50.0, 36.0, 22.0, 12.0, 9.0):
        way = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        far = throw_sensitivity(HALF_BALL, way[1], step + way[0]) / level
        if far * way[1] < 0.9 * up and far * way[0] < 0.9 * (right - step):
            break
    return step + far * way[0], far * way[1]


def _spread(end: float) -> NDArray[np.float64]:
    """Return points from near 0 to an end, closest together near 0."""
    return end * np.sinh(np.linspace(0.04, 5.0, _POINTS)) / math.sinh(5.0)


def _power(power: float) -> str:
    """Return a power of 2 as a whole number or a fraction: 4, 1/4."""
    return f"{2.0**power:.0f}" if power >= 0.0 else f"1/{2.0**-power:.0f}"


def gearing_tips() -> Axes:
    """Fig. 4.8: the contact points that cancel throw once the ball rolls lie on a line."""
    axes = new_axes("", "", size=(6.1, 6.1))
    degrees = math.degrees(TIP_LINE_CUT)
    ball_view(axes, rf"No throw in natural roll: cut to the right by {degrees:g}° (chosen)")
    at_once = gearing_tip(TIP_LINE_CUT)
    nearest = small_circle_point(gearing_side(TIP_LINE_CUT))
    draw_small_circle(axes)
    roll_height(axes)
    line = gearing_tip(TIP_LINE_CUT, np.array([1e-9, roll_chord(nearest).z]))
    draw_line(axes, line.y, line.z, lw=1.6)
    name_point(axes, at_once, r"$(-2/5\;y_{cp},\ 7/5\;R)$", (8, 13), "left")
    name_point(axes, nearest, "nearest to the center", (-10, 9), "right")
    object_ball = ContactPoint(-math.sin(TIP_LINE_CUT), 1.0)
    name_point(
        axes,
        object_ball,
        "touches the object ball,\n$y_{cp} = -R\\,\\sin\\alpha$",
        (0, 20),
        "center",
    )
    name_point(axes, ContactPoint(0.0, 1.0), "center", (6, -10), "left")
    return axes


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
            value = throw_sensitivity(HALF_BALL, topspin, side)
            yield record({"sidespin": side, "topspin": topspin}, {"sensitivity": value})


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
    """Yield the points on the line in Fig. 4.8, from the cloth to the ball's edge."""
    nearest = small_circle_point(gearing_side(TIP_LINE_CUT))
    heights = {
        "on the cloth": 0.0,
        "nearest to the center": nearest.z,
        "rolls at once": gearing_tip(TIP_LINE_CUT).z,
        "edge of the ball": roll_chord(nearest).z,
    }
    for name, z in heights.items():
        y = gearing_tip(TIP_LINE_CUT, z).y if z else 0.0
        yield record({"point": name}, {"y": y, "z": z})
    touched = {"y": -math.sin(TIP_LINE_CUT), "z": 1.0}
    yield record({"point": "touches the object ball"}, touched)


class MarkedPoint(NamedTuple):
    """A point in Fig. 4.7: a cut angle, in radians, and the curve on which it is special.

    `topspin` is the curve's J_y: 1 for natural roll, 0 for stun, -1 for reverse natural roll.
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
    """Return the points marked in Fig. 4.7, curve by curve.

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


def deflections() -> Axes:
    """Fig. 4.7: deflection in natural roll, stun and reverse natural roll; the first's slope."""
    axes = new_axes(
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
    return axes


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
"""Where a letter is placed next to its point, in typographic points; other letters follow the
slope."""


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
    """Explain the letters, column by column."""
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
    """Return a slope with three decimals, a true minus sign, and no sign for zero."""
    return f"{round(point.slope, 3) + 0.0:.3f}".replace("-", "\N{MINUS SIGN}")


def figure_tables() -> Tables:
    """Return the numbers behind each plot in section 4, by figure name.

    Lengths are in ball radii, y to the left and z above the cloth; angles are in degrees.
    """
    return {
        "figure_4_4": list(_throw_factors()),
        "figure_4_5": list(_sensitivities()),
        "figure_4_7": list(_deflections()),
        "figure_4_7_points": list(_points()),
        "figure_4_8": list(_tip_line()),
    }
