"""Plots of matches: the chance of winning by p and format, and its course in a match so far."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes

from evenbreak.games.rack import Rack
from evenbreak.matches.crossings import Crossings, rack_along
from evenbreak.matches.formats import MatchFormat
from evenbreak.matches.live import LiveOdds
from evenbreak.matches.win import win_probability
from evenbreak.plots.picture import (
    LINES,
    Picture,
    figure_of,
    in_our_look,
    new_axes,
    take_names_as_they_are,
    unit_axis,
    write_title,
)
from evenbreak.words import tally

_POINTS = 401


@in_our_look
def draw_formats(
    formats: Sequence[MatchFormat],
    line: Mapping[str, Any],
    pairs: Iterable[Crossings],
    *,
    p1: float,
    title: str = "",
    names: tuple[str, str] = ("A", "B"),
    ax: Axes | None = None,
) -> Axes:
    """Draw player 1's chance in a match against p1, one curve per format, at most seven.

    `line` holds what stays fixed as p1 varies, as options of `evenbreak.matches.crossings`; each
    crossing is a dot, and the players' own p1 is a vertical line.
    """
    fixed = {name: line.get(name) for name in ("p2", "break_odds")}
    matters = any(value is not None for value in fixed.values())
    a, b = names
    x = f"chance that {a} wins a game {a} breaks" if matters else f"chance that {a} wins a game"
    axes = new_axes(x, f"chance that {a} wins the match", size=(5.4, 4.8), ax=ax)
    chances = np.linspace(0.0, 1.0, _POINTS)[1:-1]
    rack: Rack = rack_along(chances, **fixed)
    axes.axhline(0.5, color="0.7", linewidth=0.8)
    for played, style in zip(formats, LINES, strict=False):
        match = played.match(
            rack, breaks=line.get("breaks"), first_breaker=line.get("first_breaker", 1)
        )
        axes.plot(
            chances,
            win_probability(match),
            label=str(played),
            **style._asdict(),
        )
    points = [point for crossing in pairs for point in crossing.points]
    if points:
        axes.plot(
            [point.p1 for point in points],
            [point.p_win_1 for point in points],
            "o",
            color="black",
            mfc="white",
            ms=6,
            zorder=4,
            clip_on=False,
            label="equal formats",
        )
    axes.axvline(p1, color="0.5", linewidth=1.0, zorder=0, label=f"{a} against {b}")
    unit_axis(axes, "x", "y")
    if title and ax is None:
        write_title(figure_of(axes), title)
    elif title:
        axes.set_title(title)
    axes.legend(frameon=False, loc="best")
    take_names_as_they_are(axes)
    return axes


_MOST_SCORES = 24
"""The most scores that fit below the plot; of more, only every second, third, ... is shown."""

_LABEL_SHARE, _LABEL_HEIGHT, _GAP = 0.09, 0.06, 0.05
"""Fractions of the plot: a label's width and height, and its distance from the line."""


@in_our_look
def course_figure(
    odds: LiveOdds, *, title: str = "", names: tuple[str, str] = ("A", "B")
) -> Picture:
    """Return a figure of a match so far, which must have at least one rack.

    The upper panel is player 1's chance of winning the match after each rack: a filled dot is a
    rack that player 1 won, an open dot a rack that player 2 won, and the rack that changed most is
    marked. The lower panel is the leverage of each rack: how much depended on it before it was
    played.
    """
    figure = Picture(figsize=(6.0, 4.8), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    wins = [moment.p_win_1 for moment in odds.course]
    racks = range(len(wins))
    line = LINES[1]
    above.axhline(0.5, color="0.7", linewidth=0.8)
    above.plot(racks, wins, color=line.color, linewidth=1.4, zorder=2)
    dot: Any = {"color": line.color, "ms": 7, "zorder": 3}
    for winner, face, name in ((1, line.color, names[0]), (2, "white", names[1])):
        at = [i for i, won in enumerate(odds.winners, 1) if won == winner]
        if at:
            chances = [wins[i] for i in at]
            above.plot(at, chances, "o", mfc=face, label=f"{name} won the rack", **dot)
    most = max(range(len(odds.swings)), key=lambda i: abs(odds.swings[i]))
    swing = odds.swings[most]
    change = f"{swing:+.2f}".replace("-", "\N{MINUS SIGN}")
    above.plot(racks[most : most + 2], wins[most : most + 2], color=line.color, linewidth=3.0)
    place, va = _clear_of(wins, most + 0.5)
    label = above.text(most + 0.5, place, change, fontsize=9, ha="center", va=va)
    label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.0})  # over the line of 1/2
    above.set(ylim=(-0.03, 1.03), ylabel=f"chance that {names[0]} wins the match")
    above.legend(frameon=False, loc="best")
    take_names_as_they_are(above)
    leverages = [moment.leverage or 0.0 for moment in odds.course[:-1]]
    below.bar([i + 0.5 for i in range(len(leverages))], leverages, width=0.7, color="0.6")
    below.set(ylabel="leverage", xlabel="score", ylim=(0.0, None))
    step = -(-len(wins) // _MOST_SCORES)
    shown = list(racks)[::step]
    below.set_xticks(shown, [_score(odds.course[i].scores) for i in shown])
    if any(len(moment.scores) > 1 for moment in odds.course):
        below.set_xlabel("score, with the set's score below it")
    for axes in (above, below):
        axes.tick_params(direction="in", top=True, right=True)
    if title:
        write_title(figure, title)
    return figure


def _clear_of(wins: Sequence[float], x: float) -> tuple[float, Literal["bottom", "top"]]:
    """Return where a label centered at x is clear of the line, and which end of it that is.

    >>> _clear_of([0.25, 0.25, 0.25], 1.5)
    (0.3, 'bottom')
    """
    half = _LABEL_SHARE * len(wins) / 2.0
    near = np.linspace(max(x - half, 0.0), min(x + half, len(wins) - 1.0), 101)
    line = np.interp(near, range(len(wins)), wins)
    over = float(line.max()) + _GAP
    if over < 1.0 - _LABEL_HEIGHT:
        return over, "bottom"
    return float(line.min()) - _GAP, "top"


def _score(scores: tuple[tuple[int, int], ...]) -> str:
    return "\n".join(tally(one) for one in scores)
