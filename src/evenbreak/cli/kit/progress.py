"""A bar on a terminal that shows how far long work is, or only that it goes on.

A terminal that cannot move its cursor, and a file, get a plain line now and then instead.
"""

from __future__ import annotations

import math
import os
import sys
import threading
import time
from typing import TYPE_CHECKING, Self

import click

if TYPE_CHECKING:
    from rich.progress import Progress as RichProgress

SILENCE = 2.0
"""The longest that a command says nothing on a terminal."""

PATIENCE = 1.0
"""Seconds before work that is counted shows its bar."""

PATIENCE_IN_A_FILE = 10.0
"""Seconds before stderr says how far the work is, where it has no bar."""

BETWEEN_LINES = 30.0
"""Seconds until it says so again; of work that takes long, a tenth of the time so far."""

_lock = threading.Lock()
_bar: RichProgress | None = None
"""What the terminal shows just now."""

_counting = 0
"""How many `Progress` have something to count just now."""


def _show(begun: float, what: str, done: int = 0, total: int | None = None) -> None:
    """Show the bar of work that started then; without a total it moves to and fro."""
    global _bar
    with _lock:
        if _bar is None:
            from rich.console import Console  # only now: it takes a while to load
            from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

            _bar = Progress(
                BarColumn(bar_width=16),
                TextColumn("{task.description}"),
                TimeElapsedColumn(),
                console=Console(file=sys.stderr),
                transient=True,
                redirect_stdout=False,
                redirect_stderr=False,
            )
            _bar.add_task(what, total=total)
            _bar.tasks[0].start_time = begun
            _bar.start()
        _bar.update(_bar.task_ids[0], description=what, completed=done, total=total)


def erase() -> None:
    """Erase the bar, before something else is printed."""
    global _bar
    with _lock:
        if _bar is not None:
            _bar.stop()
            _bar = None


def _has_bar() -> bool:
    """Return whether stderr is a terminal that can show a bar."""
    stderr = sys.stderr
    return stderr is not None and stderr.isatty() and os.environ.get("TERM") != "dumb"


class Working:
    """A bar that shows that a command still works, unless it counts by itself.

    >>> with Working():
    ...     pass
    """

    def __enter__(self) -> None:
        """Start the clock."""
        self._begun = time.monotonic()
        self._timer = threading.Timer(SILENCE, self._show)
        self._timer.daemon = True
        # What is read from a terminal may be waited for.
        if _has_bar() and "-" not in sys.argv[1:]:
            self._timer.start()

    def _show(self) -> None:
        if not _counting and not self._timer.finished.is_set():
            _show(self._begun, "Working; Ctrl-C stops it")

    def __exit__(self, *_: object) -> None:
        """Erase the bar."""
        self._timer.cancel()
        erase()


class Progress:
    """A bar that counts, shown only if the work takes long, and erased at its end."""

    def __init__(self, what: str) -> None:
        self._what = what
        self._begun = time.monotonic()
        self._has_bar = _has_bar()
        self._next = self._begun + (PATIENCE if self._has_bar else PATIENCE_IN_A_FILE)

    def __call__(self, count: int, total: int | None = None, part: float | None = None) -> None:
        """Show how many are done and, if the total is known, how long the rest will take.

        `part` says what part of the work they are, where some take longer than others.
        """
        seconds = time.monotonic() - self._begun
        if self._begun + seconds < self._next:
            return
        line = f"{count:,} {self._what} so far"
        done = 0.0
        if total is not None:
            done = count / total if part is None else part
            of = "" if part is None else " of the work"
            line = f"{count:,} of {total:,} {self._what} ({math.floor(100 * done + 1e-9)}%{of})"
            line += f", {_left(seconds, done)}"
        if self._has_bar:
            _show(self._begun, line, round(1000 * done), None if total is None else 1000)
        elif done < 1.0:
            self._next = self._begun + seconds + max(BETWEEN_LINES, seconds / 10.0)
            click.echo(f"{line} ...", err=True)

    def __enter__(self) -> Self:
        """Start the clock."""
        global _counting
        _counting += 1
        return self

    def __exit__(self, *_: object) -> None:
        """Erase the bar."""
        global _counting
        _counting -= 1
        erase()


def _left(seconds: float, done: float) -> str:
    """Say how long the rest takes at the pace so far.

    >>> _left(20.0, 0.25), _left(1200.0, 0.125), _left(3.0, 0.0)
    ('about 60 s left', 'about 2 h 20 min left', 'time left not yet known')
    """
    if done <= 0.0:
        return "time left not yet known"
    left = math.ceil(round(seconds * (1.0 - done) / done, 6))
    if left < 100:
        return f"about {left} s left"
    minutes = round(left / 60)
    hours = f"{minutes // 60} h " if minutes >= 60 else ""
    return f"about {hours}{minutes % 60} min left"
