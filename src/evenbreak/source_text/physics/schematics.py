"""The schematic figures in sections 1 to 4: arrows on balls, with computed directions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.physics import axis_tilt, collide, throw_factor
from evenbreak.plots.picture import new_axes, note

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import FancyArrowPatch

_CUT = math.pi / 6.0
_FRICTION = 0.2
"""Friction between the balls, exaggerated to show its effect."""
_OFFSET = 0.5
_SPEED = 1.5
"""The length of the arrow for V_0 in Fig. 4.2; a ball's radius is 1."""

Pair = Sequence[float]


def friction_at_hit() -> Axes:
    """Fig. 1.1: the forces on two touching balls, and the rotation caused by friction."""
    axes = _sheet((-1.35, 3.35), (-1.5, 1.5), (7.4, 4.9))
    for x, way in ((0.0, -1.0), (2.0, 1.0)):
        _ball(axes, (x, 0.0))
        touch, normal, along = (1.0, 0.0), (0.8 * way, 0.0), (0.0, -0.45 * way)
        total = (normal[0], along[1])
        _arrow(axes, touch, normal, "$F_N$", beside=(way * 12, 0), ls="--")
        _arrow(axes, touch, along, "$F_T$", beside=(0, -way * 10))
        _arrow(axes, touch, total, "$F$", beside=(way * 9, -way * 4), lw=2.2)
        _turn(axes, (x, 0.0), r"$\dot\omega$", 170.0 if way < 0.0 else -10.0)
    return axes


def tip_forces() -> Axes:
    """Fig. 1.2: the tip's force, split into one toward the center and one from friction."""
    axes = _sheet((-2.3, 1.35), (-1.25, 1.25), (7.0, 4.8))
    _ball(axes, (0.0, 0.0))
    depth = math.sqrt(1.0 - _OFFSET**2)
    touch = (-depth, _OFFSET)
    inward = np.array([depth, -_OFFSET])
    force = np.array([0.9, 0.0])
    normal = (force @ inward) * inward
    tip = [-2.25, touch[0], touch[0], -2.25]
    axes.plot(tip, _OFFSET + np.array([0.09, 0.05, -0.05, -0.09]), color="black", lw=1.2)
    axes.plot([touch[0], 0.0], [0.0, 0.0], ls=":", color="black", lw=0.9)
    axes.plot([touch[0], touch[0]], [0.0, _OFFSET], ls=":", color="black", lw=0.9)
    note(axes, "$b$", (touch[0], _OFFSET / 2), (-9, 0), va="center")
    axes.plot([0.0], [0.0], "ko", ms=4)
    _arrow(axes, touch, force, "$F$", beside=(10, 0), lw=2.2)
    _arrow(axes, touch, normal, "$F_N$", beside=(-12, -8), at=0.9, ls="--")
    _arrow(axes, touch, force - normal, "$F_T$", beside=(-3, 11))
    _angle(axes, touch, force - normal, force, r"$\alpha$", radius=0.2)
    return axes


def sliding_draw() -> Axes:
    """Fig. 2.1: a ball that slides forward with backspin, and the cloth's force."""
    axes = _sheet((-1.9, 2.3), (-0.35, 2.25), (7.0, 4.6))
    axes.plot([-1.9, 2.3], [0.0, 0.0], color="0.5", lw=1.2, zorder=0)
    _ball(axes, (0.0, 1.0))
    _arrow(axes, (0.0, 1.0), (1.6, 0.0), "$V > 0$", beside=(4, 10), lw=2.2)
    _arrow(axes, (0.0, 0.0), (-1.2, 0.0), "$F < 0$", beside=(-6, 10), lw=2.2)
    _turn(axes, (0.0, 1.0), r"$\omega < 0$", 170.0)
    return axes


def velocity_triangle() -> Axes:
    """Fig. 4.1: the velocities after a hit add up to the one before."""
    axes = _sheet((-0.1, 1.1), (-0.45, 0.5), (7.0, 5.6))
    object_ball, cue_ball = _velocities(0.25 * math.pi)
    _arrow(axes, (0.0, 0.0), object_ball, "$V_b$", beside=(-4, -14), at=0.6, lw=1.8)
    _arrow(axes, object_ball, cue_ball, "$V_c$", beside=(12, -2), at=0.6, lw=1.8)
    _arrow(axes, (0.0, 0.0), cue_ball, "$V_c$", beside=(-11, 6), at=0.6, ls="--")
    _arrow(axes, (0.0, 0.0), object_ball + cue_ball, "$V_0$", beside=(0, 9), at=0.7, lw=2.2)
    _angle(axes, (0.0, 0.0), object_ball, cue_ball, "$D$", named=0.85)
    _angle(axes, object_ball, -object_ball, cue_ball, "$C$")
    return axes


