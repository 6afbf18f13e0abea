"""How an output format writes: its language, its numbers, its names for parameters and commands."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from gettext import NullTranslations
from typing import Any


def _itself(name: str) -> str:
    return name


def _command_line(name: str, words: Sequence[str]) -> str:
    return " ".join(("evenbreak", name, shlex.join(words))).rstrip()


@dataclass(frozen=True)
class Face:
    """How sentences are phrased in one place: a terminal, a page in German, Python.

    `percent` has {n} for the number; `parameter` returns a name such as '--win-by' for 'win_by';
    `command` returns what a reader does instead of a command, given its name and words; `file`
    returns a path's name.

    >>> Face(decimal=",", group=".").number(1234.5, ",.2f")
    '1.234,50'
    """

    language: str = "en"
    translations: NullTranslations = field(default_factory=NullTranslations)
    decimal: str = "."
    group: str = ","
    percent: str = "{n}%"
    parameter: Callable[[str], str] = _itself
    command: Callable[[str, Sequence[str]], str] = _command_line
    file: Callable[[str], str] = _itself

    def number(self, value: Any, spec: str = "") -> str:
        """Return a number formatted for this place; `spec` is as for `format`."""
        text = format(value, spec)
        digits = text.removesuffix("%") if spec.endswith("%") else text
        shown = digits.translate({ord("."): self.decimal, ord(","): self.group})
        return self.percent.format(n=shown) if digits != text else shown


PYTHON = Face()
"""Plain English, with parameters and commands under their own names: used for `str(sentence)`."""
