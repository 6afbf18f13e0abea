"""The curves pass through the exact values, and show what the text says of its figures."""

from fractions import Fraction
from math import comb
from typing import Any

import numpy as np
import pytest

from drawings import at, contours, curves, figure, line_at, marked


def race(p: Fraction, m: int, n: int) -> Fraction:
    """Return W(p; m, n), the loser's score summed out."""
    return sum((comb(m - 1 + k, k) * p**m * (1 - p) ** k for k in range(n)), start=Fraction(0))


# Fig. 5.1


def test_races_are_ten_even_and_ten_with_twice_the_games_for_player_1() -> None:
    drawn = curves(figure("figure_5_1").axes[0])
    assert len(drawn) == 20
    for n, (even, uneven) in enumerate(zip(drawn[0::2], drawn[1::2], strict=True), start=1):
        for p in (Fraction(1, 4), Fraction(1, 2), Fraction(7, 10)):
            assert at(even, float(p)) == pytest.approx(float(race(p, n, n)), abs=1e-12)
            assert at(uneven, float(p)) == pytest.approx(float(race(p, 2 * n, n)), abs=1e-12)
        assert at(even, 0.5) == pytest.approx(0.5, abs=1e-12)


def test_the_two_families_of_races_differ_without_colour() -> None:
    lines = figure("figure_5_1").axes[0].lines[:20]
    styles = (
        {line.get_linestyle() for line in lines[0::2]},
        {line.get_linestyle() for line in lines[1::2]},
    )
    assert styles == ({"-"}, {"--"})


def test_the_inset_marks_where_2_to_1_and_4_to_2_cross() -> None:
    (inset,) = figure("figure_5_1").axes[0].child_axes
    dot = next(line for line in inset.lines if line.get_marker() == "o")
    ((p, chance),) = dot.get_xydata()
    assert p == pytest.approx(0.640388, abs=1e-6)
    assert chance == pytest.approx(0.410097, abs=1e-6)
    assert inset.get_xlim()[0] < p < inset.get_xlim()[1]
    assert "$p$ = 0.640" in [text.get_text() for text in inset.texts]
    assert marked(figure("figure_5_1").axes[0], p, chance)


# Fig. 5.3


def test_the_even_chance_is_the_same_line_for_both_look_aheads() -> None:
    for axes in figure("figure_5_3").axes:
        p1, p2 = line_at(axes, 0.5).T
        inner = p1 > 0.02
        assert p2[inner] == pytest.approx((p1 / (1 - p1))[inner], abs=0.006)
        assert p1.max() == pytest.approx(0.5, abs=1e-4)


def test_look_aheads_differ_elsewhere() -> None:
    infinite, two = figure("figure_5_3").axes
    line = line_at(infinite, 0.9)
    p1, p2 = line[line[:, 0] > 0.1].T  # all lines meet at the origin
    assert p1 / (p1 + p2 - p1 * p2) == pytest.approx(0.9, abs=1e-3)
    p1, p2 = line_at(two, 0.9).T
    assert p1 + (1 - p1) * (1 - p2) / 2 == pytest.approx(0.9, abs=1e-3)
    assert "Infinite" in infinite.get_title()
    assert "Two-shot" in two.get_title()


# Fig. 5.6


def test_every_break_format_is_even_for_equal_players() -> None:
    for axes in figure("figure_5_6").axes[:3]:
        p1, p2 = line_at(axes, 0.5).T
        assert p1 == pytest.approx(p2, abs=1e-9)


def test_lines_cluster_where_the_winner_breaks_and_both_are_strong() -> None:
    def near(axes: Any, corner: float) -> int:
        """Return how many lines pass by a corner."""
        return sum(
            bool((np.hypot(*(line_at(axes, level) - corner).T) < 0.1).any())
            for level in contours(axes).levels
        )

    winner, loser, alternate, _ = figure("figure_5_6").axes
    assert [near(axes, 1.0) for axes in (winner, loser, alternate)] == [9, 1, 1]
    assert [near(axes, 0.0) for axes in (winner, loser, alternate)] == [1, 9, 1]


