"""What the file of an evening holds besides its events: secrets, prizes."""

from __future__ import annotations

import secrets
import sqlite3
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path

from evenbreak.errors import DataError
from evenbreak.files.evening_entries import named
from evenbreak.files.evening_file import DAMAGED, changing, copied, has_table, opened
from evenbreak.tournaments.money.prize_money import PrizeMoney

_SECRETS = "CREATE TABLE IF NOT EXISTS secret (name TEXT PRIMARY KEY, value TEXT NOT NULL)"
_PRIZES = """
CREATE TABLE IF NOT EXISTS prize (
    one INTEGER PRIMARY KEY CHECK (one = 1), fee REAL NOT NULL, added REAL NOT NULL,
    house REAL NOT NULL, payout TEXT NOT NULL
)
"""


def kept_secrets(path: str | Path, first: Mapping[str, str]) -> dict[str, str]:
    """Return the secrets of a tournament by name; those that it has none of are kept from now on.

    In a file that cannot be written to now they are not kept: it is shown all the same.

    Parameters
    ----------
    path
        the file of the tournament.
    first
        a secret for each name, for the first time.
    """
    with opened(path) as base:
        found = _secrets(base)
    if not first.keys() <= found.keys():
        try:
            with changing(path) as base:
                base.execute(_SECRETS)
                base.executemany("INSERT OR IGNORE INTO secret VALUES (?, ?)", list(first.items()))
                found = _secrets(base)
        except DataError:
            pass
    if not all(isinstance(value, str) for value in found.values()):
        raise DataError([DAMAGED.format(name=Path(path).name, error="its PIN cannot be read")])
    return {**first, **found}


def _secrets(base: sqlite3.Connection) -> dict[str, str]:
    if not has_table(base, "secret"):
        return {}
    return dict(base.execute("SELECT name, value FROM secret").fetchall())


def change_secrets(path: str | Path, to: Mapping[str, str]) -> None:
    """Keep other secrets of a tournament instead of those that have these names."""
    with changing(path) as base:
        base.execute(_SECRETS)
        base.executemany("INSERT OR REPLACE INTO secret VALUES (?, ?)", list(to.items()))


def new_pin() -> str:
    """Return a PIN of six digits."""
    return f"{secrets.randbelow(10**6):06d}"


def keep_prizes(path: str | Path, money: PrizeMoney) -> None:
    """Keep the prize money of a tournament, instead of what was kept before."""
    with changing(path) as base:
        base.execute(_PRIZES)
        row = 1, money.fee, money.added, money.house, money.payout
        base.execute("INSERT OR REPLACE INTO prize VALUES (?, ?, ?, ?, ?)", row)


def kept_prizes(path: str | Path) -> PrizeMoney | None:
    """Return the prize money of a tournament; None: none was kept."""
    with opened(path) as base:
        if not has_table(base, "prize"):
            return None
        row = base.execute("SELECT fee, added, house, payout FROM prize").fetchone()
    with named(path, "its prizes"):
        return PrizeMoney(*row) if row else None


def back_up(path: str | Path, now: datetime) -> Path:
    """Write a copy of the file beside it, and return its name.

    What bears that name is a whole copy, even if the program ends while it is written.
    """
    return copied(path, f"{now:%Y%m%d-%H%M%S}")
