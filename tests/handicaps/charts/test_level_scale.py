import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import LevelChart, audit_levels, level_scale


@pytest.mark.parametrize("scale", ["npl", "fargo", 7.5])
def test_games_are_won_as_the_audit_says(scale):
    report, levels = audit_levels("apa_8ball", scale=scale), level_scale("apa_8ball")
    strengths = levels.strength(report.levels)
    theirs = report.scale.win_probability(np.subtract.outer(report.ratings, report.ratings))
    ours = levels.scale.win_probability(np.subtract.outer(strengths, strengths))
    assert ours == pytest.approx(theirs, rel=1e-12)


def test_an_average_step_is_one_level():
    levels = level_scale("apa_8ball")
    assert levels.strength([2, 7]).tolist() == pytest.approx([2.0, 7.0])
    assert levels.strength(4.5) == pytest.approx((levels.strengths[2] + levels.strengths[3]) / 2)
    p = levels.scale.win_probability(1.0)
    assert levels.odds_of_a_level == pytest.approx(p / (1 - p))


@pytest.mark.parametrize(
    "chart", [LevelChart("one", [5], [[4]]), LevelChart("flat", [3, 4], [[3, 3], [3, 3]])]
)
def test_races_that_do_not_set_levels_apart(chart):
    with pytest.raises(InputError, match="give a scale"):
        level_scale(chart)
