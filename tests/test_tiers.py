"""Every test is run by one of the commands of the three tiers, whatever its marks."""

import re
from itertools import product

import pytest

from places import ROOT
from tiers import SHARES, examples

RULES = {"parametrize", "skipif", "skip", "xfail", "usefixtures", "filterwarnings"}
"""Marks of pytest that take no test out of a run without a word."""


def text(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def recipe(target: str) -> str:
    """Return the lines of a target of the Makefile."""
    (lines,) = re.findall(rf"^{target}:.*\n((?:\t.*\n)+)", text("Makefile"), re.MULTILINE)
    return str(lines)


def develop() -> str:
    """Return the README's second command, which `.ci/run` reads and runs."""
    assert "develop=$(readme_command 2)" in text(".ci/run")
    return re.findall(r"^```sh\n(.*)\n```$", text("README.md"), re.MULTILINE)[1]


def rest() -> str:
    """Return the targets that `.ci/run` makes after the first tier."""
    assert re.search(r"^make .* check-rest ", text(".ci/run"), re.MULTILINE)
    return re.findall(r"^check-rest: (.*?) *##", text("Makefile"), re.MULTILINE)[0]


def chosen_marks(command: str) -> str:
    """Return the marks by which a command chooses; it may leave out tests by nothing else."""
    (marks,) = re.findall(r'-m "([^"]*)"', command)
    arguments = command.partition(f'-m "{marks}"')[2].strip()
    assert not re.search(r"(^| )(-k|--ignore|--deselect|--maxfail|-x)", command)
    assert arguments == "", "no paths: all that is in testpaths"
    return marks


def runs(marks: str, slow: bool, thorough: bool, drawn: bool) -> bool:
    """Return whether an expression chooses a test with these marks, as pytest would."""
    names = {"slow": slow or thorough, "thorough": thorough, "drawn": drawn}
    return bool(eval(marks, {"__builtins__": {}}, names))  # noqa: S307


def test_no_test_is_in_none_of_the_tiers() -> None:
    assert "slow" in rest().split()
    tiers = [chosen_marks(command) for command in (develop(), recipe("slow"), recipe("thorough"))]
    assert tiers == ["not slow", "slow and not thorough", "thorough or drawn"]
    for marks in product((False, True), repeat=3):
        assert any(runs(tier, *marks) for tier in tiers), marks
    # What CI runs, it runs once.
    assert not any(
        runs(tiers[0], *m) and runs(tiers[1], *m) for m in product((False, True), repeat=3)
    )
    assert chosen_marks(recipe("test")) == tiers[0]


def test_the_examples_of_the_sources_are_a_step_of_ci() -> None:
    assert "doctests" in rest().split()
    assert recipe("doctests").split()[-1] == "src"
    assert "--doctest-modules" in text("pyproject.toml")


def test_each_tier_has_more_examples_than_the_one_before() -> None:
    assert SHARES["first"] < SHARES["ci"] < SHARES["thorough"]
    assert "EVENBREAK_TIER=thorough EVENBREAK_TRIES=200" in recipe("thorough")
    assert "EVENBREAK_TIER=ci" in recipe("slow")
    assert "export EVENBREAK_TIER=ci" in text(".ci/run")
    assert examples(1000) >= 400


def test_marks_choose_a_tier_or_come_from_pytest() -> None:
    used = {
        mark
        for path in (ROOT / "tests").rglob("*.py")
        for mark in re.findall(r"pytest\.mark\.(\w+)", path.read_text(encoding="utf-8"))
    }
    assert used <= RULES | {"slow", "slow_after", "thorough"}


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("row", [(k, name) for k in range(2) for name in "ab"])
def test_rows_after_the_first_ones_are_slow(
    row: tuple[int, str], request: pytest.FixtureRequest
) -> None:
    assert (request.node.get_closest_marker("slow") is not None) == (row[0] > 0)
