"""Who plays whom: a list of pairs, and a schedule by weeks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.results.matches import REQUIRED as RESULTS
from evenbreak.files.tables.cells import whole_numbers
from evenbreak.files.tables.names import KnownNames, clean_name
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.table import TextTable, read_table
from evenbreak.league.schedule import FixedSchedule
from evenbreak.ratings.roster import Roster

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


WEEK = {"week": ("round", "night", "matchday", "week number")}
"""The column of a schedule besides those of `PAIRS`, with its other names."""

MOST_LISTED = 5
"""How many repeated matches are listed; the rest are counted."""

LAST_WEEK = 10_000
"""The largest number accepted as a week."""


@dataclass(frozen=True, eq=False)
class ScheduleFile:
    """What a list of fixtures contains.

    Parameters
    ----------
    schedule
        who meets whom in which week.
    source
        the name of the file in messages.
    warnings
        what to check although the file can be used, a line each.
    """

    schedule: FixedSchedule
    source: str
    warnings: tuple[str, ...]


def read_schedule(path: str | Path, roster: Roster) -> ScheduleFile:
    r"""Read a schedule from a CSV file, a match a row; '-' is standard input.

    Names are those of the roster, as `read_pairs` takes them; weeks count from 1, in any
    order, and a player may have several matches in one.

    Raises
    ------
    DataError
        with every problem of the file: missing columns, no rows, weeks that are not whole
        numbers from 1, names that are not in the roster, a player who meets themselves.

    >>> import tempfile, pathlib
    >>> club = Roster(["Ann", "Bo", "Cy"], [92, 71, 80])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "fixtures.csv"
    ...     _ = path.write_text("week,player_a,player_b\n1,Cy,Ann\n2,bo,Cy\n")
    ...     schedule = read_schedule(path, club).schedule
    >>> schedule.weeks, schedule.a, schedule.b
    (2, array([2, 1]), array([0, 2]))
    """
    table = read_table(path, {**WEEK, **PAIRS}, rows="matches")
    week = whole_numbers(
        table, "week", at_least=1, at_most=LAST_WEEK, remedy="write 1 for the first week, 2, ..."
    ).values
    pairs = pairs_in(table, roster)
    table.problems.raise_any()
    warnings = *table.warnings, *_twice(table, week, pairs)
    return ScheduleFile(FixedSchedule(week, *pairs.T), table.source, warnings)


def _twice(table: TextTable, week: NDArray[np.int64], pairs: NDArray[np.int64]) -> Iterator[str]:
    """Yield a warning for each match that is already listed in the same week."""
    _, first, same = np.unique(
        np.column_stack([week, np.sort(pairs, axis=1)]),
        axis=0,
        return_index=True,
        return_inverse=True,
    )
    earlier = first[same.ravel()]
    again = np.flatnonzero(earlier != np.arange(len(week)))
    for row in again[:MOST_LISTED].tolist():
        yield (
            f"{table.source}:{table.lines[row]}: the same two meet in week {week[row]} as in line "
            f"{table.lines[earlier[row]]}; both matches are played"
        )
    if len(again) > MOST_LISTED:
        more = len(again) - MOST_LISTED
        yield f"{table.source}: and {more:,} more such match{'es' if more > 1 else ''}"
