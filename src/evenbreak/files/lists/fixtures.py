"""Who plays whom: a list of pairs, and a schedule by weeks."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.lists.roster import LAST_WEEK
from evenbreak.files.results.matches import RESULTS
from evenbreak.files.tables.cells import Whole
from evenbreak.files.tables.names import KnownNames, Name, clean_name
from evenbreak.files.tables.problems import first_ones, quoted, warning
from evenbreak.files.tables.schema import Schema
from evenbreak.files.tables.table import TextTable
from evenbreak.league.schedule import FixedSchedule
from evenbreak.ratings.roster import Roster
from evenbreak.words import say, say_count

_NOBODY = KnownNames(())


@dataclass(frozen=True, kw_only=True)
class _OfRoster(Name):
    """Names of players as places in a roster."""

    players: KnownNames = _NOBODY
    write: str = say("a name from the roster")
    nothing: int = -1

    dtype: ClassVar[Any] = np.int64

    def meaning(self, text: str) -> int | None:
        """Return the place."""
        return self.players.place(clean_name(text))

    def fault(self, text: str) -> str:
        """Return what is wrong with a name that the roster does not have."""
        name = clean_name(text)
        if not name:
            return super().fault("")
        return say(
            "{name} is not in the roster{hint}; write names as the roster does",
            name=quoted(name),
            hint=self.players.hint(name),
        )


PAIRS = Schema(
    "pairs",
    player_a=_OfRoster(RESULTS["player_a"].also, "one of the two players", needed=True),
    player_b=_OfRoster(RESULTS["player_b"].also, "the other", needed=True),
)
"""A list of who plays whom."""

SCHEDULE = Schema(
    "matches",
    week=Whole(
        "round, night, matchday, week number",
        "the week",
        needed=True,
        filled=True,
        least=1,
        most=LAST_WEEK,
        write=say("1 for the first week, 2, ..."),
    ),
    **PAIRS.columns,
)
"""A list of who plays whom in which week."""

MOST_LISTED = 5
"""How many repeated matches are listed; the rest are counted."""


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
    table, pairs = _read(PAIRS, path, roster)
    return PairsFile(pairs, table.warnings)


def _read(schema: Schema, path: str | Path, roster: Roster) -> tuple[TextTable, NDArray[np.int64]]:
    """Return a table without problems, and the pairs in it as places in the roster."""
    players = {"players": KnownNames(roster.players)}
    table = schema.but(player_a=players, player_b=players).read(path)
    a, b = table["player_a"], table["player_b"]
    table.problems.add_rows(
        table.lines,
        np.flatnonzero((a == b) & (a >= 0)),
        lambda row: say(
            "{name} is on both sides; write two different players",
            name=quoted(roster.players[a[row]]),
        ),
    )
    table.problems.raise_any()
    return table, np.column_stack([a, b])


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
    table, pairs = _read(SCHEDULE, path, roster)
    week = table["week"]
    warnings = *table.warnings, *_twice(table, week, pairs)
    return ScheduleFile(FixedSchedule(week, *pairs.T), table.source, warnings)


def _twice(table: TextTable, week: NDArray[np.int64], pairs: NDArray[np.int64]) -> list[str]:
    """Return a warning for each match that is already listed in the same week."""
    _, first, same = np.unique(
        np.column_stack([week, np.sort(pairs, axis=1)]),
        axis=0,
        return_index=True,
        return_inverse=True,
    )
    earlier = first[same.ravel()]
    again = np.flatnonzero(earlier != np.arange(len(week)))
    warnings = [
        warning(
            table.source,
            table.lines[row],
            "the same two meet in week {week} as in line {line}; both matches are played",
            week=week[row],
            line=table.lines[earlier[row]],
        )
        for row in again.tolist()
    ]
    return first_ones(
        warnings,
        MOST_LISTED,
        table.source,
        lambda n: say_count("and {n} more such match", "and {n:,} more such matches", n),
    )
