"""A night's matches, players and standings as views in its file, next to the log.

They are for other programs, which read them with SQL. The rows follow from the log and change in
the same transaction: a reader sees both before an entry, or both after it. Only rows that have
changed are written.

The views are based on tables of their own, so that their columns have types, and no one who reads a
view can change it. `events` has the last entry they include: if an earlier version has added
entries to a file, the views are out of date until this version adds one. The same goes for a file
whose views can't be written, say because someone else's table has a view's name: no entry is
refused for that.
"""

from __future__ import annotations

import logging
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple, get_args, get_type_hints

from evenbreak.errors import EvenbreakError
from evenbreak.files.store.formats import ENTRIES
from evenbreak.files.store.prizes import prizes_in
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.listed import (
    MatchRow,
    PlayerRow,
    StandingRow,
    match_rows,
    player_rows,
    standing_rows,
)

_LOG = logging.getLogger(__name__)
_TYPES = {int: "INTEGER", bool: "INTEGER", float: "REAL", str: "TEXT"}


class EventRow(NamedTuple):
    """One of the night's events, and the last entry that the rows include."""

    name: str | None
    format: str
    date: str | None
    entry: int


class _View(NamedTuple):
    """A view: its name, the class of its rows, their order, and calculated columns."""

    name: str
    rows: type[Any]
    order: str
    more: str = ""

    @property
    def table(self) -> str:
        """The table it is based on."""
        return f"{self.name}_rows"

    @property
    def statements(self) -> dict[str, str]:
        """The statements that create the table and the view, by name."""
        types = get_type_hints(self.rows).items()
        columns = [f"{name} {_TYPES[(get_args(kind) or (kind,))[0]]}" for name, kind in types]
        names = ", ".join(self.rows._fields)
        (table, of_table), (view, of_view) = self.begin.items()
        return {
            table: f"{of_table}{', '.join(columns)}, PRIMARY KEY (event, row)) WITHOUT ROWID",
            view: f"{of_view}{names}{self.more} FROM {table} ORDER BY event, {self.order}",
        }

    @property
    def begin(self) -> dict[str, str]:
        """How the statements start in every version of this program, and in no one else's file."""
        return {
            self.table: f"CREATE TABLE {self.table} (event INTEGER, row INTEGER, ",
            self.name: f"CREATE VIEW {self.name} AS SELECT event, ",
        }


_UP_TO_DATE = (
    f", entry = (SELECT MAX(number) FROM {ENTRIES} WHERE strand = CAST(event AS TEXT)) "  # noqa: S608
    "AS up_to_date"
)
_VIEWS = (
    _View("matches", MatchRow, "match IS NULL, match, row"),
    _View("players", PlayerRow, "row"),
    _View(
        "standings",
        StandingRow,
        "side, place IS NOT NULL, place, won DESC, lost, buchholz DESC, chips DESC, row",
    ),
    _View("events", EventRow, "event", _UP_TO_DATE),
)


@cache
def _statements() -> dict[str, str]:
    return {name: text for view in _VIEWS for name, text in view.statements.items()}


def are_current(base: sqlite3.Connection) -> bool:
    """Return whether a file's views are this version's, and include all its entries."""
    if not _are_there(base):
        return False
    entered = f"SELECT COUNT(DISTINCT strand) FROM {ENTRIES} WHERE strand NOT GLOB '*[^0-9]*'"  # noqa: S608
    known = "SELECT SUM(up_to_date) FROM events"
    return bool(base.execute(f"SELECT ({entered}) = COALESCE(({known}), 0)").fetchone()[0])


def _are_there(base: sqlite3.Connection) -> bool:
    asked = "SELECT name, sql FROM sqlite_master WHERE type IN ('table', 'view')"
    return _statements().items() <= dict(base.execute(asked).fetchall()).items()


def renew(base: sqlite3.Connection, path: str | Path, night: Mapping[int, Evening]) -> None:
    """Write the changed rows of a night, in the same transaction as its log entry.

    Rows of events not in `night` are removed.
    """
    with apart(base, path):
        if not _are_there(base):
            _make(base)
        for view in _VIEWS:
            each = {n: _rows(base, path, n, state, view.rows) for n, state in night.items()}
            _write(base, view, {(n, k): row for n in each for k, row in enumerate(each[n], 1)})


@contextmanager
def apart(base: sqlite3.Connection, path: str | Path) -> Iterator[None]:
    """Keep all of what the block writes to the views, or none; either way, continue after it."""
    base.execute("SAVEPOINT views")
    try:
        yield
    except Exception as error:
        if not base.in_transaction:  # SQLite has dropped the entry too
            raise
        base.execute("ROLLBACK TO views")
        _LOG.warning("the views in %s were left as they were: %s", Path(path).name, error)
    base.execute("RELEASE views")


def _make(base: sqlite3.Connection) -> None:
    """Create the tables and views, replacing those of an earlier version."""
    there = base.execute("SELECT type, name, sql FROM sqlite_master WHERE sql NOT NULL").fetchall()
    for view in _VIEWS:
        for kind, name, text in there:
            if text.startswith(view.begin.get(name, "\0")):  # else it is somebody else's
                base.execute(f"DROP {kind} {name}")
        for statement in view.statements.values():
            base.execute(statement)


def _rows(
    base: sqlite3.Connection, path: str | Path, event: int, state: Evening, kind: type[Any]
) -> Iterable[tuple[Any, ...]]:
    if kind is MatchRow:
        return match_rows(state)
    if kind is PlayerRow:
        return player_rows(state)
    if kind is EventRow:
        plan = state.plan
        return [EventRow(plan.name or None, plan.form, plan.date or None, len(state.log))]
    try:
        money = prizes_in(base, path, event)
        prizes = money.amounts(len(state.entrants), state.payers) if money else None
    except EvenbreakError:  # no row of the payout table is for so many
        money = prizes = None
    return standing_rows(state, prizes, money.unit if money else 0.0)


def _write(
    base: sqlite3.Connection, view: _View, rows: Mapping[tuple[int, int], tuple[Any, ...]]
) -> None:
    """Write the rows that have changed, and remove those that are gone."""
    before = {
        (event, row): tuple(rest)
        for event, row, *rest in base.execute(f"SELECT * FROM {view.table}")  # noqa: S608
    }
    gone = f"DELETE FROM {view.table} WHERE event = ? AND row = ?"  # noqa: S608
    base.executemany(gone, before.keys() - rows.keys())
    marks = ", ".join("?" * (2 + len(view.rows._fields)))
    base.executemany(
        f"INSERT OR REPLACE INTO {view.table} VALUES ({marks})",  # noqa: S608
        [(*key, *row) for key, row in rows.items() if before.get(key) != row],
    )
