"""From a file of drill attempts to `DrillLog`, with everything that is wrong in it told at once."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.files.cells import read_cells, whole_numbers
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
}
"""The columns that a drill log may have, with their other names."""

WORDS = {
    **dict.fromkeys(("yes", "y", "true", "t", "1", "made", "make", "success", "hit"), True),
    **dict.fromkeys(
        ("no", "n", "false", "f", "0", "missed", "miss", "failed", "fail", "failure"), False
    ),
}
"""What a cell of the column success may say, in any case."""


@dataclass(frozen=True, eq=False)
class DrillLogFile:
    """What a file of drill attempts says.

    Parameters
    ----------
    log
        its attempts, in the order of the file.
    source
        what the file is called in messages.
    warnings
        what a person should look at although the file can be used, a line each.
    """

    log: DrillLog
    source: str
    warnings: tuple[str, ...]


def read_drill_log(path: str | Path, *, levels: int | None = None) -> DrillLogFile:
    r"""Read the attempts of a progressive drill from a CSV file; '-' is standard input.

    Encoding, separator and header are read as `evenbreak.files.text_table` says; the
    columns are those of `REQUIRED` and `OPTIONAL`, a row an attempt, in the order in which
    they were made. A row whose session or date differs from that of the row above begins
    a session; an empty cell stands for what is above it. A row that does not follow the
    drill's rule within a session is taken as a new start, with a warning.

    Parameters
    ----------
    path
        the file.
    levels
        how many levels the drill has; None takes the highest one in the file.

    Raises
    ------
    DataError
        with every problem of the file, a line each, if there is any.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "drill.csv"
    ...     _ = path.write_text("Level;Made it\n1;yes\n2;no\n1;yes\n", encoding="utf-8")
    ...     file = read_drill_log(path)
    >>> file.log.attempts, file.log.successes
    (array([2, 1]), array([2, 0]))
    """
    table = read_table(path, REQUIRED, OPTIONAL)
    if not len(table) and not len(table.problems):
        table.problems.add(None, "has no attempts below its header; write one line for each")
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
        wanted="a word for a success or a miss",
        remedy="write yes or no, and a row for each attempt",
        dtype=np.bool_,
        empty=False,
    ).values
    table.problems.raise_any()
    log = DrillLog(level, success, session=_sessions(table), levels=levels)
    return DrillLogFile(log, table.source, (*table.warnings, *_jump_warning(table, log)))


def _sessions(table: TextTable) -> NDArray[np.int64]:
    """Return a number for each row that changes where the session or the date does."""
    changes = np.zeros(len(table), dtype=bool)
    for name in OPTIONAL:
        distinct, codes = table.columns[name]
        stated = np.array([bool(text) for text in distinct], dtype=bool)[codes]
        # The last row that says something: of empty cells it is the one above that does.
        said = np.maximum.accumulate(np.where(stated, np.arange(len(table)), 0))
        changes[1:] |= codes[said][1:] != codes[said][:-1]
    return changes.cumsum()


def _jump_warning(table: TextTable, log: DrillLog) -> list[str]:
    if not len(log.jumps):
        return []
    row = int(log.jumps[0])
    step = 1 if log.success[row - 1] else -1
    ruled = min(max(int(log.level[row - 1]) + step, 1), len(log.attempts))
    many = len(log.jumps)
    taken = f"{many:,} such rows are taken as new starts" if many > 1 else "it is a new start"
    return [
        f"{table.source}:{table.lines[row]}: level {log.level[row]} follows a "
        f"{'success' if step > 0 else 'miss'} at level {log.level[row - 1]}, which leads to level "
        f"{ruled}; {taken}. Rows stand in the order of the attempts; a column session or date "
        "says where one begins"
    ]
