"""A line on stderr that shows the progress of a long computation, or that it takes long."""

import math
import sys
import threading
import time
from typing import Self

import click

SILENCE = 2.0
"""The longest that a command says nothing on a terminal."""

PATIENCE = 1.0
"""Seconds before the line first appears."""

PATIENCE_IN_A_FILE = 10.0
"""Seconds before stderr says once that the work goes on, where it is not a terminal."""

_PAUSE = 0.1
"""Seconds between two updates."""

_lock = threading.Lock()
_shown = 0
"""How many letters are on the line."""

_counting = 0
"""How many `Progress` have something to count just now."""


def _show(line: str) -> None:
    """Write the line over on the terminal; an empty one erases it."""
    global _shown
    with _lock:
        end = "" if line else "\r"
        click.echo("\r" + line.ljust(_shown) + end, nl=False, err=True)
        _shown = len(line)


def erase() -> None:
    """Erase the line, before something else is printed."""
    if _shown:
        _show("")


class Working:
    """A line on a terminal that shows that a command still works, unless it counts by itself.

    >>> with Working():
    ...     pass
    """

    def __init__(self) -> None:
        self._done = threading.Event()

    def __enter__(self) -> None:
        """Start the clock."""
        # What is read from a terminal may be waited for.
        if sys.stderr is not None and sys.stderr.isatty() and "-" not in sys.argv[1:]:
            threading.Thread(target=self._show, daemon=True).start()

    def _show(self) -> None:
        begun = time.monotonic()
        while not self._done.wait(SILENCE if time.monotonic() - begun < SILENCE else 1.0):
            if not _counting:
                seconds = round(time.monotonic() - begun)
                _show(f"Working, {seconds} s so far; Ctrl-C stops it ...")

    def __exit__(self, *_: object) -> None:
        """Erase the line."""
        self._done.set()
        erase()


class Progress:
    """A line that counts, shown only if the work takes long.

    On a terminal it is written over again and again, and erased at the end. Elsewhere one line
    is printed, and no more.

    Parameters
    ----------
    what
        what is counted, such as 'charts designed'.

    >>> with Progress("charts designed") as progress:
    ...     progress(1)
    >>> with Progress("seasons") as progress:
    ...     progress(250, 1000)
    """

    def __init__(self, what: str) -> None:
        self._what = what
        self._begun = time.monotonic()
        self._terminal = sys.stderr is not None and sys.stderr.isatty()
        self._next = self._begun + (PATIENCE if self._terminal else PATIENCE_IN_A_FILE)

    def __call__(self, count: int, total: int | None = None) -> None:
        """Show how many are done and, if the total is known, how long the rest will take."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + _PAUSE if self._terminal else math.inf
        line = f"{count} {self._what} so far ..."
        if total is not None:
            line = f"{count:,} of {total:,} {self._what} ({100 * count // total}%)"
            line += f", {_left(now - self._begun, count, total)} ..."
        if not self._terminal:
            click.echo(line, err=True)
            return
        _show(line)

    def __enter__(self) -> Self:
        """Start the clock."""
        global _counting
        _counting += 1
        return self

    def __exit__(self, *_: object) -> None:
        """Erase the line."""
        global _counting
        _counting -= 1
        erase()


def _left(seconds: float, count: int, total: int) -> str:
    """Say how long the rest takes at the pace so far.

    >>> _left(20.0, 250, 1000), _left(1200.0, 2, 16), _left(3.0, 0, 9)
    ('about 60 s left', 'about 2 h 20 min left', 'time left not yet known')
    """
    if not count:
        return "time left not yet known"
    left = math.ceil(seconds / count * (total - count))
    if left < 100:
        return f"about {left} s left"
    minutes = round(left / 60)
    hours = f"{minutes // 60} h " if minutes >= 60 else ""
    return f"about {hours}{minutes % 60} min left"
