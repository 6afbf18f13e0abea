"""The picture of a match as it went: who was how likely to win, rack after rack."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from evenbreak.reports.style import LINES, label_beside

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from evenbreak.matches.live import LiveOdds

__all__ = ["plot_course"]

_MOST_SCORES = 24
"""Scores that fit below the picture; beyond, every so many are written."""


def plot_course(odds: LiveOdds) -> Figure:
    """Return a figure of a match as it went; player 1 is A and player 2 is B.

    Above, P(A wins the match) after each rack: a filled dot is a rack that A won, an open one
    a rack that B won; the rack that moved the match most is marked. Below, the leverage of
    each rack before it was played: how much hung on it.

    Parameters
    ----------
    odds
        the match, with one rack at least.

    >>> from evenbreak.games import Race, Rack
    >>> from evenbreak.matches import live_odds
    >>> figure = plot_course(live_odds(Race(3, 2, Rack(0.6)), [1, 2, 1]))
    >>> [label.get_text() for label in figure.axes[1].get_xticklabels()]
    ['0:0', '1:0', '1:1', '2:1']
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 5.4), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    wins = [moment.p_win_1 for moment in odds.course]
    racks = range(len(wins))
    line = LINES[1]
    above.axhline(0.5, color="0.7", linewidth=0.8)
    above.plot(racks, wins, color=line.color, linewidth=1.4, zorder=2)
    for winner, face, name in ((1, line.color, "A won the rack"), (2, "white", "B won the rack")):
        at = [i for i, won in enumerate(odds.winners, 1) if won == winner]
        if at:
            chances = [wins[i] for i in at]
            above.plot(at, chances, "o", color=line.color, mfc=face, ms=7, label=name, zorder=3)
    most = max(range(len(odds.swings)), key=lambda i: abs(odds.swings[i]))
    swing = odds.swings[most]
    told = f"{swing:+.2f}".replace("-", "\N{MINUS SIGN}")
    last = most >= len(odds.swings) - 2
    side: Literal["left", "right"] = "left" if last or (swing > 0 and most > 0) else "right"
    label = label_beside(above, most + 0.5, wins[most] + 0.5 * swing, told, side)
    # Where the line is flat it runs through the label.
    label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 1.0})
    above.set(ylim=(-0.03, 1.03), ylabel="P(A wins the match)")
    above.legend(frameon=False, loc="best")
    leverages = [moment.leverage or 0.0 for moment in odds.course[:-1]]
    below.bar([i + 0.5 for i in range(len(leverages))], leverages, width=0.7, color="0.6")
    below.set(ylabel="leverage", xlabel="score", ylim=(0.0, None))
    step = -(-len(wins) // _MOST_SCORES)
    shown = list(racks)[::step]
    below.set_xticks(shown, [_score(odds.course[i].scores) for i in shown])
    if any(len(moment.scores) > 1 for moment in odds.course):
        below.set_xlabel("score, below it that of the set")
    for axes in (above, below):
        axes.tick_params(direction="in", top=True, right=True)
    return figure


def _score(scores: tuple[tuple[int, int], ...]) -> str:
    return "\n".join(f"{a}:{b}" for a, b in scores)
