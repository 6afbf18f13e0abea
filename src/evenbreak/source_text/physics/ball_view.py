"""A ball seen from behind: y/R to the left, z/R above the cloth."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.physics.offset import NATURAL_ROLL_OFFSET, ContactPoint, small_circle_point
from evenbreak.plots.style import LINES, note

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def ball_view(axes: Axes, title: str) -> None:
    """Draw the outline of the ball and the cloth, y growing to the left as the player sees it.

    >>> from evenbreak.plots.style import new_axes
    >>> _, axes = new_axes("", "")
    >>> ball_view(axes, "Contact points")
    >>> bool(axes.xaxis_inverted())
    True
    """
    from matplotlib.patches import Circle

    axes.add_patch(Circle((0.0, 1.0), 1.0, fill=False, lw=1.6))
    axes.axhline(0.0, color="0.5", lw=1.0, zorder=0)
    ticks = [-1.0, -0.5, 0.0, 0.5, 1.0]
    axes.set(xlim=(1.35, -1.35), ylim=(-0.25, 2.25), aspect="equal", title=title, xticks=ticks)
    axes.set(xlabel="$y/R$, to the left of the centre", ylabel="$z/R$, above the cloth")
    axes.tick_params(direction="in", top=True, right=True)


def draw_line(axes: Axes, y: Any, z: Any, *, lw: float = 1.0) -> None:
    """Draw a line of contact points."""
    axes.plot(y, z, color="black", lw=lw)


def roll_chord(point: ContactPoint) -> ContactPoint:
    """Return where the line from (0, 0) through a point of the small circle leaves the ball.

    The line's nearest point to the centre halves the chord.

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
    """Draw the circle of the contact points nearest to the centre, for every sidespin."""
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 182)[1:-1]
    circle = small_circle_point(3.5 * np.tan(turn))
    y, z = (np.concatenate([[0.0], part, [0.0]]) for part in circle)
    axes.plot(y, z, **LINES[2]._asdict(), lw=1.4)


def angle_arc(axes: Axes, point: ContactPoint, radius: float, name: str) -> None:
    """Mark the angle at (0, 0) between the upright and the line to a point."""
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
    """Mark a point and write its name beside it, at an offset in typographic points."""
    axes.plot([point.y], [point.z], "ko", ms=4.5, zorder=4)
    box = {"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85}
    note(axes, name, (point.y, point.z), beside, fontsize=9.5, ha=ha, va="center", bbox=box)
