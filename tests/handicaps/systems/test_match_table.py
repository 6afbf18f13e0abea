import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart, chart
from evenbreak.handicaps.systems.catalog import SYSTEMS, system_of
from evenbreak.handicaps.systems.match_table import match_table

NPL = system_of("npl")
SHORT = Chart("short", [(0, 1, 2, 2), (2, None, 2, 1)])


def test_the_table_lists_the_scores_of_each_race():
    table = match_table(NPL, SHORT, widest=2)
    assert table.needs.tolist() == [[1, 2], [2, 2], [2, 2], [2, 2], [2, 1]]
    assert table.games[2].tolist() == [[2, 0], [2, 1], [0, 2], [1, 2]]
    assert table.games[0].tolist() == [[1, 0], [1, 1], [0, 2], [-1, -1]]
    assert table.won[0, :3].tolist() == [True, True, False]
    assert table.moves[0].tolist() == [[1, -1], [1, -1], [-1, 1], [0, 0]]


def test_shapes_follow_the_shape_of_p():
    table = match_table(NPL, SHORT, widest=2)
    assert table.wins(0.5).shape == (5,)
    assert table.chances(0.5).shape == (5, 4)
    assert table.wins(np.full((3, 2), 0.5)).shape == (5, 3, 2)
    assert table.chances(np.full((3, 2), 0.5)).shape == (5, 4, 3, 2)
    many = table.chances([[0.1, 0.9]])
    np.testing.assert_array_equal(many[:, :, 0, 1], table.chances(0.9))


def test_the_odds_of_the_text():
    table = match_table(NPL, chart("npl_10"))
    assert table.widest == 60
    assert table.wins(0.5)[[54, 60, 66]].round(3).tolist() == [0.637, 0.5, 0.363]


def test_long_races_keep_their_digits():
    table = match_table(NPL, Chart("long", [(0, None, 500, 500)]), widest=1)
    chances = table.chances([0.5, 0.9])
    np.testing.assert_allclose(chances.sum(axis=1), 1.0, rtol=1e-11)


def test_without_a_chart_it_is_the_systems_own():
    assert match_table(NPL).chart.name == "npl_10"
    assert match_table(system_of("elo")).widest == 241


def test_nobody_writes_into_a_table():
    table = match_table(NPL, SHORT, widest=2)
    for array in (table.needs, table.games, table.moves, table.won):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (("npl",), r"system must be a StepSystem, such as system_of\('npl'\); you gave 'npl'"),
        (
            (NPL, "nobody"),
            (
                "chart must be a chart by rating difference: fargo_r6_hot, npl_8, npl_10, "
                "npl_12, npl_20, or a Chart of your own; you gave 'nobody'"
            ),
        ),
    ],
)
def test_what_is_no_system_or_chart_is_refused(given, message):
    with pytest.raises(InputError, match=message):
        match_table(*given)


def test_the_widest_difference_is_a_whole_number():
    with pytest.raises(InputError, match="widest must"):
        match_table(NPL, widest=0)


@pytest.mark.parametrize("points", [(0.5, -0.5), (1, -1, 0), (1,), 1, None, "ab"])
def test_a_rule_that_does_not_return_two_whole_points_is_refused(points):
    from dataclasses import replace

    with pytest.raises(InputError, match="the rule of the system npl"):
        match_table(replace(NPL, rule=lambda _: points), SHORT, widest=2)


@pytest.mark.parametrize("p", [-0.1, 1.1, "a", [0.5, 2.0]])
def test_what_is_no_chance_is_refused(p):
    table = match_table(NPL, SHORT, widest=2)
    for ask in (table.wins, table.chances):
        with pytest.raises(InputError, match="p "):
            ask(p)


def test_a_system_without_charts_asks_for_one():
    from dataclasses import replace

    bare = replace(SYSTEMS["npl"], charts=(), own_chart=None)
    with pytest.raises(InputError, match="the system npl has no chart"):
        match_table(bare)
    assert match_table(replace(bare, charts=("npl_8",))).chart.name == "npl_8"
