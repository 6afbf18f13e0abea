"""Plots of simulated and real seasons: ratings, standings, sandbagging, calibration."""

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from evenbreak.files.tables.problems import printable
from evenbreak.league.sandbag_pay import Sandbagging
from evenbreak.league.sandbag_watch import Watched
from evenbreak.plots.picture import LINES, in_our_look, legend_below, new_axes
from evenbreak.ratings.validation.calibration import CalibrationBin
from evenbreak.ratings.validation.validate import Validation

MOST_PLAYERS = 40
"""How many players in the standings are drawn: half from the top and half from the bottom."""


@in_our_look
def draw_errors(weeks: pd.DataFrame, *, ax: Axes | None = None) -> Axes:
    """Draw the errors of the ratings in `weeks_frame`, week by week."""
    axes = new_axes(
        "week",
        "rating minus true skill (points)",
        title="How far off ratings are",
        counts="x",
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
    axes.legend(loc="upper right", frameon=False, ncols=2)
    bottom, top = axes.get_ylim()
    axes.set_ylim(bottom, top + 0.25 * (top - bottom))  # room for the legend
    return axes


@in_our_look
def draw_gaps(fairness: pd.DataFrame, *, ax: Axes | None = None) -> Axes:
    """Draw how often the stronger player wins, by skill gap, from `fairness_frame`.

    The bars are two standard errors of the simulation in each direction.
    """
    rows = fairness[fairness["group"] == "gap"]
    axes = new_axes(
        "difference in true skill that night (points)",
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
    return axes


@in_our_look
def draw_standings(standings: pd.DataFrame, *, ax: Axes | None = None) -> Axes:
    """Draw how many matches each player wins: the mean, and the range in 8 seasons out of 10.

    If `standings_frame` has more than 40 players, the first 20 and the last 20 are drawn.
    """
    rows, many, half = standings, len(standings), MOST_PLAYERS // 2
    title = "Matches won in a season"
    if many > MOST_PLAYERS:
        rows = rows.iloc[[*range(half), *range(many - half, many)]]
        title += f": the first {half} and the last {half} of {many:,}"
    size = (5.8, 1.4 + 0.22 * len(rows))
    axes = new_axes("matches won in a season", "", title=title, size=size, counts="x", ax=ax)
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
    legend_below(axes, ax)
    return axes


@in_our_look
def draw_even(deciles: pd.DataFrame, *, ax: Axes | None = None) -> Axes:
    """Draw the share of even matches by skill (`deciles_frame`), by system, with 90% bars.

    >>> rows = [("npl", part, 0.5, 0.01) for part in (1, 2)]
    >>> frame = pd.DataFrame(rows, columns=["system", "part", "p_even", "p_even_se"])
    >>> draw_even(frame).get_ylabel()
    'share of their matches that are even'
    """
    axes = new_axes(
        "players by true skill (1: the weakest tenth)",
        "share of their matches that are even",
        title="How even matches are, by skill",
        counts="x",
        ax=ax,
    )
    _lines(axes, deciles, "part", "p_even")
    legend_below(axes, ax)
    return axes


@in_our_look
def draw_errors_compared(nights: pd.DataFrame, *, ax: Axes | None = None) -> Axes:
    """Draw the errors of ratings night by night (`nights_frame`), with one line per system."""
    axes = new_axes(
        "night",
        "typical rating error (doublings of odds)",
        title="How far off ratings are",
        counts="x",
        ax=ax,
    )
    _lines(axes, nights, "night", "error", markers=False)
    axes.set_xlim(left=0.0)
    legend_below(axes, ax)
    return axes


def _lines(axes: Axes, frame: pd.DataFrame, x: str, y: str, *, markers: bool = True) -> None:
    """Draw a line for each system, with bars for 90% intervals."""
    for place, (name, rows) in enumerate(frame.groupby("system", sort=False)):
        line = LINES[place % len(LINES)]._asdict()
        bars = 1.645 * rows[f"{y}_se"].to_numpy(float)
        values = rows[x].to_numpy(float), rows[y].to_numpy(float)
        if markers and not np.isnan(bars).any():
            axes.errorbar(*values, yerr=bars, capsize=2.5, marker="o", markersize=4, **line,
                          label=str(name))  # fmt: skip
        else:
            axes.plot(*values, **line, label=str(name))
    axes.set_ylim(bottom=0.0)


MOST_NAMED = 6
"""How many players in a league are named; the others are thin lines."""


@in_our_look
def draw_pay(pays: Sandbagging, *, ax: Axes | None = None) -> Axes:
    """Draw the chance of winning each match that counts, for several numbers of dumped matches."""
    axes = new_axes(
        "match that counts",
        "chance of winning it",
        title="What dumping matches gains",
        counts="x",
        ax=ax,
    )
    most, many = len(pays.rows) - 1, pays.p_win.shape[1]
    shown = sorted({round(most * part / 4) for part in range(5)})
    matches = range(1, many + 1)
    for dumped, line in zip(shown, LINES, strict=False):
        label = f"{dumped} dumped" if dumped else "honest"
        axes.plot(matches, pays.p_win[dumped], **line._asdict(), label=label)
    axes.set_xlim(1, max(many, 2))
    # Room above the lines for their names.
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.25 * (high - low))
    axes.legend(loc="upper center", fontsize=9, ncols=3)
    return axes


@in_our_look
def draw_watch(watched: Sequence[Watched], *, alpha: float, ax: Axes | None = None) -> Axes:
    """Draw the evidence against each player, match by match, on a logarithmic axis.

    The alarm is at 1 / alpha.
    """
    axes = new_axes(
        "the player's match number",
        "evidence",
        title="Evidence of sandbagging",
        size=(6.4, 4.2),
        counts="x",
        ax=ax,
    )
    named = sorted(watched, key=lambda watch: -float(watch.log_e.max()))[:MOST_NAMED]
    axes.axhline(1.0 / alpha, color="#555555", linewidth=0.8, linestyle=":", label="alarm")
    for watch in watched:
        if watch not in named:
            axes.plot(*_curve(watch), color="#bbbbbb", linewidth=0.6)
    for watch, line in zip(named, LINES, strict=False):
        axes.plot(*_curve(watch), **line._asdict(), label=watch.player)
    axes.set_yscale("log")
    axes.set_xlim(left=0)
    legend = axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=9)
    for text in legend.get_texts():
        text.set_parse_math(False)
    return axes


