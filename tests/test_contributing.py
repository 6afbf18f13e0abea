"""CONTRIBUTING.md followed from end to end, in a copy of the checkout where the tests then pass."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from places import ROOT, SRC
from test_layers import LAYERS

PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
WHERE = re.findall(r"^## Where things are\n(.*?)^## ", PAGE, re.MULTILINE | re.DOTALL)[0]
SECTIONS = dict(re.findall(r"^## (Add .*?)\n(.*?)(?=^## |\Z)", PAGE, re.MULTILINE | re.DOTALL))
NEW_FILE = re.compile(r"`(src/[^`]+)`:\n\n```\w+\n(.*?)^```$", re.MULTILINE | re.DOTALL)
EDIT = re.compile(r"^```diff\n\+\+\+ (\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PLACE = re.compile(r"`(\w+[/.][^`]*)`")
RUN = re.compile(r"`python -m pytest ([^`]+)`")

NEW = ("ghost", "example_7", "shutout", "page_playoff", "every_route_is_declared")
"""What the page adds."""

OLD = ("test_lazy", "test_layers and not start and not import_each_other")
"""What a new module may break; not each start of a new interpreter, nor every pair of modules."""


class Checkout:
    """A copy of the package and its tests, in which a section of the page has been followed."""

    def __init__(self, place: Path) -> None:
        self.place = place
        # What is compiled already is taken along, but for what others are just writing.
        unwanted = shutil.ignore_patterns("*.pyc.*")
        for folder in ("src", "tests"):
            shutil.copytree(ROOT / folder, place / folder, ignore=unwanted)
        shutil.copy(ROOT / "pyproject.toml", place)

    def follow(self, section: str) -> list[Path]:
        """Write the new files and make the edits that a section asks for; return the new files."""
        new = []
        for name, text in NEW_FILE.findall(SECTIONS[section]):
            assert not (self.place / name).exists()
            (self.place / name).write_text(text, encoding="utf-8")
            new.append(self.place / name)
        for name, hunks in EDIT.findall(SECTIONS[section]):
            for hunk in hunks.split("@@\n"):
                self.edit(name, hunk)
        return new

    def edit(self, name: str, hunk: str) -> None:
        """Put the lines marked + where the page says, between the lines that it shows."""
        lines = hunk.splitlines(keepends=True)
        before = "".join(line[1:] for line in lines if line.startswith(" "))
        after = "".join(line[1:] for line in lines)
        text = (self.place / name).read_text(encoding="utf-8")
        assert text.count(before) == 1, f"{name} does not have these lines once:\n{before}"
        (self.place / name).write_text(text.replace(before, after), encoding="utf-8")

    def run(self, *words: str) -> str:
        """Run Python there and return what it prints."""
        environment = {**os.environ, "PYTHONPATH": str(self.place / "src")}
        done = subprocess.run(
            [sys.executable, *words],
            cwd=self.place,
            env=environment,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    def asks(self, line: str) -> str:
        """Run a command of the program there and return what it prints."""
        return self.run("-m", "evenbreak", *line.split())

    def passes(self, *words: str) -> list[str]:
        """Run pytest there, where nothing may fail; return what passed."""
        shown = self.run("-m", "pytest", "-q", "-rp", "-p", "no:cacheprovider", *words)
        return re.findall(r"^PASSED (.+)$", shown, re.MULTILINE)


class Followed(NamedTuple):
    """A checkout in which the whole page was followed, its new files and the tests that passed."""

    checkout: Checkout
    new: list[Path]
    passed: list[str]

    def count(self, *words: str) -> int:
        """Return how many tests passed whose name has these words."""
        return sum(all(word in name for word in words) for name in self.passed)


@pytest.fixture(scope="module")
def followed(tmp_path_factory: pytest.TempPathFactory) -> Followed:
    checkout = Checkout(tmp_path_factory.mktemp("followed") / "evenbreak")
    new = [path for section in SECTIONS for path in checkout.follow(section)]
    rooms = [room for section in SECTIONS.values() for room in RUN.findall(section)[0].split()]
    asked = {room for room in rooms if room.startswith("tests") and room != "tests/test_docs.py"}
    asked |= {str(path.relative_to(checkout.place)) for path in new if path.suffix == ".py"}
    asked |= {"tests/test_lazy.py", "tests/test_layers.py"}
    chosen = " or ".join(f"({words})" for words in (*NEW, *OLD))
    return Followed(checkout, new, checkout.passes(*sorted(asked), "-k", chosen))


def drawn_layers() -> str:
    """Return the layers as the page draws them, one below the other."""
    rows = [" | ".join(row) for row in LAYERS if row != ("__main__",)]
    return "".join(f"    {'  -> ' if k else ''}{row}\n" for k, row in enumerate(rows))


def test_the_map_is_that_of_the_layers() -> None:
    assert drawn_layers() in WHERE, f"draw the layers so:\n\n{drawn_layers()}"


def test_every_room_is_among_what_there_is_to_change() -> None:
    named = {name for row in re.findall(r"^\| .* \|$", WHERE, re.M) for name in PLACE.findall(row)}
    assert {
        name for name in named if not any((top / name).exists() for top in (SRC, ROOT))
    } == set()
    rooms = {inner.parent.name for inner in SRC.glob("*/__init__.py")}
    assert rooms - {name.split("/")[0] for name in named} == set()


def test_the_page_has_a_section_for_each_kind() -> None:
    assert {*SECTIONS} == {
        *("Add a game", "Add a chart", "Add a handicap system"),
        *("Add a tournament format", "Add a page", "Add a column"),
    }


@pytest.mark.slow
def test_what_there_was_still_holds(followed: Followed) -> None:
    assert followed.count("test_layers") > 50
    assert followed.count("test_lazy") > 5


@pytest.mark.slow
def test_a_game(followed: Followed) -> None:
    assert followed.count("test_games", "ghost") + followed.count("test_diagram", "ghost") > 10
    assert followed.count("src/evenbreak/games/ghost.py") > 0
    code = "import evenbreak.games as g; print(g.__file__, g.Ghost(0.5).winner(-2))"
    place = followed.checkout.place
    assert followed.checkout.run("-c", code) == f"{place}/src/evenbreak/games/__init__.py 2\n"


@pytest.mark.slow
def test_a_chart(followed: Followed) -> None:
    assert followed.count("example_7") > 2
    shown = followed.checkout.asks("chart list")
    assert "example_7,An example of races to 7,difference,7,7,13,3" in shown
    assert '"example_7"' in followed.checkout.asks("ladder --chart example_7 --json")


@pytest.mark.slow
def test_a_system(followed: Followed) -> None:
    assert followed.count("test_systems", "shutout") > 5
    assert '"shutout"' in followed.checkout.asks("ladder --system shutout --json")


@pytest.mark.slow
def test_a_format(followed: Followed) -> None:
    entrants = followed.checkout.place / "four.csv"
    entrants.write_text("Ann 600\nBo 590\nCy 580\nDi 570\n", encoding="utf-8")
    asked = f"tournament odds {entrants} --format page-playoff --race 5 --scale fargo --csv"
    lines = followed.checkout.asks(asked).splitlines()
    chances = [float(line.split(",")[lines[0].split(",").index("p_title")]) for line in lines[1:]]
    assert len(chances) == 4
    assert chances[0] > chances[1] > chances[2] > chances[3] > 0
    assert "page-playoff" in followed.checkout.asks("tournament new --help-all")


@pytest.mark.slow
def test_a_page(followed: Followed) -> None:
    assert followed.count("test_every_route_is_declared") > 0


@pytest.mark.slow
def test_a_column(followed: Followed) -> None:
    shown = followed.checkout.asks("odds --p .6 --race 7:5 --json")
    assert 0.2 < json.loads(shown)["p_upset"] < 0.5
    assert "the underdog wins" in followed.checkout.asks("odds --p .6 --race 7:5 --text")


@pytest.mark.slow
def test_the_examples_pass_the_linter(followed: Followed) -> None:
    code = [str(path) for path in followed.new if path.suffix == ".py"]
    assert code
    followed.checkout.run("-m", "ruff", "check", "-q", *code)
    followed.checkout.run("-m", "ruff", "format", "-q", "--check", *code)


@pytest.mark.parametrize("path", re.findall(r"\]\(([^)]+)\)", PAGE))
def test_links_lead_somewhere(path: str) -> None:
    file, _, place = path.partition("#")
    assert not file or (ROOT / file).exists()
    headings = re.findall(r"^## (.*)$", PAGE, re.MULTILINE)
    slugs = {re.sub(r"[^\w-]", "", one.lower().replace(" ", "-")) for one in headings}
    assert file or place in slugs
