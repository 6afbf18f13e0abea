"""What the file of an evening holds besides its events: secrets, prizes, what phones did.

Of what phones did entries are only ever added: who claimed which side, who proposed which result.
Who holds a side, and what is proposed now, are a fold of them.
"""

from __future__ import annotations

import json
import secrets
import sqlite3
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from evenbreak.errors import DataError
from evenbreak.evenings.log import read_json
from evenbreak.files.store.evening_file import changing, copied, damaged, named, opened
from evenbreak.files.store.formats import has_table
from evenbreak.tournaments.money.payouts import PrizeMoney
from evenbreak.words import say

_SECRETS = "CREATE TABLE IF NOT EXISTS secret (name TEXT PRIMARY KEY, value TEXT NOT NULL)"
_PRIZES = """
CREATE TABLE IF NOT EXISTS prize (
    one INTEGER PRIMARY KEY CHECK (one = 1), fee REAL NOT NULL, added REAL NOT NULL,
    house REAL NOT NULL, payout TEXT NOT NULL, unit REAL NOT NULL DEFAULT 0
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
        kept = _secrets(base)
    if not first.keys() <= kept.keys():
        try:
            with changing(path) as base:
                base.execute(_SECRETS)
                base.executemany("INSERT OR IGNORE INTO secret VALUES (?, ?)", list(first.items()))
                kept = _secrets(base)
        except DataError:
            pass
    if not all(isinstance(value, str) for value in kept.values()):
        raise damaged(path, say("its PIN cannot be read"))
    return {**first, **kept}


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
        if "unit" not in _columns(base):  # of an earlier version
            base.execute("ALTER TABLE prize ADD COLUMN unit REAL NOT NULL DEFAULT 0")
        row = 1, money.fee, money.added, money.house, money.payout, money.unit
        base.execute("INSERT OR REPLACE INTO prize VALUES (?, ?, ?, ?, ?, ?)", row)


def _columns(base: sqlite3.Connection) -> list[str]:
    return [str(row[1]) for row in base.execute("PRAGMA table_info(prize)")]


def kept_prizes(path: str | Path) -> PrizeMoney | None:
    """Return the prize money of a tournament; None: none was kept."""
    with opened(path) as base:
        if not has_table(base, "prize"):
            return None
        unit = "unit" if "unit" in _columns(base) else "0.0"
        row = base.execute(f"SELECT fee, added, house, payout, {unit} FROM prize").fetchone()  # noqa: S608
    with named(path, say("its prizes")):
        return PrizeMoney(*row) if row else None


def back_up(path: str | Path, now: datetime) -> Path:
    """Write a copy of the file beside it, and return its name.

    What bears that name is a whole copy, even if the program ends while it is written.
    """
    return copied(path, f"{now:%Y%m%d-%H%M%S}")


CLAIMED, RELEASED, PROPOSED, ENTERED = "claimed", "released", "proposed", "entered"
TABLE = "phone"

_TABLE = f"""
CREATE TABLE IF NOT EXISTS {TABLE} (
    number INTEGER PRIMARY KEY, at TEXT NOT NULL, game TEXT NOT NULL, kind TEXT NOT NULL,
    player TEXT NOT NULL, score TEXT NOT NULL, phone TEXT NOT NULL, address TEXT NOT NULL
)
"""


@dataclass(frozen=True)
class Entry:
    """Something that a phone did in a match.

    Parameters
    ----------
    at
        when, such as 2025-03-01T19:30:00.
    match
        its name.
    kind
        claimed: the phone said that it is this player's; released: the director set the side free;
        proposed: the player sent a result; entered: what was proposed is the result now.
    player
        whose side it is; '' for `entered`.
    score
        the games of each player by name, of a proposal.
    phone, address
        the session, and where it came from.
    """

    at: str
    match: str
    kind: str
    player: str = ""
    score: Mapping[str, int] = field(default_factory=dict)
    phone: str = ""
    address: str = ""


class Sides:
    """Who holds the sides of a match, and what they propose.

    >>> ann = Entry("19:30", "F", CLAIMED, "Ann", phone="x", address="10.0.0.7")
    >>> bo = Entry("19:31", "F", CLAIMED, "Bo", phone="y", address="10.0.0.8")
    >>> sides = Sides([ann, bo])
    >>> sides.of("x"), sides.apart
    ('Ann', True)
    >>> Sides([ann, bo, Entry("19:32", "F", RELEASED, "Ann")]).of("x")
    ''
    """

    def __init__(self, entries: Iterable[Entry]) -> None:
        self.claims: dict[str, Entry] = {}
        self.proposed: dict[str, Entry] = {}
        for entry in entries:
            self._add(entry)

    def _add(self, entry: Entry) -> None:
        match entry.kind:
            case "claimed":  # a phone holds one side; what it proposed for the other is void
                self._free(self.of(entry.phone))
                self.claims[entry.player] = entry
            case "released":
                self._free(entry.player)
            case "proposed":
                self.proposed[entry.player] = entry
            case _:
                self.proposed.clear()

    def _free(self, player: str) -> None:
        self.claims.pop(player, None)
        self.proposed.pop(player, None)

    def of(self, phone: str) -> str:
        """Return whose side a phone holds; '' if none."""
        return next((who for who, claim in self.claims.items() if claim.phone == phone), "")

    @property
    def agree(self) -> bool:
        """Whether both players propose one result."""
        scores = [dict(entry.score) for entry in self.proposed.values()]
        return len(scores) == 2 and scores[0] == scores[1]

    @property
    def apart(self) -> bool:
        """Whether the two sides are held by different phones at different addresses."""
        used: list[set[str]] = [
            {entry.address for entry in (claim, self.proposed.get(who)) if entry}
            for who, claim in self.claims.items()
        ]
        return len(used) == 2 and not used[0] & used[1]


def enter(
    path: str | Path, match: str, pair: Iterable[str], decide: Callable[[Sides], Entry | None]
) -> Sides:
    """Add what a phone does to the log, and return the sides of its match after that.

    Parameters
    ----------
    path
        the file of the tournament.
    match
        its name.
    pair
        who play it now.
    decide
        returns the entry, given the sides as they are; None: nothing is new. Nobody else can add
        any in the meantime.
    """
    with changing(path) as base:
        entries = _read(base, path, match)
        sides = sides_between(entries, pair)
        entry = decide(sides)
        if entry is None:
            return sides
        base.execute(_TABLE)
        values = entry.at, entry.match, entry.kind, entry.player, json.dumps(dict(entry.score))
        base.execute(
            f"INSERT INTO {TABLE} VALUES (NULL, ?, ?, ?, ?, ?, ?, ?)",  # noqa: S608
            (*values, entry.phone, entry.address),
        )
        return sides_between([*entries, entry], pair)


def phone_entries(path: str | Path, match: str | None = None) -> list[Entry]:
    """Return what phones did in a match, or in all, in the order in which it came in."""
    with opened(path) as base:
        return _read(base, path, match)


def sides_between(entries: Iterable[Entry], pair: Iterable[str]) -> Sides:
    """Return the sides of a match, without what others did who were in it before."""
    players = set(pair)
    return Sides(
        entry
        for entry in entries
        if (not entry.player or entry.player in players)
        and (entry.kind != PROPOSED or set(entry.score) == players)
    )


def _read(base: sqlite3.Connection, path: str | Path, match: str | None) -> list[Entry]:
    """Return the entries of a match, or of all, those that 0.2.0 kept first."""
    names = "at, game, kind, player, score, phone, address"
    kept = {
        "proposal": "SELECT at, game, 'proposed', player, score, phone, '' FROM proposal "
        "ORDER BY rowid",
        TABLE: f"SELECT {names} FROM {TABLE} ORDER BY number",  # noqa: S608
    }
    entries = []
    for table, asked in kept.items():
        for row in base.execute(asked).fetchall() if has_table(base, table) else ():
            with named(path, say("what the phones entered")):
                values = dict(zip(names.replace("game", "match").split(", "), row, strict=True))
                values["score"] = json.loads(values["score"])
                entries.append(read_json(Entry, json.dumps(values)))
    return [entry for entry in entries if match in (None, entry.match)]
