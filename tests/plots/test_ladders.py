"""Pictures of ladders and systems show the numbers they are given."""

from itertools import combinations

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from evenbreak.handicaps import Settling
from evenbreak.plots.ladders import (
    SystemPoint,
    draw_systems,
    ladder_figure,
)
from evenbreak.stats import Distribution

LAW = Distribution((-2, -1, 0, 1, 2), (0.1, 0.2, 0.4, 0.2, 0.1))
NATURAL = Distribution((-2, -1, 0, 1, 2), (0.05, 0.2, 0.5, 0.2, 0.05))


def curves(axes):
    return {line.get_label(): line.get_xydata() for line in axes.lines}


def test_errors_stand_beside_the_natural_and_the_normal_ones():
    (axes,) = ladder_figure(LAW, natural=NATURAL, within=1).axes
    drawn = curves(axes)
    law = drawn["this ladder (sd 1.10)"]
    assert law.tolist() == [list(pair) for pair in zip(LAW.values, LAW.probability, strict=True)]
    natural = drawn["against correctly rated opponents (sd 0.89)"]
    assert natural[:, 1].tolist() == list(NATURAL.probability)
    bell = drawn["normal distribution with the same sd"]
    assert bell[:, 1].max() == pytest.approx(1.0 / (LAW.sd * np.sqrt(2.0 * np.pi)))
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert "within 1 point: 80%" in labels


def test_natural_errors_are_drawn_once():
    (axes,) = ladder_figure(LAW).axes
    assert not any("correctly" in label for label in curves(axes))


def test_errors_that_never_occur_are_left_out():
    law = Distribution((-2, -1, 0, 1, 2), (0.25, 0.0, 0.5, 0.0, 0.25))
    (axes,) = ladder_figure(law).axes
    drawn = curves(axes)
    assert drawn[f"this ladder (sd {law.sd:.2f})"][:, 0].tolist() == [-2, 0, 2]
    # Half as many errors share the whole probability.
    bell = drawn["normal distribution with the same sd"]
    assert bell[:, 1].max() == pytest.approx(2.0 / (law.sd * np.sqrt(2.0 * np.pi)))


def test_a_single_error_has_no_normal_distribution():
    (axes,) = ladder_figure(Distribution((0,), (1.0,))).axes
    assert "normal distribution with the same sd" not in curves(axes)


def settling(settled):
    chances = tuple(np.diff(settled, prepend=0.0))
    return Settling(-30, 5, newcomer=False, mean=2.0, sd=1.0, chances=chances, tail=0.0)


def test_how_newcomers_settle_is_marked_at_half_and_nine_of_ten():
    settled = [0.0, 0.2, 0.5, 0.8, 0.9, 0.99, 1.0, 1.0]
    axes = ladder_figure(LAW, curve=settling(settled)).axes[1]
    assert {text.get_text() for text in axes.texts} == {"half: 2 matches", "9 of 10: 4 matches"}
    assert axes.get_xlabel().endswith("30 points too low")
    (steps,) = (line for line in axes.lines if line.get_drawstyle() == "steps-post")
    assert steps.get_ydata().tolist() == pytest.approx(settled[:7])


def test_what_never_settles_within_the_picture_is_not_marked():
    axes = ladder_figure(LAW, curve=settling([0.0, 0.1, 0.2])).axes[1]
    assert not axes.texts


def test_each_system_is_a_point_with_its_name():
    points = [
        SystemPoint("step 2", 20.8, 30.8, unbeaten=True),
        SystemPoint("step 1", 15.4, 60.3, unbeaten=True),
        SystemPoint("step 6", 36.3, 31.0, unbeaten=False),
        SystemPoint("elo 4", 20.0, 50.0, unbeaten=None),
    ]
    axes = draw_systems(points, chart="npl_10")
    drawn = {tuple(point) for line in axes.lines for point in line.get_xydata().tolist()}
    assert drawn == {(point.matches, point.sd) for point in points}
    assert {text.get_text() for text in axes.texts} == {point.name for point in points}
    joined = axes.lines[0].get_xydata().tolist()
    assert joined == [[30.8, 20.8], [60.3, 15.4]]
    told = [text.get_text() for text in axes.get_legend().get_texts()]
    assert len(told) == 3
    assert "npl_10" in told[0]
    alone = draw_systems(points[:2])
    assert len(alone.get_legend().get_texts()) == 1


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


@pytest.mark.slow
@pytest.mark.parametrize("points", [CROWDED, CROWDED[:4], CROWDED[4:]])
def test_no_name_covers_another_or_a_mark(points):
    axes = draw_systems(points, chart="npl_10")
    canvas = FigureCanvasAgg(axes.figure)
    canvas.draw()
    texts = [text.get_window_extent(canvas.get_renderer()) for text in axes.texts]
    assert len(texts) == len(points)
    assert not any(one.overlaps(other) for one, other in combinations(texts, 2))
    marks = axes.transData.transform([(point.matches, point.sd) for point in points])
    assert not any(text.contains(*mark) for text in texts for mark in marks)
    assert axes.get_title().endswith("npl_10")
