"""The plot of what fairness costs in length."""

from collections.abc import Sequence
from typing import overload

from matplotlib.axes import Axes

from evenbreak.handicaps.charts.pareto import ParetoChart
from evenbreak.plots.picture import Picture, in_our_look
from evenbreak.plots.style import LINES, new_axes


@overload
def pareto_figure(charts: Sequence[ParetoChart], *, criterion: str = "mean", ax: Axes) -> Axes: ...
@overload
def pareto_figure(charts: Sequence[ParetoChart], *, criterion: str = "mean") -> Picture: ...
@in_our_look
def pareto_figure(
    charts: Sequence[ParetoChart], *, criterion: str = "mean", ax: Axes | None = None
) -> Picture | Axes:
    """Draw the unfairness of charts over their mean length.

    Dots are charts that no other beats; those with a limit on the 90% length are filled and
    labelled with that length. Diamonds are charts that another one beats, with their names.

    Parameters
    ----------
    charts
        what `pareto` returned.
    criterion
        'mean' or 'worst': the unfairness to draw.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.

    >>> from evenbreak.handicaps import RaceLimits, chart, pareto
    >>> npl_8 = chart("npl_8")
    >>> figure = pareto_figure(pareto("npl", RaceLimits((5, 7), weaker_least=2), beside=[npl_8]))
    >>> [text.get_text() for text in figure.axes[0].texts if text.get_text()]
    ['6', '5', 'npl_8']
    """
    figure, axes = new_axes(
        "games in a match, on average",
        f"unfairness {'on average' if criterion == 'mean' else 'at worst'}",
        ax=ax,
    )
    black, orange = LINES[0].color, LINES[2].color
    kinds = (
        (_by_mean, "o", "white", black, "fairest chart of this mean length"),
        (_by_p90, "o", black, black, "fairest with 9 of 10 matches within this many games"),
        (_beaten, "D", orange, orange, "another chart is fairer and no longer"),
    )
    middle = sum(_place(one, criterion)[0] for one in (charts[0], charts[-1])) / 2.0
    for kind, mark, inside, edge, label in kinds:
        drawn = [one for one in charts if kind(one)]
        if not drawn:
            continue
        points = [_place(one, criterion) for one in drawn]
        axes.plot(
            *zip(*points, strict=True), mark, mfc=inside, mec=edge, ms=5, zorder=3, label=label
        )
        for one, point in zip(drawn, points, strict=True):
            right = kind is _beaten and point[0] > middle
            axes.annotate(
                _name(one),
                point,
                xytext=(-6 if right else 4, 5),
                textcoords="offset points",
                ha="right" if right else "left",
                fontsize=10 if kind is _beaten else 7,
                parse_math=False,
            )
    axes.margins(0.06)
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="upper right", fontsize=9)
    return figure if ax is None else ax


def _place(one: ParetoChart, criterion: str) -> tuple[float, float]:
    return one.measure.mean_games, getattr(one.measure, f"{criterion}_unfairness")


def _beaten(one: ParetoChart) -> bool:
    return one.beaten_by is not None


def _by_p90(one: ParetoChart) -> bool:
    return not _beaten(one) and one.chart.name.startswith("games_p90")


def _by_mean(one: ParetoChart) -> bool:
    return not _beaten(one) and not _by_p90(one)


def _name(one: ParetoChart) -> str:
    """Return the label of a chart: its name, its 90% length, or nothing."""
    if _by_p90(one):
        return str(one.measure.games_p90)
    return one.chart.name if _beaten(one) else ""
