"""Every command says the same in every face, and its text is the one kept in `golden`.

To take over new wording: EVENBREAK_GOLDEN=write python -m pytest tests/test_faces.py, then read the
difference.
"""

import csv
import io
import json
import os
import re
import shlex
import tempfile
from html.parser import HTMLParser

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from places import DATA, ROOT

GOLDEN = ROOT / "tests" / "golden"

ASKED = {
    "odds": "odds 612 521 --scale fargo --race 7:5",
    "odds_sets": "odds --p 0.66 --race 3:1 --set 3:3 --score 1:0",
    "fair": "fair 612 521 --scale fargo --race-to 7 --top 3",
    "live": "live --p 0.6 --race 7:5 --racks abbab",
    "live_table": "live --p 0.6 --set 4:3 --race 3:3 --score 1:1 --set-score 2:2 --table",
    "compare": "compare --p 0.6667 9:5 '3:1 of 3:3' 'ahead 5:3'",
    "compare_breaks": "compare --p1 0.6 --p2 0.55 --breaks winner 9:7 '9:7 alternate breaks'",
    "straight": "straight 24 19 --points 150",
    "breaks": "breaks 0.9 0.5 --win 1 --lose 2",
    "oneball": "oneball 0.1 0.05 --or 0.5:0.8",
    "oneball_alone": "oneball 0.4 0.8",
    "chain": "chain data/safety_battle.csv",
    "chain_steps": "chain data/safety_battle.csv --steps 4",
    "report": "report data/demo_league.csv --out OUT --top 6",
    "report_lengths": "report data/demo_league.csv --out OUT --scale fargo --games 7..13 --top 14",
    "matchups": "matchups data/demo_roster.csv --pairs data/demo_pairs.csv --chart npl_10",
    "matchups_both": "matchups data/demo_roster.csv --pairs data/demo_pairs.csv --chart npl_10 "
    "--games 7..13 --minutes-per-game 8 --tables 2",
    "matchups_uneven": "matchups data/demo_roster.csv --race-to 3",
}
"""A question for each command, and for each kind of answer that it has."""

OWN_PAGE = ("report", "matchups")
"""Commands whose --html writes a page of their own."""

NO_CSV = ("report",)
"""Commands that print text into a pipe too, since they write files."""

WORDLESS = re.compile(r"\s+")


def ask(line: str, *options: str) -> str:
    with tempfile.TemporaryDirectory() as out:
        places = {"data/": f"{DATA}/", "OUT": out}
        words = shlex.split(line)
        for place, here in places.items():
            words = [word.replace(place, here) for word in words]
        result = CliRunner().invoke(program, [*words, *options])
    assert result.exit_code == 0, result.output
    return result.stdout


def squeezed(text: str) -> str:
    """Return text without blanks, which faces may set differently."""
    return WORDLESS.sub("", text)


class Cells(HTMLParser):
    """The texts of a page, a string for each element that holds text."""

    def __init__(self) -> None:
        super().__init__()
        self.texts: list[str] = []

    def handle_data(self, data: str) -> None:
        if data.strip():
            self.texts.append(data)


@pytest.fixture(scope="module", params=ASKED)
def faces(request, tmp_path_factory):
    """The answer to one question in each face."""
    name, line = request.param, ASKED[request.param]
    command = line.split()[0]
    page = tmp_path_factory.mktemp("page") / "answer.html"
    page.write_text("", "utf-8")
    writes_page = () if command in OWN_PAGE else ("--html", str(page))
    text = ask(line, "--text", "--verbose", *writes_page)
    table = "" if command in NO_CSV else ask(line, "--csv")
    return name, text, json.loads(ask(line, "--json")), table, page.read_text("utf-8")


def test_every_face_has_the_same_sentences(faces):
    _, text, answer, _, page = faces
    shown = Cells()
    shown.feed(page)
    on_page = squeezed("".join(shown.texts))
    assert answer["sentences"]
    for sentence in [answer["heading"], *answer["sentences"], *answer["details"]]:
        assert squeezed(sentence) in squeezed(text)
        assert squeezed(sentence) in on_page or not page


def test_a_page_has_the_numbers_of_the_text(faces):
    _, text, _, _, page = faces
    shown = Cells()
    shown.feed(page.partition("<main>")[2].partition("</main>")[0])
    everything = squeezed(text)
    missing = [one for one in shown.texts if squeezed(one) not in everything and one != "Details"]
    assert missing == []


def test_csv_has_the_numbers_of_json(faces):
    _, _, answer, table, _ = faces
    if not table:
        pytest.skip("prints no CSV, since it writes files")
    header, *rows = csv.reader(io.StringIO(table))
    if header == ["quantity", "value"]:
        records = {name: answer[name] for name, _ in rows}
        assert [value for _, value in rows] == [as_csv(records[name]) for name, _ in rows]
        return
    tables = [
        value
        for value in answer.values()
        if isinstance(value, list) and value and isinstance(value[0], dict)
    ]
    (records,) = [one for one in tables if set(header) <= set(one[0]) and len(one) == len(rows)]
    for row, record in zip(rows, records, strict=True):
        for name, cell in zip(header, row, strict=True):
            # A spreadsheet must not take words such as 9:5 for a time of day.
            assert isinstance(record[name], str) or cell in (
                as_csv(record[name]),
                repr(record[name]),
            )


def as_csv(value):
    if value is None:
        return ""
    if not isinstance(value, float):
        return str(value)
    text = f"{value:.6f}"
    return text.removeprefix("-") if float(text) == 0.0 else text


@pytest.mark.parametrize("name", ASKED)
def test_the_text_is_the_one_that_was_read_and_kept(name):
    place = GOLDEN / f"{name}.txt"
    text = f"$ evenbreak {ASKED[name]}\n{ask(ASKED[name], '--text')}"
    if os.environ.get("EVENBREAK_GOLDEN") == "write":
        place.parent.mkdir(exist_ok=True)
        place.write_text(text, encoding="utf-8")
    assert text == place.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ASKED)
def test_the_answer_comes_first_and_fits_a_terminal(name):
    lines = (GOLDEN / f"{name}.txt").read_text(encoding="utf-8").splitlines()[1:]
    blank = lines.index("")
    assert re.match(r"\S", lines[blank + 1]), "a paragraph follows the heading"
    assert max(map(len, lines)) <= 80
