"""Two players on the contour plots of what a break format is worth to them."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.rack import Rack
from evenbreak.practice.breaks import long_run_share
from evenbreak.reports.contours import contour_axes
from evenbreak.reports.marks import mark_points

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["breaks_figure"]

_X = "$p_1$ = P(A wins | A breaks)"
_Y = "$p_2$ = P(B wins | B breaks)"
_DIFFERENCES = (-0.3, -0.2, -0.1, -0.05, 0, 0.05, 0.1, 0.2, 0.3)


def breaks_figure(rack: Rack, *, first_breaker: int = 1) -> Figure:
    """Draw player 1's long-run share of racks over (p1, p2), with the two players as a dot.

    Four panels: winner, loser and alternate breaks, and winner less loser breaks; player 1 is
    called A and player 2 B.

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
    from matplotlib.figure import Figure

    rack.of_numbers()
    p1, p2 = rack.p1, rack.chance(2, breaker=2)
    figure = Figure(figsize=(8.8, 9.2), layout="constrained")
    panels = list(np.ravel(figure.subplots(2, 2)))
    shares = {
        name: partial(long_run_share, breaks=BREAK_FORMATS[name], first_breaker=first_breaker)
        for name in ("winner", "loser", "alternate")
    }
    for axes, (name, share) in zip(panels, shares.items(), strict=False):
        contour_axes(axes, share, x=_X, y=_Y)
        axes.set_title(f"{name} breaks: A wins {share(p1, p2):.3f}")

    def difference(p1: Any, p2: Any) -> Any:
        return shares["winner"](p1, p2) - shares["loser"](p1, p2)

    contour_axes(panels[3], difference, x=_X, y=_Y, levels=_DIFFERENCES, main=0.0)
    told = f"{difference(p1, p2):+.3f}".replace("-", "\N{MINUS SIGN}")
    panels[3].set_title(f"winner less loser breaks: {told}")
    for axes in panels:
        mark_points(axes, [(p1, p2, "")])
    figure.suptitle(f"the dot: A wins {p1:g} of A's breaks, B wins {p2:g} of B's breaks")
    return figure
