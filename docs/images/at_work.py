"""Commands run as on a terminal, in a folder with the sample data."""

from __future__ import annotations

import contextlib
import functools
import io
import os
import shlex
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from unittest import mock

from evenbreak.cli.program import program

DATA = Path(__file__).resolve().parents[2] / "data"
WIDTH = 80


class Screen(io.TextIOWrapper):
    """What takes the place of a terminal."""

    def isatty(self) -> bool:
        """Be one."""
        return True


@contextlib.contextmanager
def desk() -> Iterator[Path]:
    """Stand in a new folder that has the sample data in `data/`."""
    terminal = {"COLUMNS": str(WIDTH), "NO_COLOR": "1", "TERM": "dumb"}
    with tempfile.TemporaryDirectory() as name, mock.patch.dict(os.environ, terminal):
        place = Path(name)
        shutil.copytree(DATA, place / "data", ignore=shutil.ignore_patterns("*.py"))
        with contextlib.chdir(place):
            yield place


@functools.cache
def run(command: str) -> str:
    """Run a command, given without `evenbreak`, and return what it prints to a terminal.

    The same command runs once only.
    """
    screen, aside = Screen(io.BytesIO(), "utf-8"), io.TextIOWrapper(io.BytesIO(), "utf-8")
    with contextlib.redirect_stdout(screen), contextlib.redirect_stderr(aside):
        program.main(shlex.split(command), standalone_mode=False)
    screen.flush()
    return screen.buffer.getvalue().decode()  # type: ignore[attr-defined, no-any-return]
