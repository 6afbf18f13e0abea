"""What the tests of the match commands share: asking as JSON, and being refused."""

import json
from collections.abc import Callable
from typing import Any

import pytest

WORDS = {"heading", "sentences", "details", "warnings", "schema_version"}
"""The keys that every answer has."""


@pytest.fixture(scope="session")
def ask(run) -> Callable[..., dict[str, Any]]:
    """Return what a command answers with --json, the keys that all answers have left out."""

    def answer(name: str, *words: str, stdin: str | bytes | None = None) -> dict[str, Any]:
        result = run(name, "--json", *words, stdin=stdin)
        assert (result.exit_code, result.stderr) == (0, "")
        told = json.loads(result.stdout)
        assert set(told) >= WORDS
        assert (told["schema_version"], told["warnings"]) == (1, [])
        return {key: value for key, value in told.items() if key not in WORDS}

    return answer


@pytest.fixture(scope="session")
def refused(run) -> Callable[..., str]:
    """Return the one error line of a command that is used wrongly."""

    def error(*words: str) -> str:
        result = run(*words)
        assert (result.exit_code, result.stdout) == (2, "")
        (line,) = [text for text in result.stderr.splitlines() if text.startswith("Error: ")]
        return line

    return error
