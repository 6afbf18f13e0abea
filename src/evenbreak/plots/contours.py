"""Contour lines over the unit square: a break format or a shot, by a pair of chances (p1, p2)."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet
from matplotlib.layout_engine import ConstrainedLayoutEngine
from numpy.typing import NDArray

from evenbreak.checks import one_of
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.rack import Rack
from evenbreak.plots.picture import Picture, in_our_look, mark_points, new_axes, write_title
from evenbreak.practice.breaks import long_run_share
from evenbreak.practice.shots import LOOK_AHEADS, ShotChoice, one_ball_win

Surface: TypeAlias = Callable[[Any, Any], Any]

TENTHS = tuple(tenth / 10 for tenth in range(1, 10))
"""The levels 0.1, 0.2, ..., 0.9 of a probability."""

_POINTS = 201
"""Number of grid points along each side."""
_INSIDE = 1e-6
"""Distance of the grid from the edges: at a corner, a limit may depend on the direction."""
_CLEAR = 0.06
"""Distance of a label from the edge and from other lines; half of it is still enough."""
_OFF_A_MARK = 0.11
"""Distance of a label from a marked point."""
_NOISE = 12
"""Digits kept, so that a line along which two formulas agree is straight."""


def contour_axes(
    axes: Axes,
    function: Surface,
    *,
    x: str,
    y: str,
    levels: Sequence[float] = TENTHS,
    main: float = 0.5,
    marked: Sequence[tuple[float, float]] = (),
) -> QuadContourSet:
    """Draw the contour lines of a function of two probabilities, each labeled with its level.

    Negative levels are dashed, and the `main` level is thick. All lines are black, so the figure
    looks the same in black and white. The axes become a square of side 1; `function` takes two
    arrays p1 and p2 of the same shape, in (0, 1), never exactly 0 or 1, and returns one of that
    shape; labels keep away from the `marked` points.

    Source: the style of Figs. 5.3 and 5.6.
    """
    side = np.clip(np.linspace(0.0, 1.0, _POINTS), _INSIDE, 1.0 - _INSIDE)
    p1, p2 = np.meshgrid(side, side)
    values = np.round(function(p1, p2), _NOISE)
    lines = axes.contour(
        p1,
        p2,
        values,
        levels=list(levels),
        colors="black",
        linewidths=[2.0 if level == main else 0.9 for level in levels],
        negative_linestyles="dashed",
    )
    ticks = np.linspace(0.0, 1.0, 6)
    axes.set(xlim=(0, 1), ylim=(0, 1), xticks=ticks, yticks=ticks, aspect="equal")
    axes.clabel(lines, fmt=_level, fontsize=9, manual=_label_places(lines, marked))
    axes.set(xlabel=x, ylabel=y)
    axes.tick_params(direction="in", top=True, right=True)
    return lines


def _label_places(
    lines: QuadContourSet, marked: Sequence[tuple[float, float]]
) -> list[tuple[float, float]]:
    """Return a point on every line: away from edges and marks, clear of others, near the center."""
    pieces = [piece for level in lines.allsegs for piece in level if len(piece) > 1]
    places = []
    for here, piece in enumerate(pieces):
        from_edge = np.minimum(piece, 1.0 - piece).min(axis=1)
        if from_edge.max() < _CLEAR / 2:
            continue
        inner = piece[from_edge >= min(_CLEAR, from_edge.max())]
        clear = _distance(inner, [np.array([point]) for point in marked]) >= _OFF_A_MARK
        inner = inner[clear] if clear.any() else inner
        others = [outline for there, outline in enumerate(pieces) if there != here]
        tightness = -np.minimum(_distance(inner, others), _CLEAR)
        off_center = np.hypot(*(inner - 0.5).T)
        # Rounded, so that of two equally good places the first one is taken.
        best = np.lexsort((np.round(off_center, 6), np.round(tightness, 6)))[0]
        places.append((float(inner[best, 0]), float(inner[best, 1])))
    return places


def _distance(points: NDArray[np.float64], lines: list[NDArray[np.float64]]) -> Any:
    """Return each point's distance from the nearest vertex of the lines."""
    from scipy.spatial import KDTree

    if not lines:
        return np.full(len(points), np.inf)
    return KDTree(np.vstack(lines)).query(points)[0]


def _level(level: Any) -> str:
    """Return a level with as few digits as possible and a true minus sign."""
    return f"{level:.4g}".replace("-", "\N{MINUS SIGN}")


_X = "A's chance when A breaks ($p_1$)"
_Y = "B's chance when B breaks ($p_2$)"
_DIFFERENCES = (-0.3, -0.2, -0.1, -0.05, 0, 0.05, 0.1, 0.2, 0.3)


