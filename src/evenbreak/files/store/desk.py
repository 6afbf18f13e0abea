"""What the file of an evening holds besides its events: secrets, prizes, what phones did.

Of what phones did entries are only ever added: who claimed which player, who proposed which result.
Who has whose phone, and what is proposed now, are a fold of them.
"""

from __future__ import annotations

import json
import secrets
import sqlite3
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path

from evenbreak.errors import DataError
from evenbreak.evenings.log import read_json
from evenbreak.files.store.evening_file import changing, copied, damaged, named, opened
from evenbreak.files.store.formats import has_table
from evenbreak.tournaments.evening.fold import Evening
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


CLAIMED, RELEASED, COMING = "claimed", "released", "coming"
PROPOSED, WITHDRAWN, ENTERED, OBJECTED = "proposed", "withdrawn", "entered", "objected"
TABLET, NO_TABLET = "tablet", "no tablet"
TABLE = "phone"

_TABLE = f"""
CREATE TABLE IF NOT EXISTS {TABLE} (
    number INTEGER PRIMARY KEY, at TEXT NOT NULL, game TEXT NOT NULL, kind TEXT NOT NULL,
    player TEXT NOT NULL, score TEXT NOT NULL, phone TEXT NOT NULL, address TEXT NOT NULL
)
"""


@dataclass(frozen=True)
class Entry:
    """Something that a phone did, or that the director did about one.

    Parameters
    ----------
    at
        when, such as 2025-03-01T19:30:00.
    match
        its name; '' for what is about no match.
    kind
        claimed: the phone is this player's from now on; released: the player has none;
        coming: the player is on the way to the table, in `score['minutes']`;
        proposed: the player sent a result; withdrawn: and took it back; entered: what was proposed
        is the result now; objected: a table says that its last result is wrong;
        tablet: the phone belongs to the table that `player` names; no tablet: it no longer does.
    player
        who did it, or whom it is about; the number of a table for what a tablet did.
    score
        the games of each player by name, of a proposal or of the result that is objected to.
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


class Phones:
    """Whose phones are whose, which tablets belong to tables, and what is proposed.

    A phone has one player. Whoever claims another one gives up the first, and with it what they
    proposed: nobody answers for both. So does a player's proposal go with the phone it came from.

    >>> ann = Entry("19:30", "", CLAIMED, "Ann", phone="x", address="10.0.0.7")
    >>> bo = Entry("19:31", "", CLAIMED, "Bo", phone="y", address="10.0.0.8")
    >>> phones = Phones([ann, bo])
    >>> phones.of("x"), phones.sides("F", ("Ann", "Bo")).apart
    ('Ann', True)
    >>> Phones([ann, bo, Entry("19:32", "", CLAIMED, "Bo", phone="x")]).of("y")
    ''
    """

    def __init__(self, entries: Iterable[Entry] = ()) -> None:
        self.claims: dict[str, Entry] = {}
        self.coming: dict[str, Entry] = {}
        self.objections: dict[str, Entry] = {}
        self.tablets: dict[str, Entry] = {}
        self._proposed: dict[str, dict[str, Entry]] = {}
        for entry in entries:
            self.add(entry)

    def add(self, entry: Entry) -> None:
        """Add the next entry."""
        match entry.kind:
            case "claimed":
                before = self.claims.get(entry.player)
                if before is None or before.phone != entry.phone:
                    self._free(entry.player)
                    self._free(self.of(entry.phone))
                self.claims[entry.player] = entry
            case "released":
                self._free(entry.player)
            case "coming":
                self.coming[entry.player] = entry
            case "proposed":
                self._proposed.setdefault(entry.match, {})[entry.player] = entry
            case "withdrawn":
                self._proposed.get(entry.match, {}).pop(entry.player, None)
            case "objected":
                self.objections[entry.match] = entry
            case "tablet":
                self.tablets[entry.phone] = entry
            case "no tablet":
                self.tablets.pop(entry.phone, None)
            case _:
                self._proposed.pop(entry.match, None)

    def _free(self, player: str) -> None:
        self.claims.pop(player, None)
        for proposed in self._proposed.values():
            proposed.pop(player, None)

    def of(self, phone: str) -> str:
        """Return whose phone it is; '' if nobody's."""
        return next((who for who, claim in self.claims.items() if claim.phone == phone), "")

    def table_of(self, phone: str) -> int:
        """Return the table that a tablet belongs to; 0 if it is none."""
        return int(self.tablets[phone].player) if phone in self.tablets else 0

    def answer(self, player: str, match: str, since: str) -> int | None:
        """Return in how many minutes a player who was called comes; None: they have not said."""
        note = self.coming.get(player)
        if note is None or note.match != match or note.at < since:
            return None
        return note.score.get("minutes", 0)

    def tablets_of(self, table: int) -> list[str]:
        """Return the tablets of a table."""
        return [phone for phone, one in self.tablets.items() if one.player == str(table)]

    def sides(self, match: str, pair: tuple[str, str]) -> Sides:
        """Return what the players of a match propose, without others who were in it before."""
        proposed = self._proposed.get(match, {})
        there = {name: proposed[name] for name in pair if name in proposed}
        now = {name: one for name, one in there.items() if set(one.score) == set(pair)}
        claims = {name: self.claims[name] for name in pair if name in self.claims}
        return Sides(match, pair, claims, now)


