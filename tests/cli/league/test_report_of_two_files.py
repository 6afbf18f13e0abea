"""A report names and fingerprints every file that it was made from, and carries its title."""

from __future__ import annotations

import hashlib
import io
import json
import re
import zipfile
from pathlib import Path

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program

pytest.importorskip("xlsxwriter", reason="a workbook needs evenbreak[excel]")

FILES = {
    "spring.csv": "player_a,player_b,score_a,score_b,date\nAnn,Bo,7,5,2024-03-01\n",
    "fall.csv": "player_a,player_b,score_a,score_b,date\nBo,Cy,7,2,2024-09-01\n"
    "Ann,Cy,7,3,2024-10-01\n",
}
PRINTS = [hashlib.sha256(text.encode()).hexdigest() for text in FILES.values()]
TITLE = "Tuesday & Friday league"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Return the text of each form of a report of two files."""
    folder = tmp_path_factory.mktemp("report")
    for name, text in FILES.items():
        (folder / name).write_text(text)
    words = ["report", *(str(folder / name) for name in FILES), "--out", str(folder / "sheet")]
    runs = [
        CliRunner().invoke(program, [*words, "--html", "--excel", "--title", TITLE, *face])
        for face in ([], ["--json"])
    ]
    assert [run.exit_code for run in runs] == [0, 0], runs[0].output
    sheet = folder / "sheet"
    with zipfile.ZipFile(io.BytesIO((sheet / "sheet.xlsx").read_bytes())) as book:
        cells = book.read("xl/sharedStrings.xml").decode()
    return {
        "text": runs[0].stdout,
        "json": json.dumps(json.loads(runs[1].stdout), ensure_ascii=False),
        "html": (sheet / "sheet.html").read_text().replace("&amp;", "&"),
        "csv": (sheet / "summary.csv").read_text(),
        "xlsx": cells.replace("&amp;", "&"),
    }


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("form", ["text", "json", "html", "csv", "xlsx"])
def test_every_form_names_both_files_and_the_title(made: dict[str, str], form: str) -> None:
    for name in ("spring.csv and fall.csv", TITLE):
        assert name in made[form]
    assert "/" not in made["text"].partition("\n")[0]


@pytest.mark.parametrize("form", ["json", "html", "csv", "xlsx"])
def test_every_form_has_the_fingerprint_of_both_files(made: dict[str, str], form: str) -> None:
    for sha256 in PRINTS:
        assert sha256 in made[form]


def test_the_paper_has_them_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from evenbreak.sheets.pdf_page import Paper

    drawn: list[str] = []
    write = Paper.text

    def text(self: Paper, x: float, y: float, words: str, **look: object) -> object:
        drawn.append(words)
        return write(self, x, y, words, **look)  # type: ignore[arg-type]

    monkeypatch.setattr(Paper, "text", text)
    for name, content in FILES.items():
        (tmp_path / name).write_text(content)
    words = ["report", *(str(tmp_path / name) for name in FILES), "--title", TITLE]
    run = CliRunner().invoke(program, [*words, "--out", str(tmp_path / "sheet")])
    assert run.exit_code == 0, run.output
    said = " ".join(drawn)
    assert TITLE in drawn
    assert "Fair races from spring.csv and fall.csv, 2024-03-01 to 2024-10-01" in said
    assert all(sha256[:12] in said for sha256 in PRINTS)
    title = re.search(rb"/Title (\(.*?\)|<.*?>)", (tmp_path / "sheet/sheet.pdf").read_bytes())
    assert title
    assert b"Tuesday" in title[1]


@pytest.mark.parametrize("title", ["x" * 201, "Bo\x07"])
def test_a_title_is_a_line(tmp_path: Path, title: str) -> None:
    (tmp_path / "r.csv").write_text(FILES["spring.csv"])
    words = ["report", str(tmp_path / "r.csv"), "--out", str(tmp_path / "sheet"), "--title", title]
    run = CliRunner().invoke(program, words)
    assert run.exit_code == 2
    assert "--title" in run.stderr
