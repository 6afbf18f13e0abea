"""Databases as an accident or an attacker may leave them, each made from a good one by a seed."""

import json
import random
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

DEEP: Any = json.loads("[" * 400 + "]" * 400)
VALUES: tuple[Any, ...] = (
    *(None, True, False, "", "x", "W1.1", "\ud800", "Ann Lee", "a" * 5000, "2025-03-01T19:30:00"),
    *(0, 1, -1, 2, 255, 256, 1000, 10**6, 10**30, 0.5, -0.0, 1e308),
    *(float("nan"), float("inf"), -float("inf")),
    *([], {}, [1], [None, None], ["x", "y"], {"x": 1}, DEEP),
)
CELLS: tuple[Any, ...] = (
    *("", "x", "{}", "[]", "null", "NaN", "[" * 100_000, "9" * 5000, "\x00", "1e999"),
    *(b"", b"\xff\xfe", b"{}", 0, -1, 5, 2**63 - 1, 0.5, float("inf")),
    *("9999-12-31T23:59:59", "0001-01-01T00:00:00", "2025-03-01T19:30:00+02:00", "2025-03-01"),
)
PRAGMAS = {
    "user_version": (0, -1, 4, 2**31 - 1, -(2**31)),
    "application_id": (0, -1, 1, 252006674),
}


def mutate(path: Path, luck: random.Random) -> str:
    """Damage a database, and say how."""
    how = luck.choices(list(WAYS), [weight for _, weight in WAYS.values()])[0]
    return f"{how}: {WAYS[how][0](path, luck)}"


def _in_base(change: Callable[[sqlite3.Connection, random.Random], str]) -> Callable[..., str]:
    def run(path: Path, luck: random.Random) -> str:
        with closing(sqlite3.connect(path, isolation_level=None)) as base:
            return change(base, luck)

    return run


def _tables(base: sqlite3.Connection) -> list[str]:
    asked = "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name"
    return [name for (name,) in base.execute(asked)]


def _events(base: sqlite3.Connection) -> str:
    return "event" if "event" in _tables(base) else "team_event"


def _value(base: sqlite3.Connection, luck: random.Random) -> str:
    """Change something in the JSON of an event."""
    table = _events(base)
    rows = base.execute(f"SELECT number, kind, what FROM {table}").fetchall()  # noqa: S608
    number, kind, what = luck.choice(rows)
    data = json.loads(what)
    where, place = _place(data, luck)
    done = luck.choice(("put", "put", "put", "remove", "add", "twice"))
    if done == "put" and place is not None:
        where[place] = luck.choice(VALUES)
    elif done == "remove" and place is not None:
        del where[place]
    elif isinstance(where, dict):
        where["more"] = luck.choice(VALUES)
    else:
        where.append(luck.choice([*where, *VALUES]))
    text = json.dumps(data)
    base.execute(f"UPDATE {table} SET what = ? WHERE number = ?", (text, number))  # noqa: S608
    return f"entry {number} ({kind}): {done} at {place!r}: {text[:300]}"


def _place(data: Any, luck: random.Random) -> tuple[Any, Any]:
    """Return a container in some data, and a key or an index in it."""
    while True:
        keys = list(data) if isinstance(data, dict) else list(range(len(data)))
        if not keys:
            return data, None
        key = luck.choice(keys)
        if not isinstance(data[key], dict | list) or luck.random() < 0.25:
            return data, key
        data = data[key]


def _cell(base: sqlite3.Connection, luck: random.Random) -> str:
    """Change a cell of any table."""
    table = luck.choice(_tables(base))
    columns = [row[1] for row in base.execute(f"PRAGMA table_info({table})")]
    column, value = luck.choice(columns), luck.choice(CELLS)
    rows = [row for (row,) in base.execute(f"SELECT rowid FROM {table}")]  # noqa: S608
    if not rows:
        return "nothing"
    row = luck.choice(rows)
    try:
        if value == b"\xff\xfe":
            asked = f"UPDATE {table} SET {column} = CAST(? AS TEXT) WHERE rowid = ?"  # noqa: S608
        else:
            asked = f"UPDATE {table} SET {column} = ? WHERE rowid = ?"  # noqa: S608
        base.execute(asked, (value, row))
    except (sqlite3.Error, OverflowError):
        return "nothing"
    return f"{table}.{column} of row {row} is {value!r:.80}"


