"""Which rows of a practice file belong to the drill that is asked about."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.problems import quoted
from evenbreak.files.text_table import TextTable
from evenbreak.ratings.result_words import letters

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
