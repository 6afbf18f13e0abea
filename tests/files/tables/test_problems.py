import numpy as np
import pytest

from evenbreak.errors import DataError
from evenbreak.files.tables.problems import Problems, quoted


def test_nothing_found_raises_nothing():
    problems = Problems("r.csv")
    problems.raise_any()
    assert len(problems) == 0


def test_problems_come_in_the_order_of_lines_and_within_a_line_as_found():
    problems = Problems("r.csv")
    problems.add(9, "late")
    problems.add_rows(np.array([2, 4, 6]), np.array([0, 2]), lambda row: f"row {row}")
    problems.add(2, "second")
    problems.add(None, "whole file")
    assert len(problems) == 5
    with pytest.raises(DataError) as caught:
        problems.raise_any()
    assert caught.value.problems == (
        "r.csv: whole file",
        "r.csv:2: row 0",
        "r.csv:2: second",
        "r.csv:6: row 2",
        "r.csv:9: late",
    )


@pytest.mark.parametrize("text", ["a\x1b[31m", "line\nline", "x" * 10_000, "\ud800"])
def test_quoted_text_is_short_and_harmless(text):
    shown = quoted(text)
    assert len(shown) < 60
    assert shown.isprintable()
    assert shown.encode()
