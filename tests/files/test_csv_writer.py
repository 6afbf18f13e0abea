import csv
import io

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.files.csv_writer import FORMULA_STARTS, csv_lines, to_csv, undefused
from evenbreak.files.tables.names import clean_name, is_name
from rows import each_of


def test_every_kind_of_value():
    frame = pd.DataFrame(
        {
            "player": ["Zoë, K", 'a "b"'],
            "p_win_a": [1 / 3, np.nan],
            "race_a": pd.array([7, None], dtype="Int64"),
            "games": np.array([12, 13]),
            "date": pd.to_datetime(["2024-09-03", None]),
            "value": pd.Series([80.0, 24], dtype="object"),
        }
    )
    assert to_csv(frame).decode() == (
        "player,p_win_a,race_a,games,date,value\n"
        '"Zoë, K",0.333333,7,12,2024-09-03,80.000000\n'
        '"a ""b""",,,13,,24\n'
    )


@pytest.mark.parametrize(
    "text", ["=1+1", "+A1", "-1+1", "@SUM(A1)", "\x1b[31m", "\r1", "＝1", "﹣x"]
)
def test_text_that_a_spreadsheet_would_run_is_defused(text):
    frame = pd.DataFrame({"player": [text], text: ["x"]})
    header, row = csv.reader(io.StringIO(to_csv(frame).decode(), newline=""))
    assert header[1] == row[0] == f"'{text}"


@each_of("separator", [",", ";", "\t"])
@each_of("column", [0, 1])
@each_of(
    "text",
    [
        "Bo;=cmd|' /C calc'!A0;x",
        "Bo; ＝cmd;@x",
        "=1;=2",
        'Bo";"=1";-x',
        "Bo\t+1;x",
        "Bo\n=1\r\n@x",
        "\t=1",
        "'=1;x",
    ],
)
def test_no_spreadsheet_of_any_country_finds_a_formula(text, column, separator):
    row = ["Ann", "x"]
    row[column] = text
    line = "".join(csv_lines(row, []))
    for split in csv.reader(io.StringIO(line, newline=""), delimiter=separator):
        assert not [cell for cell in split if cell.lstrip('" \t\n')[:1] in (*FORMULA_STARTS,)]
    assert undefused(next(csv.reader(io.StringIO(line, newline="")))[column]) in (text, f"'{text}")


NAMES = st.text("ab '\";,=-+\u202e\u200d\u0301\u00e9\uff1d", max_size=8)


@given(st.lists(NAMES.map(clean_name).filter(is_name), min_size=1))
def test_names_come_back_as_they_were(names):
    text = "".join(csv_lines(["player"], [[name] for name in names]))
    assert [clean_name(row["player"]) for row in csv.DictReader(io.StringIO(text))] == names


def test_numbers_are_never_defused_even_as_text():
    frame = pd.DataFrame({"rating": [-12.5], "won": [-3], "state": ["-1"]})
    assert to_csv(frame) == b"rating,won,state\n-12.500000,-3,-1\n"


def test_what_rounds_to_zero_has_no_sign():
    assert to_csv(pd.DataFrame({"x": [-1e-9, -0.0]})) == b"x\n0.000000\n0.000000\n"


def test_no_number_is_written_for_what_is_none():
    assert to_csv(pd.DataFrame({"x": [np.inf, -np.inf, np.nan]})) == b"x\n\n\n\n"


def test_excel_gets_a_mark_and_its_line_ends():
    frame = pd.DataFrame({"player": ["Zoë"]})
    assert to_csv(frame, excel=True) == b"\xef\xbb\xbfplayer\r\nZo\xc3\xab\r\n"


TEXTS = st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=10)


@given(st.lists(st.tuples(TEXTS, st.floats(0, 1)), max_size=10), st.booleans())
def test_what_is_written_reads_back_and_is_the_same_each_time(rows, excel):
    frame = pd.DataFrame(rows, columns=["name", "p"]).astype({"name": object, "p": float})
    written = to_csv(frame, excel=excel)
    assert written == to_csv(frame.copy(), excel=excel)
    text = written.decode("utf-8-sig")
    read = list(csv.DictReader(io.StringIO(text, newline="")))
    for row, (name, _) in zip(read, rows, strict=True):
        assert undefused(row["name"]) in (name, f"'{name}")
    assert [row["p"] for row in read] == [f"{p:.6f}" for _, p in rows]
    for row in read:
        assert row["name"][:1] not in (*FORMULA_STARTS,) or float(row["name"])
