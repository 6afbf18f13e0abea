import numpy as np
import pytest
from matplotlib.patches import Rectangle

from evenbreak.games import Drill
from evenbreak.plots.practice import drill_figure, log_figure
from evenbreak.practice import DrillLog, analyse_log, drill_statistics


def heights(figure):
    bars = (patch for patch in figure.axes[0].patches if isinstance(patch, Rectangle))
    return [bar.get_height() for bar in bars]


def test_a_bar_for_each_level():
    statistics = drill_statistics(Drill.progressive(0.8))
    figure = drill_figure(statistics)
    assert heights(figure) == pytest.approx(statistics.distribution.probability)
    assert figure.axes[0].get_legend().get_texts()[0].get_text() == "mean 4.35"


def test_a_pair_of_bars_for_each_level_told_apart_without_colour():
    log = DrillLog([1, 2, 3, 2, 1, 1], [1, 1, 0, 0, 0, 1])
    analysis = analyse_log(log, rng=np.random.default_rng(1), replicas=9)
    figure = log_figure(analysis)
    assert heights(figure) == pytest.approx([3 / 6, 2 / 6, 1 / 6, *analysis.implied.probability])
    ends = next(line for line in figure.axes[0].lines if "interval" in str(line.get_label()))
    assert ends.get_xdata() == pytest.approx([analysis.mean_low, analysis.mean_high])
    bars = figure.axes[0].patches
    assert {bar.get_hatch() for bar in bars[:3]} != {bar.get_hatch() for bar in bars[3:]}


def test_many_levels_have_no_crowd_of_ticks():
    axes = drill_figure(drill_statistics(Drill.progressive(0.9, 60))).axes[0]
    assert len(axes.get_xticks()) < 20
