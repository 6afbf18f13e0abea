"""The plots in section 3, on where the tip hits the ball and its speed, with their numbers.

Our copy of the text has lost its plots' legends, and with them the values for most curves. The
values in capitals are our choice, here and in `section_4_plots`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.physics import (
    NATURAL_ROLL_OFFSET,
    ContactPoint,
    ball_speed_ratio,
    best_lag_offset,
    contact_for_later,
    offset_for,
    roll_speed_ratio,
    small_circle_point,
)
from evenbreak.plots.picture import LINES, new_axes, note
from evenbreak.source_text.cells import Records, Tables, record

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


SIDES_AFTER_TIP = tuple(quarter / 4 for quarter in range(-5, 6))
"""Fig. 3.1a: the sidespins J_z just after the tip."""

SIDES_IN_ROLL = tuple(half / 2 for half in range(-7, 8))
"""Fig. 3.1b: the sidespins J_z in natural roll."""

MINIMAL_SIDE = 2.0
"""Fig. 3.2: the sidespin J_z in natural roll for the line drawn."""

MASS_RATIOS = (Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(1, 4))
"""Figs. 3.3 and 3.4: the ball's mass divided by the stick's; the text uses the last two."""

LARGEST_OFFSET = 0.7
"""Figs. 3.3 and 3.4: the largest offset b/R, at which even a tip with friction 1 slips."""

_OFFSETS = [k / 100 for k in range(-round(100 * LARGEST_OFFSET), round(100 * LARGEST_OFFSET) + 1)]


_QUARTERS = {0.0: "", 0.25: "¼", 0.5: "½", 0.75: "¾"}


def same_sidespin() -> Figure:
    """Fig. 3.1: the contact points for equal sidespin, just after the tip and in natural roll."""
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
    axes.text(*place, name, fontsize=8, ha=ha, va="center")


def small_circle() -> Axes:
    """Fig. 3.2: the smallest offsets for a sidespin in natural roll lie on a small circle."""
    axes = new_axes("", "", size=(6.1, 6.1))
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
    return axes


def stick_speeds() -> Axes:
    """Fig. 3.3: the speed that the stick gives the ball, by offset and mass ratio."""
    axes = _speeds("offset $b/R$", "$V_b / V_0$ = speed of ball / speed of stick")
    _ratio_curves(axes, ball_speed_ratio)
    axes.set(ylim=(0.5, 1.7))
    axes.legend(loc="upper left", frameon=False, handlelength=3.5)
    return axes


def lag_speeds() -> Axes:
    """Fig. 3.4: the speed in natural roll, by tip height; the best height for a lag."""
    axes = _speeds(
        "height above the center $b/R$", "$V_{b,NR} / V_0$ = speed of roll / speed of stick"
    )
    for height in (0.0, NATURAL_ROLL_OFFSET):
        axes.axvline(height, color="0.6", lw=0.8, zorder=0)
    top: Any = {"xycoords": axes.get_xaxis_transform(), "fontsize": 9, "va": "top"}
    note(axes, "center", (0.0, 0.97), (-4, 0), ha="right", **top)
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
    return axes


def _speeds(x: str, y: str) -> Axes:
    axes = new_axes(x, y, title="$m$ = mass of ball / mass of stick (chosen)", size=(7.2, 5.2))
    axes.set(xlim=(-LARGEST_OFFSET, LARGEST_OFFSET))
    return axes


def _ratio_curves(axes: Axes, ratio_of: Callable[[Any, Any], Any]) -> None:
    offset = np.linspace(-LARGEST_OFFSET, LARGEST_OFFSET, 281)
    for ratio, line in zip(MASS_RATIOS, LINES, strict=False):
        speed = ratio_of(offset, float(ratio))
        axes.plot(offset, speed, **line._asdict(), lw=1.5, label=f"$m$ = {ratio}")


def ball_view(axes: Axes, title: str) -> None:
    """Draw the outline of the ball and the cloth, with y increasing to the player's left.

    >>> from evenbreak.plots.picture import new_axes
    >>> axes = new_axes("", "")
    >>> ball_view(axes, "Contact points")
    >>> bool(axes.xaxis_inverted())
    True
    """
    from matplotlib.patches import Circle

    axes.add_patch(Circle((0.0, 1.0), 1.0, fill=False, lw=1.6))
    axes.axhline(0.0, color="0.5", lw=1.0, zorder=0)
    ticks = [-1.0, -0.5, 0.0, 0.5, 1.0]
    axes.set(xlim=(1.35, -1.35), ylim=(-0.25, 2.25), aspect="equal", title=title, xticks=ticks)
    axes.set(xlabel="$y/R$, to the left of the center", ylabel="$z/R$, above the cloth")
    axes.tick_params(direction="in", top=True, right=True)


def draw_line(axes: Axes, y: Any, z: Any, *, lw: float = 1.0) -> None:
    """Draw a line of contact points."""
    axes.plot(y, z, color="black", lw=lw)


def roll_chord(point: ContactPoint) -> ContactPoint:
    """Return where the line from (0, 0) through a point on the small circle leaves the ball.

    The line's closest point to the center bisects the chord.

    >>> roll_chord(ContactPoint(0.5, 0.5))
    ContactPoint(y=1.0, z=1.0)
    """
    return ContactPoint(2.0 * point.y, 2.0 * point.z)


def roll_height(axes: Axes) -> None:
    """Draw the height at which natural roll is immediate, z = 7/5 R."""
    height = 1.0 + NATURAL_ROLL_OFFSET
    reach = float(np.sqrt(1.0 - NATURAL_ROLL_OFFSET**2))
    axes.plot([-reach, reach], [height, height], **LINES[1]._asdict(), lw=1.2)
    axes.set_yticks([0.0, 0.5, 1.0, height, 2.0])


def draw_small_circle(axes: Axes) -> None:
    """Draw the circle of contact points closest to the center, for every sidespin."""
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 182)[1:-1]
    circle = small_circle_point(3.5 * np.tan(turn))
    y, z = (np.concatenate([[0.0], part, [0.0]]) for part in circle)
    axes.plot(y, z, **LINES[2]._asdict(), lw=1.4)


def angle_arc(axes: Axes, point: ContactPoint, radius: float, name: str) -> None:
    """Mark the angle at (0, 0) between the vertical and the line to a point."""
    end = np.arctan2(point.y, point.z)
    turn = np.linspace(0.0, end, 31)
    axes.plot(radius * np.sin(turn), radius * np.cos(turn), color="black", lw=0.8)
    middle = 1.22 * radius
    axes.text(
        middle * np.sin(0.5 * end), middle * np.cos(0.5 * end), name, ha="center", va="center"
    )


def name_point(
    axes: Axes, point: ContactPoint, name: str, beside: tuple[float, float], ha: str
) -> None:
    """Mark a point and write its name next to it, at an offset in typographic points."""
    axes.plot([point.y], [point.z], "ko", ms=4.5, zorder=4)
    box = {"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85}
    note(axes, name, (point.y, point.z), beside, fontsize=9.5, ha=ha, va="center", bbox=box)


def _same_sidespin() -> Records:
    """Yield the two ends of each straight line in Fig. 3.1, on the ball's outline."""
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
    """Yield the points on the small circle, and their distances from the ball's center."""
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


def figure_tables() -> Tables:
    """Return the numbers behind each plot in section 3, by figure name.

    Lengths are in ball radii, y to the left and z above the cloth; `m` is the ball's mass divided
    by the stick's.

    >>> [str(cell) for cell in figure_tables()["figure_3_4_best"][2].values()]
    ['0.3333333333', '0.238278', '1.199078']
    """
    return {
        "figure_3_1": list(_same_sidespin()),
        "figure_3_2": list(_small_circle()),
        "figure_3_3": list(_by_offset(ball_speed_ratio)),
        "figure_3_4": list(_by_offset(roll_speed_ratio)),
        "figure_3_4_best": list(_best_lags()),
    }
