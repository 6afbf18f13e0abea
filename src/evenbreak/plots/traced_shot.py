"""Draw a traced shot from above on its table, with the hit enlarged, in inches."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerPatch
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Rectangle

from evenbreak.physics.aimed import AimedShot
from evenbreak.physics.leg import Leg, pockets
from evenbreak.physics.objects import PoolTable
from evenbreak.physics.shot import Shot
from evenbreak.physics.units import DEGREE, INCH
from evenbreak.plots.picture import LINES, Picture, in_our_look

_SIZE = (5.0, 6.0)
_CUE = LINES[1].color
_OBJECT = LINES[2].color
_DASHES: dict[str, Any] = {"slides": "-", "rolls": (0, (4, 2))}
_LINE_OF_CENTERS: dict[str, Any] = {"color": "0.35", "ls": (0, (1, 1.5)), "lw": 1.0}
_TANGENT: dict[str, Any] = {"color": "0.35", "ls": (0, (6, 2, 1, 2)), "lw": 1.0}
_GHOST: dict[str, Any] = {"fc": "none", "ec": "black", "ls": (0, (3, 2)), "lw": 1.1}
_UNAIDED: dict[str, Any] = {"fc": "none", "ec": LINES[3].color, "ls": (0, (1, 1)), "lw": 1.5}
_REACH = 14.0
"""The length of the line of centers and of the tangent line, in inches."""
_ALIGNED: dict[str, dict[int, Any]] = {
    "x": {-1: "right", 0: "center", 1: "left"},
    "y": {-1: "top", 0: "center", 1: "bottom"},
}
"""How text is aligned at a point: away from what is on its other side."""
_WORD = 7.0
"""Distance from a cushion, in inches, below which text might run onto the rail."""
_NEAR = 5.6
"""How much is shown on each side of the hit in the enlarged view, in inches."""


@in_our_look
def shot_on_table(traced: Shot | AimedShot) -> Picture:
    """Draw a shot from above, to scale: where both balls go, and how they meet.

    A line is solid where a ball slides and dashed where it rolls. The ghost ball is where the
    cue ball is at the hit; the line of centers continues through the object ball, and the tangent
    line is at a right angle to it. For an aimed shot a cross marks the target, and a second ghost
    ball shows the aim without allowing for throw.

    Parameters
    ----------
    traced
        a shot from `evenbreak.physics.shot`, `aimed_shot` or `pocketed_shot`.

    >>> from evenbreak.physics import shot, strike
    >>> figure = shot_on_table(shot(strike(1.2), 0.5, 0.5))
    >>> [axes.get_title() for axes in figure.axes]
    ['', 'At the hit', '']
    """
    aimed = traced if isinstance(traced, AimedShot) else None
    shot = traced.shot if isinstance(traced, AimedShot) else traced
    figure = Picture(figsize=_SIZE)
    whole = bare_axes(figure, (0.01, 0.52, 0.98, 0.47))
    draw_table(whole, shot.table)
    _draw_shot(whole, shot, aimed)
    for leg in shot.legs[-2:]:
        _draw_end(whole, leg, shot.table)
    near = bare_axes(figure, (0.02, 0.12, 0.44, 0.33))
    near.set_title("At the hit" if shot.reached else "As aimed", fontsize=11, pad=4)
    _draw_shot(near, shot, aimed)
    middle = (0.5 * (shot.ghost_position + shot.object_position)) / INCH
    for name, at, reach in zip("xy", middle, (1.25 * _NEAR, _NEAR), strict=True):
        near.set(**{f"{name}lim": (at - reach, at + reach)})
    near.add_patch(_frame(near))
    _write_key(bare_axes(figure, (0.48, 0.01, 0.51, 0.49)), shot, aimed)
    return figure


def _draw_shot(axes: Axes, shot: Shot, aimed: AimedShot | None) -> None:
    """Draw balls, lines and paths."""
    radius = shot.strike.ball.radius / INCH
    ghost, standing = shot.ghost_position / INCH, shot.object_position / INCH
    line, tangent = shot.line_of_centers, shot.tangent
    _line(axes, ghost, standing + _REACH * line, **_LINE_OF_CENTERS)
    _line(axes, ghost - 0.3 * _REACH * tangent, ghost + _REACH * tangent, **_TANGENT)
    draw_ball(axes, shot.approach.slide.position / INCH, radius, fc="white", ec="black")
    draw_ball(axes, standing, radius, fc=_OBJECT, ec="black", alpha=0.55)
    draw_ball(axes, ghost, radius, **_GHOST)
    if aimed is not None:
        unaided = aimed.unaided.ghost_position / INCH
        draw_ball(axes, unaided, radius, **_UNAIDED)
        axes.plot(*(aimed.target / INCH), marker="x", ms=7, color="black", zorder=6)
    for leg in shot.legs:
        color = _CUE if leg.name == "cue ball" else _OBJECT
        for motion, dashes in _DASHES.items():
            x, y, _ = leg.path(motion=motion).T / INCH
            axes.plot(x, y, color=color, ls=dashes, lw=1.6, zorder=4)


def _draw_end(axes: Axes, leg: Leg, table: PoolTable) -> None:
    """Draw a ball where its path ends, with a label for the ending."""
    at = leg.state(leg.end).position / INCH
    color = _CUE if leg.name == "cue ball" else _OBJECT
    radius = leg.slide.ball.radius / INCH
    draw_ball(axes, at, radius, fc="white" if color == _CUE else color, ec=color, alpha=0.6)
    word = {"rest": "stops", "pocket": "drops"}.get(leg.ending, leg.ending)
    # Beside the path, on the side of the middle of the table, where there is room.
    along = at - leg.slide.at(0.98 * (leg.end - leg.begin)) / INCH
    length = float(np.hypot(*along))
    along = along / length if length else np.array([1.0, 0.0])
    beside = np.array([-along[1], along[0]])
    middle = [np.mean(axes.get_xlim()), np.mean(axes.get_ylim())]
    beside *= np.sign(beside @ (middle - at)) or 1.0
    place, aligned = at + 2.0 * radius * beside, []
    for axis, size in enumerate((table.length / INCH, table.width / INCH)):
        # Next to a cushion it runs away from the rail.
        out = int(place[axis] < _WORD) - int(place[axis] > size - _WORD)
        place[axis] = np.clip(place[axis], 0.5, size - 0.5)
        aligned.append(_ALIGNED["xy"[axis]][int(out or np.rint(beside[axis]))])
    axes.text(place[0], place[1], word, color=color, ha=aligned[0], va=aligned[1], fontsize=10)


def _write_key(axes: Axes, shot: Shot, aimed: AimedShot | None) -> None:
    """Write the key of the lines, and the angles."""

    def as_circle(**space: Any) -> Circle:
        # Drawn as in the picture, with dashes, which a line marker cannot have.
        middle = (0.5 * space["width"] - space["xdescent"], 0.5 * space["height"])
        return Circle(middle, 0.5 * space["fontsize"])

    drawn = {(phase.ball, phase.motion) for phase in shot.phases}
    rows: dict[str, Any] = {
        f"{name}, {motion}": Line2D([], [], color=color, ls=dashes)
        for name, color in (("cue ball", _CUE), ("object ball", _OBJECT))
        for motion, dashes in _DASHES.items()
        if (name, motion) in drawn
    }
    rows["line of centers"] = Line2D([], [], **_LINE_OF_CENTERS)
    rows["tangent line"] = Line2D([], [], **_TANGENT)
    rows["ghost ball"] = Circle((0.0, 0.0), **_GHOST)
    if aimed is not None:
        rows["ghost ball without throw"] = Circle((0.0, 0.0), **_UNAIDED)
        rows["target"] = Line2D([], [], marker="x", ms=7, color="black", ls="none")
    legend: dict[str, Any] = {"loc": "upper left", "frameon": False, "handlelength": 2.6}
    legend["handler_map"] = {Circle: HandlerPatch(patch_func=as_circle)}
    axes.legend(rows.values(), rows.keys(), fontsize=9.5, **legend)
    axes.text(0.06, 0.02, "\n".join(_angles(shot, aimed)), fontsize=10, va="bottom", ha="left")
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0), aspect="auto")


def _angles(shot: Shot, aimed: AimedShot | None) -> list[str]:
    """Return the angles of a shot, in words.

    >>> from evenbreak.physics import shot, strike
    >>> _angles(shot(strike(1.2), -0.5, 0.5), None)[0]
    'cut 28.6° to the left'
    """
    side = "left" if shot.cut < 0.0 else "right"
    cut = f"{abs(shot.cut) / DEGREE:.1f}"
    words = ["full hit" if cut == "0.0" else f"cut {cut}° to the {side}"]
    if shot.throw is None:
        return [*words, "no hit"]
    words.append(f"throw {shot.throw / DEGREE:.1f}°")
    if shot.deflection is not None:
        words.append(f"deflection {shot.deflection / DEGREE:.1f}°")
    if aimed is not None and (turn := f"{abs(aimed.turn) / DEGREE:.1f}") != "0.0":
        words.append(f"aim {turn}° {'thinner' if aimed.turn > 0.0 else 'fuller'}")
    return [word.replace("-", "\N{MINUS SIGN}") for word in words]


def _line(axes: Axes, start: Any, end: Any, **style: Any) -> None:
    axes.plot(*zip(start, end, strict=True), zorder=3, **style)


def _frame(axes: Axes) -> Any:
    frame: dict[str, Any] = {"fc": "none", "ec": "0.5", "lw": 0.8, "transform": axes.transAxes}
    return Rectangle((0.0, 0.0), 1.0, 1.0, **frame, clip_on=False)


_RAIL = 5.0
"""How far the rails extend beyond the noses of the cushions, in inches."""
_DIAMOND = 3.6
"""How far the diamonds lie beyond them, in inches."""
_HOLE = 2.5
"""The radius of a pocket's hole, in inches."""


def bare_axes(figure: Figure, place: tuple[float, float, float, float]) -> Axes:
    """Return axes without ticks, with equal scales; `place` is left, bottom, width, height."""
    axes = figure.add_axes(place)
    axes.set_axis_off()
    axes.set_aspect("equal")
    return axes


def draw_table(axes: Axes, table: PoolTable) -> None:
    """Draw a table: x runs along it from the head cushion, y upward.

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
