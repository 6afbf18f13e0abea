import pytest

from evenbreak.matches import StraightPool, even_spot, straight_pool_odds
from evenbreak.plots.practice import draw_score, draw_spot
from evenbreak.stats import InningsScore, RunLength


@pytest.mark.parametrize(
    "law", [RunLength(0.96), InningsScore(0.96, 5), InningsScore(0.96, 5, 0.5), RunLength(0)]
)
def test_mean_median_and_mode_stand_where_they_are(law):
    axes = draw_score(law)
    marks = [line for line in axes.lines if line.get_label()[0] != "_"]
    assert [line.get_xdata()[0] for line in marks] == list(law.fair_line)
    assert [line.get_label().split()[0] for line in marks] == ["mean", "median", "mode"]
    assert len({line.get_color() for line in marks}) == 3


def test_scores_are_drawn_with_their_probabilities():
    law = InningsScore(0.9, 3)
    axes = draw_score(law, 3)
    curve = axes.lines[0]
    assert curve.get_ydata().tolist() == law.probability(curve.get_xdata()).tolist()
    assert law.between(curve.get_xdata()[0], curve.get_xdata()[-1]) > 0.99
    assert axes.get_xlabel() == "balls made in 3 innings"


def test_what_was_asked_is_shaded_and_named():
    law = RunLength(0.96)
    asked = [("20 to 20", 20, 20), ("over 30", 31, None), ("far", 5000, None)]
    axes = draw_score(law, asked=asked)
    _, *shades = axes.collections
    assert [shade.get_label() for shade in shades] == [
        f"20 to 20 ({law.probability(20):.4f})",
        f"over 30 ({law.at_least(31):.4f})",
        "far (0.0000)",
    ]
    assert len({shade.get_hatch() for shade in shades}) == 3
    one, above, far = (shade.get_paths() for shade in shades)
    assert (one[0].get_extents().x0, one[0].get_extents().x1) == (19.5, 20.5)
    assert above[0].get_extents().x0 == 30.5
    assert not far


def test_no_line_where_no_spot_is_even():
    axes = draw_spot(StraightPool(9, 9, 0, 0.8))
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == ["9 against 9"]


@pytest.mark.parametrize(("p1", "p2"), [(0.9, 0.8), (0.8, 0.9)])
def test_the_curve_is_the_chance_by_the_points_of_the_weaker_player(p1, p2):
    match = StraightPool(100, 80, p1, p2, first=2)
    spot = even_spot(match)
    axes = draw_spot(match)
    curve, dot, *_, mark = axes.lines
    for n, win in zip(curve.get_xdata()[::30], curve.get_ydata()[::30], strict=True):
        needs = (int(n), 80) if spot.weaker == 1 else (100, int(n))
        assert win == straight_pool_odds(StraightPool(*needs, p1, p2, first=2)).p_win_1
    assert dot.get_xdata()[0] == (100 if spot.weaker == 1 else 80)
    assert dot.get_ydata()[0] == straight_pool_odds(match).p_win_1
    assert mark.get_xdata()[0] == spot.points
