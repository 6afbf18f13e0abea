"""From a list of who meets whom to places in a roster, with all its problems told at once."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

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
    """Who meets whom.

    Parameters
    ----------
    pairs
        places in the roster, shape (matches, 2), in the order of the file.
    warnings
        what a person should look at although the file can be used, a line each.
    """

    pairs: NDArray[np.int64]
    warnings: tuple[str, ...]


def read_pairs(path: str | Path, roster: Roster) -> PairsFile:
    r"""Read a list of pairs from a CSV file, a match a row; '-' is standard input.

    Names are those of the roster; upper and lower case may differ where that leaves no doubt.

    Raises
    ------
    DataError
        with all that is wrong in the file: missing columns, no rows, names that the roster
        does not have, a player against himself.

    >>> import tempfile, pathlib
    >>> club = Roster(["Ann", "Bo", "Cy"], [92, 71, 80])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "tonight.csv"
    ...     _ = path.write_text("player_a,player_b\nCy,Ann\nbo,Cy\n")
    ...     read_pairs(path, club).pairs.tolist()
    [[2, 0], [1, 2]]
    """
    table = read_table(path, PAIRS)
    if not len(table) and not len(table.problems):
        table.problems.add(None, "has no pairs below its header; write one line for each match")
    pairs = pairs_in(table, roster)
    table.problems.raise_any()
    return PairsFile(pairs, table.warnings)


def pairs_in(table: TextTable, roster: Roster) -> NDArray[np.int64]:
    """Return the pairs in a table as places in the roster, -1 where it notes a problem."""
    find = _Finder(roster)
    pairs = np.full((len(table), 2), -1)
    for side, column in enumerate(PAIRS):
        if column not in table:
            continue
        for row, text in enumerate(table.cells(column)):
            place = find(text)
            if isinstance(place, str):
                table.problems.add(int(table.lines[row]), f"{column} {place}")
            else:
                pairs[row, side] = place
    table.problems.add_rows(
        table.lines,
        np.flatnonzero((pairs[:, 0] == pairs[:, 1]) & (pairs[:, 0] >= 0)),
        lambda row: (
            f"{quoted(roster.players[pairs[row, 0]])} meets himself; write two different players"
        ),
    )
    return pairs


class _Finder:
    """Finds the place of a name in a roster, or says why there is none."""

    def __init__(self, roster: Roster) -> None:
        self.exact = {name: place for place, name in enumerate(roster.players)}
        self.folded: defaultdict[str, list[str]] = defaultdict(list)
        for name in roster.players:
            self.folded[name.casefold()].append(name)
        self.told: dict[str, int | str] = {}

    def __call__(self, text: str) -> int | str:
        name = clean_name(text)
        if name not in self.told:
            self.told[name] = self._find(name)
        return self.told[name]

    def _find(self, name: str) -> int | str:
        if not name:
            return "is empty; write a name of the roster"
        same = [name] if name in self.exact else self.folded.get(name.casefold(), [])
        if len(same) == 1:
            return self.exact[same[0]]
        close = same or [
            self.folded[key][0] for key in get_close_matches(name.casefold(), self.folded, n=3)
        ]
        hint = f" (did you mean {' or '.join(map(quoted, close))}?)" if close else ""
        return f"{quoted(name)} is not in the roster{hint}; write names as the roster does"