def hit_from_above() -> Axes:
    """Fig. 4.2: a hit in its two frames, with the effect of friction on each ball."""
    axes = _sheet((-1.25, 3.3), (-2.4, 1.75), (7.2, 6.6))
    way = np.array([math.cos(_CUT), -math.sin(_CUT)])
    left = np.array([math.sin(_CUT), math.cos(_CUT)])
    _ball(axes, (0.0, 0.0))
    _ball(axes, 2.0 * way)
    object_ball, cue_ball = _SPEED * _velocities(_CUT)
    _arrow(axes, (0.0, 0.0), (2.6, 0.0), "$x'$", beside=(8, 0), lw=0.8)
    _arrow(axes, (0.0, 0.0), (_SPEED, 0.0), "$V_0$", beside=(0, 10), at=0.85, lw=2.2)
    _arrow(axes, (0.0, 0.0), (0.0, 1.5), "$y'$", beside=(0, 8), lw=0.8)
    _arrow(axes, (0.0, 0.0), 3.4 * way, "$x$", beside=(7, -5), lw=0.8)
    _arrow(axes, (0.0, 0.0), 1.5 * left, "$y$", beside=(6, 6), lw=0.8)
    _angle(axes, (0.0, 0.0), way, (1.0, 0.0), r"$\alpha$", radius=0.62)
    friction = (object_ball @ left) * left
    for start, after, sign, name, side in (
        (2.0 * way, object_ball, 1.0, "$V_b$", (2, 11)),
        (np.zeros(2), cue_ball, -1.0, "$V_c$", (-13, 2)),
    ):
        _arrow(axes, start, after, name, beside=side, lw=2.2)
        shift = "$+V_{by}$" if sign > 0.0 else "$-V_{by}$"
        beside = (24, -4) if sign > 0.0 else (20, -3)
        _arrow(axes, start + after - sign * friction, sign * friction, shift, beside=beside, at=0.4)
    return axes


def slip_directions() -> Axes:
    """Fig. 4.3: which way friction pushes the object ball, by topspin or draw and english."""
    axes = _sheet((1.75, -1.75), (-1.4, 1.4), (7.2, 6.0))
    _ball(axes, (0.0, 0.0))
    _arrow(axes, (-1.45, 0.0), (2.9, 0.0), "$y$", beside=(-8, 0), lw=0.8)
    _arrow(axes, (0.0, -1.25), (0.0, 2.5), "$z$", beside=(0, 8), lw=0.8)
    names = {
        (-1.0, 0.0): "draw, no or\ninside english",
        (1.0, 0.0): "topspin, no or\ninside english",
        (-1.0, -1.0): "draw, much\noutside english",
        (1.0, -1.0): "topspin, much\noutside english",
    }
    for (topspin, side), name in names.items():
        cos = throw_factor(_CUT, topspin, side)
        sin = math.copysign(math.sqrt(1.0 - cos * cos), -topspin)
        outside = (-8.0 * np.sign(cos), 9.0 * np.sign(sin))
        _arrow(axes, (0.0, 0.0), (cos, sin), r"$\hat e$", beside=outside, lw=1.8)
        axes.text(1.3 * math.copysign(1.0, cos), 1.15 * sin, name, ha="center", va="center")
    cos = throw_factor(_CUT, -1.0, 0.0)
    end = (cos, math.sqrt(1.0 - cos * cos))
    axes.plot([cos, cos], [0.0, end[1]], ls=":", color="black", lw=0.9)
    axes.text(0.5 * cos, -0.11, r"$\cos\gamma$", ha="center", va="center")
    axes.text(cos + 0.08, 0.4 * end[1], r"$\sin\gamma$", ha="right", va="center")
    _angle(axes, (0.0, 0.0), (1.0, 0.0), end, r"$\gamma$", radius=0.24)
    return axes


