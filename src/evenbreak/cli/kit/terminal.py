"""The two streams of a command: the answer on stdout, everything else on stderr."""

from __future__ import annotations

import sys

import click

from evenbreak.answers.faces.to_text import WIDTH, paragraph
from evenbreak.files.problems import printable


def to_terminal() -> bool:
    """Return whether the output goes to a terminal."""
    return sys.stdout is not None and sys.stdout.isatty()


def write(text: str) -> None:
    """Write text to stdout; letters that the terminal cannot show become question marks."""
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    click.echo(text.encode(encoding, "replace"), nl=False)


def say(message: str) -> None:
    """Print a message on stderr; on a terminal its lines are wrapped."""
    terminal = sys.stderr is not None and sys.stderr.isatty()
    # File names stay whole, so that they can be copied.
    click.echo(paragraph(message, WIDTH) if terminal else printable(message), err=True)