def _curve(watched: Watched) -> tuple[range, list[float]]:
    values = [1.0, *(math.exp(min(max(value, -300.0), 300.0)) for value in watched.log_e)]
    return range(len(values)), values


_ENOUGH = 20
"""A chance from fewer games or matches than this is too uncertain to draw."""


@in_our_look
def draw_calibration(validation: Validation, *, ax: Axes | None = None) -> Axes:
    """Draw how often favorites won against their predicted chance.

    Points on the diagonal are right; below it, the chances were too extreme. The bars are 95%
    intervals.

    The plot is drawn on the axes `ax`, or else in a new figure.

    >>> from evenbreak.ratings import Results, validate
    >>> season = Results.from_names(["Ann"] * 3, ["Bo"] * 3, [7, 7, 3], [2, 4, 7],
    ...     date=["2024-09-03", "2024-09-10", "2024-09-17"])
    >>> axes = draw_calibration(validate(season, prior_sd=0.5))
    >>> axes.get_xlabel()
    'predicted chance of the favorite'
    """
    axes = new_axes(
        "predicted chance of the favorite",
        "share the favorite won",
        title="How often favorites won, and were expected to",
        size=(5.4, 4.8),
        ax=ax,
    )
    axes.plot(
        [0.5, 1.0], [0.5, 1.0], color="0.6", linewidth=1.0, zorder=0, label="perfect prediction"
    )
    groups: tuple[tuple[str, Sequence[CalibrationBin], str, float, str], ...] = (
        ("games", validation.games, "o", -0.006, LINES[0].color),
        ("matches", validation.matches, "s", 0.0, LINES[1].color),
        (
            "matches, ratings treated as exact",
            validation.matches_plug_in,
            "^",
            0.006,
            LINES[2].color,
        ),
    )
    lowest, few = 0.5, 0
    for name, bins, marker, shift, color in groups:
        enough = [row for row in bins if row.games >= _ENOUGH]
        few += len(bins) - len(enough) if enough else 0
        bins = enough or bins
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
    if few:
        text = (
            f"Not shown: {few} groups of fewer than {_ENOUGH} games or matches"
            if few > 1
            else f"Not shown: one group of fewer than {_ENOUGH} games or matches"
        )
        axes.text(0.98, 0.02, text, transform=axes.transAxes, ha="right", fontsize=9, color="0.35")
    return axes
