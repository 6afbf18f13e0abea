"""Bytes split into rows, with the lines they begin in."""

import pytest

from evenbreak.files.tables.rows import ROWS_AT_A_TIME, csv_rows, first_rows


def rows_of(content, separator=","):
    unreadable = []
    parts = list(csv_rows(content.encode(), "utf-8", separator, unreadable))
    lines = [line for part, _ in parts for line in part]
    return lines, [row for _, part in parts for row in part], unreadable


def test_blank_lines_are_skipped_and_cells_with_line_ends_are_one_row():
    lines, rows, unreadable = rows_of('a,b\n\n1,"x\ny"\r\n2,z\n')
    assert (lines, rows) == ([1, 3, 5], [["a", "b"], ["1", "x\ny"], ["2", "z"]])
    assert unreadable == []


def test_a_line_that_cannot_be_split_is_reported_and_the_rest_is_read():
    lines, rows, unreadable = rows_of('a,b\n"x"y,1\n2,z\n')
    assert (lines, rows, unreadable) == ([1, 3], [["a", "b"], ["2", "z"]], [2])


def test_each_separator_makes_its_header():
    found = first_rows(b"name;score\nAnn;7\n", "utf-8")
    headers = {separator: rows[0] for separator, (_, rows) in found.items()}
    assert headers == {",": ["name;score"], ";": ["name", "score"], "\t": ["name;score"]}


@pytest.mark.parametrize("declared", ["|", ";", "\t"])
def test_a_declared_separator_is_the_only_one_and_counts_as_a_line(declared):
    content = f"sep={declared}\nname{declared}score\n"
    assert first_rows(content.encode(), "utf-8") == {declared: ([2], [["name", "score"]])}
    assert rows_of(content, declared)[:2] == ([2], [["name", "score"]])


def test_many_rows_come_in_parts():
    content = "a\n" * (2 * ROWS_AT_A_TIME + 1)
    parts = list(csv_rows(content.encode(), "utf-8", ",", []))
    assert [len(rows) for _, rows in parts] == [ROWS_AT_A_TIME, ROWS_AT_A_TIME, 1]


def test_an_empty_text_has_no_header():
    assert all(rows == [] for _, rows in first_rows(b"\n", "utf-8").values())
