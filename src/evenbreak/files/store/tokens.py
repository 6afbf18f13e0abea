"""Other programs' tokens in an evening's file: what each may enter, and only its hash.

A token is 160 random bits. It is shown once, when it is created; the file has only its SHA-256,
which no one can use as a token. Every server on the file checks each time that the token still
exists. Tokens aren't log entries: an undo neither revokes one nor brings it back.
"""

from __future__ import annotations

import base64
import hashlib
import hmac
import re
import secrets
import sqlite3
from dataclasses import dataclass, replace
from pathlib import Path

from evenbreak.errors import InputError
from evenbreak.evenings.log import PROGRAM
from evenbreak.files.store.evening_file import changing, damaged, opened
from evenbreak.files.store.formats import has_table, source
from evenbreak.files.tables.names import clean_name, is_name
from evenbreak.words import say

SCORES, DIRECTOR = "scores", "director"
MOVES_OF_SCORES = ("score", "result", "call", "uncall")
MOVES_OF_A_TABLE = ("score", "result")
_AT_TABLE = "table:"
_SCOPE = re.compile(rf"{SCORES}|{DIRECTOR}|{_AT_TABLE}[1-9][0-9]{{0,2}}")
_BEGINS = "evenbreak-"
_BYTES = 20
_MOST, _LONGEST = 50, 40
_TABLE = """
CREATE TABLE IF NOT EXISTS token (
    name TEXT PRIMARY KEY, scope TEXT NOT NULL, hash TEXT NOT NULL, created TEXT NOT NULL
)
"""


@dataclass(frozen=True)
class Token:
    """A token's name, scope and use.

    Its scope is scores, director, or table:4 for the match on the fourth table; `used` is the time
    of the last entry made with it, '' if there is none or it wasn't looked up.

    >>> Token("TV", "table:4").allows("result"), Token("TV", "table:4").allows("call")
    (True, False)
    """

    name: str
    scope: str
    created: str = ""
    used: str = ""

    @property
    def table(self) -> int:
        """The number of the only table whose match it may enter; 0 for all tables."""
        return int(self.scope.removeprefix(_AT_TABLE)) if self.scope.startswith(_AT_TABLE) else 0

    @property
    def author(self) -> str:
        """The author stored with its entries."""
        return PROGRAM + self.name

    def allows(self, move: str) -> bool:
        """Return whether it may be used for a move."""
        of = MOVES_OF_A_TABLE if self.table else MOVES_OF_SCORES
        return self.scope == DIRECTOR or move in of


def at_table(number: int) -> str:
    """Return the scope of a token for one table's match."""
    return f"{_AT_TABLE}{number}"


def create_token(path: str | Path, name: str, scope: str, at: str) -> str:
    """Create a token and return it: it can't be shown again.

    Raises InputError if another program has the name, or there are too many tokens. The scope is as
    in `Token`.
    """
    called = clean_name(name)
    if not is_name(called) or len(called) > _LONGEST:
        what = say("a name of up to {most} printable characters", most=_LONGEST)
        raise InputError("{name!r} isn't {what}", name=name[:_LONGEST], what=what)
    token = _BEGINS + base64.b32encode(secrets.token_bytes(_BYTES)).decode().lower()
    with changing(path) as base:
        base.execute(_TABLE)
        there = _tokens(base, path)
        if any(one.name.casefold() == called.casefold() for one in there.values()):
            raise InputError(
                "{name} already has a token. Revoke it first, or choose another name.",
                name=called,
            )
        if len(there) >= _MOST:
            raise InputError("there are already {n} tokens. Revoke some first.", n=_MOST)
        row = called, scope, _hash(token), at
        base.execute("INSERT INTO token VALUES (?, ?, ?, ?)", row)
    return token


def revoke_token(path: str | Path, name: str) -> None:
    """Revoke a token at once, on every server; raise InputError if no program has this name."""
    with changing(path) as base:
        base.execute(_TABLE)
        if not base.execute("DELETE FROM token WHERE name = ?", (name,)).rowcount:
            raise InputError("no program called {name} has a token", name=name)


def kept_tokens(path: str | Path, *, used: bool = False) -> dict[str, Token]:
    """Return a file's tokens by hash, oldest first; `used` adds the times of their last entries."""
    with opened(path) as base:
        found = _tokens(base, path) if has_table(base, "token") else {}
        if not used:
            return found
        asked = f"SELECT MAX(at) FROM {source(base)} WHERE author = ? AND at >= ?"  # noqa: S608
        last = {
            kept: base.execute(asked, (one.author, one.created)).fetchone()[0]
            for kept, one in found.items()
        }
    return {kept: replace(one, used=last[kept] or "") for kept, one in found.items()}


def token_in(tokens: dict[str, Token], text: str) -> Token | None:
    """Return the token that a string matches; None if there is none."""
    hashed = _hash(text)
    same = (
        one for kept, one in tokens.items() if hmac.compare_digest(kept.encode(), hashed.encode())
    )
    return next(same, None)


def _tokens(base: sqlite3.Connection, path: str | Path) -> dict[str, Token]:
    found: dict[str, Token] = {}
    for row in base.execute(
        "SELECT name, scope, hash, created FROM token ORDER BY rowid"
    ).fetchall():
        name, scope, hashed, created = row
        if not all(isinstance(one, str) for one in row) or not _SCOPE.fullmatch(scope):
            raise damaged(path, say("its tokens can't be read"))
        found[hashed] = Token(name, scope, created)
    return found


def _hash(token: str) -> str:
    return hashlib.sha256(token.encode(errors="replace")).hexdigest()
