"""A line on stderr that tells how far a long answer is."""

from __future__ import annotations

import sys
import time
from typing import Self

import click

__all__ = ["Progress"]

PATIENCE = 1.0
"""Seconds without a word that nobody minds."""

_PAUSE = 0.1
"""Between two lines, in seconds."""


class Progress:
    """A line that counts, on a terminal only and only of what takes long.

    Parameters
    ----------
    what
        what is counted, such as 'charts designed'.

    >>> with Progress("charts designed") as progress:
    ...     progress(1)
    """

    def __init__(self, what: str) -> None:
        self._what, self._shown = what, 0
        self._next = time.monotonic() + PATIENCE

    def __call__(self, count: int) -> None:
        """Tell how many there are so far."""
        now = time.monotonic()
        if now < self._next or not sys.stderr.isatty():
            return
        self._next = now + _PAUSE
        line = f"{count} {self._what} so far ..."
        click.echo("\r" + line.ljust(self._shown), nl=False, err=True)
        self._shown = len(line)

    def __enter__(self) -> Self:
        """Begin to wait."""
        return self

    def __exit__(self, *_: object) -> None:
        """Wipe the line out."""
        if self._shown:
            click.echo("\r" + " " * self._shown + "\r", nl=False, err=True)