def tilted_axis() -> Axes:
    """Fig. 4.6: a thrown ball that rolls away, its axis tilted by 7/2 of the throw."""
    axes = _sheet((1.6, -1.6), (-0.3, 2.35), (6.6, 5.6))
    axes.plot([-1.6, 1.6], [0.0, 0.0], color="0.5", lw=1.2)
    _ball(axes, (0.0, 1.0))
    tilt = axis_tilt(math.atan(0.1))
    axis = np.array([math.cos(tilt), math.sin(tilt)])
    equator = np.array([-axis[1], axis[0]])
    _arrow(axes, np.array([0.0, 1.0]) - axis, 2.4 * axis, r"$\omega$", beside=(-8, -4), lw=1.8)
    ends = np.array([0.0, 1.0]) + np.outer([-1.0, 1.0], equator)
    axes.plot(*ends.T, ls="--", color="black", lw=1.6)
    axes.plot([-1.0, 1.0], [1.0, 1.0], ls=":", color="black", lw=0.9)
    axes.text(-0.1 + 0.6 * equator[0], 1.0 + 0.6 * equator[1], "equator", va="center")
    _angle(axes, (0.0, 1.0), (1.0, 0.0), axis, r"$\beta$", radius=0.55)
    return axes


def _velocities(cut: float) -> Any:
    """Return the level velocities of object ball and cue ball after a stun shot with V_0 = 1."""
    hit = collide(cut, 0.0, mu=_FRICTION, friction="shepard")
    return np.array([hit.object_velocity[:2], hit.cue_velocity[:2]])


def _sheet(x: Pair, y: Pair, size: tuple[float, float]) -> Axes:
    axes = new_axes("", "", size=size)
    axes.set(xlim=x, ylim=y, aspect="equal")
    axes.set_axis_off()
    return axes


def _ball(axes: Axes, center: Any) -> None:
    from matplotlib.patches import Circle

    axes.add_patch(Circle((center[0], center[1]), 1.0, fill=False, lw=1.4))


def _arrow(
    axes: Axes,
    start: Any,
    vector: Any,
    name: str,
    *,
    beside: tuple[float, float],
    at: float = 1.0,
    lw: float = 1.4,
    ls: str = "-",
) -> FancyArrowPatch:
    """Draw a vector from a point, with its name at the fraction `at` of its length."""
    from matplotlib.patches import FancyArrowPatch

    tail, along = np.asarray(start, float), np.asarray(vector, float)
    head, named = tail + along, tail + at * along
    style: Any = {"arrowstyle": "-|>", "mutation_scale": 13, "shrinkA": 0, "shrinkB": 0}
    arrow = FancyArrowPatch(
        (tail[0], tail[1]), (head[0], head[1]), color="black", lw=lw, ls=ls, label=name, **style
    )
    axes.add_patch(arrow)
    note(axes, name, (named[0], named[1]), beside, fontsize=11, ha="center", va="center")
    return arrow


def _turn(axes: Axes, center: Pair, name: str, toward: float) -> None:
    """Draw an arrow that turns counterclockwise within a ball, on a side given in degrees."""
    from matplotlib.patches import FancyArrowPatch

    turn = np.radians([toward - 45.0, toward + 45.0])
    (x, x_to), (y, y_to) = 0.6 * np.cos(turn), 0.6 * np.sin(turn)
    axes.add_patch(
        FancyArrowPatch(
            (center[0] + x, center[1] + y),
            (center[0] + x_to, center[1] + y_to),
            connectionstyle="arc3,rad=0.4",
            arrowstyle="-|>",
            mutation_scale=13,
            color="black",
            label=name,
        )
    )
    # Beside its arrow, on the side of the center.
    way = math.radians(toward)
    place = center[0] + 0.36 * math.cos(way), center[1] + 0.36 * math.sin(way)
    axes.text(*place, name, fontsize=11, ha="center", va="center")


def _angle(
    axes: Axes,
    corner: Any,
    start: Any,
    stop: Any,
    name: str,
    *,
    radius: float = 0.13,
    named: float = 0.5,
) -> None:
    """Mark the angle between two directions; `named` is how far along it its name is."""
    begin, end = (math.atan2(way[1], way[0]) for way in (start, stop))
    turn = begin + np.linspace(0.0, math.remainder(end - begin, 2.0 * math.pi), 41)
    arc = np.asarray(corner, float)[:, None] + radius * np.array([np.cos(turn), np.sin(turn)])
    axes.plot(*arc, color="black", lw=0.9)
    x, y = np.asarray(corner, float) + 1.35 * (arc[:, round(40 * named)] - corner)
    axes.text(x, y, name, fontsize=11, ha="center", va="center")