def test_the_difference_is_dashed_where_the_loser_should_break() -> None:
    axes = figure("figure_5_6").axes[3]
    lines = contours(axes)
    for level, (_, dashes) in zip(lines.levels, lines.get_linestyles(), strict=True):
        assert (dashes is not None) == (level < 0)
        p1, p2 = line_at(axes, level).T
        difference = (1 - p2) / (2 - p1 - p2) - p1 / (p1 + p2)
        inner = (np.minimum(p1, p2) > 0.05) & (np.maximum(p1, p2) < 0.95)
        assert difference[inner] == pytest.approx(level, abs=2e-3)
    p1, p2 = line_at(axes, 0.0).T
    assert np.minimum(abs(p1 - p2), abs(p1 + p2 - 1)) == pytest.approx(0, abs=1e-9)


# Fig. 5.8


def test_the_drill_has_nine_shares_that_make_up_the_whole() -> None:
    drawn = curves(figure("figure_5_8").axes[0])
    assert len(drawn) == 9
    assert sum(curve[:, 1] for curve in drawn) == pytest.approx(1.0)
    # Table 5.5, p = .8; at p = 1 nothing fails and the last level repeats.
    table = [0.018, 0.088, 0.195, 0.256, 0.222, 0.135, 0.060, 0.020, 0.005]
    assert [at(curve, 0.8) for curve in drawn] == pytest.approx(table, abs=6e-4)
    assert [at(curve, 1.0) for curve in drawn] == [0] * 8 + [1]
    assert [at(curve, 0.0) for curve in drawn] == [0.5, 0.5] + [0] * 7


def test_no_two_levels_share_a_line() -> None:
    lines = figure("figure_5_8").axes[0].lines
    assert len({line.get_color() for line in lines}) == 9
    legend = figure("figure_5_8").axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == [f"$v_{n}$" for n in range(1, 10)]
    dashes = {line._unscaled_dash_pattern for line in lines}
    assert len({str(pattern) for pattern in dashes}) == 9


def test_the_level_most_visited_goes_up_with_skill() -> None:
    drawn = curves(figure("figure_5_8").axes[0])
    peaks = [curve[np.argmax(curve[:, 1]), 0] for curve in drawn]
    assert peaks == sorted(peaks)


# Fig. 5.9


def test_ladders_are_flat_on_top_and_sharper_for_longer_matches() -> None:
    axes = figure("figure_5_9").axes[0]
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    assert names == ["Chart-8", "Chart-10", "Chart-12", "Chart-20"]
    laws = curves(axes)
    spreads, flats, peaks = [], [], []
    for law in laws:
        errors, chances = law.T
        assert chances.sum() == pytest.approx(1.0)
        assert chances == pytest.approx(chances[::-1])
        spreads.append(np.sqrt(chances @ errors**2))
        flats.append(int((chances > chances.max() * (1 - 1e-9)).sum()))
        peaks.append(chances.max())
    assert spreads == pytest.approx([4.963, 4.634, 4.269, 3.668], abs=6e-4)
    assert flats == [13, 11, 9, 5]
    assert peaks == sorted(peaks)
    assert len({line.get_marker() for line in axes.lines}) == 4


# Fig. 5.11


def test_ahead_matches_are_the_gamblers_ruin() -> None:
    drawn = curves(figure("figure_5_11").axes[0])
    assert len(drawn) == 5
    p = Fraction(3, 5)
    odds = (1 - p) / p
    for m, curve in enumerate(drawn, start=1):
        exact = (1 - odds ** (6 - m)) / (1 - odds**6)
        assert at(curve, 0.6) == pytest.approx(float(exact), abs=1e-12)
        assert at(curve, 0.5) == pytest.approx((6 - m) / 6)
    texts = [text.get_text() for text in figure("figure_5_11").axes[0].texts]
    assert texts == ["1:5", "2:4", "3:3", "4:2", "5:1"]
