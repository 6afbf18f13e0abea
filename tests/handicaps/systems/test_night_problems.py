"""What keeps a night from changing ratings, and which chart its scores fit."""

import numpy as np
import pytest

from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.catalog import system_of
from evenbreak.handicaps.systems.rating_changes import chart_of_night, night_problems
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import NOT_STATED, Roster

NPL = system_of("npl")
CLUB = Roster(["Cy", "Ann", "Bo"], [71, 92, 80], [9.0, 4.0, np.nan], [10, 200, NOT_STATED])


def night(*rows, **columns):
    a, b, score_a, score_b = zip(*rows, strict=True)
    return Results.from_names(a, b, score_a, score_b, **columns)


def problems(results, **options):
    return [(p.row, p.message) for p in night_problems(NPL, CLUB, results, **options)]


def test_without_race_winner_or_chart_no_winner_is_guessed():
    found = problems(night(("Ann", "Bo", 5, 3), ("Bo", "Cy", 5, 4), winner=[0, 1]))
    ((row, message),) = found
    assert row == 0
    assert "'Ann' - 'Bo', 5-3" in message
    assert "npl_8, npl_10, npl_12 or npl_20" in message


def test_a_score_that_the_charts_race_cannot_have():
    found = problems(night(("Ann", "Cy", 5, 3), ("Cy", "Ann", 4, 6)), chart=chart("npl_10"))
    assert [row for row, _ in found] == [0, 1]
    for (_, message), parts in zip(
        found,
        (("5-3", "6:4", "'Ann' (92)", "'Cy' (71)"), ("4-6", "4:6", "'Cy' (71)", "'Ann' (92)")),
        strict=True,
    ):
        assert all(part in message for part in (*parts, "npl_10"))


@pytest.mark.parametrize("name", NPL.charts)
def test_scores_show_the_chart_that_was_used(name):
    played = chart(name)
    ahead, behind = played.race(12), played.race(21)
    scores = night(("Ann", "Bo", ahead[0], 0), ("Cy", "Ann", behind[1], behind[0] - 1))
    assert chart_of_night(NPL, CLUB, scores).name == name


@pytest.mark.parametrize(
    ("results", "why"),
    [
        (night(("Ann", "Bo", 5, 3), winner=[1]), "the winner is given"),
        (night(("Ann", "Bo", 5, 3), race_a=[5], race_b=[4]), "the race is stated"),
        (night(("Ann", "Bo", 5, 3), ("Bo", "Ann", 3, 4)), "5-3 ends npl_10's, 3-4 npl_8's"),
        (night(("Ann", "Cy", 6, 2)), "npl_10 and npl_12 both have the race 6:4"),
        (night(("Ann", "Boo", 5, 3)), "Boo is not on the list"),
    ],
)
def test_no_chart_is_taken_where_none_is_needed_or_several_fit(results, why):
    assert chart_of_night(NPL, CLUB, results) is None, why


def test_each_player_without_a_rating_is_a_problem_once():
    club = Roster(["Ann", "New"], [92, np.nan])
    results = night(
        ("Zed", "Ann", 5, 3), ("Ann", "Zed", 5, 3), ("New", "Ann", 5, 3), winner=[1, 1, 1]
    )
    told = night_problems(NPL, club, results)
    assert [(p.row, p.column) for p in told] == [(0, "player_a"), (2, "player_a")]
    assert "'Zed' isn't on the list" in told[0].message
    assert "'New' has no rating on the list" in told[1].message


@pytest.mark.parametrize("options", [{}, {"chart": chart("npl_10")}], ids=["bare", "chart"])
@pytest.mark.parametrize("club", [Roster([], []), Roster(["Ann"], [np.nan])], ids=["none", "new"])
def test_a_list_without_the_players(club, options):
    told = night_problems(NPL, club, night(("Ann", "Bo", 5, 3), ("Bo", "Ann", 5, 4)), **options)
    assert [(p.row, p.column) for p in told] == [(0, "player_a"), (0, "player_b")]


def test_a_rule_that_needs_score_or_race_is_refused_without():
    unscored = night(("Ann", "Bo", 0, 0), race_a=[5], race_b=[4], winner=[1], unscored=[True])
    (problem,) = night_problems(system_of("elo"), CLUB, unscored)
    assert (problem.row, problem.column) == (0, "score_a")
    open_race = night(("Ann", "Bo", 9, 2), winner=[1])
    (problem,) = night_problems(system_of("margin"), CLUB, open_race)
    assert (problem.row, problem.column) == (0, "race_a")
    assert not night_problems(NPL, CLUB, open_race)
