import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import RaceLimits, design, measure_chart
from evenbreak.handicaps.charts.candidates import SimilarLengths, similar_limits
from evenbreak.ratings import SCALES

WIDE = RaceLimits((5, 13), weaker_least=2)


def longest(chart):
    return [row.stronger_needs + row.weaker_needs - 1 for row in chart.rows]


@pytest.mark.slow_after(5)
@pytest.mark.parametrize("spread", [0, 1, 2, 4])
def test_the_fairest_chart_is_the_fairest_of_the_groups(spread):
    made = design("npl", WIDE, spread=spread, up_to=60)
    assert max(longest(made)) - min(longest(made)) <= spread
    of_groups = [design("npl", limits, up_to=60) for limits in similar_limits(WIDE, spread)]
    least = min(measure_chart(group, "npl", up_to=60).mean_unfairness for group in of_groups)
    ours = measure_chart(made, "npl", up_to=60).mean_unfairness
    assert ours == pytest.approx(least, rel=1e-9)


def test_a_spread_that_allows_all_lengths_changes_nothing():
    assert design("npl", WIDE, spread=8) == design("npl", WIDE)


def test_lengths_without_an_even_race_are_left_out():
    assert [one.games for one in similar_limits(RaceLimits((4, 7)), 0)] == [(5, 5), (7, 7)]


def test_groups_too_long_for_a_limit_are_left_out():
    short, shorter = (
        SimilarLengths(SCALES["npl"], RaceLimits((5, 13), weaker_least=2, games_p90=most), 2, 40)
        for most in (6, 2)
    )
    assert max(longest(short.fairest())) <= 7
    with pytest.raises(InputError, match="games_p90 is 2"):
        shorter.fairest()
