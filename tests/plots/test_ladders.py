import numpy as np
import pytest

from evenbreak.plots.ladders import (
    SettlingCurve,
    SystemPoint,
    ladder_figure,
    systems_figure,
)
from evenbreak.stats import Distribution

LAW = Distribution((-2, -1, 0, 1, 2), (0.1, 0.2, 0.4, 0.2, 0.1))
NATURAL = Distribution((-2, -1, 0, 1, 2), (0.05, 0.2, 0.5, 0.2, 0.05))


def curves(axes):
    return {line.get_label(): line.get_xydata() for line in axes.lines}


def test_the_law_stands_beside_the_natural_and_the_normal_one():
    (axes,) = ladder_figure(LAW, natural=NATURAL, within=1).axes
    drawn = curves(axes)
    law = drawn["this ladder, sd 1.10"]
    assert law.tolist() == [list(pair) for pair in zip(LAW.values, LAW.probability, strict=True)]
    natural = drawn["opponents rated rightly, sd 0.89"]
    assert natural[:, 1].tolist() == list(NATURAL.probability)
    bell = drawn["normal law of the same sd"]
    assert bell[:, 1].max() == pytest.approx(1.0 / (LAW.sd * np.sqrt(2.0 * np.pi)))
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert "within 1 point: 80 %" in labels


def test_the_natural_law_is_drawn_once():
    (axes,) = ladder_figure(LAW).axes
    assert not any("rightly" in label for label in curves(axes))


def test_errors_that_never_occur_are_left_out_and_the_normal_law_is_as_high():
    law = Distribution((-2, -1, 0, 1, 2), (0.25, 0.0, 0.5, 0.0, 0.25))
    (axes,) = ladder_figure(law).axes
    drawn = curves(axes)
    assert drawn[f"this ladder, sd {law.sd:.2f}"][:, 0].tolist() == [-2, 0, 2]
    # Half as many errors share the whole probability.
    bell = drawn["normal law of the same sd"]
    assert bell[:, 1].max() == pytest.approx(2.0 / (law.sd * np.sqrt(2.0 * np.pi)))


def test_a_single_error_has_no_normal_law():
    (axes,) = ladder_figure(Distribution((0,), (1.0,))).axes
    assert "normal law of the same sd" not in curves(axes)


def test_how_newcomers_settle_is_marked_at_half_and_nine_of_ten():
    settled = [0.0, 0.2, 0.5, 0.8, 0.9, 0.99, 1.0, 1.0]
    axes = ladder_figure(LAW, curve=SettlingCurve(-30, 5, settled)).axes[1]
    assert {text.get_text() for text in axes.texts} == {"half: 2 matches", "9 of 10: 4 matches"}
    assert axes.get_xlabel().endswith("-30 points")
    (steps,) = (line for line in axes.lines if line.get_drawstyle() == "steps-post")
    assert steps.get_ydata().tolist() == settled[:7]


def test_who_never_settles_within_the_picture_is_not_marked():
    axes = ladder_figure(LAW, curve=SettlingCurve(-30, 5, [0.0, 0.1, 0.2])).axes[1]
    assert not axes.texts


def test_each_system_is_a_point_with_its_name():
    points = [
        SystemPoint("step 2", 20.8, 30.8, unbeaten=True),
        SystemPoint("step 1", 15.4, 60.3, unbeaten=True),
        SystemPoint("step 6", 36.3, 31.0, unbeaten=False),
        SystemPoint("elo 4", 20.0, 50.0, unbeaten=None),
    ]
    (axes,) = systems_figure(points, chart="npl_10").axes
    drawn = {tuple(point) for line in axes.lines for point in line.get_xydata().tolist()}
    assert drawn == {(point.matches, point.sd) for point in points}
    assert {text.get_text() for text in axes.texts} == {point.name for point in points}
    joined = axes.lines[0].get_xydata().tolist()
    assert joined == [[30.8, 20.8], [60.3, 15.4]]
    told = [text.get_text() for text in axes.get_legend().get_texts()]
    assert len(told) == 3
    assert "npl_10" in told[0]
    (alone,) = systems_figure(points[:2]).axes
    assert len(alone.get_legend().get_texts()) == 1
