"""Why a request is refused: one line in the reader's language."""

from __future__ import annotations


class RefusalError(Exception):
    """A request that is refused.

    Parameters
    ----------
    key
        of the sentence in the catalogue.
    status
        of HTTP.
    values
        what the sentence holds.
    """

    def __init__(self, key: str, *, status: int = 400, **values: object) -> None:
        super().__init__(key)
        self.key = key
        self.status = status
        self.values = values
