import numpy as np
import pytest
from matplotlib.patches import Rectangle

from evenbreak.games import Drill
from evenbreak.plots.practice import draw_drill, draw_log
from evenbreak.practice import DrillLog, analyse_log, drill_statistics


def heights(axes):
    bars = (patch for patch in axes.patches if isinstance(patch, Rectangle))
    return [bar.get_height() for bar in bars]


def test_a_bar_for_each_level():
    statistics = drill_statistics(Drill.progressive(0.8))
    axes = draw_drill(statistics)
    assert heights(axes) == pytest.approx(statistics.distribution.probability)
    assert axes.get_legend().get_texts()[0].get_text() == "mean 4.35"


def test_a_pair_of_bars_for_each_level_told_apart_without_colour():
    log = DrillLog([1, 2, 3, 2, 1, 1], [1, 1, 0, 0, 0, 1])
    analysis = analyse_log(log, rng=np.random.default_rng(1), replicas=9)
    axes = draw_log(analysis)
    assert heights(axes) == pytest.approx([3 / 6, 2 / 6, 1 / 6, *analysis.implied.probability])
    ends = next(line for line in axes.lines if "interval" in str(line.get_label()))
    assert ends.get_xdata() == pytest.approx([analysis.mean_low, analysis.mean_high])
    bars = axes.patches
    assert {bar.get_hatch() for bar in bars[:3]} != {bar.get_hatch() for bar in bars[3:]}


def test_many_levels_have_no_crowd_of_ticks():
    axes = draw_drill(drill_statistics(Drill.progressive(0.9, 60)))
    assert len(axes.get_xticks()) < 20
