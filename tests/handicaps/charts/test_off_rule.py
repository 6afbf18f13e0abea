"""Where the printed charts break their own rule, against a direct count of wins."""

from fractions import Fraction
from math import comb

import pytest

from evenbreak.handicaps import Chart, chart
from evenbreak.handicaps.charts.off_rule import nearest_rows, off_rule

CHARTS = ("npl_8", "npl_10", "npl_12", "npl_20")


def win(difference: int, m: int, n: int) -> float:
    p = 1 / (1 + 2 ** (-difference / 30))
    return sum(comb(m - 1 + k, k) * p**m * (1 - p) ** k for k in range(n))


@pytest.mark.parametrize(
    ("name", "differences"),
    [("npl_8", [19, 29]), ("npl_10", [46]), ("npl_12", [58]), ("npl_20", [45, 68, 98])],
)
def test_the_seven_places(name: str, differences: list[int]) -> None:
    printed = chart(name)
    found = off_rule(printed, "npl")
    assert [place.difference for place in found] == differences
    for place in found:
        assert place.race == printed.race(place.difference)
        assert place.win == pytest.approx(win(place.difference, *place.race), rel=1e-12)
        assert place.nearest_win == pytest.approx(win(place.difference, *place.nearest), rel=1e-12)
        assert abs(place.nearest_win - 0.5) < abs(place.win - 0.5)


@pytest.mark.parametrize("name", CHARTS)
def test_by_the_rule_no_place_is_left(name: str) -> None:
    by_rule = Chart(name, nearest_rows(chart(name), "npl"))
    assert off_rule(by_rule, "npl") == ()
    assert [row[2:] for row in by_rule.rows] == [row[2:] for row in chart(name).rows]


def test_far_beyond_the_chart_the_last_race_is_the_nearest() -> None:
    for name in CHARTS:
        rows = chart(name).rows
        for difference in range(rows[-1].difference_from, 400):
            misses = [abs(win(difference, *row[2:]) - 0.5) for row in rows]
            assert misses[-1] == min(misses)


def test_an_exact_case() -> None:
    # At 30 points p = 2/3: 2:1 has 4/9 and 2:2 has 20/27, so 2:1 is nearer to 1/2.
    assert Fraction(1, 2) - Fraction(4, 9) < Fraction(20, 27) - Fraction(1, 2)
    late = Chart("late", [(0, 30, 2, 2), (31, None, 2, 1)])
    assert 30 in [place.difference for place in off_rule(late, "npl")]
