"""The options of a command's answer: which face, which page, which details."""

import json
from pathlib import Path
from typing import Any

import click
import pytest
from click.testing import CliRunner, Result

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Column, Quantities, Quantity
from evenbreak.cli.kit.faces import faces

ANSWER = Answer(
    "A coin is tossed.",
    (
        "Heads comes up half the time.",
        Quantities(
            (
                Quantity(Column("p", "P(heads)"), 0.5),
                Quantity(Column("sd", "SD", detail=True), 0.25),
            )
        ),
    ),
    warnings=("it may be bent",),
)


def command_of(**options: Any) -> click.Command:
    @click.command()
    @faces(**options)
    def toss() -> Answer:
        return ANSWER

    return toss


def run(*words: str, **options: Any) -> Result:
    return CliRunner().invoke(command_of(**options), list(words), catch_exceptions=False)


def test_a_pipe_gets_csv_and_the_words_go_to_stderr() -> None:
    result = run()
    assert "p,0.500000" in result.stdout
    assert "Heads comes up" in result.stderr
    assert run("--csv").stdout == result.stdout


def test_a_terminal_gets_text(monkeypatch: pytest.MonkeyPatch) -> None:
    text = run("--text").stdout
    assert text.startswith("A coin is tossed.\n")
    monkeypatch.setattr("evenbreak.cli.kit.faces.to_terminal", lambda: True)
    assert run().stdout == text
    assert run(always_text=True).stdout == text


def test_details_are_shown_only_if_asked_for() -> None:
    assert "SD" not in run("--text").stdout
    assert "SD" in run("--text", "--verbose").stdout


def test_json_has_everything() -> None:
    assert json.loads(run("--json").stdout)["sd"] == 0.25


def test_warnings_go_to_stderr_in_every_face() -> None:
    for face in ("--text", "--csv", "--json"):
        assert "Warning: it may be bent" in run(face).stderr


def test_a_page_is_written_beside_the_answer(tmp_path: Path) -> None:
    page = tmp_path / "toss.html"
    result = run("--json", "--html", str(page))
    assert json.loads(result.stdout)
    assert "Heads comes up" in page.read_text(encoding="utf-8")
    assert str(page) in result.stderr


def test_a_page_has_the_name_of_a_page() -> None:
    result = run("--html", "toss.txt")
    assert result.exit_code == 2
    assert "toss.txt" in result.stderr


@pytest.mark.parametrize(("options", "missing"), [({"page": False}, "--html"), ({}, "")])
def test_a_command_may_have_a_page_option_of_its_own(options: Any, missing: str) -> None:
    shown = run("--help", **options).stdout
    assert ("--html" in shown) == (missing != "--html")
