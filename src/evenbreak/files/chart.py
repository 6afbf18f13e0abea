"""From a file to a chart of races, and back, with all that is wrong in it told at once."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from evenbreak.errors import DataError
from evenbreak.files.cells import whole_numbers
from evenbreak.files.problems import Problems, printable, quoted
from evenbreak.files.text_table import TextTable, read_table
from evenbreak.handicaps.charts.chart import CHARTS, Chart, chart
from evenbreak.handicaps.charts.level_chart import LEVEL_CHARTS, LevelChart, level_chart
from evenbreak.handicaps.charts.rows import ChartDraft, ChartRow, row_faults

if TYPE_CHECKING:
    import pandas as pd

DIFFERENCES = {
    "difference_from": ("from", "gap from", "points from"),
    "difference_to": ("to", "gap to", "points to"),
    "stronger_needs": ("stronger", "higher needs", "games stronger"),
    "weaker_needs": ("weaker", "lower needs", "games weaker"),
}
"""The columns of a chart of rating differences, with their other names."""

LEVELS = {
    "level": ("skill level", "own level", "level a"),
    "opponent_level": ("opponent", "opponent skill level", "level b"),
    "needs": ("games", "own games"),
    "opponent_needs": ("opponent games",),
}
"""The columns of a chart of skill levels, with their other names; the last may be missing."""

MOST_MISSING = 20
"""The most missing pairs of levels that are listed one by one."""


@dataclass(frozen=True)
class ChartFile:
    """What a file says of a chart, also where that makes no chart yet.

    Parameters
    ----------
    found
        the rows of a chart of rating differences as they stand, or a chart of skill levels.
    problems
        what keeps those rows from being a chart: gaps and overlaps among them.
    warnings
        what a person should look at although the file can be used, a line each.
    """

    found: ChartDraft | LevelChart
    problems: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def chart(self) -> Chart | LevelChart:
        """The chart; a DataError with all problems where there is none."""
        if self.problems:
            raise DataError(self.problems)
        return self.found if isinstance(self.found, LevelChart) else Chart(*self.found)


def read_chart_file(path: str | Path) -> ChartFile:
    """Read a file of a chart and keep what is wrong with the chart, for `audit` to tell.

    Raises
    ------
    DataError
        where the file says nothing that could be audited: missing columns, cells that are no
        whole numbers, rows that end before they begin; skill levels that make no chart.
    """
    table = read_table(path, {}, {**DIFFERENCES, **LEVELS})
    name = "chart" if str(path) == "-" else printable(Path(path).stem)
    by_level = sum(column in table for column in LEVELS) > sum(
        column in table for column in DIFFERENCES
    )
    _check_columns(table, dict(list(LEVELS.items())[:3]) if by_level else DIFFERENCES)
    if by_level:
        return ChartFile(_levels(table, name), (), table.warnings)
    rows = _rows(table)
    table.problems.raise_any()
    faults = Problems(table.source)
    for place, fault in row_faults(rows):
        faults.add(int(table.lines[place]), fault)
    if any(row.difference_to is not None and row.difference_to < row[0] for row in rows):
        faults.raise_any()
    return ChartFile(ChartDraft(name, rows), _told(faults), table.warnings)


def _check_columns(table: TextTable, needed: Mapping[str, Sequence[str]]) -> None:
    """Note the columns that are missing, or that there are no rows."""
    missing = [column for column in needed if column not in table]
    if not table.found:
        table.problems.add(
            None,
            "has no column of a chart; name the columns "
            f"{', '.join(DIFFERENCES)}, or {', '.join(LEVELS)}",
        )
        table.problems.raise_any()
    for column in missing:
        also = " or ".join(map(quoted, needed[column]))
        table.problems.add(
            None, f"there is no column {column!r}; add it (it may also be called {also})"
        )
    if not len(table.problems) and not len(table):
        table.problems.add(None, "holds no rows of a chart; write one a line below the header")


def _told(problems: Problems) -> tuple[str, ...]:
    """Return the problems, a line each."""
    try:
        problems.raise_any()
    except DataError as error:
        return error.problems
    return ()


def _rows(table: TextTable) -> tuple[ChartRow, ...]:
    """Return the rows as they stand; cells that are no whole numbers are noted."""
    columns = (
        _points(table, "difference_from"),
        _points(table, "difference_to", may_be_empty=True),
        _games(table, "stronger_needs"),
        _games(table, "weaker_needs"),
    )
    return tuple(
        ChartRow(start, end if text else None, stronger, weaker)
        for text, start, end, stronger, weaker in zip(
            table.cells("difference_to"), *columns, strict=True
        )
    )


def _points(table: TextTable, name: str, *, may_be_empty: bool = False) -> list[int]:
    points = whole_numbers(
        table, name, remedy="write whole points, such as 7", may_be_empty=may_be_empty
    )
    return list(map(int, points.values))


def _games(table: TextTable, name: str, *, may_be_empty: bool = False) -> list[int]:
    """Return a column of games, 0 where a cell is empty."""
    games = whole_numbers(
        table,
        name,
        at_least=1,
        remedy="write how many games, such as 5",
        may_be_empty=may_be_empty,
    )
    return list(map(int, games.values))


def _skill(table: TextTable, name: str) -> list[int]:
    skill = whole_numbers(table, name, remedy="write a skill level, such as 4")
    return list(map(int, skill.values))


def _levels(table: TextTable, name: str) -> LevelChart:
    """Return a chart of skill levels, or refuse the file."""
    own, other = _skill(table, "level"), _skill(table, "opponent_level")
    needs, theirs = _games(table, "needs"), _games(table, "opponent_needs", may_be_empty=True)
    table.problems.raise_any()
    found: dict[tuple[int, int], tuple[int, int]] = {}
    for row in range(len(table)):
        pair = own[row], other[row]
        for key, games in ((pair, needs[row]), (pair[::-1], theirs[row])):
            if games:
                _note(table, found, key, games, row)
    levels = sorted({level for pair in found for level in pair})
    missing = [pair for pair in ((i, j) for i in levels for j in levels) if pair not in found]
    for mine, opponent in missing[:MOST_MISSING]:
        table.problems.add(
            None, f"does not say what level {mine} needs against level {opponent}; add a row"
        )
    if len(missing) > MOST_MISSING:
        table.problems.add(None, f"lacks {len(missing) - MOST_MISSING} more pairs of levels")
    for (mine, opponent), (games, row) in found.items():
        against = found.get((opponent, mine), (games, row))[0]
        if mine > opponent and games < against:
            table.problems.add(
                int(table.lines[row]),
                f"level {mine} needs {games} games against level {opponent}, which needs "
                f"{against}; the higher level needs as many at least",
            )
    table.problems.raise_any()
    return LevelChart(name, levels, [[found[i, j][0] for j in levels] for i in levels])


def _note(
    table: TextTable,
    found: dict[tuple[int, int], tuple[int, int]],
    pair: tuple[int, int],
    games: int,
    row: int,
) -> None:
    """Note what one level needs against another, or that an earlier row says otherwise."""
    before, line = found.setdefault(pair, (games, row))
    if before != games:
        table.problems.add(
            int(table.lines[row]),
            f"level {pair[0]} needs {games} games against level {pair[1]} here and {before} in "
            f"line {table.lines[line]}; keep one of the two",
        )


def read_chart(path: str | Path) -> Chart | LevelChart:
    r"""Read a chart of rating differences or of skill levels from a CSV file; '-' is stdin.

    Which of the two it is, its columns say; the chart is called as the file without its ending.

    Raises
    ------
    DataError
        with all that is wrong in the file: missing columns, cells that are no whole numbers,
        gaps and overlaps between the rows, pairs of levels that are missing or said twice.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "ours.csv"
    ...     _ = path.write_text("from,to,stronger,weaker\n0,9,5,5\n10,,5,4\n")
    ...     read_chart(path).race(12)
    (5, 4)
    """
    return read_chart_file(path).chart


def find_chart(name_or_path: str | Path) -> Chart | LevelChart:
    """Return the chart of the package that has this name, or else the one in this file.

    Raises
    ------
    DataError
        where there is neither, or as `read_chart` does.

    >>> find_chart("NPL-10").race(12)
    (5, 4)
    """
    return find_chart_file(name_or_path).chart


def find_chart_file(name_or_path: str | Path) -> ChartFile:
    """Return the chart of the package that has this name, or else what this file says of one."""
    key = re.sub(r"[-\s]+", "_", str(name_or_path).strip().lower())
    if key in CHARTS:
        return ChartFile(ChartDraft(key, tuple(chart(key).rows)), (), ())
    if key in LEVEL_CHARTS:
        return ChartFile(level_chart(key), (), ())
    try:
        return read_chart_file(name_or_path)
    except DataError as error:
        if str(name_or_path) == "-" or _exists(name_or_path):
            raise
        known = ", ".join((*CHARTS, *LEVEL_CHARTS))
        problem = error.problems[0].partition(";")[0]
        raise DataError(
            [f"{problem}, and no chart is called so; name a file, or {known}"]
        ) from None


def _exists(path: str | Path) -> bool:
    try:
        return Path(path).exists()
    except OSError:  # a name that no file can have, such as one of a thousand letters
        return False


def chart_frame(chart: Chart | LevelChart) -> pd.DataFrame:
    """Return a chart as the table that `read_chart` reads.

    >>> chart_frame(find_chart("npl_8")).tail(2)
       difference_from  difference_to  stronger_needs  weaker_needs
    4               40             48               5             2
    5               49           <NA>               6             2
    """
    import pandas as pd

    columns, rows = chart_table(chart)
    return pd.DataFrame(rows, columns=columns).astype("Int64")


def chart_table(chart: Chart | LevelChart) -> tuple[list[str], list[tuple[int | None, ...]]]:
    """Return the columns and rows of the file that `read_chart` reads.

    >>> chart_table(find_chart("npl_8"))[1][-1]
    (49, None, 6, 2)
    """
    if isinstance(chart, Chart):
        return list(DIFFERENCES), [tuple(row) for row in chart.rows]
    levels = chart.levels
    return list(LEVELS), [
        (own, other, *chart.race(own, other)) for own in levels for other in levels
    ]
