"""Why a request is refused: one line in the reader's language."""

from __future__ import annotations

from typing import Any

from evenbreak.errors import EvenbreakError


class RefusalError(EvenbreakError):
    """A request that is refused.

    Parameters
    ----------
    template
        what the reader is told, as `evenbreak.words.say` takes it.
    status
        of HTTP.
    values
        what fills it in.
    """

    def __init__(self, template: str, /, *, status: int = 400, **values: Any) -> None:
        super().__init__(template, **values)
        self.status = status


class MovedOnError(RefusalError):
    """A tap on a page that shows an older score than there is."""