def _rows(base: sqlite3.Connection, luck: random.Random) -> str:
    """Remove, repeat or exchange events."""
    table = _events(base)
    numbers = [one for (one,) in base.execute(f"SELECT number FROM {table}")]  # noqa: S608
    one, other = luck.choice(numbers), luck.choice(numbers)
    done = luck.choice(("remove", "repeat", "exchange", "remove from"))
    if done == "repeat":
        form = ", NULL" if table == "team_event" else ""
        more = ", author" + form if form else ""
        base.execute(
            f"INSERT INTO {table} SELECT {max(numbers) + 1}, at, kind, what{more} "  # noqa: S608
            f"FROM {table} WHERE number = {one}"
        )
    elif done == "exchange":
        for old, new in ((one, -1), (other, one), (-1, other)):
            base.execute(f"UPDATE {table} SET number = {new} WHERE number = {old}")  # noqa: S608
    else:
        sign = "=" if done == "remove" else "<="
        base.execute(f"DELETE FROM {table} WHERE number {sign} {one}")  # noqa: S608
    return f"{done} {one}, {other}"


def _schema(base: sqlite3.Connection, luck: random.Random) -> str:
    """Change a table itself."""
    table = luck.choice(_tables(base))
    columns = [row[1] for row in base.execute(f"PRAGMA table_info({table})")]
    column = luck.choice(columns)
    asked = luck.choice(
        (
            f"DROP TABLE {table}",
            f"DELETE FROM {table}",  # noqa: S608
            f"ALTER TABLE {table} RENAME TO other",
            f"ALTER TABLE {table} RENAME COLUMN {column} TO other",
            f"ALTER TABLE {table} DROP COLUMN {column}",
            f"ALTER TABLE {table} ADD COLUMN more TEXT",
            f"ALTER TABLE {table} RENAME TO o; CREATE VIEW {table} AS SELECT * FROM o",  # noqa: S608
            f"DROP TABLE {table}; CREATE TABLE {table} (x)",
            f"CREATE TRIGGER t AFTER INSERT ON {table} BEGIN SELECT RAISE(ABORT, 'no'); END",
        )
    )
    try:
        base.executescript(asked)
    except sqlite3.Error:
        return "nothing"
    return asked


def _pragma(base: sqlite3.Connection, luck: random.Random) -> str:
    name = luck.choice(list(PRAGMAS))
    value = luck.choice(PRAGMAS[name])
    base.execute(f"PRAGMA {name} = {value}")
    return f"{name} = {value}"


def _bytes(path: Path, luck: random.Random) -> str:
    """Change the file itself."""
    body = bytearray(path.read_bytes())
    done = luck.choice(("cut", "flip", "flip", "flip", "zero", "more", "text", "empty", "swap"))
    if done == "cut":
        del body[luck.randrange(len(body)) :]
    elif done == "flip":
        for _ in range(luck.choice((1, 5, 50, 500))):
            body[luck.randrange(len(body))] ^= 1 << luck.randrange(8)
    elif done == "zero":
        start = 4096 * luck.randrange(len(body) // 4096)
        body[start : start + 4096] = bytes(4096)
    elif done == "more":
        body += luck.randbytes(5000)
    elif done == "swap":
        body[4096:8192], body[8192:12288] = body[8192:12288], body[4096:8192]
    else:
        body = bytearray(b"player,rating\nAnn,600\n" if done == "text" else b"")
    path.write_bytes(body)
    return done


def _beside(path: Path, luck: random.Random) -> str:
    """Leave a log beside it that is none."""
    ending = luck.choice(("-wal", "-journal", "-shm"))
    path.with_name(path.name + ending).write_bytes(luck.randbytes(luck.choice((0, 30, 5000))))
    return ending


WAYS: dict[str, tuple[Callable[[Path, random.Random], str], int]] = {
    "value": (_in_base(_value), 12),
    "cell": (_in_base(_cell), 4),
    "rows": (_in_base(_rows), 3),
    "schema": (_in_base(_schema), 2),
    "pragma": (_in_base(_pragma), 1),
    "bytes": (_bytes, 3),
    "beside": (_beside, 1),
}
"""How a database is damaged, and how often."""
