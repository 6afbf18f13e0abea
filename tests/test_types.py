"""User code passes a strict type checker, with argument names of its own."""

import subprocess
import sys

import pytest

import user_code
from places import ROOT


def test_user_code_passes_mypy() -> None:
    mypy = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "tests/user_code.py"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert mypy.stdout == ""
    assert mypy.returncode == 0, mypy.stderr


@pytest.mark.parametrize(
    "ask",
    [
        user_code.own_games,
        user_code.matches,
        user_code.chains,
        user_code.ratings,
        user_code.pictures,
    ],
)
def test_user_code_runs(ask) -> None:
    ask()
