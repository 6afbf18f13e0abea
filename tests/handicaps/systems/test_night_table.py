"""A night's results beside the list of ratings."""

import numpy as np

from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.night_table import night_table
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster

CLUB = Roster(["Cy", "Ann", "Bo"], [71, 92, np.nan])
NIGHT = Results.from_names(
    ["Ann", "Cy", "Ann", "Ann"],
    ["Cy", "Zed", "Bo", "Cy"],
    [6, 5, 5, 0],
    [2, 3, 3, 0],
    race_a=[0, 5, 0, 0],
    race_b=[0, 5, 0, 0],
)


def test_players_are_found_on_the_list():
    table = night_table(CLUB, NIGHT, None)
    assert table.a.tolist() == [1, 0, 1, 1]
    assert table.b.tolist() == [0, -1, 2, 0]
    assert table.rated.tolist() == [True, False, False, True]


def test_the_chart_fills_races_that_are_not_stated():
    table = night_table(CLUB, NIGHT, chart("npl_10"))
    assert table.results.race_a.tolist() == [6, 5, 0, 6]
    assert table.from_chart.tolist() == [True, False, True, True]
    assert (table.chart_a[1], table.chart_b[1]) == (0, 0)  # Zed has no rating


def test_who_won_and_what_counts():
    table = night_table(CLUB, NIGHT, chart("npl_10"))
    assert table.winner.tolist() == [1, 1, 0, 0]
    assert table.counted.tolist() == [True, True, True, False]
