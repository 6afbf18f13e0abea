"""Long work is announced before it starts: a terminal prints a line, an API rejects it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Told = Callable[[str], None]

_TOLD: ContextVar[Told | None] = ContextVar("told", default=None)


@contextmanager
def told(whom: Told) -> Iterator[None]:
    """Announce long work to a function, which may raise an error instead of waiting."""
    before = _TOLD.set(whom)
    try:
        yield
    finally:
        _TOLD.reset(before)


def takes_long(why: str) -> None:
    """Announce that the work starting now will take long, and why.

    >>> with told(print):
    ...     takes_long("this can take a minute")
    this can take a minute
    """
    if (whom := _TOLD.get()) is not None:
        whom(why)
