"""Reading a file of practice scores, with all its problems at once."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.files import date_cells
from evenbreak.files.cells import numbers
from evenbreak.files.drill_rows import DRILL, rows_of_drill, source_of
from evenbreak.files.text_table import TextTable, read_table
from evenbreak.stats.confidence import LARGEST

REQUIRED = {"score": ("points", "result", "total", "balls")}
OPTIONAL = {"date": ("day", "practised on", "played on"), **DRILL}


class ScoresFile(NamedTuple):
    """The scores of a file, in the order of its rows.

    `dates` has the day of each score; it is None unless every score has a date.
    """

    scores: NDArray[np.float64]
    dates: NDArray[np.datetime64] | None
    source: str
    warnings: tuple[str, ...]


def read_scores(
    path: str | Path, *, drill: str | None = None, dates: date_cells.DateOrder | None = None
) -> ScoresFile:
    r"""Read practice scores from a CSV file, one score per row; '-' is standard input.

    Parameters
    ----------
    path
        the file.
    drill
        whose scores are read, if the file has several drills.
    dates
        'mdy' or 'dmy': the order in dates such as 9/3/2024, if no date of the file shows it.

    Raises
    ------
    DataError
        with all problems of the file: no column of scores, no rows, scores that are not
        numbers or too large, dates that cannot be read, several drills and none asked for.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "scores.csv"
    ...     _ = path.write_text("Date;Points\n2024-09-03;50\n2024-09-10;44,5\n")
    ...     file = read_scores(path)
    >>> file.scores, str(file.dates[0])
    (array([50. , 44.5]), '2024-09-03')
    """
    table = read_table(path, REQUIRED, OPTIONAL, rows="scores")
    most = int(LARGEST)
    remedy = "write a score such as 48"
    scores = numbers(table, "score", at_least=-most, at_most=most, remedy=remedy).values
    days = date_cells.dates(table, "date", dates).values
    rows = rows_of_drill(table, drill)
    table.problems.raise_any()
    undated = rows[np.isnat(days[rows])]
    dated = not undated.size
    return ScoresFile(
        scores[rows],
        days[rows] if dated else None,
        source_of(table, drill),
        (*table.warnings, *([] if dated else _undated(table, undated, len(rows)))),
    )


def _undated(table: TextTable, rows: NDArray[np.int64], scores: int) -> list[str]:
    """Return a warning if some scores have a date and others, those of `rows`, do not."""
    if "date" not in table or rows.size == scores:
        return []
    missing = f"{rows.size} dates are missing" if rows.size > 1 else "the date is missing"
    return [f"{table.source}:{table.lines[rows[0]]}: {missing}, so no dates are used"]
