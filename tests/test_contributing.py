"""CONTRIBUTING.md followed step by step, in a copy of the checkout where the tests then pass."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from places import ROOT

PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
SECTIONS = dict(re.findall(r"^## (Add .*?)\n(.*?)(?=^## |\Z)", PAGE, re.MULTILINE | re.DOTALL))
NEW_FILE = re.compile(r"`(src/[^`]+)`:\n\n```\w+\n(.*?)^```$", re.MULTILINE | re.DOTALL)
EDIT = re.compile(r"^```diff\n\+\+\+ (\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
RUN = re.compile(r"`python -m pytest ([^`]+)`")

LAYERS = ("tests/test_layers.py", "-k", "not starting_up and not import_each_other")
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

    def passes(self, *words: str) -> int:
        """Run pytest there; return how many tests passed, of which none may fail."""
        shown = self.run("-m", "pytest", "-q", "-p", "no:cacheprovider", *words)
        passed = re.search(r"(\d+) passed", shown)
        return int(passed[1]) if passed else 0


@pytest.fixture
def checkout(tmp_path: Path) -> Checkout:
    return Checkout(tmp_path / "evenbreak")


def test_the_page_has_a_section_for_each_kind() -> None:
    assert set(SECTIONS) == {"Add a game", "Add a chart", "Add a handicap system"}


def test_a_game(checkout: Checkout) -> None:
    [module] = checkout.follow("Add a game")
    contract, plots, _ = RUN.findall(SECTIONS["Add a game"])[0].split()
    assert checkout.passes(contract, plots, "-k", "ghost") > 10
    assert checkout.passes(str(module), "tests/test_lazy.py", *LAYERS) > 10
    code = "import evenbreak.games as g; print(g.__file__, g.Ghost(0.5).winner(-2))"
    assert checkout.run("-c", code) == f"{checkout.place}/src/evenbreak/games/__init__.py 2\n"


def test_a_chart(checkout: Checkout) -> None:
    checkout.follow("Add a chart")
    *rooms, _ = RUN.findall(SECTIONS["Add a chart"])[0].split()
    assert checkout.passes(*rooms, "-k", "example_7") > 2
    assert "example_7,An example of races to 7,difference,7,7,13,3" in checkout.asks("chart list")
    assert '"example_7"' in checkout.asks("ladder --chart example_7 --json")


def test_a_system(checkout: Checkout) -> None:
    [module] = checkout.follow("Add a handicap system")
    contract, _ = RUN.findall(SECTIONS["Add a handicap system"])[0].split()
    assert checkout.passes(contract, "-k", "shutout") > 5
    assert checkout.passes(str(module), *LAYERS) > 10
    assert '"shutout"' in checkout.asks("ladder --system shutout --json")


@pytest.mark.parametrize("section", SECTIONS)
def test_the_examples_pass_the_linter(section: str, checkout: Checkout) -> None:
    for path in checkout.follow(section):
        if path.suffix == ".py":
            checkout.run("-m", "ruff", "check", "-q", str(path))
            checkout.run("-m", "ruff", "format", "-q", "--check", str(path))


@pytest.mark.parametrize("path", re.findall(r"\]\(([^)]+)\)", PAGE))
def test_links_lead_somewhere(path: str) -> None:
    assert (ROOT / path).exists()
