"""A command run in this process, its output and its exit code."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from click.testing import CliRunner, Result

from evenbreak.cli.program import program

Run = Callable[..., Result]


@pytest.fixture(scope="session")
def run() -> Run:
    """Run the words of a command line; `stdin` is text or bytes."""

    def run_words(*words: str, stdin: str | bytes | None = None) -> Result:
        result = CliRunner().invoke(program, list(words), input=stdin)
        assert result.exception is None or isinstance(result.exception, SystemExit)
        return result

    return run_words


@pytest.fixture
def ask(run: Run) -> Callable[..., Any]:
    """Run the words of a command line and return its JSON."""

    def answer(*words: str) -> Any:
        result = run(*words, "--json")
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return answer


@pytest.fixture(scope="session")
def ask_physics(run: Run) -> Callable[[str, str], dict[str, Any]]:
    """Return the JSON that a command of `physics` answers to a line of options."""

    def answer(name: str, line: str) -> dict[str, Any]:
        result = run("physics", name, "--json", *line.split())
        assert (result.exit_code, result.stderr) == (0, "")
        data: dict[str, Any] = json.loads(result.stdout)
        return data

    return answer
