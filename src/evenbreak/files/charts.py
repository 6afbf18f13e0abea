"""Charts of races, by rating difference, skill level or points, and chip charts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np

from evenbreak.errors import DataError, InputError
from evenbreak.files.lists.roster import LARGEST
from evenbreak.files.tables.cells import numbers, whole_numbers
from evenbreak.files.tables.problems import Problems, printable, quoted
from evenbreak.files.tables.table import TextTable, read_table
from evenbreak.handicaps.charts.chart import CHARTS, Chart, ChartDraft, ChartRow, chart, row_faults
from evenbreak.handicaps.charts.chart_of import catalogue_name
from evenbreak.handicaps.charts.level_chart import (
    LEVEL_CHARTS,
    POINTS_CHARTS,
    LevelChart,
    PointsChart,
    level_chart,
    points_chart,
)
from evenbreak.ratings.result_words import LARGEST_WHOLE
from evenbreak.tournaments.chips.chip_charts import CHIP_CHARTS, ChipChart, ChipRow

DIFFERENCES = {
    "difference_from": ("from", "gap from", "points from"),
    "difference_to": ("to", "gap to", "points to"),
    "stronger_needs": ("stronger", "higher needs", "games stronger"),
    "weaker_needs": ("weaker", "lower needs", "games weaker"),
}
"""The columns of a chart by rating difference, with their other names."""

LEVELS = {
    "level": ("skill level", "own level", "level a"),
    "opponent_level": ("opponent", "opponent skill level", "level b"),
    "needs": ("games", "own games"),
    "opponent_needs": ("opponent games",),
}
"""The columns of a chart by skill level, with their other names; the last may be missing."""

POINTS = {"level": LEVELS["level"], "points": ("points to win", "needs points")}
"""The columns of a chart of points, with their other names."""

MAY_BE_EMPTY = ("difference_to", "opponent_needs")
"""The columns whose cells may be empty."""

MOST_GAMES = 1000
"""Games in the longest race."""

MOST_MISSING = 20
"""The most missing pairs of levels listed one by one."""


def is_chart(path: str | Path) -> bool:
    """Return whether a table has a column that charts have and other tables have not."""
    own = {"stronger_needs": DIFFERENCES["stronger_needs"], **LEVELS, **POINTS}
    return bool({"stronger_needs", "opponent_level", "points"} & read_table(path, {}, own).found)


@dataclass(frozen=True)
class ChartFile:
    """The content of a chart file, even if it is not a valid chart yet.

    Parameters
    ----------
    found
        the rows of a chart by rating difference as they are, or another kind of chart.
    problems
        what keeps those rows from being a chart, such as gaps and overlaps.
    warnings
        what to check although the file can be used, a line each.
    """

    found: ChartDraft | LevelChart | PointsChart
    problems: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def chart(self) -> Chart | LevelChart | PointsChart:
        """The chart; a DataError with all problems if it is not valid."""
        if self.problems:
            raise DataError(self.problems)
        return Chart(*self.found) if isinstance(self.found, ChartDraft) else self.found


def read_chart_file(path: str | Path) -> ChartFile:
    """Read a chart file; gaps and overlaps are kept as problems, for `audit` to report.

    Raises
    ------
    DataError
        if there is nothing to audit: missing columns, cells that are not whole numbers, rows
        that end before they begin, or an invalid chart by skill level.
    """
    table = read_table(path, {}, {**DIFFERENCES, **LEVELS, **POINTS})
    name = "chart" if str(path) == "-" else printable(Path(path).stem)
    if "points" in table:
        _check_columns(table, POINTS)
        return ChartFile(_points(table, name), (), table.warnings)
    by_level = sum(column in table for column in LEVELS) > sum(
        column in table for column in DIFFERENCES
    )
    needed = {key: names for key, names in LEVELS.items() if key != "opponent_needs"}
    _check_columns(table, needed if by_level else DIFFERENCES)
    if by_level:
        return ChartFile(_levels(table, name), (), table.warnings)
    rows = _rows(table)
    table.problems.raise_any()
    faults = Problems(table.source)
    for place, fault in row_faults(rows):
        faults.add(int(table.lines[place]), fault)
    if any(row.difference_to is not None and row.difference_to < row[0] for row in rows):
        faults.raise_any()
    return ChartFile(ChartDraft(name, rows), faults.listed(), table.warnings)


def _check_columns(table: TextTable, needed: Mapping[str, Sequence[str]]) -> None:
    """Note missing columns, or missing rows, as problems."""
    missing = [column for column in needed if column not in table]
    if not table.found:
        table.problems.add(
            None,
            "has none of the columns of a chart; name the columns "
            f"{', '.join(DIFFERENCES)}, or {', '.join(LEVELS)}",
        )
        table.problems.raise_any()
    for column in missing:
        also = " or ".join(map(quoted, needed[column]))
        table.problems.add(
            None, f"there is no column {column!r}; add it (it may also be called {also})"
        )
    if not len(table.problems) and not len(table):
        table.problems.add(None, "has no rows below its header; write one line for each race")


def _rows(table: TextTable) -> tuple[ChartRow, ...]:
    """Return the rows as they are; cells that are not whole numbers are noted as problems."""
    start, end, stronger, weaker = (_whole(table, name) for name in DIFFERENCES)
    has_end = map(bool, table.cells("difference_to"))
    return tuple(
        ChartRow(first, last if ends else None, *needs)
        for first, last, ends, *needs in zip(start, end, has_end, stronger, weaker, strict=True)
    )


def _levels(table: TextTable, name: str) -> LevelChart:
    """Return a chart by skill level; a DataError with all problems where there is none."""
    own, other, needs, theirs = (_whole(table, column) for column in LEVELS)
    table.problems.raise_any()
    found: dict[tuple[int, int], tuple[int, int]] = {}
    for row in range(len(table)):
        pair = own[row], other[row]
        for key, games in ((pair, needs[row]), (pair[::-1], theirs[row])):
            if games:
                _note(table, found, key, games, row)
    levels = sorted({level for pair in found for level in pair})
    missing = [pair for pair in product(levels, repeat=2) if pair not in found]
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
                f"{against}; the higher level must need at least as many",
            )
    table.problems.raise_any()
    return LevelChart(name, levels, [[found[i, j][0] for j in levels] for i in levels])


def _points(table: TextTable, name: str) -> PointsChart:
    """Return a chart of points; a DataError with all problems where there is none."""
    levels, points = _whole(table, "level"), _whole(table, "points")
    table.problems.raise_any()
    try:
        return PointsChart(name, levels, points)
    except InputError as error:
        table.problems.add(None, f"is not a chart of points: {error}")
        table.problems.raise_any()
        raise


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
            f"level {pair[0]} needs {games} games against level {pair[1]} here but {before} in "
            f"line {table.lines[line]}; keep one of the two",
        )


def _whole(table: TextTable, column: str) -> list[int]:
    """Return a column of whole numbers, 0 where a cell may be empty and is."""
    games = column.endswith("needs") or column == "points"
    wanted = "points, such as 7" if column in DIFFERENCES else "a skill level, such as 4"
    found = whole_numbers(
        table,
        column,
        at_least=1 if games else 0,
        at_most=MOST_GAMES if games else LARGEST_WHOLE,
        remedy=f"write {'a number of games, such as 5' if games else wanted}",
        may_be_empty=column in MAY_BE_EMPTY,
    )
    return list(map(int, found.values))


def read_chart(path: str | Path) -> Chart | LevelChart | PointsChart:
    r"""Read a chart by rating difference or by skill level from a CSV file; '-' is stdin.

    The columns decide which of the two it is; the chart is named after the file.

    Raises
    ------
    DataError
        with all problems of the file: missing columns, cells that are not whole numbers, gaps
        and overlaps between rows, pairs of levels that are missing or contradict each other.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "ours.csv"
    ...     _ = path.write_text("from,to,stronger,weaker\n0,9,5,5\n10,,5,4\n")
    ...     read_chart(path).race(12)
    (5, 4)
    """
    return read_chart_file(path).chart


def find_chart(name_or_path: str | Path) -> Chart | LevelChart | PointsChart:
    """Return the chart of this name that comes with the package, or else the one in this file.

    Raises
    ------
    DataError
        if there is neither, or as for `read_chart`.

    >>> find_chart("NPL-10").race(12)
    (5, 4)
    """
    return find_chart_file(name_or_path).chart


def find_chart_file(name_or_path: str | Path) -> ChartFile:
    """Return the chart of this name that comes with the package, or else the content of a file."""
    key = catalogue_name(str(name_or_path))
    if key in CHARTS:
        return ChartFile(ChartDraft(key, tuple(chart(key).rows)), (), ())
    if key in LEVEL_CHARTS:
        return ChartFile(level_chart(key), (), ())
    if key in POINTS_CHARTS:
        return ChartFile(points_chart(key), (), ())
    try:
        return read_chart_file(name_or_path)
    except DataError as error:
        if str(name_or_path) == "-" or _exists(name_or_path):
            raise
        known = ", ".join((*CHARTS, *LEVEL_CHARTS, *POINTS_CHARTS))
        problem = error.problems[0].partition(";")[0]
        raise DataError(
            [f"{problem}, and no chart has this name; name a file, or {known}"]
        ) from None


def _exists(path: str | Path) -> bool:
    try:
        return Path(path).exists()
    except OSError:  # a name that no file can have, such as a thousand letters
        return False


def chart_table(
    chart: Chart | LevelChart | PointsChart,
) -> tuple[list[str], list[tuple[int | None, ...]]]:
    """Return a chart as the columns and rows of a file that `read_chart` reads.

    >>> chart_table(find_chart("npl_8"))[1][-1]
    (49, None, 6, 2)
    """
    if isinstance(chart, Chart):
        return list(DIFFERENCES), [tuple(row) for row in chart.rows]
    if isinstance(chart, PointsChart):
        return list(POINTS), list(zip(chart.levels, chart.points, strict=True))
    levels = chart.levels
    return list(LEVELS), [
        (own, other, *chart.race(own, other)) for own in levels for other in levels
    ]


CHIPS = {
    "rating_from": ("from", "rating", "from rating"),
    "chips": ("lives",),
}
"""The columns of a chip chart, with their other names."""

_MOST_CHIPS = 1000


def read_chip_chart(path: str | Path) -> ChipChart:
    r"""Read a chip chart from a CSV file; '-' is standard input.

    It has a row for each band of ratings: the rating from which it holds, empty for the weakest
    players, and the chips.

    Raises
    ------
    DataError
        with the problems of the file.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "ours.csv"
    ...     _ = path.write_text("rating_from,chips\n,8\n400,6\n550,4\n")
    ...     read_chip_chart(path).chips([300, 400, 600])
    array([8, 6, 4])
    """
    table = read_table(path, CHIPS, rows="rows")
    starts = numbers(
        table,
        "rating_from",
        at_least=-LARGEST,
        at_most=LARGEST,
        remedy="write a rating, or leave it empty for the weakest players",
        may_be_empty=True,
        points_may_group=True,
    )
    chips = whole_numbers(table, "chips", at_least=1, at_most=_MOST_CHIPS, remedy="write 1, 2, ...")
    table.problems.raise_any()
    first = np.where(starts.stated, starts.values, -math.inf).tolist()
    rows = sorted(zip(first, chips.values.tolist(), strict=True))
    try:
        return ChipChart(Path(path).stem, [ChipRow(*row) for row in rows], str(path))
    except InputError as error:
        raise DataError([f"{table.source}: {error}"]) from error


def chip_chart_of(name_or_path: str) -> ChipChart:
    """Return a chip chart that comes with the package, or one from a file.

    >>> chip_chart_of("hoboken").rows[-1]
    ChipRow(rating_from=601.0, chips=4)
    """
    if name_or_path in CHIP_CHARTS:
        return CHIP_CHARTS[name_or_path]
    if not Path(name_or_path).exists() and name_or_path != "-":
        raise InputError(
            f"chip chart is {name_or_path!r}; give {' or '.join(CHIP_CHARTS)}, or a file with the "
            "columns rating_from and chips"
        )
    return read_chip_chart(name_or_path)
