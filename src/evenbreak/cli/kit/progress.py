"""A line on stderr that shows the progress of a long computation, or that it takes long."""

import math
import sys
import time
from typing import Self

import click

PATIENCE = 1.0
"""Seconds before the line first appears."""

PATIENCE_IN_A_FILE = 10.0
"""Seconds before stderr says once that the work goes on, where it is not a terminal."""

_PAUSE = 0.1
"""Seconds between two updates."""


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
        self._what, self._shown = what, 0
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
        click.echo("\r" + line.ljust(self._shown), nl=False, err=True)
        self._shown = len(line)

    def __enter__(self) -> Self:
        """Start the clock."""
        return self

    def __exit__(self, *_: object) -> None:
        """Erase the line."""
        if self._shown:
            click.echo("\r" + " " * self._shown + "\r", nl=False, err=True)


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
