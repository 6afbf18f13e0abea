"""A night's results beside the list of ratings."""

import numpy as np
import pytest

from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.catalog import system_of
from evenbreak.handicaps.systems.history import Entries
from evenbreak.handicaps.systems.night_table import SeasonSoFar, listed, night_table
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


@pytest.mark.parametrize("name", ["level-steps 1", "napa-like"])
def test_a_stated_winner_without_a_score_has_won(name):
    system, numbers = system_of(name), np.array([4.0, 4.0])
    roster = Roster(["Ann", "Bo"], numbers, level=numbers, matches=[90, 90])
    pair = ["Ann", "Bo"], ["Bo", "Ann"]
    stated = Results.from_names(
        *pair, [0, 0], [0, 0], race_a=[3, 3], race_b=[3, 3], winner=[1, 2], unscored=[True, True]
    )
    scored = Results.from_names(*pair, [3, 1], [1, 3], race_a=[3, 3], race_b=[3, 3])
    of_both = [
        SeasonSoFar(system, roster).after(night_table(roster, night, system)).tolist()
        for night in (stated, scored)
    ]
    assert of_both[0] == of_both[1] != numbers.tolist()
    assert of_both[0][0] > of_both[0][1]


@pytest.mark.parametrize("name", ["fargo-like", "napa-like", "averages", "level-review"])
def test_a_player_without_a_number_on_the_list_moves_as_a_newcomer(name):
    system = system_of(name)
    usual = float(system.initial(Entries.of([np.nan]))[0])
    new, known = (
        Roster(["Ann", "Bo"], column, level=column if system.publishes == "levels" else None)
        for column in ([np.nan, usual], [usual, usual])
    )
    night = Results.from_names(["Ann"], ["Bo"], [5], [0], race_a=[5], race_b=[5])
    after = []
    for roster in (listed(system, new), listed(system, known)):
        season = SeasonSoFar(system, roster)
        after.append(season.after(night_table(roster, night, system))[0] - usual)
    assert after[0] > after[1] >= 0.0
