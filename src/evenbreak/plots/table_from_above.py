"""A pool table from above: cushions, pockets and diamonds, in inches."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from evenbreak.physics.objects import PoolTable
from evenbreak.physics.pockets import pockets
from evenbreak.physics.units import INCH

_RAIL = 5.0
"""How far the rails extend beyond the noses of the cushions, in inches."""
_DIAMOND = 3.6
"""How far the diamonds lie beyond them, in inches."""
_HOLE = 2.5
"""The radius of a pocket's hole, in inches."""


def bare_axes(figure: Figure, place: tuple[float, float, float, float]) -> Axes:
    """Return axes without ticks, with equal scales.

    Parameters
    ----------
    figure, place
        the figure, and the left, bottom, width and height as shares of it.
    """
    axes = figure.add_axes(place)
    axes.set_axis_off()
    axes.set_aspect("equal")
    return axes


def draw_table(axes: Axes, table: PoolTable) -> None:
    """Draw a table: x runs along it from the head cushion, y upwards.

    >>> from matplotlib.figure import Figure
    >>> axes = bare_axes(Figure(), (0.0, 0.0, 1.0, 1.0))
    >>> draw_table(axes, PoolTable())
    >>> [round(float(end), 9) for end in axes.get_xlim()]
    [-6.0, 106.0]
    """
    length, width = table.length / INCH, table.width / INCH
    border, size = (-_RAIL, -_RAIL), (length + 2.0 * _RAIL, width + 2.0 * _RAIL)
    axes.add_patch(Rectangle(border, *size, fc="0.82", ec="0.3", lw=1.0, zorder=0))
    axes.add_patch(Rectangle((0.0, 0.0), length, width, fc="#f2f7f2", ec="0.3", lw=1.0, zorder=1))
    for pocket in pockets(table):
        # The hole lies behind the middle of the mouth.
        deep = 0.75 * _HOLE
        x, y = pocket.x / INCH + deep * pocket.into_x, pocket.y / INCH + deep * pocket.into_y
        axes.add_patch(Circle((x, y), _HOLE, fc="0.15", ec="none", zorder=2))
    along, across = zip(*_diamonds(length, width), strict=True)
    axes.plot(along, across, ls="none", marker="D", ms=2.6, color="0.3", zorder=2)
    axes.set(xlim=(-_RAIL - 1.0, length + _RAIL + 1.0), ylim=(-_RAIL - 1.0, width + _RAIL + 1.0))


def draw_ball(axes: Axes, at: Any, radius: float, **style: Any) -> None:
    """Draw a ball at a point, in inches; `style` is for matplotlib's patch."""
    axes.add_patch(Circle(tuple(at), radius, **{"lw": 1.0, "zorder": 5, **style}))


def _diamonds(length: float, width: float) -> list[tuple[float, float]]:
    """Return the diamonds: at the eighths of the long rails and the quarters of the short ones.

    >>> len(_diamonds(100.0, 50.0))
    18
    """
    long = [eighth * length / 8.0 for eighth in range(1, 8) if eighth != 4]
    short = [quarter * width / 4.0 for quarter in range(1, 4)]
    return [
        *((x, y) for x in long for y in (-_DIAMOND, width + _DIAMOND)),
        *((x, y) for y in short for x in (-_DIAMOND, length + _DIAMOND)),
    ]
