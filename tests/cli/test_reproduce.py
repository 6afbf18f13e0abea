import os
import subprocess
import sys
from pathlib import Path

import pytest

from evenbreak.source_text.section5 import numbers


@pytest.fixture(scope="module")
def made(run, tmp_path_factory):
    folder = tmp_path_factory.mktemp("reports") / "section5"
    return run("reproduce", "--out", str(folder)), folder


def test_files_are_written_and_named(made):
    result, folder = made
    assert result.exit_code == 0
    assert result.stdout == ""
    names = {path.name for path in folder.iterdir()}
    tables = sum(name.endswith(".csv") for name in names)
    figures = sum(name.endswith(".png") for name in names)
    assert result.stderr.splitlines()[-1] == (
        f"Wrote index.md, physics.md, {tables} tables (CSV) and {figures} figures (PNG and SVG) "
        f"to {folder}"
    )
    assert len(names) == 2 + tables + 2 * figures


def test_another_process_writes_the_same_bytes(made, tmp_path):
    _, folder = made
    environment = {**os.environ, "PYTHONHASHSEED": "7", "LC_ALL": "C", "TZ": "Asia/Tokyo"}
    command = [sys.executable, "-m", "evenbreak", "reproduce", "--out", "again"]
    subprocess.run(command, check=True, cwd=tmp_path, env=environment, capture_output=True)
    again = {path.name: path.read_bytes() for path in (tmp_path / "again").iterdir()}
    assert again == {path.name: path.read_bytes() for path in folder.iterdir()}


def test_other_files_of_the_folder_are_left_alone(made, run, monkeypatch):
    _, folder = made
    (folder / "README.md").write_text("mine")
    quick = {"index.md": b"new", "a.csv": b"1", "a.png": b"2", "a.svg": b"3"}
    monkeypatch.setattr("evenbreak.source_text.reproduce.reproduction", lambda _: quick)
    assert run("reproduce", "--out", str(folder)).exit_code == 0
    assert (folder / "README.md").read_text() == "mine"
    assert (folder / "index.md").read_bytes() == b"new"


def test_a_number_that_differs_is_told_and_ends_with_1(run, tmp_path, monkeypatch):
    wrong = numbers.findings()[0]._replace(verdict="differs", computed=2.5)
    quick = {"index.md": b"new", "a.csv": b"1", "a.png": b"2", "a.svg": b"3"}
    monkeypatch.setattr("evenbreak.source_text.reproduce.reproduction", lambda _: quick)
    monkeypatch.setattr(numbers, "findings", lambda: (wrong,))
    result = run("reproduce", "--out", str(tmp_path / "out"))
    assert result.exit_code == 1
    assert "Differs: P5.1: mean" in result.stderr
    assert (tmp_path / "out" / "index.md").exists()


@pytest.mark.parametrize("words", [[], ["--out", ""], ["--out", "  "], ["extra", "--out", "a"]])
def test_wrong_usage(run, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("reproduce", *words)
    assert result.exit_code == 2
    assert list(Path().iterdir()) == []


def test_a_file_is_no_folder(run, tmp_path):
    (tmp_path / "file").write_text("x")
    result = run("reproduce", "--out", str(tmp_path / "file"))
    assert result.exit_code == 2
    assert "is a file" in result.stderr
