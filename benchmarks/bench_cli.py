"""From start to answer: `evenbreak odds` beside an interpreter that only imports click and rich.

Both run from a cold start, in turns: once into a pipe, once on a terminal.
"""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

Beside = Callable[..., float]

QUESTION = "odds 612 521 --scale fargo --race 7:7"
OURS = [str(Path(sys.executable).with_name("evenbreak")), *QUESTION.split()]
BARE = [sys.executable, "-c", "import click, rich"]


def into_a_pipe(command: list[str]) -> bytes:
    return subprocess.run(command, check=True, capture_output=True).stdout


def on_a_terminal(command: list[str]) -> bytes:
    ours, theirs = pty.openpty()
    try:
        subprocess.run(command, check=True, stdout=theirs)
        return os.read(ours, 4096) if command is OURS else b""
    finally:
        os.close(theirs)
        os.close(ours)


@pytest.mark.parametrize(
    ("where", "answer"), [(into_a_pipe, b"p_win_a,0.874919"), (on_a_terminal, b"0.8749")]
)
def test_odds_from_start_to_answer(
    beside: Beside, where: Callable[[list[str]], bytes], answer: bytes
) -> None:
    assert answer in where(OURS)
    place = where.__name__.replace("_", " ")
    beside(
        f"`evenbreak {QUESTION}`, {place} / import click, rich",
        lambda: where(OURS),
        lambda: where(BARE),
        rounds=41,
    )
