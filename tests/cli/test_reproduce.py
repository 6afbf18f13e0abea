import json
from pathlib import Path

import pytest

from evenbreak.source_text import reproduce
from evenbreak.source_text.answers import section_5_findings

QUICK = {"index.md": b"new", "a.csv": b"1", "a.png": b"2", "a.svg": b"3"}


@pytest.fixture
def quick(monkeypatch):
    """Write a few files at once in place of all."""
    monkeypatch.setattr(reproduce, "reproduction", lambda _: QUICK)


@pytest.mark.usefixtures("quick")
def test_the_answer_counts_what_was_compared_and_written(run, tmp_path):
    answer = json.loads(run("reproduce", "--json", "--out", str(tmp_path)).stdout)
    verdicts = {row["verdict"]: row["numbers"] for row in answer["verdicts"]}
    assert verdicts == {"agrees": 936, "formula": 165, "given": 32, "derived": 31, "erratum": 28}
    assert (answer["tables"], answer["figures"]) == (1, 1)
    text = run("reproduce", "--out", str(tmp_path)).stdout
    assert f"{tmp_path}/index.md" in "".join(text.split("\n"))


@pytest.mark.usefixtures("quick")
def test_other_files_of_the_folder_are_left_alone(run, tmp_path):
    (tmp_path / "README.md").write_text("mine")
    assert run("reproduce", "--out", str(tmp_path)).exit_code == 0
    assert (tmp_path / "README.md").read_text() == "mine"
    assert (tmp_path / "index.md").read_bytes() == b"new"


@pytest.mark.usefixtures("quick")
def test_a_number_that_differs_is_named_and_ends_with_1(run, tmp_path, monkeypatch):
    wrong = section_5_findings()[0]._replace(verdict="differs", computed=2.5)
    monkeypatch.setattr(reproduce, "all_findings", lambda: (wrong,))
    result = run("reproduce", "--out", str(tmp_path / "out"))
    assert result.exit_code == 1
    assert "P5.1: mean" in result.stderr
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
