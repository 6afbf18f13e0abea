"""Reading a file of drill attempts as a `DrillLog`, with all its problems at once."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.files.cells import read_cells, whole_numbers
from evenbreak.files.drill_rows import DRILL, rows_of_drill, source_of
from evenbreak.files.text_table import TextTable, read_table
from evenbreak.practice.drill_log import MOST_LEVELS, DrillLog

if TYPE_CHECKING:
    from numpy.typing import NDArray

REQUIRED = {
    "level": ("difficulty", "step", "balls"),
    "success": ("made", "made it", "succeeded", "result", "outcome"),
}
"""The columns that a drill log must have, with their other names."""

OPTIONAL = {
    "session": ("practice session", "visit", "evening"),
    "date": ("day", "practised on", "played on"),
    **DRILL,
}
"""The columns that a drill log may have, with their other names."""

WORDS = {
    **dict.fromkeys(("yes", "y", "true", "t", "1", "made", "make", "success", "hit"), True),
    **dict.fromkeys(
        ("no", "n", "false", "f", "0", "missed", "miss", "failed", "fail", "failure"), False
    ),
}
"""The words of the column success, in upper or lower case."""


@dataclass(frozen=True, eq=False)
class DrillLogFile:
    """The content of a file of drill attempts.

    Parameters
    ----------
    log
        its attempts, in the order of the file.
    source
        the name of the file in messages.
    warnings
        what to check although the file can be used, a line each.
    """

    log: DrillLog
    source: str
    warnings: tuple[str, ...]


def read_drill_log(
    path: str | Path, *, levels: int | None = None, drill: str | None = None
) -> DrillLogFile:
    r"""Read the attempts of a progressive drill from a CSV file; '-' is standard input.

    Encoding, separator and header are handled by `evenbreak.files.text_table`; the columns are
    those of `REQUIRED` and `OPTIONAL`, with one row for each attempt, in the order in which they
    were made. A new session begins where session, date or drill differ from the row above; an
    empty cell means the same as the cell above. A row that breaks the rule of the drill within a
    session counts as a new start, with a warning.

    Parameters
    ----------
    path
        the file.
    levels
        how many levels the drill has; None takes the highest one in the file.
    drill
        whose attempts are read, if the file has several drills.

    Raises
    ------
    DataError
        with every problem of the file, a line each.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "drill.csv"
    ...     _ = path.write_text("Level;Made it\n1;yes\n2;no\n1;yes\n", encoding="utf-8")
    ...     file = read_drill_log(path)
    >>> file.log.attempts, file.log.successes
    (array([2, 1]), array([2, 0]))
    """
    table = read_table(path, REQUIRED, OPTIONAL, rows="attempts")
    level = whole_numbers(
        table,
        "level",
        at_least=1,
        at_most=MOST_LEVELS if levels is None else levels,
        remedy="write 1, 2, 3, ..." + (", or give the drill more levels" if levels else ""),
    ).values
    success = read_cells(
        table,
        "success",
        lambda text: WORDS.get(text.casefold()),
        wanted="yes or no",
        remedy="write one of them, and a row for each attempt",
        dtype=np.bool_,
        empty=False,
    ).values
    rows = rows_of_drill(table, drill, as_above=True)
    table.problems.raise_any()
    log = DrillLog(level[rows], success[rows], session=_sessions(table)[rows], levels=levels)
    warnings = (*table.warnings, *_jump_warning(table, log, rows))
    return DrillLogFile(log, source_of(table, drill), warnings)


def _sessions(table: TextTable) -> NDArray[np.int64]:
    """Return a number for each row that changes where the session or the date does."""
    changes = np.zeros(len(table), dtype=bool)
    for name in OPTIONAL:
        distinct, codes = table.columns[name]
        stated = np.array([bool(text) for text in distinct], dtype=bool)[codes]
        # The last row with something in the cell: an empty cell means the same as that one.
        said = np.maximum.accumulate(np.where(stated, np.arange(len(table)), 0))
        changes[1:] |= codes[said][1:] != codes[said][:-1]
    return changes.cumsum()


def _jump_warning(table: TextTable, log: DrillLog, rows: NDArray[np.int64]) -> list[str]:
    if not len(log.jumps):
        return []
    row = int(log.jumps[0])
    step = 1 if log.success[row - 1] else -1
    by_rule = min(max(int(log.level[row - 1]) + step, 1), len(log.attempts))
    count = len(log.jumps)
    such = f"{count:,} such rows count as new starts" if count > 1 else "it counts as a new start"
    return [
        f"{table.source}:{table.lines[rows[row]]}: level {log.level[row]} follows a "
        f"{'success' if step > 0 else 'miss'} at level {log.level[row - 1]}, which leads to level "
        f"{by_rule}; {such}. Keep the rows in the order of the attempts; a column session or date "
        "says where a session begins"
    ]
