"""Pages printed by a browser on Letter and A4: no stray line spills onto a second sheet."""

import re
import shutil
import subprocess
import zlib

import pytest

from evenbreak.matches.pace import own_pace
from evenbreak.sheets.sheet_page import round_html, sheet_html
from leagues import league, round_of, sheet_of

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium to print with")

TIMED = {"pace": own_pace(8.0), "tables": 2}
FEWEST_LINES = 4


def lines_printed(page, folder, paper):
    """Return how many lines of text stand on each sheet of paper."""
    source, out = folder / "page.html", folder / "page.pdf"
    # The policy allows the style only as it is.
    sized = page.replace(b"Content-Security-Policy", b"x").replace(
        b"@page {", b"@page { size: " + paper.encode() + b";"
    )
    assert sized.count(b"size: " + paper.encode()) == 1
    source.write_bytes(sized)
    flags = ["--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder / 'profile'}"]
    subprocess.run(
        [CHROMIUM, *flags, "--no-pdf-header-footer", f"--print-to-pdf={out}", source.as_uri()],
        check=True,
        capture_output=True,
        timeout=120,
    )
    return [heights(content) for content in contents(out.read_bytes())]


def contents(pdf):
    """Yield the drawing commands of each page of a PDF, in order."""
    objects = dict(re.findall(rb"\n(\d+) 0 obj\b(.*?)endobj", pdf, re.DOTALL))
    (kids,) = (found[1] for found in [re.search(rb"/Kids \[(.*?)\]", pdf, re.DOTALL)])
    for page in re.findall(rb"(\d+) 0 R", kids):
        number = re.search(rb"/Contents (\d+) 0 R", objects[page])[1]
        stream = re.search(rb"stream\r?\n(.*)endstream", objects[number], re.DOTALL)[1]
        yield zlib.decompress(stream)


def heights(content):
    """Return at how many heights text is shown."""
    return len(set(re.findall(rb"1 0 0 -1 [-\d.]+ ([-\d.]+) Tm", content)))


@pytest.mark.slow
@pytest.mark.parametrize("paper", ["Letter", "A4"])
@pytest.mark.parametrize("matches", [4, 12])
def test_a_list_of_matches(tmp_path, matches, paper):
    page = round_html(round_of(pairs=[[0, 1], [2, 3]] * (matches // 2) + [[0, 2]], **TIMED))
    *_, last = sheets = lines_printed(page, tmp_path, paper)
    assert len(sheets) <= 2
    assert last >= FEWEST_LINES


@pytest.mark.slow
@pytest.mark.parametrize("page", [round_html(round_of()), sheet_html(sheet_of(league(9)))])
def test_all_pairs(tmp_path, page):
    *_, last = lines_printed(page, tmp_path, "Letter")
    assert last >= FEWEST_LINES


@pytest.mark.slow
def test_a_short_list_is_one_sheet(tmp_path):
    page = round_html(round_of(pairs=[[0, 1], [2, 3]] * 4, **TIMED))
    assert len(lines_printed(page, tmp_path, "Letter")) == 1
