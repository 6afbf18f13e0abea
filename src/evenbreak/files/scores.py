"""From a file of practice scores to numbers, with everything that is wrong in it told at once."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.cells import dates, numbers
from evenbreak.files.text_table import TextTable, read_table
from evenbreak.stats.confidence import LARGEST

REQUIRED = {"score": ("points", "result", "total", "balls")}
OPTIONAL = {"date": ("day", "practised on", "played on")}


class ScoresFile(NamedTuple):
    """The scores of a file, in the order of its rows.

    `dates` has the day of each score; it is None where the file does not date them all.
    """

    scores: NDArray[np.float64]
    dates: NDArray[np.datetime64] | None
    source: str
    warnings: tuple[str, ...]


def read_scores(path: str | Path) -> ScoresFile:
    r"""Read practice scores from a CSV file, a row a score; '-' is standard input.

    Raises
    ------
    DataError
        with all that is wrong in the file: no column of scores, no rows, scores that are
        no numbers or too large, dates that are none.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "scores.csv"
    ...     _ = path.write_text("Date;Points\n2024-09-03;50\n2024-09-10;44,5\n")
    ...     file = read_scores(path)
    >>> file.scores, str(file.dates[0])
    (array([50. , 44.5]), '2024-09-03')
    """
    table = read_table(path, REQUIRED, OPTIONAL)
    if not len(table) and not len(table.problems):
        table.problems.add(None, "has no scores below its header; write one line for each")
    scores = numbers(table, "score", remedy="write one such as 48").values
    table.problems.add_rows(
        table.lines,
        np.flatnonzero(np.abs(scores) > LARGEST),
        lambda row: f"score {scores[row]:g} is not from {-LARGEST:g} to {LARGEST:g}; correct it",
    )
    days = dates(table, "date").values
    table.problems.raise_any()
    undated = np.flatnonzero(np.isnat(days))
    dated = not undated.size
    return ScoresFile(
        scores,
        days if dated else None,
        table.source,
        (*table.warnings, *([] if dated else _undated(table, undated))),
    )


def _undated(table: TextTable, rows: NDArray[np.int64]) -> list[str]:
    """Return a warning if some scores are dated and others, `rows`, are not."""
    if "date" not in table or rows.size == len(table):
        return []
    many = f"{rows.size} dates are" if rows.size > 1 else "the date is"
    return [f"{table.source}:{table.lines[rows[0]]}: {many} missing; no date is used"]
