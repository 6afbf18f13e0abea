"""Practice files: the attempts at a drill, and the scores of drills."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.tables import cells as date_cells
from evenbreak.files.tables.cells import numbers, read_cells, whole_numbers
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.table import TextTable, read_table
from evenbreak.practice.drill_log import MOST_LEVELS, DrillLog
from evenbreak.ratings.result_words import letters
from evenbreak.stats.confidence import LARGEST

DRILL = {"drill": ("exercise", "drill name")}
"""The column that names the drill, with its other names."""

NAMED = 6
"""How many drills a message names."""


def rows_of_drill(
    table: TextTable, drill: str | None, *, as_above: bool = False
) -> NDArray[np.int64]:
    """Return the rows of one drill, noting as a problem what leaves open which rows these are.

    Parameters
    ----------
    table
        of which `DRILL` may be a column; without it all rows are of one drill.
    drill
        the drill asked about, in any case; None: the only one of the file.
    as_above
        whether an empty cell means the same drill as the cell above it.
    """
    rows = np.arange(len(table))
    if "drill" not in table:
        if drill is not None:
            table.problems.add(None, "has no column 'drill'; leave --drill out")
        return rows
    cells = table.cells("drill")
    if as_above:
        for row in range(1, len(cells)):
            cells[row] = cells[row] or cells[row - 1]
    if any(cells):
        for line, text in zip(table.lines.tolist(), cells, strict=True):
            if not text:
                table.problems.add(line, "drill is empty; write which drill it was")
    names: dict[str, str] = {}
    for text in filter(None, cells):
        names.setdefault(letters(text) or text, text)
    listed = ", ".join(quoted(name) for name in list(names.values())[:NAMED])
    listed += ", ..." * (len(names) > NAMED)
    if drill is None:
        if len(names) > 1:
            table.problems.add(
                None, f"has {len(names)} drills ({listed}); name one of them with --drill"
            )
        return rows
    asked = letters(drill) or drill
    if asked not in names:
        table.problems.add(None, f"has no drill {quoted(drill)}; it has {listed or 'no names'}")
    return np.flatnonzero([(letters(text) or text) == asked for text in cells])


def source_of(table: TextTable, drill: str | None) -> str:
    """Return what the rows of a drill are called in messages."""
    return table.source if drill is None else f"{table.source}, drill {quoted(drill)}"


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

    Encoding, separator and header are handled by `evenbreak.files.tables.table`; the columns are
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


SCORE = {"score": ("points", "result", "total", "balls")}
MORE_OF_SCORES = {"date": ("day", "practised on", "played on"), **DRILL}


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
    table = read_table(path, SCORE, MORE_OF_SCORES, rows="scores")
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
