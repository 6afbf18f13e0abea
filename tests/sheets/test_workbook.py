"""Workbooks are read back by another program's reader."""

import io
import sys
import zipfile

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from python_calamine import CalamineWorkbook

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.errors import InputError
from evenbreak.ratings.results import Results
from evenbreak.sheets.workbook import check_workbook, race_table, report_tables, workbook_bytes
from leagues import league, sheet_of
from tiers import examples

pytest.importorskip("xlsxwriter", reason="writes workbooks")


def read_back(content):
    book = CalamineWorkbook.from_filelike(io.BytesIO(content))
    return {name: book.get_sheet_by_name(name).to_python() for name in book.sheet_names}


SEASON = Results.from_names(["Ann", "Bo", "Di"], ["Bo", "Cy", "Ed"], [7, 7, 7], [5, 4, 3])


def test_a_report_has_a_sheet_for_each_table():
    sheet = sheet_of(SEASON, warnings=("folder/season.csv: columns not used: 'x'",))
    sheets = read_back(workbook_bytes(report_tables(sheet)))
    assert list(sheets) == ["Ratings", "Races", "Pairs", "Chart", "Left out", "About"]
    header, *rows = sheets["Ratings"]
    assert header == list(sheet.rated.columns)
    assert [row[0] for row in rows] == sheet.rated["player"].tolist()
    assert [row[1] for row in rows] == pytest.approx(sheet.rated["rating"].tolist(), abs=5e-7)
    header, *rows = sheets["Races"]
    for row in rows:
        for name, cell in zip(header[1:], row[1:], strict=True):
            assert cell == ("" if name == row[0] else sheet.races.get((row[0], name), "-"))
    header, *rows = sheets["Pairs"]
    assert len(rows) == len(sheet.paired)
    assert header[-1] == "note"
    for row in (dict(zip(header, row, strict=True)) for row in rows):
        if row["note"]:
            assert row["p_win_a"] == row["p_win_a_low"] == row["race_a"] == ""
        else:
            assert row["p_win_a_low"] < row["p_win_a"] < row["p_win_a_high"]
    assert [row[0] for row in sheets["Chart"]][:2] == ["difference_from", 0.0]
    assert [row[0] for row in sheets["Left out"]] == (
        ["what", "the races for 6 pairs", "Warning about season.csv"]
    )
    assert ["results_file", "season.csv"] in sheets["About"]


def test_where_lengths_differ_there_is_no_chart():
    assert "Chart" not in report_tables(sheet_of(SEASON, offered=OfferedRaces(games=(5, 9))))


def test_text_stays_text_and_no_cell_is_a_formula_or_a_link():
    names = ["=1+1", "7-5", "+49", "http://a.b/", "'x", "00123", "{=1}", "1e5"]
    content = workbook_bytes({"A": pd.DataFrame({"player": names})})
    assert [row[0] for row in read_back(content)["A"]] == ["player", *names]
    with zipfile.ZipFile(io.BytesIO(content)) as parts:
        sheet = parts.read("xl/worksheets/sheet1.xml").decode()
        assert not [part for part in parts.namelist() if "rels" in part and "sheet1" in part]
    assert "<f>" not in sheet
    assert "hyperlink" not in sheet


def test_what_is_missing_is_empty_and_numbers_have_six_decimals():
    table = pd.DataFrame(
        {
            "p": [1 / 3, np.nan, np.inf],
            "n": pd.array([7, None, 9], dtype="Int64"),
            "any": pd.Series(["a", 2, None], dtype="object"),
        }
    )
    assert read_back(workbook_bytes({"A": table}))["A"] == [
        ["p", "n", "any"],
        [0.333333, 7.0, "a"],
        ["", "", 2.0],
        ["", 9.0, ""],
    ]


def test_the_same_tables_give_the_same_bytes():
    table = {"A": pd.DataFrame({"player": ["Zoë"], "p": [0.5]})}
    content = workbook_bytes(table)
    assert workbook_bytes(table) == content
    with zipfile.ZipFile(io.BytesIO(content)) as parts:
        assert {part.date_time[0] for part in parts.infolist()} == {1980}
        assert b"2000-01-01" in parts.read("docProps/core.xml")


@given(st.lists(st.text(st.characters(exclude_categories=["Cs"]), max_size=20), max_size=5))
@settings(max_examples=examples(30), deadline=None)
def test_any_text_makes_a_workbook_that_can_be_read(names):
    content = workbook_bytes({"A": pd.DataFrame({"player": pd.Series(names, dtype="object")})})
    assert len(read_back(content)["A"]) >= 1


def test_a_table_too_large_for_a_sheet_is_refused():
    wide = pd.DataFrame(np.zeros((1, 16_385)))
    with pytest.raises(InputError, match="sheet 'A' would have 2 rows and 16,385 columns"):
        workbook_bytes({"A": wide})
    tall = pd.DataFrame({"p": np.zeros(1_048_576)})
    with pytest.raises(InputError, match="pair fewer players"):
        workbook_bytes({"A": tall})


def test_a_missing_xlsxwriter_is_told_with_its_remedy(monkeypatch):
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    with pytest.raises(InputError, match="pip install XlsxWriter"):
        check_workbook()


def test_a_player_may_be_called_player():
    table = race_table(sheet_of(league(("player", "Bo"))))
    assert list(table.columns) == ["player", "player", "Bo"]
    header, *rows = read_back(workbook_bytes({"Races": table}))["Races"]
    assert header == ["player", "player", "Bo"]
    assert [row[0] for row in rows] == ["player", "Bo"]
