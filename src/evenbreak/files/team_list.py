"""Reading the players of one team, with their skill levels for caps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from evenbreak.arrays import Floats, short_repr
from evenbreak.files.cells import numbers
from evenbreak.files.roster import OPTIONAL, REQUIRED, WRITTEN, RosterFile, roster_of
from evenbreak.files.text_table import read_table

_LEVELS = ("skill level", "handicap", "sl")
COLUMNS = {"player": (*REQUIRED["player"], "team player")}
MORE = {
    "rating": tuple(name for name in REQUIRED["rating"] if name not in (*_LEVELS, "level")),
    "level": _LEVELS,
    **OPTIONAL,
    **WRITTEN,
    "team": (),
    "division": (),
}


@short_repr
@dataclass(frozen=True)
class TeamList:
    """The players of one team.

    Parameters
    ----------
    file
        their names and ratings; the levels stand in for the ratings where the file has no others.
    levels
        each player's skill level; NaN where the file states none.
    """

    file: RosterFile
    levels: Floats


def read_team(path: str | Path) -> TeamList:
    r"""Read a team from a CSV file with the columns player, rating and level.

    Either of rating and level may be missing. Other columns are those of a roster.

    Raises
    ------
    DataError
        with every problem of the file: no players, a name that appears twice, cells that are not
        numbers.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "team.csv"
    ...     _ = path.write_text("player,rating,level\nAnn,612,6\nBo,540,5\n")
    ...     team = read_team(path)
    >>> team.file.roster.rating, team.levels
    (array([612., 540.]), array([6., 5.]))
    """
    table = read_table(path, COLUMNS, MORE, rows="players")
    levels = numbers(
        table, "level", at_least=0, at_most=1000, remedy="write a skill level", may_be_empty=True
    ).values
    if "rating" not in table and "level" in table:
        table = replace(
            table,
            columns={**table.columns, "rating": table.columns["level"]},
            found=table.found | {"rating"},
            titles={**table.titles, "rating": table.titles["level"]},
        )
    return TeamList(roster_of(table), np.asarray(levels))
