"""The plots of section 3: where the tip meets the ball, and the speed it gives."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.physics.offset import (
    NATURAL_ROLL_OFFSET,
    ContactPoint,
    ball_speed_ratio,
    best_lag_offset,
    contact_for_later,
    offset_for,
    roll_speed_ratio,
    small_circle_point,
)
from evenbreak.plots.style import LINES, new_axes, note
from evenbreak.source_text.physics.ball_view import (
    angle_arc,
    ball_view,
    draw_line,
    draw_small_circle,
    name_point,
    roll_chord,
    roll_height,
)
from evenbreak.source_text.physics.chosen import (
    LARGEST_OFFSET,
    MASS_RATIOS,
    MINIMAL_SIDE,
    SIDES_AFTER_TIP,
    SIDES_IN_ROLL,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_QUARTERS = {0.0: "", 0.25: "¼", 0.5: "½", 0.75: "¾"}


def same_sidespin() -> Figure:
    """Fig. 3.1: the contact points of equal sidespin, just after the tip and in natural roll."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.3, 5.0), layout="constrained")
    figure.suptitle("Contact points of equal sidespin; values of $J_z$ chosen")
    after_tip, in_roll = figure.subplots(1, 2)
    ball_view(after_tip, "a) $J_z$ just after the tip")
    for number, side in enumerate(SIDES_AFTER_TIP):
        y = -offset_for(side)
        half = np.sqrt(1.0 - y * y)
        draw_line(after_tip, [y, y], [1.0 - half, 1.0 + half])
        _name_spin(after_tip, side, (y, 2.09 if number % 2 else -0.09), "center")
    ball_view(in_roll, "b) $J_z$ in natural roll; dashed: it rolls at once")
    roll_height(in_roll)
    for side in SIDES_IN_ROLL:
        edge = roll_chord(small_circle_point(side))
        draw_line(in_roll, [0.0, edge.y], [0.0, edge.z])
        ha = "center" if side == 0.0 else "left" if side > 0.0 else "right"
        _name_spin(in_roll, side, (1.05 * edge.y, 1.0 + 1.08 * (edge.z - 1.0)), ha)
    return figure


def _name_spin(axes: Axes, side: float, place: tuple[float, float], ha: str) -> None:
    """Write a sidespin outside the ball."""
    whole, rest = divmod(abs(side), 1.0)
    sign = "\N{MINUS SIGN}" if side < 0.0 else ""
    name = sign + (f"{whole:.0f}" if whole or not rest else "") + _QUARTERS[rest]
    axes.text(*place, name, fontsize=7.5, ha=ha, va="center")


def small_circle() -> Figure:
    """Fig. 3.2: the smallest offsets for a sidespin in natural roll lie on a small circle."""
    figure, axes = new_axes("", "", size=(6.1, 6.1))
    ball_view(axes, f"Line of $J_z$ = {MINIMAL_SIDE:g} in natural roll (chosen)")
    point = small_circle_point(MINIMAL_SIDE)
    draw_small_circle(axes)
    line = contact_for_later(point, np.array([1e-9, roll_chord(point).z]))
    draw_line(axes, line.y, line.z, lw=1.6)
    offset = np.hypot(point.y, point.z - 1.0)
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    axes.plot(offset * np.sin(turn), 1.0 + offset * np.cos(turn), **LINES[3]._asdict(), lw=1.4)
    axes.plot([0.0, 0.0, point.y], [0.0, 1.0, point.z], color="black", lw=0.9)
    # The corner of the right angle, along the two short sides.
    along = np.array([-point.y, -point.z]) / np.hypot(point.y, point.z) * 0.07
    across = np.array([-point.y, 1.0 - point.z]) / offset * 0.07
    corner = np.array([along, along + across, across]) + np.array(point)
    axes.plot(*corner.T, color="black", lw=0.8)
    angle_arc(axes, point, 0.3, r"$\alpha$")
    name_point(axes, ContactPoint(0.0, 1.0), "$(0, R)$", (7, 9), "left")
    name_point(axes, ContactPoint(0.0, 0.0), "$(0, 0)$", (0, -13), "center")
    name_point(axes, point, "$(y_0, z_0)$", (10, -10), "left")
    return figure


def stick_speeds() -> Figure:
    """Fig. 3.3: the speed that the stick gives the ball, by offset and mass ratio."""
    figure, axes = _speeds("offset $b/R$", "$V_b / V_0$ = speed of ball / speed of stick")
    _ratio_curves(axes, ball_speed_ratio)
    axes.set(ylim=(0.5, 1.7))
    axes.legend(loc="upper left", frameon=False, handlelength=3.5)
    return figure


def lag_speeds() -> Figure:
    """Fig. 3.4: the speed of natural roll, by height of the tip; the best one for a lag."""
    figure, axes = _speeds(
        "height above the centre $b/R$", "$V_{b,NR} / V_0$ = speed of roll / speed of stick"
    )
    for height in (0.0, NATURAL_ROLL_OFFSET):
        axes.axvline(height, color="0.6", lw=0.8, zorder=0)
    top: Any = {"xycoords": axes.get_xaxis_transform(), "fontsize": 9, "va": "top"}
    note(axes, "centre", (0.0, 0.97), (-4, 0), ha="right", **top)
    note(axes, "immediate\nnatural roll", (NATURAL_ROLL_OFFSET, 0.97), (4, 0), ha="left", **top)
    _ratio_curves(axes, roll_speed_ratio)
    for ratio in MASS_RATIOS:
        best = best_lag_offset(float(ratio))
        height = roll_speed_ratio(best, float(ratio))
        axes.plot([best], [height], "ko", ms=4, zorder=4)
        # The two highest curves leave no room between them.
        beside = (0, 6) if ratio == min(MASS_RATIOS) else (0, -14)
        note(axes, f"{best:.3f}", (best, height), beside, fontsize=9, ha="center")
    axes.set(ylim=(0.0, 1.4))
    axes.legend(loc="lower right", frameon=False, handlelength=3.5)
    return figure


def _speeds(x: str, y: str) -> tuple[Figure, Axes]:
    figure, axes = new_axes(
        x, y, title="$m$ = mass of ball / mass of stick (chosen)", size=(7.2, 5.2)
    )
    axes.set(xlim=(-LARGEST_OFFSET, LARGEST_OFFSET))
    return figure, axes


def _ratio_curves(axes: Axes, ratio_of: Callable[[Any, Any], Any]) -> None:
    offset = np.linspace(-LARGEST_OFFSET, LARGEST_OFFSET, 281)
    for ratio, line in zip(MASS_RATIOS, LINES, strict=False):
        speed = ratio_of(offset, float(ratio))
        axes.plot(offset, speed, **line._asdict(), lw=1.5, label=f"$m$ = {ratio}")
