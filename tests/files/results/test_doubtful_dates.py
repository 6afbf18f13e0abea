"""Dates that were probably mistyped are named with their lines; dates of a long past are not."""

import numpy as np

from evenbreak.files.results.doubts import MOST_DATES_LISTED, date_warnings
from evenbreak.files.results.results_file import read_results
from rows import each_of

TODAY = np.datetime64("2026-03-01")


def warned(*days):
    dates = np.array(days, dtype="datetime64[D]")
    found = date_warnings(dates, np.arange(2, len(days) + 2), "r.csv", TODAY)
    return [warning.split(" is ")[0] for warning in found]


@each_of(
    "days, found",
    [
        (["2026-01-01", "2026-03-02"], []),
        (["2026-01-01", "2026-03-03"], ["r.csv:3: date 2026-03-03"]),
        (["2204-04-01", "NaT", "2026-01-01"], ["r.csv:2: date 2204-04-01"]),
        (["2204-04-01"], ["r.csv:2: date 2204-04-01"]),
        (["2025-01-01", "1925-01-01", "2025-02-01"], ["r.csv:3: date 1925-01-01"]),
        (["2025-01-01", "2014-01-01", "2025-02-01", "NaT"], ["r.csv:3: date 2014-01-01"]),
        (["2015-01-01", "2025-01-01", "2015-02-01"], ["r.csv:3: date 2025-01-01"]),
        (["2021-01-01", "2025-01-01", "2025-02-01"], []),
        (["2015-01-01", "2025-01-01"], []),
        (["2015-01-01"] * 5 + ["2025-01-01"] * 9, []),
        (["NaT"], []),
        ([], []),
    ],
)
def test_dates_in_the_future_or_far_from_all_others(days, found):
    assert warned(*days) == found


def test_one_mistyped_date_in_each_direction():
    days = [f"2025-01-{day:02d}" for day in range(1, 31)]
    assert warned("1205-01-01", *days, "2015-01-01") == [
        "r.csv:2: date 1205-01-01",
        "r.csv:33: date 2015-01-01",
    ]


def test_many_are_counted():
    assert len(warned(*["2204-04-01"] * 40)) == MOST_DATES_LISTED + 1


def test_a_file_with_such_a_date_is_read_with_a_warning(tmp_path):
    path = tmp_path / "r.csv"
    path.write_text(
        "date,player_a,player_b,score_a,score_b\n"
        "2024-03-25,Ann,Bo,7,5\n2204-04-01,Ann,Cy,7,3\n2024-04-08,Bo,Cy,7,6\n"
    )
    (warning,) = read_results(path).warnings
    assert warning.startswith(f"{path}:3: date 2204-04-01 is in the future")
