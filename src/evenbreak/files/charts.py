"""Charts of races by rating difference, skill level or points, and chip charts."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np

from evenbreak.errors import DataError, InputError
from evenbreak.files.lists.roster import LARGEST
from evenbreak.files.tables.header import missing_column
from evenbreak.files.tables.problems import Problems, printable, refusal
from evenbreak.files.tables.schema import Number, Schema, Whole
from evenbreak.files.tables.table import TextTable
from evenbreak.handicaps.charts.chart import Chart, ChartDraft, ChartRow, row_faults
from evenbreak.handicaps.charts.chart_of import (
    EVERY_CHART,
    catalog_name,
    chart_names,
    named_chart,
)
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.tournaments.chips.chip_charts import CHIP_CHARTS, ChipChart, ChipRow
from evenbreak.words import listed, say

MOST_GAMES = 1000
"""The longest race, in games."""

_DIFFERENCE = Whole(filled=True, write=say("points, such as 7"))
_LEVEL = Whole(filled=True, write=say("a skill level, such as 4"))
_GAMES = Whole(filled=True, least=1, most=MOST_GAMES, write=say("a number of games, such as 5"))

DIFFERENCES = Schema(
    difference_from=_DIFFERENCE.called(
        "from, gap from, points from", "the row's smallest rating difference, in whole points"
    ),
    difference_to=_DIFFERENCE.called(
        "to, gap to, points to",
        "the row's largest rating difference; empty in the last row, which is open-ended",
        filled=False,
        empty=None,
    ),
    stronger_needs=_GAMES.called(
        "stronger, higher needs, games stronger", "how many games the stronger player needs"
    ),
    weaker_needs=_GAMES.called(
        "weaker, lower needs, games weaker", "how many games the weaker player needs"
    ),
)
"""A chart by rating difference."""

LEVELS = Schema(
    level=_LEVEL.called("skill level, own level, level a", "one player's level"),
    opponent_level=_LEVEL.called(
        "opponent, opponent skill level, level b", "the other player's level"
    ),
    needs=_GAMES.called("games, own games", "how many games the player at `level` needs"),
    opponent_needs=_GAMES.called(
        "opponent games",
        "how many games the opponent needs; can be left out if every pair is listed in both orders",
        filled=False,
    ),
)
"""A chart by skill level."""

POINTS = LEVELS.only("level") | Schema(
    points=_GAMES.called(
        "points to win, needs points",
        "how many points a player at this level needs; each row must have more than the row "
        "above it",
    )
)
"""A points chart."""

CHIPS = Schema(
    "rows",
    rating_from=Number(
        "from, rating, from rating",
        "the lowest rating in the row's range",
        needed=True,
        least=-LARGEST,
        most=LARGEST,
        grouped=True,
        write=say("a rating"),
        empty=say("for the weakest players"),
    ),
    chips=Whole(
        "lives",
        "the chips that these players start with",
        needed=True,
        filled=True,
        least=1,
        most=1000,
    ),
)
"""A chip chart."""

MOST_MISSING = 20
"""How many missing pairs of levels are listed one by one."""


def is_chart(path: str | Path) -> bool:
    """Return whether a table has a column that only charts have."""
    charts = DIFFERENCES.only("stronger_needs") | LEVELS | POINTS
    return bool({"stronger_needs", "opponent_level", "points"} & charts.text(path).found)


@dataclass(frozen=True)
class ChartFile:
    """The content of a chart file, even if it is not a valid chart yet.

    `problems`, such as gaps and overlaps, are what makes the chart invalid.
    """

    found: ChartDraft | LevelChart | PointsChart
    problems: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def chart(self) -> Chart | LevelChart | PointsChart:
        """The chart; raises DataError with all problems if it isn't valid."""
        if self.problems:
            raise DataError(self.problems)
        return Chart(*self.found) if isinstance(self.found, ChartDraft) else self.found


