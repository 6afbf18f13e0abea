import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import MatchRules, RaceLimits, design, measure_chart, pareto
from evenbreak.handicaps.charts.similar_lengths import SimilarLengths, similar_limits

WIDE = RaceLimits((5, 13), weaker_least=2)


def longest(chart):
    return [row.stronger_needs + row.weaker_needs - 1 for row in chart.rows]


@pytest.mark.parametrize("spread", [0, 1, 2, 4])
@pytest.mark.parametrize("criterion", ["mean", "worst"])
def test_the_fairest_chart_is_the_fairest_of_the_groups(spread, criterion):
    made = design("npl", WIDE, spread=spread, criterion=criterion, up_to=60)
    assert max(longest(made)) - min(longest(made)) <= spread
    of_groups = [
        design("npl", limits, criterion=criterion, up_to=60)
        for limits in similar_limits(WIDE, spread)
    ]
    unfair = f"{criterion}_unfairness"
    least = min(getattr(measure_chart(one, "npl", up_to=60), unfair) for one in of_groups)
    assert getattr(measure_chart(made, "npl", up_to=60), unfair) == pytest.approx(least, rel=1e-9)


def test_a_spread_that_allows_all_lengths_changes_nothing():
    assert design("npl", WIDE, spread=8) == design("npl", WIDE)


def test_lengths_without_an_even_race_are_left_out():
    assert [one.games for one in similar_limits(RaceLimits((4, 7)), 0)] == [(5, 5), (7, 7)]


def test_groups_too_long_for_a_limit_are_left_out():
    groups = SimilarLengths(MatchRules("npl"), WIDE, 2, 40)
    assert max(longest(groups.fairest(mean_games=4.6))) <= 7
    with pytest.raises(InputError, match="mean_games is 2"):
        groups.fairest(mean_games=2.0)


def test_a_front_of_charts_with_similar_lengths():
    for one in pareto("npl", WIDE, spread=2, up_to=40):
        assert max(longest(one.chart)) - min(longest(one.chart)) <= 2
