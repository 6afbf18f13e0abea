"""What the bundled program does by its words; that it is built and runs, the workflow tries."""

import os
import runpy
import sys
from io import BytesIO, StringIO
from pathlib import Path
from unittest.mock import patch

import pytest
import xlsxwriter

from evenbreak.files.tables import workbook
from evenbreak.files.tables.rows import sheets_of
from places import ROOT

PROGRAM = ROOT / "packaging" / "program.py"


@pytest.mark.parametrize(
    ("words", "run"),
    [
        ([], ["serve", "--open"]),  # a double click
        (["2026-11-28.db"], ["serve", "2026-11-28.db", "--open"]),  # a file dropped on it
        ([__file__], ["serve", __file__, "--open"]),  # another one, which is refused there
        (["odds", "612", "521"], ["odds", "612", "521"]),
        (["serve", "tonight.db"], ["serve", "tonight.db"]),
        (["--help"], ["--help"]),
    ],
)
def test_a_double_click_opens_the_page_and_words_are_commands(
    words: list[str], run: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["evenbreak", *words])
    monkeypatch.setenv("LD_LIBRARY_PATH", "of the bundle")
    monkeypatch.setenv("LD_LIBRARY_PATH_ORIG", "of the system")
    with patch("evenbreak.cli.main"):
        runpy.run_path(str(PROGRAM))["run"]()
    assert sys.argv[1:] == run
    assert os.environ["LD_LIBRARY_PATH"] == "of the system"  # for the browser and other programs
    assert "LD_LIBRARY_PATH_ORIG" not in os.environ


@pytest.mark.parametrize("typed", ["", "\n"])
def test_an_error_of_a_double_click_waits_for_enter_if_there_is_a_keyboard(
    typed: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    terminal = StringIO(typed)
    monkeypatch.setattr(terminal, "isatty", lambda: True)
    monkeypatch.setattr(sys, "argv", ["evenbreak"])
    monkeypatch.setattr(sys, "stdin", terminal)
    with patch("evenbreak.cli.main", side_effect=SystemExit(2)), pytest.raises(SystemExit):
        runpy.run_path(str(PROGRAM))["run"]()
    assert "Press Enter" in capsys.readouterr().out


@pytest.mark.skipif(sys.platform == "win32", reason="a shell script stands for the program")
def test_its_own_process_reads_a_workbook(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """There is no Python beside it that could."""
    assert runpy.run_path(str(PROGRAM))["AS_READER"] == workbook.AS_READER
    content = BytesIO()
    with xlsxwriter.Workbook(content, {"in_memory": True}) as book:
        book.add_worksheet("Club").write_row(0, 0, ["Name", 7])
    bundled = tmp_path / "evenbreak"
    bundled.write_text(f'#!/bin/sh\nexec {sys.executable} {PROGRAM} "$@"\n')
    bundled.chmod(0o700)
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    monkeypatch.setattr(sys, "executable", str(bundled))
    monkeypatch.setenv("PYTHONPATH", str(ROOT / "src"))
    (sheet,) = sheets_of(content.getvalue(), "club.xlsx")
    assert sheet.rows == [["Name", "7"]]
