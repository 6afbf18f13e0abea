"""How an entry of the registry is written down."""

from __future__ import annotations

from functools import partial
from typing import Any

from evenbreak.answers.kit.parts import Column, Show
from evenbreak.answers.kit.wording import decimals

Entry = tuple[str, Column]


def number(
    key: str, words: str | None = None, show: Show | int = str, name: Any = None, **how: Any
) -> Entry:
    """Return an entry of the registry.

    Parameters
    ----------
    key
        what answers call it; its name in files too, unless `name` is another.
    words
        what a person reads, with fields for what only an answer knows; None: it is in files only.
    show
        how a person reads a value; a number is one of decimals.
    name, how
        as for `Column`.
    """
    reads = decimals(show) if isinstance(show, int) else show
    return key, Column(key if name is None else name, words, reads, **how)


text = partial(number, left=True)
"""An entry that a person finds flush left."""

detail = partial(number, detail=True)
"""An entry for those who ask for details."""


def registry(*entries: Entry, files_only: str = "") -> tuple[Entry, ...]:
    """Return entries, and further ones that are names in files and nothing else."""
    return (*entries, *(number(name) for name in files_only.split()))
