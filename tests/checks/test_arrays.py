"""Arrays that pass the checks, as what they pass, and arrays that do not."""

import datetime as dt
import subprocess
import sys
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from evenbreak.checks import column, floats, plain, probability, together, whole_numbers
from evenbreak.errors import InputError
from rows import each_of


@pytest.mark.parametrize("value", [0, 1, 0.25, Fraction(1, 3), np.float32(0.5), np.array(0.5)])
def test_one_probability_comes_back_as_a_float(value: object) -> None:
    checked = probability(value, "p")
    assert type(checked) is float
    assert checked == value or value == Fraction(1, 3)


def test_several_probabilities_come_back_as_an_array() -> None:
    assert probability([0, Fraction(1, 2), 1], "p").tolist() == [0.0, 0.5, 1.0]
    assert probability(np.empty((0, 3)), "p").shape == (0, 3)


@pytest.mark.parametrize("value", ["0.5", b"1", ["0.5"], [0.5, "a"], 0.5j, [0.5j], None, [None]])
def test_what_is_not_a_number_is_not_a_probability(value: object) -> None:
    with pytest.raises(InputError, match=r"^p must be .*numbers? from 0 to 1"):
        probability(value, "p")


def test_the_first_wrong_value_is_named() -> None:
    with pytest.raises(InputError, match="p must be numbers from 0 to 1; it holds nan"):
        probability([0.5, float("nan")], "p")
    with pytest.raises(
        InputError, match=r"speed must be finite numbers, 0 or more; it holds -2\.0"
    ):
        floats([[1.0, -2.0], [-3.0, 0.0]], "speed", low=0.0)


@pytest.mark.parametrize(
    ("values", "shape"), [(3, ()), ([1, 2], (2,)), (np.ones((2, 3)), (2, 3)), ([], (0,))]
)
def test_floats_keep_their_shape(values: Any, shape: tuple[int, ...]) -> None:
    array = floats(values, "x", low=0.0)
    assert array.dtype == float
    assert array.shape == shape


@each_of(
    "values", ["1", ["1"], None, [None], 1j, [[1, 2], [3]], np.inf, [1, np.nan], 10**400, [{}]]
)
def test_what_is_not_finite_or_not_a_number_is_refused(values: object) -> None:
    with pytest.raises(InputError, match=r"^x must be (a )?finite number"):
        floats(values, "x")


def test_a_limit_may_be_excluded() -> None:
    assert floats([1e-300], "x", above=0.0).tolist() == [1e-300]
    with pytest.raises(InputError, match=r"x must be finite numbers above 0; it holds 0\.0"):
        floats([1.0, 0.0], "x", above=0.0)


def test_the_caller_may_say_what_is_wanted() -> None:
    with pytest.raises(InputError, match=r"ratings must be points; it holds nan$"):
        floats([np.nan], "ratings", wanted="points")


def test_whole_numbers() -> None:
    assert whole_numbers([1, 2.0, Fraction(3)], "n").tolist() == [1.0, 2.0, 3.0]
    assert whole_numbers(-4, "n") == -4.0
    for values, at_least in ((2.5, None), ([1, 2.5], None), ([3, -1], 0), (np.inf, None)):
        with pytest.raises(InputError, match=r"n must be whole numbers"):
            whole_numbers(values, "n", at_least=at_least)


def test_a_column_is_a_copy_that_cannot_be_written() -> None:
    mine = np.array([1, 2])
    games = column(mine, "games", 2, "players", np.int64)
    mine[0] = 9
    assert games.tolist() == [1, 2]
    with pytest.raises(ValueError, match="read-only"):
        games[0] = 9


@each_of(
    "values, dtype, problem",
    [
        ([1, 2, 3], float, r"must have one value for each of 2 players; its shape is \(3,\)"),
        (5, float, r"must have one value for each of 2 players; its shape is \(\)"),
        ([1, 2.5], np.int64, "must be whole numbers"),
        ([1, np.nan], np.int64, "must be whole numbers"),
        (["a", "b"], float, "must be numbers"),
        (["80", "90"], float, "must be numbers"),
        ([80, "90"], float, "must be numbers"),
        ([80, 90 + 1j], float, "must be numbers"),
        ([257, 1], np.int8, "must be whole numbers"),
        (["7", "5"], np.int64, "must be whole numbers"),
        (["no", "yes"], bool, "must be True or False"),
        ([True, np.nan], bool, "must be True or False"),
        ([True, None], bool, "must be True or False"),
        ([0, 2], bool, "must be True or False"),
        (["a", "b"], "datetime64[D]", "must be days"),
        ([20260131, 20260201], "datetime64[D]", "must be days"),
        (["20260131", "2026-02-01"], "datetime64[D]", "must be days"),
        (["aba", np.nan], object, "must be text"),
        (["aba", None], object, "must be text"),
    ],
)
def test_other_columns_are_refused(values: Any, dtype: Any, problem: str) -> None:
    with pytest.raises(InputError, match=f"^x .*{problem}"):
        column(values, "x", 2, "players", dtype)


def test_zeros_and_ones_are_a_column_of_bools() -> None:
    for values in ([0, 1], [0.0, 1.0], [False, True], np.array([False, True], dtype=object)):
        assert column(values, "x", 2, "rows", bool).tolist() == [False, True]


def test_a_column_of_days_and_one_with_gaps() -> None:
    days = column(["2026-01-31"], "date", 1, "rows", "datetime64[D]")
    assert days.dtype == np.dtype("datetime64[D]")
    given = ["2026-01-31", dt.date(2026, 2, 1), np.datetime64("2026-02-02T20:15"), None]
    days = column(np.array(given, dtype=object), "date", 4, "rows", "datetime64[D]")
    assert [str(day) for day in days] == ["2026-01-31", "2026-02-01", "2026-02-02", "NaT"]
    assert np.isnan(column([np.nan, 80], "rating", 2, "players")).tolist() == [True, False]


def test_shapes_together() -> None:
    assert together() == together(p=0.5, m=3) == together(p=np.array(1.0), m=None) == ()
    assert together(p=0.5, m=[1, 2]) == (2,)
    assert together(p=np.zeros((3, 1)), m=np.zeros(2)) == (3, 2)
    with pytest.raises(InputError, match=r"m has shape \(2,\), n has shape \(3,\)"):
        together(p=0.5, m=[1, 2], n=np.zeros(3))


def test_plain() -> None:
    assert type(plain(np.array(2.5))) is float
    assert plain(np.array([2.5])).tolist() == [2.5]


def test_numbers_are_checked_without_numpy() -> None:
    program = (
        "import sys; from evenbreak.checks import probability, together, whole; "
        "probability(0.5, 'p'), together(p1=0.5, p2=None), whole(3, 'm'); "
        "sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_what_is_masked_is_missing() -> None:
    masked = np.ma.masked_array([0.5, 0.25], mask=[False, True])
    with pytest.raises(InputError, match="holds nan"):
        probability(masked, "p")
    assert np.isnan(column(masked, "rating", 2, "players")).tolist() == [False, True]
    assert floats(np.ma.masked_array([1, 2]), "p").tolist() == [1.0, 2.0]
