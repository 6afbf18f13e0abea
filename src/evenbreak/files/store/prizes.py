"""An evening's prize money in its file, by event."""

from __future__ import annotations

import sqlite3
from pathlib import Path

from evenbreak.files.store.evening_file import named, opened
from evenbreak.files.store.formats import has_table
from evenbreak.tournaments.money.payouts import PrizeMoney
from evenbreak.words import say

_PRIZES = """
CREATE TABLE IF NOT EXISTS prizes (
    event INTEGER PRIMARY KEY, fee REAL NOT NULL, added REAL NOT NULL, house REAL NOT NULL,
    payout TEXT NOT NULL, unit REAL NOT NULL
)
"""
_EARLIER_PRIZES = "prize"  # of the one tournament that a file had


def write_prizes(base: sqlite3.Connection, money: PrizeMoney, event: int) -> None:
    """Store an event's prize money, replacing any stored before."""
    base.execute(_PRIZES)
    if (earlier := _prizes(base, 1)) and has_table(base, _EARLIER_PRIZES):
        base.execute("INSERT OR IGNORE INTO prizes VALUES (1, ?, ?, ?, ?, ?)", earlier)
        base.execute(f"DROP TABLE {_EARLIER_PRIZES}")
    row = event, money.fee, money.added, money.house, money.payout, money.unit
    base.execute("INSERT OR REPLACE INTO prizes VALUES (?, ?, ?, ?, ?, ?)", row)


def _prizes(base: sqlite3.Connection, event: int) -> tuple[float, float, float, str, float] | None:
    names, row = "fee, added, house, payout", None
    if has_table(base, "prizes"):
        asked = f"SELECT {names}, unit FROM prizes WHERE event = ?"  # noqa: S608
        row = base.execute(asked, (event,)).fetchone()
    if row is None and event == 1 and has_table(base, _EARLIER_PRIZES):
        there = {one[1] for one in base.execute(f"PRAGMA table_info({_EARLIER_PRIZES})")}
        unit = "unit" if "unit" in there else "0.0"
        row = base.execute(f"SELECT {names}, {unit} FROM {_EARLIER_PRIZES}").fetchone()  # noqa: S608
    return None if row is None else tuple(row)


def prizes_in(base: sqlite3.Connection, path: str | Path, event: int) -> PrizeMoney | None:
    """Return an event's prize money from an open file; None if none was stored."""
    row = _prizes(base, event)
    with named(path, say("its prizes")):
        return PrizeMoney(*row) if row else None


def kept_prizes(path: str | Path, event: int = 1) -> PrizeMoney | None:
    """Return an event's prize money; None if none was stored."""
    with opened(path) as base:
        return prizes_in(base, path, event)
