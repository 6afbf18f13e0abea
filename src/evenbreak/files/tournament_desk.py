"""What the file of an evening holds besides its events: secrets, authors, prizes."""

from __future__ import annotations

import secrets
import sqlite3
from collections.abc import Mapping
from contextlib import suppress
from datetime import datetime
from itertools import count
from pathlib import Path

from evenbreak.files.evening_file import has_table, opened
from evenbreak.tournaments.money.prize_money import PrizeMoney

_TABLES = """
CREATE TABLE IF NOT EXISTS secret (name TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS prize (
    one INTEGER PRIMARY KEY CHECK (one = 1), fee REAL NOT NULL, added REAL NOT NULL,
    house REAL NOT NULL, payout TEXT NOT NULL
);
"""


def kept_secrets(path: str | Path, first: Mapping[str, str]) -> dict[str, str]:
    """Return the secrets of a tournament by name; those that it has none of are kept from now on.

    Parameters
    ----------
    path
        the file of the tournament.
    first
        a secret for each name, for the first time.
    """
    with opened(path) as base:
        _begin(base)
        base.executemany("INSERT OR IGNORE INTO secret VALUES (?, ?)", list(first.items()))
        found = dict(base.execute("SELECT name, value FROM secret").fetchall())
        base.execute("COMMIT")
    return found


def change_secrets(path: str | Path, to: Mapping[str, str]) -> None:
    """Keep other secrets of a tournament instead of those that have these names."""
    with opened(path) as base:
        _begin(base)
        base.executemany("INSERT OR REPLACE INTO secret VALUES (?, ?)", list(to.items()))
        base.execute("COMMIT")


def new_pin() -> str:
    """Return a PIN of six digits."""
    return f"{secrets.randbelow(10**6):06d}"


def keep_prizes(path: str | Path, money: PrizeMoney) -> None:
    """Keep the prize money of a tournament, instead of what was kept before."""
    with opened(path) as base:
        _begin(base)
        row = 1, money.fee, money.added, money.house, money.payout
        base.execute("INSERT OR REPLACE INTO prize VALUES (?, ?, ?, ?, ?)", row)
        base.execute("COMMIT")


def kept_prizes(path: str | Path) -> PrizeMoney | None:
    """Return the prize money of a tournament; None: none was kept."""
    with opened(path) as base:
        if not has_table(base, "prize"):
            return None
        row = base.execute("SELECT fee, added, house, payout FROM prize").fetchone()
    return PrizeMoney(*row) if row else None


def authors(path: str | Path) -> dict[int, str]:
    """Return who entered each event, by its number from 1, where that is known."""
    with opened(path) as base:
        if not has_table(base, "author"):
            return {}
        return dict(base.execute("SELECT number, name FROM author").fetchall())


def back_up(path: str | Path, now: datetime) -> Path:
    """Write a copy of the file beside it, and return its name.

    What bears that name is a whole copy, even if the program ends while it is written.
    """
    place = Path(path)
    part = place.with_name(f".{place.stem}-{secrets.token_hex(4)}.part")
    with opened(place) as base:
        base.execute("VACUUM INTO ?", (str(part),))
    return part.replace(_new_name(place, f"{now:%Y%m%d-%H%M%S}"))


def _new_name(place: Path, at: str) -> Path:
    """Reserve a name for a copy made at some time; others may have been made in that second."""
    for k in count(1):
        again = f"-{k}" if k > 1 else ""
        copy = place.with_name(f"{place.stem}-{at}{again}.backup.db")
        with suppress(FileExistsError):
            copy.touch(exist_ok=False)
            break
    return copy


def _begin(base: sqlite3.Connection) -> None:
    base.executescript(_TABLES)
    base.execute("BEGIN IMMEDIATE")
