"""What commands share about values: how a text is a number, and how wrong usage is refused."""

from typing import Any, NoReturn

import click

from evenbreak.cli.kit.said import said
from evenbreak.words import say

SAY_WHICH = "say which with --scale npl, --scale fargo or --scale elo"
"""What to do about ratings that do not show their scale."""


def number_of(text: str) -> float:
    """Return the number that a text means; -0 is 0.

    >>> number_of("1.5"), number_of("-0")
    (1.5, 0.0)
    """
    return float(text) + 0.0


def refuse(template: str, /, **values: Any) -> NoReturn:
    """End the command with exit code 2; the message says how to correct it, as errors do."""
    message = said(say(template, **values) if values else template)
    raise click.UsageError(message, ctx=click.get_current_context(silent=True))
