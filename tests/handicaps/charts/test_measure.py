import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import Chart, chart, last_difference, measure_chart
from evenbreak.handicaps.charts.race_grid import mean_games_grid, win_grid
from evenbreak.ratings import SCALES

NPL = SCALES["npl"]


def test_measures_are_means_over_all_differences():
    short = Chart("short", [(0, 1, 2, 2), (2, None, 3, 2)])
    races = [(2, 2), (2, 2), (3, 2), (3, 2)]
    wins = [abs(win_grid(NPL, [m], [n], [d])[0, 0] - 0.5) for d, (m, n) in enumerate(races)]
    measured = measure_chart(short, "npl", up_to=3)
    assert measured.mean_unfairness == pytest.approx(np.mean(wins))
    assert measured.worst_unfairness == pytest.approx(max(wins))
    assert measured.worst_difference == int(np.argmax(wins))
    assert measured.mean_games == pytest.approx(
        np.mean([mean_games_grid(NPL, [m], [n], [d])[0, 0] for d, (m, n) in enumerate(races)])
    )
    assert measured.games_p90 == 4


def test_the_last_difference_is_where_the_last_race_is_even():
    for number in (8, 10, 12, 20):
        printed = chart(f"npl_{number}")
        last, row = last_difference(printed, NPL), printed.rows[-1]
        wins = win_grid(NPL, [row.stronger_needs], [row.weaker_needs], [last, last + 1])[0]
        assert wins[0] <= 0.5 < wins[1]


def test_with_a_target_equal_players_count_as_no_unfairness():
    even = Chart("even", [(0, None, 5, 5)])
    measured = measure_chart(even, "npl", up_to=1, target=0.9)
    assert measured.worst_difference == 1
    assert measured.mean_unfairness == pytest.approx(measured.worst_unfairness / 2)


def test_wrong_wishes_are_refused():
    with pytest.raises(InputError, match="up_to must"):
        measure_chart(chart("npl_8"), "npl", up_to=0)
    with pytest.raises(InputError, match="target must"):
        measure_chart(chart("npl_8"), "npl", target=2)
