"""Reading a list of who plays whom, as places in a roster."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.files.known_names import KnownNames
from evenbreak.files.player_names import clean_name
from evenbreak.files.problems import quoted
from evenbreak.files.results_columns import REQUIRED as RESULTS
from evenbreak.files.text_table import TextTable, read_table
from evenbreak.ratings.roster import Roster

if TYPE_CHECKING:
    from numpy.typing import NDArray

PAIRS = {name: RESULTS[name] for name in ("player_a", "player_b")}
"""The columns of a list of pairs, with their other names."""


@dataclass(frozen=True, eq=False)
class PairsFile:
    """Who plays whom.

    Parameters
    ----------
    pairs
        places in the roster, shape (matches, 2), in the order of the file.
    warnings
        what to check although the file can be used, a line each.
    """

    pairs: NDArray[np.int64]
    warnings: tuple[str, ...]


def read_pairs(path: str | Path, roster: Roster) -> PairsFile:
    r"""Read a list of pairs from a CSV file, a match a row; '-' is standard input.

    Names are those of the roster; upper and lower case may differ where that is unambiguous.

    Raises
    ------
    DataError
        with every problem of the file: missing columns, no rows, names that the roster does
        not have, a player on both sides.

    >>> import tempfile, pathlib
    >>> club = Roster(["Ann", "Bo", "Cy"], [92, 71, 80])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "tonight.csv"
    ...     _ = path.write_text("player_a,player_b\nCy,Ann\nbo,Cy\n")
    ...     read_pairs(path, club).pairs.tolist()
    [[2, 0], [1, 2]]
    """
    table = read_table(path, PAIRS, rows="pairs")
    pairs = pairs_in(table, roster)
    table.problems.raise_any()
    return PairsFile(pairs, table.warnings)


def pairs_in(table: TextTable, roster: Roster) -> NDArray[np.int64]:
    """Return the pairs in a table as places in the roster, -1 where it notes a problem."""
    known = KnownNames(roster.players)
    pairs = np.full((len(table), 2), -1)
    for side, column in enumerate(PAIRS):
        if column not in table:
            continue
        for row, name in enumerate(map(clean_name, table.cells(column))):
            place = known.place(name)
            if place is not None:
                pairs[row, side] = place
                continue
            problem = "is empty; write a name from the roster"
            if name:
                unknown = f"{quoted(name)} is not in the roster{known.hint(name)}"
                problem = f"{unknown}; write names as the roster does"
            table.problems.add(int(table.lines[row]), f"{column} {problem}")
    table.problems.add_rows(
        table.lines,
        np.flatnonzero((pairs[:, 0] == pairs[:, 1]) & (pairs[:, 0] >= 0)),
        lambda row: (
            f"{quoted(roster.players[pairs[row, 0]])} is on both sides; write two different players"
        ),
    )
    return pairs
