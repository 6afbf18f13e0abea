"""Dates in the orders in which people write them."""

import pytest

from evenbreak.errors import DataError, InputError
from evenbreak.files.tables.dates import Day, read_date
from evenbreak.files.tables.table import read_table


@pytest.fixture
def read(tmp_path):
    def read_dates(*texts, order=None):
        path = tmp_path / "d.csv"
        path.write_text("n,date\n" + "".join(f"{k},{text}\n" for k, text in enumerate(texts)))
        table = read_table(path, {"n": ()}, {"date": ()})
        found = Day(order=order).read(table, "date")
        table.problems.raise_any()
        return [str(day) for day in found.values]

    return read_dates


@pytest.mark.parametrize(
    "text",
    [
        "2024-09-03",
        "2024/9/3",
        "3.9.2024",
        "03.09.2024",
        "2024-09-03T19:30:00+02:00",
        "2024-09-03 19:30",
        "3.9.2024 7:30 PM",
    ],
)
def test_dates_that_read_one_way(text):
    assert str(read_date(text)) == "2024-09-03"
    assert str(read_date(text, "mdy")) == "2024-09-03"


@pytest.mark.parametrize("text", ["9/3/2024", "09-03-2024", "9/3/2024 7:30 p.m."])
def test_the_order_of_day_and_month(text):
    assert str(read_date(text, "mdy")) == "2024-09-03"
    assert str(read_date(text, "dmy")) == "2024-03-09"
    assert read_date(text) is None


@pytest.mark.parametrize(
    ("text", "day"),
    [("9/13/2024", "2024-09-13"), ("13/9/2024", "2024-09-13"), ("9/9/2024", "2024-09-09")],
)
def test_dates_that_only_one_order_allows(text, day):
    assert str(read_date(text)) == day


@pytest.mark.parametrize(
    "text",
    ["9/3/24", "24/9/3", "9/3-2024", "31/31/2024", "2/30/2024", "soon", "9/2024", "3 9 2024"],
)
def test_what_is_no_date(text):
    assert read_date(text) is None


def test_any_day_above_12_settles_the_file(read):
    assert read("9/3/2024", "9/13/2024", "", "2024-01-02") == [
        "2024-09-03",
        "2024-09-13",
        "NaT",
        "2024-01-02",
    ]
    assert read("9/3/2024", "13/9/2024") == ["2024-03-09", "2024-09-13"]
    assert read("9/9/2024") == ["2024-09-09"]


def test_an_open_file_is_one_problem_that_names_the_option(read):
    with pytest.raises(DataError) as caught:
        read("2024-01-02", "9/3/2024", "9/4/2024", "10/5/2024")
    (problem,) = caught.value.problems
    assert "d.csv:3:" in problem
    assert "Add dates mdy" in problem


def test_the_option_settles_it(read):
    assert read("9/3/2024", "9/4/2024", order="mdy") == ["2024-09-03", "2024-09-04"]
    assert read("9/3/2024", "9/4/2024", order="dmy") == ["2024-03-09", "2024-04-09"]


def test_a_file_of_both_orders_is_one_problem(read):
    with pytest.raises(DataError) as caught:
        read("9/13/2024", "13/9/2024", "9/3/2024")
    (problem,) = caught.value.problems
    assert "'9/13/2024' in line 2" in problem
    assert "'13/9/2024' in line 3" in problem


def test_a_date_that_the_option_does_not_allow_is_a_problem_in_its_line(read):
    with pytest.raises(DataError, match=r"d\.csv:3: date '9/13/2024' isn't a date"):
        read("9/3/2024", "9/13/2024", order="dmy")


def test_an_order_that_there_is_not_is_refused(read):
    with pytest.raises(InputError, match="'ymd'"):
        read("9/3/2024", order="ymd")