@dataclass(frozen=True)
class Sides:
    """What the two players of a match propose.

    Parameters
    ----------
    match, pair
        the match and who play it.
    claims
        the phones of those who have one.
    proposed
        what they propose.
    """

    match: str
    pair: tuple[str, str]
    claims: Mapping[str, Entry]
    proposed: Mapping[str, Entry]

    @property
    def scores(self) -> dict[str, tuple[int, int]]:
        """What each of them says, the games of the first player first."""
        one, other = self.pair
        return {who: (its.score[one], its.score[other]) for who, its in self.proposed.items()}

    @property
    def agree(self) -> bool:
        """Whether both players propose one result."""
        return len(self.proposed) == 2 and len(set(self.scores.values())) == 1

    @property
    def apart(self) -> bool:
        """Whether the two players have different phones at different addresses."""
        used: list[set[str]] = [
            {one.address for one in (claim, self.proposed.get(who)) if one}
            for who, claim in self.claims.items()
        ]
        return len(used) == 2 and not used[0] & used[1]


def disputes(state: Evening, phones: Phones) -> list[Sides]:
    """Return the matches of which the two players propose different results."""
    ready = state.standing.to_play if state.drawn else ()
    sides = (phones.sides(name, state.pair(name)) for name in ready)
    return [one for one in sides if len(set(one.scores.values())) == 2]


def objected(state: Evening, phones: Phones) -> list[str]:
    """Return the matches whose result, as it is, is wrong by what was tapped at their table."""
    found = []
    for match, entry in phones.objections.items():
        result = state.counted.get(match) if state.drawn else None
        if result is not None and result.games == dict(entry.score):
            found.append(match)
    return found


def phones_in(entries: Iterable[Entry], state: Evening) -> Phones:
    """Return what is known of the phones, each player called what they are called now."""

    def now(entry: Entry) -> Entry:
        score = {state.former.get(who, who): games for who, games in entry.score.items()}
        return replace(entry, player=state.former.get(entry.player, entry.player), score=score)

    return Phones(map(now, entries) if state.former else entries)


def enter(path: str | Path, state: Evening, decide: Callable[[Phones], Entry | None]) -> Phones:
    """Add what a phone does to the log, and return what is known of the phones after that.

    Parameters
    ----------
    path
        the file of the tournament.
    state
        its state, which knows what the players are called now.
    decide
        returns the entry, given the phones as they are; None: nothing is new. Nobody else can add
        any in the meantime.
    """
    with changing(path) as base:
        phones = phones_in(_read(base, path), state)
        entry = decide(phones)
        if entry is None:
            return phones
        base.execute(_TABLE)
        values = entry.at, entry.match, entry.kind, entry.player, json.dumps(dict(entry.score))
        base.execute(
            f"INSERT INTO {TABLE} VALUES (NULL, ?, ?, ?, ?, ?, ?, ?)",  # noqa: S608
            (*values, entry.phone, entry.address),
        )
        phones.add(entry)
        return phones


def phone_entries(path: str | Path) -> list[Entry]:
    """Return what phones did, in the order in which it came in."""
    with opened(path) as base:
        return _read(base, path)


def _read(base: sqlite3.Connection, path: str | Path) -> list[Entry]:
    """Return all entries, those that 0.2.0 kept first."""
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
    return entries
