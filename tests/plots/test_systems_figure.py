from itertools import combinations

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from evenbreak.plots.ladders import SystemPoint, systems_figure

CROWDED = [  # two that fall together at either end, and a crowd on the right
    SystemPoint("step 1", 14.7, 62.7, True),
    SystemPoint("fixed 9", 16.0, 62.0, None),
    SystemPoint("npl_12", 13.8, 57.3, None),
    SystemPoint("npl_8", 15.3, 67.1, None),
    SystemPoint("step 5", 34.0, 10.6, True),
    SystemPoint("step 6", 37.8, 11.9, False),
    SystemPoint("elo 16", 33.8, 10.1, None),
    SystemPoint("step 8", 44.7, 9.4, True),
]


@pytest.mark.parametrize("points", [CROWDED, CROWDED[:4], CROWDED[4:]])
def test_no_name_covers_another_or_a_mark(points):
    figure = systems_figure(points, chart="npl_10")
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    axes = figure.axes[0]
    texts = [text.get_window_extent(canvas.get_renderer()) for text in axes.texts]
    assert len(texts) == len(points)
    assert not any(one.overlaps(other) for one, other in combinations(texts, 2))
    marks = axes.transData.transform([(point.matches, point.sd) for point in points])
    assert not any(text.contains(*mark) for text in texts for mark in marks)
    assert axes.get_title() == "Systems, and sizes of the step on npl_10"
