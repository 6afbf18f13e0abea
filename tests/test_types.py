"""User code passes a strict type checker, with argument names of its own."""

import tomllib

import pytest

import user_code
from places import ROOT, SRC


def test_mypy_checks_user_code_too() -> None:
    options = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["mypy"]
    assert options["strict"]
    assert "tests/user_code.py" in options["files"]
    assert (SRC / "py.typed").exists()


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