def share_panels(
    *, x: str, y: str, first_breaker: int = 1, marked: Sequence[tuple[float, float]] = ()
) -> tuple[Picture, list[Axes]]:
    """Draw player 1's long-run share of racks by (p1, p2) in four panels without titles.

    The panels are winner, loser and alternate breaks, and winner minus loser breaks;
    `first_breaker` is 1 or 2, as in `evenbreak.practice.long_run_share`.

    Source: Fig. 5.6.

    >>> figure, panels = share_panels(x="$p_1$", y="$p_2$")
    >>> len(panels)
    4
    """
    figure = Picture(figsize=(6.8, 7.6), layout=ConstrainedLayoutEngine(h_pad=0.12, w_pad=0.1))
    panels = list(np.ravel(figure.subplots(2, 2)))
    for axes, share in zip(panels, _shares(first_breaker), strict=True):
        if axes is panels[3]:
            contour_axes(axes, share, x=x, y=y, levels=_DIFFERENCES, main=0.0, marked=marked)
        else:
            contour_axes(axes, share, x=x, y=y, marked=marked)
    return figure, panels


def _shares(first_breaker: int) -> list[Callable[[Any, Any], Any]]:
    """Return player 1's share in winner, loser and alternate breaks, and winner minus loser."""
    winner, loser, alternate = (
        partial(long_run_share, breaks=BREAK_FORMATS[name], first_breaker=first_breaker)
        for name in ("winner", "loser", "alternate")
    )
    return [winner, loser, alternate, lambda p1, p2: winner(p1, p2) - loser(p1, p2)]


@in_our_look
def breaks_figure(rack: Rack, *, first_breaker: int = 1) -> Picture:
    """Draw player 1's long-run share of racks by (p1, p2), with the two players as a dot.

    There are four panels: winner, loser and alternate breaks, and winner minus loser breaks. Player
    1 is called A, player 2 B.

    Parameters
    ----------
    first_breaker
        as in `evenbreak.practice.long_run_share`.

    Raises
    ------
    InputError
        if the rack holds arrays, or `first_breaker` is not 1 or 2.

    Notes
    -----
    Source: Fig. 5.6.

    >>> [axes.get_title() for axes in breaks_figure(Rack(0.9, 0.5)).axes][:2]
    ['Winner breaks: A wins 83.3%', 'Loser breaks: A wins 64.3%']
    """
    rack.of_numbers()
    p1, p2 = rack.p1, rack.chance(2, breaker=2)
    figure, panels = share_panels(x=_X, y=_Y, first_breaker=first_breaker, marked=[(p1, p2)])
    *shares, difference = (share(p1, p2) for share in _shares(first_breaker))
    text = f"{100 * difference:+.1f}".replace("-", "\N{MINUS SIGN}")
    titles = [
        f"{name.capitalize()} breaks: A wins {100 * share:.1f}%"
        for name, share in zip(("winner", "loser", "alternate"), shares, strict=True)
    ]
    for axes, title in zip(panels, [*titles, f"Winner minus loser breaks: {text}%"], strict=True):
        axes.set_title(title, fontsize=10)
        mark_points(axes, [(p1, p2, "")])
    write_title(
        figure,
        f"A's long-run share of racks, by break format\nDot: A wins {100 * p1:.4g}% of the racks "
        f"A breaks, B {100 * p2:.4g}% of those B breaks",
    )
    return figure


_TITLES = {
    "infinite": "Your chance of winning, shot after shot",
    "two shots": "Your chance of winning, even after two misses",
}


@in_our_look
def draw_shots(
    shots: Sequence[ShotChoice], *, look_ahead: str = "infinite", ax: Axes | None = None
) -> Axes:
    """Draw P(player 1 wins the one-ball game) by (p1, p2), with each shot as a dot.

    Below the thick line player 1, called "you", is the favorite.

    Parameters
    ----------
    look_ahead
        as in `evenbreak.practice.one_ball_win`.

    Raises
    ------
    InputError
        if `look_ahead` is unknown.

    Notes
    -----
    Source: Fig. 5.3.

    >>> axes = draw_shots([ShotChoice("bank", 0.4, 0.8)])
    >>> axes.get_title()
    'Your chance of winning, shot after shot'
    """
    one_of(look_ahead, "look_ahead", LOOK_AHEADS)
    axes = new_axes("", "", title=_TITLES[look_ahead], size=(5.0, 5.2), ax=ax)
    contour_axes(
        axes,
        partial(one_ball_win, look_ahead=look_ahead),
        marked=[(shot.p1, shot.p2) for shot in shots],
        x="chance that you make the shot ($p_1$)",
        y="chance they make the shot you leave ($p_2$)",
    )
    mark_points(axes, [(shot.p1, shot.p2, shot.name) for shot in shots])
    return axes
