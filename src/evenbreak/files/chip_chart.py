"""Reading a chip chart: how many chips a player starts with, by rating."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from evenbreak.errors import DataError, InputError
from evenbreak.files.cells import numbers, whole_numbers
from evenbreak.files.roster import LARGEST
from evenbreak.files.text_table import read_table
from evenbreak.tournaments.chips.chip_charts import CHIP_CHARTS, ChipChart, ChipRow

REQUIRED = {
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
    table = read_table(path, REQUIRED, rows="rows")
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
