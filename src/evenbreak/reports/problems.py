"""All that is wrong with a file, gathered so that a person can mend it in one go."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from evenbreak.errors import DataError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["SHOWN", "Problems", "quoted"]

SHOWN = 20
"""How many problems of a file are told; the rest are counted."""

LONGEST_QUOTE = 40


def quoted(text: str) -> str:
    r"""Return text as a message may quote it: short, on one line, harmless to a terminal.

    >>> quoted("six\nhundred"), quoted("9" * 50)
    ("'six\\nhundred'", "'9999999999999999999999999999999999999999'...")
    """
    return repr(text) if len(text) <= LONGEST_QUOTE else repr(text[:LONGEST_QUOTE]) + "..."


class Problems:
    """The problems of one file, told in the order of its lines.

    Parameters
    ----------
    source
        what the file is called in the messages.

    >>> problems = Problems("players.csv")
    >>> problems.add(7, "rating 'six' is not a number; write digits")
    >>> problems.add(None, "there is no column 'player'; add it")
    >>> problems.raise_any()
    Traceback (most recent call last):
    ...
    evenbreak.errors.DataError: players.csv: there is no column 'player'; add it
    players.csv:7: rating 'six' is not a number; write digits
    """

    def __init__(self, source: str) -> None:
        self.source = source
        self._total = 0
        self._told: list[tuple[int, str]] = []

    def __len__(self) -> int:
        return self._total

    def add(self, line: int | None, message: str) -> None:
        """Note one problem: its line (None for the file as a whole), what and how to mend it."""
        self._total += 1
        self._told.append((line or 0, message))

    def add_rows(
        self, lines: NDArray[np.int64], rows: NDArray[np.int64], message: Callable[[int], str]
    ) -> None:
        """Note a problem in each of `rows`; `message` is asked only for those that may be told.

        Parameters
        ----------
        lines
            the line of each row of the table, rising.
        rows
            the rows at fault, rising.
        message
            what is wrong in a row, and how to mend it.
        """
        self._total += len(rows)
        # The first lines of all checks together are among the first lines of each check.
        self._told += [(int(lines[row]), message(int(row))) for row in rows[:SHOWN]]

    def raise_any(self) -> None:
        """Raise what was found, if anything was.

        Raises
        ------
        DataError
            with one line a problem, those of the file as a whole first; beyond the first
            20 only a count.
        """
        if not self._total:
            return
        ordered = sorted(self._told, key=lambda problem: problem[0])[:SHOWN]
        told = [f"{self.source}{f':{line}' if line else ''}: {text}" for line, text in ordered]
        if self._total > SHOWN:
            more = self._total - SHOWN
            told.append(f"{self.source}: and {more:,} more problem{'s' if more > 1 else ''}")
        raise DataError(told)
