"""Shots of the one-ball game on a contour plot of the chance of winning."""

from collections.abc import Sequence
from functools import partial
from typing import overload

from matplotlib.axes import Axes

from evenbreak.checks import one_of
from evenbreak.plots.contours import contour_axes
from evenbreak.plots.picture import Picture, in_our_look
from evenbreak.plots.point_labels import mark_points
from evenbreak.plots.style import new_axes
from evenbreak.practice.shots import LOOK_AHEADS, ShotChoice, one_ball_win

_TITLES = {
    "infinite": "P(you win), the two shots repeated",
    "two shots": "P(you win), even after two misses",
}


@overload
def shots_figure(
    shots: Sequence[ShotChoice], *, look_ahead: str = "infinite", ax: Axes
) -> Axes: ...
@overload
def shots_figure(shots: Sequence[ShotChoice], *, look_ahead: str = "infinite") -> Picture: ...
@in_our_look
def shots_figure(
    shots: Sequence[ShotChoice], *, look_ahead: str = "infinite", ax: Axes | None = None
) -> Picture | Axes:
    """Draw P(player 1 wins the one-ball game) over (p1, p2), with each shot as a dot.

    Below the thick line player 1, called "you", is the favourite.

    Parameters
    ----------
    shots
        the shots that player 1 may choose from.
    look_ahead
        as in `evenbreak.practice.one_ball_win`.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.

    Raises
    ------
    InputError
        if there is no such look-ahead.

    Notes
    -----
    Source: Fig. 5.3.

    >>> figure = shots_figure([ShotChoice("bank", 0.4, 0.8)])
    >>> figure.axes[0].get_title()
    'P(you win), the two shots repeated'
    """
    one_of(look_ahead, "look_ahead", LOOK_AHEADS)
    figure, axes = new_axes("", "", title=_TITLES[look_ahead], size=(5.6, 5.6), ax=ax)
    contour_axes(
        axes,
        partial(one_ball_win, look_ahead=look_ahead),
        x="$p_1$ = P(you make the shot)",
        y="$p_2$ = P(the opponent makes what a miss leaves)",
    )
    mark_points(axes, [(shot.p1, shot.p2, shot.name) for shot in shots])
    return figure if ax is None else ax
