"""Pictures of a score, with its mean, median and mode, and of the spot in straight pool."""

from collections.abc import Sequence
from dataclasses import replace
from typing import overload

import numpy as np
from matplotlib.axes import Axes

from evenbreak.matches.straight_pool import StraightPool, even_spot, straight_pool_odds
from evenbreak.plots.picture import LINES, Picture, in_our_look, new_axes
from evenbreak.stats.innings import InningsScore
from evenbreak.stats.runs import RunLength

_SHOWN = (0.001, 0.995)
"""The quantiles between which scores are drawn."""

_COLORS = ("#CC79A7", "#009E73", "#E69F00")
_HATCHES = ("////", "\\\\\\\\", "....")
"""The shading of the spans of scores that were asked for."""

_POINTS = 150
"""The most points that a curve is drawn through."""


@overload
def plot_score(
    law: RunLength | InningsScore,
    innings: int = 1,
    *,
    asked: Sequence[tuple[str, int, int | None]] = (),
    ax: Axes,
) -> Axes: ...
@overload
def plot_score(
    law: RunLength | InningsScore,
    innings: int = 1,
    *,
    asked: Sequence[tuple[str, int, int | None]] = (),
) -> Picture: ...
@in_our_look
def plot_score(
    law: RunLength | InningsScore,
    innings: int = 1,
    *,
    asked: Sequence[tuple[str, int, int | None]] = (),
    ax: Axes | None = None,
) -> Picture | Axes:
    """Return a figure of the probability of each score, with its mean, median and mode.

    Parameters
    ----------
    law
        the distribution of the score.
    innings
        the number of innings, for the label of the axis.
    asked
        spans of scores to shade, each with its name: the fewest balls, and the most or None.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.

    >>> from evenbreak.stats import RunLength
    >>> figure = plot_score(RunLength(0.9))
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    ['mean 9', 'median 6', 'mode 0']
    """
    low, high = (law.quantile(q) for q in _SHOWN)
    scores = np.arange(low, high + 1)
    chances = law.probability(scores)
    played = "an inning" if innings == 1 else f"{innings} innings"
    figure, axes = new_axes(f"balls made in {played}", "probability", ax=ax)
    axes.fill_between(scores, chances, step="mid", color="0.85", linewidth=0)
    axes.step(scores, chances, where="mid", color="0.45", linewidth=1.0)
    for color, hatch, (name, least, most) in zip(_COLORS, _HATCHES, asked, strict=False):
        inside = (scores >= least) & (scores <= (high if most is None else most))
        p = float(law.at_least(least) if most is None else law.between(least, most))
        sides = np.add.outer(scores[inside], [-0.5, 0.5]).ravel()
        axes.fill_between(
            sides,
            np.repeat(chances[inside], 2),
            facecolor="none",
            edgecolor=color,
            hatch=hatch,
            linewidth=0.0,
            label=f"{name} ({p:.4f})",
        )
    for line, (name, at) in zip(LINES, law.fair_line._asdict().items(), strict=False):
        axes.axvline(at, **line._asdict(), linewidth=1.6, label=f"{name} {at:.4g}")
    axes.set_ylim(0.0)
    axes.margins(x=0.02)
    axes.legend(frameon=False)
    return figure if ax is None else ax


@overload
def plot_spot(match: StraightPool, *, ax: Axes) -> Axes: ...
@overload
def plot_spot(match: StraightPool) -> Picture: ...
@in_our_look
def plot_spot(match: StraightPool, *, ax: Axes | None = None) -> Picture | Axes:
    """Return a figure of A's chance in straight pool against the weaker player's points.

    The match as it stands is a dot on the curve. If any number of points makes it even (see
    `even_spot`), a dashed line marks the one nearest to even.

    Parameters
    ----------
    match
        the match; player 1 is A.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.

    >>> from evenbreak.matches import StraightPool
    >>> figure = plot_spot(StraightPool(50, 50, 0.9, 0.8))
    >>> figure.axes[0].get_xlabel()
    'points that B needs'
    """
    weaker, even, _ = even_spot(match)
    name = f"points_{weaker}"
    now = getattr(match, name)
    most = max(now, min(2 * (even or now), match.points_1 + match.points_2 - now))
    points = np.unique(np.linspace(1, most, _POINTS).round().astype(int)).tolist()
    wins = [straight_pool_odds(replace(match, **{name: n})).p_win_1 for n in points]
    shots = f"A makes a shot with {float(match.p1):.4g}, B with {float(match.p2):.4g}"
    figure, axes = new_axes(
        f"points that {' AB'[weaker]} needs",
        "P(A wins the match)",
        title=shots,
        ax=ax,
    )
    curve, half = LINES[:2]
    axes.plot(points, wins, **curve._asdict())
    axes.plot(
        [now],
        [straight_pool_odds(match).p_win_1],
        "o",
        color=curve.color,
        label=f"{match.points_1} against {match.points_2}",
    )
    axes.axhline(0.5, color="0.7", linewidth=0.8)
    if even is not None:
        name = f"nearest to even: {even}"
        axes.axvline(even, **half._asdict(), label=name)
    axes.set_ylim(-0.02, 1.02)
    axes.margins(x=0.02)
    axes.legend(frameon=False)
    return figure if ax is None else ax
