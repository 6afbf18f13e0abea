"""A picture of a validated season: the chances given, and how often favourites won."""

from collections.abc import Sequence
from typing import overload

from matplotlib.axes import Axes

from evenbreak.plots.picture import LINES, Picture, in_our_look, new_axes
from evenbreak.ratings.calibration import CalibrationBin
from evenbreak.ratings.validate import Validation


@overload
def calibration_figure(found: Validation, *, ax: Axes) -> Axes: ...
@overload
def calibration_figure(found: Validation) -> Picture: ...
@in_our_look
def calibration_figure(found: Validation, *, ax: Axes | None = None) -> Picture | Axes:
    """Draw how often favourites won against the chance that they had been given.

    Points on the diagonal are right; below it the chances were too extreme. The bars are
    95% intervals.

    It is drawn on the axes `ax`, which are returned, or else in a new figure, which is.

    >>> from evenbreak.ratings import Results, validate
    >>> season = Results.from_names(["Ann"] * 3, ["Bo"] * 3, [7, 7, 3], [2, 4, 7],
    ...     date=["2024-09-03", "2024-09-10", "2024-09-17"])
    >>> figure = calibration_figure(validate(season, prior_sd=0.5))
    >>> figure.axes[0].get_xlabel()
    'chance given to the favourite'
    """
    figure, axes = new_axes(
        "chance given to the favourite",
        "share that the favourite won",
        title="Chances given, and how often favourites won",
        size=(6.0, 5.4),
        ax=ax,
    )
    axes.plot([0.5, 1.0], [0.5, 1.0], color="0.6", linewidth=1.0, zorder=0, label="right")
    groups: tuple[tuple[str, Sequence[CalibrationBin], str, float, str], ...] = (
        ("games", found.games, "o", -0.006, LINES[0].color),
        ("matches", found.matches, "s", 0.0, LINES[1].color),
        ("matches, ratings at face value", found.matches_plug_in, "^", 0.006, LINES[2].color),
    )
    lowest = 0.5
    for name, bins, marker, shift, color in groups:
        if not bins:
            continue
        axes.errorbar(
            # Slightly apart, so that no bar hides another.
            [row.predicted + shift for row in bins],
            [row.seen for row in bins],
            yerr=[[row.seen - row.low for row in bins], [row.high - row.seen for row in bins]],
            fmt=marker,
            color=color,
            markerfacecolor="white" if marker == "^" else color,
            markersize=5,
            capsize=2.5,
            linewidth=1.0,
            label=name,
        )
        lowest = min(lowest, *(row.low for row in bins))
    axes.set_xlim(0.49, 1.01)
    axes.set_ylim(max(0.0, lowest - 0.02), 1.01)
    axes.legend(loc="upper left", frameon=False)
    return figure if ax is None else ax
