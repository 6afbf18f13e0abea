"""Pictures of simulated seasons: ratings by week, wins by gap of skill, spread of the standings."""

from typing import overload

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from evenbreak.files.tables.problems import printable
from evenbreak.plots.picture import LINES, Picture, in_our_look, legend_below, new_axes

MOST_PLAYERS = 40
"""How many players of the standings are drawn: the first half and the last half of them."""


@overload
def errors_figure(weeks: pd.DataFrame, *, ax: Axes) -> Axes: ...
@overload
def errors_figure(weeks: pd.DataFrame) -> Picture: ...
@in_our_look
def errors_figure(weeks: pd.DataFrame, *, ax: Axes | None = None) -> Picture | Axes:
    """Draw how far off the ratings are, week by week.

    Parameters
    ----------
    weeks
        as `weeks_frame` returns it.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.

    >>> from evenbreak.answers.league.season_tables import weeks_frame
    >>> from evenbreak.league import LeaguePlayers, Season, run_chunk
    >>> season = Season(LeaguePlayers.of([92, 80], skill=[85, 80]), "npl", weeks=3)
    >>> figure = errors_figure(weeks_frame(run_chunk(season, 20, np.random.SeedSequence(1))))
    >>> figure.axes[0].get_xlabel()
    'week'
    """
    figure, axes = new_axes(
        "week",
        "rating less true skill (points)",
        title="How far off ratings are",
        ax=ax,
    )
    week = weeks["week"].to_numpy()
    for low, high, shade, part in (("05", "95", "0.88", 90), ("25", "75", "0.72", 50)):
        axes.fill_between(
            week,
            weeks[f"error_p{low}"].to_numpy(float, na_value=np.nan),
            weeks[f"error_p{high}"].to_numpy(float, na_value=np.nan),
            color=shade,
            linewidth=0,
            label=f"{part}% of the players",
        )
    axes.axhline(0.0, color="0.5", linewidth=0.8)
    mean, sd = weeks["error_mean"].to_numpy(), weeks["error_sd"].to_numpy()
    axes.plot(week, mean, **LINES[0]._asdict(), label="mean")
    axes.plot(week, sd, **LINES[1]._asdict(), label="standard deviation")
    axes.set_xlim(float(week[0]), float(week[-1]))
    axes.locator_params(axis="x", integer=True)
    axes.legend(loc="upper right", frameon=False, ncols=2)
    bottom, top = axes.get_ylim()
    axes.set_ylim(bottom, top + 0.25 * (top - bottom))  # room for the legend
    return figure if ax is None else ax


@overload
def gaps_figure(fairness: pd.DataFrame, *, ax: Axes) -> Axes: ...
@overload
def gaps_figure(fairness: pd.DataFrame) -> Picture: ...
@in_our_look
def gaps_figure(fairness: pd.DataFrame, *, ax: Axes | None = None) -> Picture | Axes:
    """Draw how often the stronger player wins, by the gap between the two skills.

    The bars are two standard errors of the simulation, up and down.

    Parameters
    ----------
    fairness
        as `fairness_frame` returns it.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.
    """
    rows = fairness[fairness["group"] == "gap"]
    figure, axes = new_axes(
        "gap between the true skills of the day (points)",
        "share of matches won by the stronger player",
        title="How fair matches are",
        ax=ax,
    )
    start = rows["from"].to_numpy(float)
    end = rows["to"].to_numpy(float, na_value=np.nan)
    # The last gap has no upper limit; it is drawn as wide as the first.
    middle = (start + np.where(np.isnan(end), start + np.nanmin(end, initial=np.inf), end)) / 2.0
    axes.axhline(0.5, color="0.5", linewidth=0.8)
    axes.errorbar(
        middle,
        rows["p_win"].to_numpy(),
        yerr=2.0 * np.nan_to_num(rows["p_win_se"].to_numpy()),
        fmt="o-",
        color=LINES[0].color,
        markersize=4,
        capsize=2.5,
        linewidth=1.0,
    )
    axes.set_xlim(left=0.0)
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, 0.4), max(high, 0.6))
    axes.annotate("even", (0.99, 0.5), xycoords=("axes fraction", "data"), ha="right", va="bottom")
    return figure if ax is None else ax


@overload
def standings_figure(standings: pd.DataFrame, *, ax: Axes) -> Axes: ...
@overload
def standings_figure(standings: pd.DataFrame) -> Picture: ...
@in_our_look
def standings_figure(standings: pd.DataFrame, *, ax: Axes | None = None) -> Picture | Axes:
    """Draw how many matches each player wins: the mean, and the range of 8 seasons in 10.

    Of more than 40 players the first 20 and the last 20 are drawn.

    Parameters
    ----------
    standings
        as `standings_frame` returns it.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.
    """
    rows, many, half = standings, len(standings), MOST_PLAYERS // 2
    title = "Matches won in a season"
    if many > MOST_PLAYERS:
        rows = rows.iloc[[*range(half), *range(many - half, many)]]
        title += f": the first and the last {half} of {many:,}"
    size = (6.4, 1.4 + 0.22 * len(rows))
    figure, axes = new_axes("matches won in a season", "", title=title, size=size, ax=ax)
    place = np.arange(len(rows))[::-1]
    mean, sd = rows["points_mean"].to_numpy(), rows["points_sd"].to_numpy()
    low = rows["points_p10"].to_numpy(float, na_value=np.nan)
    high = rows["points_p90"].to_numpy(float, na_value=np.nan)
    # Where no histograms of the players are kept, as if normally distributed.
    low = np.where(np.isnan(low), mean - 1.2816 * sd, low)
    high = np.where(np.isnan(high), mean + 1.2816 * sd, high)
    if not np.isnan(sd).all():  # one season has no spread
        axes.hlines(place, low, high, color="0.65", linewidth=5, label="8 seasons in 10")
    axes.plot(mean, place, "o", color=LINES[0].color, markersize=4, label="mean")
    axes.set_yticks(place, [printable(str(name))[:32] for name in rows["player"]])
    axes.set_ylim(-0.8, len(rows) - 0.2)
    axes.set_xlim(left=0.0)
    legend_below(figure, ax)
    return figure if ax is None else ax
