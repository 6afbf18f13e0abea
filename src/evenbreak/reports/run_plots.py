"""The picture of a score: its law, with the mean, the median and the mode marked."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.reports.style import LINES, new_axes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from evenbreak.stats.innings import InningsScore
    from evenbreak.stats.runs import RunLength

__all__ = ["plot_score"]

_SHOWN = (0.001, 0.995)
"""The quantiles from which and up to which scores are drawn."""


def plot_score(law: RunLength | InningsScore, innings: int = 1) -> Figure:
    """Return a figure of the probability of each score, with its mean, median and mode.

    Parameters
    ----------
    law
        the law of the score.
    innings
        in how many innings it is made, for the words beside the axes.

    >>> from evenbreak.stats import RunLength
    >>> figure = plot_score(RunLength(0.9))
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    ['mean 9', 'median 6', 'mode 0']
    """
    import numpy as np

    low, high = (law.quantile(q) for q in _SHOWN)
    scores = np.arange(low, high + 1)
    chances = law.probability(scores)
    played = "an inning" if innings == 1 else f"{innings} innings"
    figure, axes = new_axes(f"balls made in {played}", "probability")
    axes.fill_between(scores, chances, step="mid", color="0.85", linewidth=0)
    axes.step(scores, chances, where="mid", color="0.45", linewidth=1.0)
    for line, (name, at) in zip(LINES, law.fair_line._asdict().items(), strict=False):
        axes.axvline(
            at, color=line.color, linestyle=line.linestyle, linewidth=1.6, label=f"{name} {at:.4g}"
        )
    axes.set_ylim(0.0)
    axes.margins(x=0.02)
    axes.legend(frameon=False)
    return figure