def read_chart_file(path: str | Path) -> ChartFile:
    """Read a chart file; gaps and overlaps are kept as problems, for `audit` to report.

    Raises DataError if there is nothing to audit: missing columns, cells that aren't whole numbers,
    rows that end before they start, or an invalid chart by skill level.
    """
    table = (DIFFERENCES | LEVELS | POINTS).text(path)
    name = "chart" if str(path) == "-" else printable(Path(path).stem)
    if "points" in table:
        return ChartFile(_points(_read(table, POINTS), name), (), table.warnings)
    by_level = _fitting(table, LEVELS) > _fitting(table, DIFFERENCES)
    if by_level:
        return ChartFile(_levels(_read(table, LEVELS), name), (), table.warnings)
    rows = _rows(_read(table, DIFFERENCES))
    table.problems.raise_any()
    faults = Problems(table.source)
    for place, fault in row_faults(rows):
        faults.add(int(table.lines[place]), fault)
    if any(row.difference_to is not None and row.difference_to < row[0] for row in rows):
        faults.raise_any()
    return ChartFile(ChartDraft(name, rows), faults.listed(), table.warnings)


def _fitting(table: TextTable, chart: Schema) -> int:
    """Return how many of a chart type's columns a file has."""
    return sum(column in table for column in chart.columns)


def _read(table: TextTable, chart: Schema) -> TextTable:
    """Return a chart from its cells, noting missing columns or rows as problems."""
    if not table.found:
        table.problems.add(
            None,
            "has none of a chart's columns. Name the columns {differences}, or {levels}.",
            differences=", ".join(DIFFERENCES.columns),
            levels=", ".join(LEVELS.columns),
        )
        table.problems.raise_any()
    for name, column in chart.columns.items():
        if name not in table and name != "opponent_needs":
            table.problems.add(None, missing_column(name, column.aliases))
    if not len(table.problems) and not len(table):
        table.problems.add(None, "has no rows below its header. Write one line for each race.")
    return chart.of(table)


def _rows(table: TextTable) -> tuple[ChartRow, ...]:
    """Return the rows unchanged."""
    columns = (table[name].tolist() for name in DIFFERENCES.columns)
    ends = table.read["difference_to"].stated.tolist()
    return tuple(
        ChartRow(start, end if ended else None, *needs)
        for start, end, *needs, ended in zip(*columns, ends, strict=True)
    )


def _levels(table: TextTable, name: str) -> LevelChart:
    """Return a chart by skill level; raise DataError with all problems if it isn't valid."""
    own, other, needs, theirs = (table[column].tolist() for column in LEVELS.columns)
    table.problems.raise_any()
    races: dict[tuple[int, int], tuple[int, int]] = {}
    for row in range(len(table)):
        pair = own[row], other[row]
        for levels_of_race, games in ((pair, needs[row]), (pair[::-1], theirs[row])):
            if games:
                _note(table, races, levels_of_race, games, row)
    levels = sorted({level for pair in races for level in pair})
    missing = [pair for pair in product(levels, repeat=2) if pair not in races]
    for mine, opponent in missing[:MOST_MISSING]:
        table.problems.add(
            None,
            "doesn't say how many games level {level} needs against level {opponent}. Add a row.",
            level=mine,
            opponent=opponent,
        )
    if len(missing) > MOST_MISSING:
        table.problems.add(
            None, "is missing {n} more pairs of levels", n=len(missing) - MOST_MISSING
        )
    for (mine, opponent), (games, row) in races.items():
        against = races.get((opponent, mine), (games, row))[0]
        if mine > opponent and games < against:
            table.note(
                row,
                "level {level} needs {games} games against level {opponent}, but level "
                "{opponent} needs {against}; the higher level must need at least as many",
                level=mine,
                games=games,
                opponent=opponent,
                against=against,
            )
    table.problems.raise_any()
    return LevelChart(name, levels, [[races[i, j][0] for j in levels] for i in levels])


def _points(table: TextTable, name: str) -> PointsChart:
    """Return a points chart; raise DataError with all problems if it isn't valid."""
    table.problems.raise_any()
    try:
        return PointsChart(name, table["level"].tolist(), table["points"].tolist())
    except InputError as error:
        table.problems.add(None, "isn't a valid points chart: {why}", why=error.sentence)
        table.problems.raise_any()
        raise


def _note(
    table: TextTable,
    races: dict[tuple[int, int], tuple[int, int]],
    pair: tuple[int, int],
    games: int,
    row: int,
) -> None:
    """Note what one level needs against another, or that an earlier row says something else."""
    before, earlier = races.setdefault(pair, (games, row))
    if before != games:
        table.note(
            row,
            "level {level} needs {games} games against level {opponent} here but "
            "{before} in line {line}. Keep one of the two.",
            level=pair[0],
            games=games,
            opponent=pair[1],
            before=before,
            line=table.lines[earlier],
        )


