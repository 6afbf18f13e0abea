"""The plots of section 4: throw, its sensitivity, and the cue ball's deflection."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.physics.offset import ContactPoint, gearing_tip, small_circle_point
from evenbreak.physics.throw import gearing_side, throw_factor, throw_sensitivity
from evenbreak.plots.picture import LINES, new_axes, note
from evenbreak.source_text.physics.tip_figures import (
    HALF_BALL,
    INSET,
    LARGEST_SPIN,
    LEVELS,
    TIP_LINE_CUT,
    TOPSPINS,
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
    from numpy.typing import NDArray

_SIDE = r"sidespin $J_{0z}$ = $R\omega_{0z}/V_0$"
_TOPSPIN = r"topspin $J_{0y}$ = $R\omega_{0y}/V_0$"
_POINTS = 121
"""Grid points from the centre of the contour plot to its edge."""
_LARGEST_DRAWN = 8.0
"""Contours above this would crowd the whole plot; the inset shows them."""
_SMALLEST_ENLARGED = 2.0
_NEAR = 1e-9
"""How close to its step the curve of a stun shot is drawn."""


def throw_factors() -> Figure:
    """Fig. 4.4: the throw factor by sidespin, for stun and for increasing topspin or draw."""
    figure, axes = new_axes(
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
    return figure


_ENDS = np.array([-1.0, 1.0])
_NAMES = {0.0: ", stun", 1.0: ", natural roll"}


def sensitivity() -> Figure:
    """Fig. 4.5: how fast the throw factor changes with the spin; contours a factor 2 apart."""
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
    found = throw_sensitivity(HALF_BALL, topspin[:, None], side)
    # Between grid points logarithms are closer to linear than the values themselves.
    lines = axes.contour(
        side, topspin, np.log2(found), levels=np.log2(levels), colors="black", linewidths=0.9
    )
    lines.set_linestyle("-")
    axes.set(xlim=across, ylim=(-up, up), aspect="equal", xlabel=_SIDE, ylabel=_TOPSPIN)
    axes.tick_params(direction="in", top=True, right=True)
    # The smallest contour of the whole plot has no room for its level; the inset names it.
    named = [level for level in levels if level != _LARGEST_DRAWN or up == INSET]
    places = [_place(level, up, right) for level in named]
    axes.clabel(lines, fmt=_power, fontsize=8.5, manual=places)


def _place(level: float, up: float, right: float) -> tuple[float, float]:
    """Return where to write a level: straight above the point where nothing slips, or beside it.

    The lower the level, the nearer to the horizontal, so that the names keep apart.

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


def gearing_tips() -> Figure:
    """Fig. 4.8: the contact points that cancel throw once the ball rolls lie on a line."""
    figure, axes = new_axes("", "", size=(6.1, 6.1))
    degrees = math.degrees(TIP_LINE_CUT)
    ball_view(axes, rf"No throw in natural roll: cut to the right by {degrees:g}° (chosen)")
    at_once = gearing_tip(TIP_LINE_CUT)
    nearest = small_circle_point(gearing_side(TIP_LINE_CUT))
    draw_small_circle(axes)
    roll_height(axes)
    line = gearing_tip(TIP_LINE_CUT, np.array([1e-9, roll_chord(nearest).z]))
    draw_line(axes, line.y, line.z, lw=1.6)
    name_point(axes, at_once, r"$(-2/5\;y_{cp},\ 7/5\;R)$", (8, 13), "left")
    name_point(axes, nearest, "nearest to the centre", (-10, 9), "right")
    object_ball = ContactPoint(-math.sin(TIP_LINE_CUT), 1.0)
    name_point(
        axes,
        object_ball,
        "touches the object ball,\n$y_{cp} = -R\\,\\sin\\alpha$",
        (0, 20),
        "center",
    )
    name_point(axes, ContactPoint(0.0, 1.0), "centre", (6, -10), "left")
    return figure
