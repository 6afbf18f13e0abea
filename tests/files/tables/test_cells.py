import dataclasses
import math

import numpy as np
import pytest

from evenbreak.errors import DataError
from evenbreak.files.tables.problems import Problems
from evenbreak.files.tables.schema import Number, Whole
from evenbreak.files.tables.table import Texts, TextTable
from rows import each_of

NUMBER = Number(least=-9, most=9, filled=True, write="0.5")


def table_of(*cells):
    distinct = list(dict.fromkeys(cells))
    codes = np.array([distinct.index(cell) for cell in cells], dtype=np.int64)
    lines = np.arange(2, len(cells) + 2)
    columns = {"x": Texts(distinct, codes)}
    return TextTable("t.csv", lines, columns, frozenset(columns), Problems("t.csv"), (), "")


def told(table):
    try:
        table.problems.raise_any()
    except DataError as error:
        return list(error.problems)
    return []


@pytest.mark.parametrize(
    ("text", "value"),
    [("7", 7), ("+7", 7), ("007", 7), ("7.0", 7), ("7.", 7), ("7,0", 7), ("1000000", 10**6)],
)
def test_whole_numbers(text, value):
    table = table_of(text)
    assert Whole(filled=True).read(table, "x").values.tolist() == [value]
    assert told(table) == []


@each_of(
    "text",
    [
        "-1",
        "7.5",
        "1e3",
        "NaN",
        "inf",
        "seven",
        "1_000",
        "1,000",
        "1.000",
        "٧",
        "²",
        "0x7",
        "1000001",
        "9" * 5_000,
        "",
    ],
)
def test_what_is_no_whole_number_is_told(text):
    table = table_of("5", text, "5")
    read = Whole(filled=True).read(table, "x")
    assert read.good.tolist() == [True, False, True]
    assert read.values.tolist() == [5, 0, 5]
    (problem,) = told(table)
    assert problem.startswith("t.csv:3: x ")
    assert problem.endswith(". Write 0, 1, 2, ...")
    assert len(problem) < 150


def test_the_least_whole_number_can_be_raised():
    table = table_of("0", "1")
    assert Whole(least=1, filled=True).read(table, "x").good.tolist() == [False, True]
    assert told(table) == [
        "t.csv:2: x '0' isn't a whole number from 1 to 1,000,000. Write 1, 2, 3, ..."
    ]


def test_the_greatest_whole_number_can_be_lowered():
    table = table_of("7", "8")
    assert Whole(most=7, filled=True).read(table, "x").good.tolist() == [True, False]
    assert told(table) == ["t.csv:3: x '8' isn't a whole number from 0 to 7. Write 0, 1, 2, ..."]


def test_empty_cells_may_be_allowed():
    table = table_of("", "7")
    read = Whole().read(table, "x")
    assert read.values.tolist() == [0, 7]
    assert read.good.all()
    assert told(table) == []


def test_a_column_that_is_missing_is_no_further_problem():
    table = table_of("", "")
    table = dataclasses.replace(table, columns={"y": table.columns["x"]}, found=frozenset())
    assert Whole(filled=True).read(table, "y").values.tolist() == [0, 0]
    assert np.isnan(NUMBER.read(table, "y").values).all()
    assert told(table) == []


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.5", 0.5),
        (".5", 0.5),
        ("5e-1", 0.5),
        ("1", 1.0),
        ("-2.", -2.0),
        ("0,5", 0.5),
        (",5", 0.5),
        ("1,000", 1.0),
        ("2,5e-1", 0.25),
    ],
)
def test_numbers(text, value):
    table = table_of(text)
    assert NUMBER.read(table, "x").values.tolist() == [value]
    assert told(table) == []


@pytest.mark.parametrize(
    ("cells", "problems"),
    [
        (("1,500", "1,700"), ["1,500' may mean 1500 or 1.5", "1,700' may mean 1700 or 1.7"]),
        (("1.500", "1.700"), ["1.500' may mean 1500 or 1.5", "1.700' may mean 1700 or 1.7"]),
        (("-1,500", "85,5"), ["-1,500' may mean -1500 or -1.5"]),
        (("1.500", "1700"), ["1.500' may mean 1500 or 1.5"]),
        (("1.500", "1.25"), []),
        (("85,5", "92,347", "0,125", "1,5", "1,5000"), []),
        (("85.5", "92.347", "9.512"), []),
    ],
)
def test_a_number_that_reads_two_ways_is_refused(cells, problems):
    table = table_of(*cells)
    Number(least=-(10**6), most=10**6, grouped=True).read(table, "x")
    assert len(told(table)) == len(problems)
    for problem, part in zip(told(table), problems, strict=True):
        assert part in problem


def test_a_point_is_a_decimal_point_unless_it_may_group_and_a_comma_where_no_thousand_fits():
    for text, at_most in (("1.500", 10**6), ("1,500", 9)):
        table = table_of(text)
        assert Number(least=0, most=at_most).read(table, "x").values.tolist() == [1.5]
        assert told(table) == []


@each_of(
    "text",
    ["NaN", "inf", "-Infinity", ",", "0,5,0", "1,000.5", "1.000,5", "1e999", "half", "1_0", ""],
)
def test_what_is_no_number_is_told(text):
    table = table_of(text)
    assert math.isnan(NUMBER.read(table, "x").values[0])
    (problem,) = told(table)
    assert problem.startswith("t.csv:2: x ")
    assert problem.endswith(". Write 0.5.")