def read_chart(path: str | Path) -> Chart | LevelChart | PointsChart:
    r"""Read a chart by rating difference or by skill level from a CSV file; '-' is stdin.

    The columns decide which kind of chart it is; the chart is named after the file.

    Raises
    ------
    DataError
        listing every problem in the file: missing columns, cells that are not whole numbers, gaps
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
    """Return the chart with this name, ours or an installed package's, or the chart in this file.

    Raises
    ------
    DataError
        if there is no such chart or file, or as for `read_chart`.
    InputError
        if the package's chart breaks a rule for charts.

    >>> find_chart("NPL-10").race(12)
    (5, 4)
    """
    return find_chart_file(name_or_path).chart


def find_chart_file(name_or_path: str | Path) -> ChartFile:
    """Return a chart by name, ours or an installed package's, or a file's content."""
    name = str(name_or_path)
    if name == "-" or (catalog_name(name) not in EVERY_CHART and _exists(name)):
        return read_chart_file(name_or_path)
    if (found := named_chart(name)) is None:
        key, charts = catalog_name(name), chart_names()
        like = [one for one in charts if key and one.startswith(key)]
        raise refusal(
            printable(name),
            "there's no chart or file with this name. {charts}",
            charts=say("Did you mean {names}?", names=listed(like, "or"))
            if like
            else say("Charts: {names}", names=", ".join(charts)),
        )
    draft = ChartDraft(found.name, tuple(found.rows)) if isinstance(found, Chart) else found
    return ChartFile(draft, (), ())


def _exists(path: str | Path) -> bool:
    try:
        return Path(path).exists()
    except OSError:  # a name that no file can have, such as a thousand letters
        return False


def chart_table(
    chart: Chart | LevelChart | PointsChart,
) -> tuple[list[str], list[tuple[int | None, ...]]]:
    """Return a chart as columns and rows for a file that `read_chart` reads.

    >>> chart_table(find_chart("npl_8"))[1][-1]
    (49, None, 6, 2)
    """
    if isinstance(chart, Chart):
        return list(DIFFERENCES.columns), [tuple(row) for row in chart.rows]
    if isinstance(chart, PointsChart):
        return list(POINTS.columns), list(zip(chart.levels, chart.points, strict=True))
    levels = chart.levels
    return list(LEVELS.columns), [
        (own, opponent, *chart.race(own, opponent)) for own in levels for opponent in levels
    ]


def read_chip_chart(path: str | Path) -> ChipChart:
    r"""Read a chip chart from a CSV file; '-' is standard input.

    Each row is a band of ratings: its lowest rating, empty for the weakest players, and the chips.

    Raises
    ------
    DataError
        listing the problems in the file.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "ours.csv"
    ...     _ = path.write_text("rating_from,chips\n,8\n400,6\n550,4\n")
    ...     read_chip_chart(path).chips([300, 400, 600])
    array([8, 6, 4])
    """
    table = CHIPS.read(path)
    table.problems.raise_any()
    stated = table.read["rating_from"].stated
    first = np.where(stated, table["rating_from"], -math.inf).tolist()
    rows = sorted(zip(first, table["chips"].tolist(), strict=True))
    try:
        return ChipChart(Path(path).stem, [ChipRow(*row) for row in rows], str(path))
    except InputError as error:
        raise refusal(table.source, error.sentence) from error


def chip_chart_of(name_or_path: str) -> ChipChart:
    """Return a chip chart: a built-in chart by name, or a chart from a file.

    >>> chip_chart_of("hoboken").rows[-1]
    ChipRow(rating_from=601.0, chips=4)
    """
    if name_or_path in CHIP_CHARTS:
        return CHIP_CHARTS[name_or_path]
    if not Path(name_or_path).exists() and name_or_path != "-":
        raise InputError(
            "there's no chip chart or file {name!r}. The charts are {charts}. A file needs the "
            "columns {columns}.",
            name=name_or_path,
            charts=listed(list(CHIP_CHARTS), "or"),
            columns=listed(list(CHIPS.columns)),
        )
    return read_chip_chart(name_or_path)
