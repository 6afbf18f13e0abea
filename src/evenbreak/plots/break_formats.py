"""Contour plots of what a break format is worth, with two players as a dot."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.rack import Rack
from evenbreak.plots.contours import contour_axes
from evenbreak.plots.picture import Picture, in_our_look
from evenbreak.plots.point_labels import mark_points
from evenbreak.plots.style import write_title
from evenbreak.practice.breaks import long_run_share

_X = "$p_1$ = P(A wins | A breaks)"
_Y = "$p_2$ = P(B wins | B breaks)"
_DIFFERENCES = (-0.3, -0.2, -0.1, -0.05, 0, 0.05, 0.1, 0.2, 0.3)


def share_panels(*, x: str, y: str, first_breaker: int = 1) -> tuple[Picture, list[Axes]]:
    """Draw player 1's long-run share of racks over (p1, p2) in four panels without titles.

    The panels are winner, loser and alternate breaks, and winner minus loser breaks.

    Parameters
    ----------
    x, y
        what p1 and p2 are the probabilities of.
    first_breaker
        who breaks the first rack, as in `evenbreak.practice.long_run_share`.

    Raises
    ------
    InputError
        if `first_breaker` is not 1 or 2.

    Notes
    -----
    Source: Fig. 5.6.

    >>> figure, panels = share_panels(x="$p_1$", y="$p_2$")
    >>> len(panels)
    4
    """
    figure = Picture(figsize=(8.8, 9.2), layout="constrained")
    panels = list(np.ravel(figure.subplots(2, 2)))
    for axes, share in zip(panels, _shares(first_breaker), strict=True):
        if axes is panels[3]:
            contour_axes(axes, share, x=x, y=y, levels=_DIFFERENCES, main=0.0)
        else:
            contour_axes(axes, share, x=x, y=y)
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
    """Draw player 1's long-run share of racks over (p1, p2), with the two players as a dot.

    Four panels: winner, loser and alternate breaks, and winner minus loser breaks. Player 1 is
    called A, player 2 B.

    Parameters
    ----------
    rack
        the chances with the break, as plain numbers.
    first_breaker
        who breaks the first rack, as in `evenbreak.practice.long_run_share`.

    Raises
    ------
    InputError
        if the rack holds arrays, or `first_breaker` is not 1 or 2.

    Notes
    -----
    Source: Fig. 5.6.

    >>> [axes.get_title() for axes in breaks_figure(Rack(0.9, 0.5)).axes][:2]
    ['winner breaks: A wins 0.833', 'loser breaks: A wins 0.643']
    """
    rack.of_numbers()
    p1, p2 = rack.p1, rack.chance(2, breaker=2)
    figure, panels = share_panels(x=_X, y=_Y, first_breaker=first_breaker)
    *shares, difference = (share(p1, p2) for share in _shares(first_breaker))
    text = f"{difference:+.3f}".replace("-", "\N{MINUS SIGN}")
    titles = [
        f"{name} breaks: A wins {share:.3f}"
        for name, share in zip(("winner", "loser", "alternate"), shares, strict=True)
    ]
    for axes, title in zip(panels, [*titles, f"winner minus loser breaks: {text}"], strict=True):
        axes.set_title(title)
        mark_points(axes, [(p1, p2, "")])
    write_title(
        figure,
        "A's share of the racks in the long run, by break format\n"
        f"The dot: A wins {p1:g} of the racks A breaks, B wins {p2:g} of the racks B breaks",
    )
    return figure
