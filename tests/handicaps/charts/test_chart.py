import time
from dataclasses import FrozenInstanceError
from fractions import Fraction
from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.handicaps import CHARTS, Chart, ChartRow, chart
from places import SHARED

SHEETS = SHARED / "data" / "charts"
SHORT = [(0, 9, 3, 3), (10, 19, 4, 3), (20, None, 4, 2)]


def even_win(m, n):
    """Return W(1/2; m, n)."""
    return Fraction(sum(comb(m + n - 1, k) for k in range(m, m + n)), 2 ** (m + n - 1))


@pytest.mark.parametrize(
    ("name", "difference", "race"),
    [
        ("npl_8", 0, (4, 4)),
        ("npl_8", 6, (4, 4)),
        ("npl_8", 7, (4, 3)),
        ("npl_8", 49, (6, 2)),
        ("npl_10", 5, (5, 5)),
        ("npl_10", 6, (5, 4)),
        ("npl_10", -6, (4, 5)),
        ("npl_12", 1000, (9, 2)),
        ("npl_20", 77, (16, 3)),
        ("npl_20", -101, (2, 18)),
        ("fargo_r6_hot", 27, (6, 6)),
        ("fargo_r6_hot", 170, (9, 3)),
    ],
)
def test_races_of_the_printed_charts(name, difference, race):
    assert chart(name).race(difference) == race


def test_one_point_too_much_on_chart_10_loses_as_the_text_says():
    assert round(float(even_win(*chart("npl_10").race(6))), 3) == 0.363
    assert round(float(even_win(*chart("npl_10").race(-6))), 3) == 0.637


@pytest.mark.parametrize("name", CHARTS)
def test_the_greater_the_difference_the_harder_the_race(name):
    wins = [even_win(*chart(name).race(difference)) for difference in range(-250, 251)]
    assert wins == sorted(wins, reverse=True)
    assert wins[250] == Fraction(1, 2)


@given(st.sampled_from(list(CHARTS)), st.integers(-10_000, 10_000))
def test_turning_the_players_round_turns_the_race_round(name, difference):
    assert chart(name).race(-difference) == chart(name).race(difference)[::-1]


@pytest.mark.parametrize("name", CHARTS)
def test_charts_are_those_of_the_sheets(name):
    if not SHEETS.is_dir():
        pytest.skip("the sheets lie beside some checkouts only")
    header, *lines = (SHEETS / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    assert header == "difference_from,difference_to,stronger_needs,weaker_needs"
    rows = [tuple(int(cell) if cell else None for cell in line.split(",")) for line in lines]
    assert chart(name).rows == tuple(rows)


def test_a_chart_is_a_frozen_value():
    short = Chart("short", SHORT)
    assert short == Chart("short", tuple(ChartRow(*row) for row in SHORT))
    assert hash(short) == hash(Chart("short", SHORT))
    with pytest.raises(FrozenInstanceError):
        short.name = "long"


def test_whole_numbers_of_any_type_are_taken():
    short = Chart("short", [(0, 9.0, 3, np.int64(3)), (10, None, 4, 3)])
    assert short.race(np.int64(12)) == (4, 3)
    assert short.race(12.0) == (4, 3)
    assert all(type(cell) is int for cell in short.rows[0])


@pytest.mark.parametrize("difference", [5.5, "7", None, float("nan"), float("inf"), [3]])
def test_no_whole_points_are_refused_with_the_remedy(difference):
    with pytest.raises(InputError, match="difference must"):
        chart("npl_8").race(difference)


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([], "rows must not be empty"),
        (3, "rows must"),
        (
            [(0, None, 3)],
            (
                r"rows must have four values each: difference_from, difference_to, stronger_needs, "
                r"weaker_needs; you gave \[\(0, None, 3\)\]"
            ),
        ),
        ([(1, None, 3, 3)], "row 1 must start at 0; it starts at 1"),
        ([(0, None, 4, 3)], "row 1 is a race 4:3"),
        ([(0, 9, 3, 3)], "the last row ends at 9"),
        ([(0, None, 3, 3), (10, None, 4, 3)], "row 1 is open-ended"),
        ([(0, 9, 3, 3), (11, None, 4, 3)], "row 2 starts at 11.* 10"),
        ([(0, 9, 3, 3), (9, None, 4, 3)], "row 2 starts at 9.* 10"),
        ([(0, 9, 3, 3), (10, 9, 4, 3), (10, None, 4, 2)], "difference_to in row 2 must"),
        ([(0, 9, 3, 3), (10, None, 3, 4)], "stronger_needs in row 2 must be 4 or more"),
        ([(0, None, 3, 0)], "weaker_needs in row 1 must be .* 1 or more"),
        (
            [(0, 9.5, 3, 3), (10, None, 4, 3)],
            r"difference_to in row 1 must be a whole number, 0 or more; you gave 9\.5",
        ),
        (
            [("0", None, 3, 3)],
            "difference_from in row 1 must be a whole number, 0 or more; you gave '0'",
        ),
    ],
)
def test_rows_that_make_no_chart_are_refused(rows, message):
    with pytest.raises(InputError, match=message):
        Chart("mine", rows)


@pytest.mark.parametrize("name", ["npl_9", "", None, ["npl_8"], "../fair"])
def test_an_unknown_chart_lists_the_known(name):
    with pytest.raises(InputError, match="fargo_r6_hot, npl_8, npl_10"):
        chart(name)


@pytest.mark.parametrize("name", CHARTS)
def test_many_races_at_once_are_those_one_by_one(name):
    differences = np.arange(-250, 251).reshape(3, 167)
    m, n = chart(name).races(differences)
    assert m.shape == n.shape == (3, 167)
    assert list(zip(m.ravel().tolist(), n.ravel().tolist(), strict=True)) == [
        chart(name).race(difference) for difference in range(-250, 251)
    ]


def test_a_million_lookups_take_no_time():
    differences = np.random.default_rng(1).integers(-200, 201, size=1_000_000)
    before = time.perf_counter()
    m, n = chart("npl_20").races(differences)
    assert time.perf_counter() - before < 1.0
    assert (m[differences > 2] > n[differences > 2]).all()


@pytest.mark.parametrize("differences", [7, 7.0, np.int8(7), [7], np.array([7], dtype=np.uint8)])
def test_whole_differences_of_any_type_and_shape(differences):
    m, n = chart("npl_8").races(differences)
    assert m.shape == n.shape == np.shape(differences)
    assert (m == 4).all()
    assert (n == 3).all()


def test_the_greatest_differences_that_numpy_holds():
    ends = np.array([np.iinfo(np.int64).min, np.iinfo(np.int64).max])
    m, n = chart("npl_8").races(ends)
    assert (m.tolist(), n.tolist()) == ([2, 6], [6, 2])
    assert [a.tolist() for a in chart("npl_8").races([])] == [[], []]


@pytest.mark.parametrize(
    "differences", [[0, 5.5], [np.nan], [np.inf], 5.5, "7", ["7"], None, [[1], [1, 2]]]
)
def test_no_whole_points_in_an_array_are_refused_with_the_remedy(differences):
    with pytest.raises(InputError, match=r"differences must be whole points"):
        chart("npl_8").races(differences)
