"""A command run in this process, its output and its exit code."""

from collections.abc import Callable

import pytest
from click.testing import CliRunner, Result

from evenbreak.cli.base import program

Run = Callable[..., Result]


@pytest.fixture(scope="session")
def run() -> Run:
    """Run the words of a command line; `stdin` is text or bytes."""

    def run_words(*words: str, stdin: str | bytes | None = None) -> Result:
        result = CliRunner().invoke(program, list(words), input=stdin)
        assert result.exception is None or isinstance(result.exception, SystemExit)
        return result

    return run_words
