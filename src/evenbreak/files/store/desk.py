"""What an evening's file holds besides its events: secrets, and what phones did.

What phones did is a strand of the log: who claimed which player, who proposed which result. Whose
phone is whose, and what is proposed now, are folded from it.
"""

from __future__ import annotations

import secrets
import sqlite3
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path

from evenbreak.errors import DataError
from evenbreak.evenings.log import Event, Kinds
from evenbreak.files.store.evening_file import changing, copied, damaged, opened
from evenbreak.files.store.formats import PHONES, has_table
from evenbreak.files.store.log import Rules, add, entries, was_taken
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.words import say

_SECRETS = "CREATE TABLE IF NOT EXISTS secret (name TEXT PRIMARY KEY, value TEXT NOT NULL)"


def kept_secrets(path: str | Path, first: Mapping[str, str]) -> dict[str, str]:
    """Return a tournament's secrets by name; if it has none, `first` are stored.

    If the file is currently read-only, they aren't stored.
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
        raise damaged(path, say("its PIN can't be read"))
    return {**first, **kept}


def _secrets(base: sqlite3.Connection) -> dict[str, str]:
    if not has_table(base, "secret"):
        return {}
    return dict(base.execute("SELECT name, value FROM secret").fetchall())


def change_secrets(path: str | Path, to: Mapping[str, str]) -> None:
    """Store new secrets for a tournament in place of those with the same names."""
    with changing(path) as base:
        base.execute(_SECRETS)
        base.executemany("INSERT OR REPLACE INTO secret VALUES (?, ?)", list(to.items()))


def new_pin() -> str:
    """Return a six-digit PIN."""
    return f"{secrets.randbelow(10**6):06d}"


def back_up(path: str | Path, now: datetime) -> Path:
    """Write a copy of the file next to it, and return the copy's name.

    A file with that name is always a complete copy, even if the program ends while writing.
    """
    return copied(path, f"{now:%Y%m%d-%H%M%S}")


CLAIMED, RELEASED, COMING = "claimed", "released", "coming"
PROPOSED, WITHDRAWN, ENTERED, OBJECTED = "proposed", "withdrawn", "entered", "objected"
TABLET, NO_TABLET = "tablet", "no tablet"
_FOR_ALL = CLAIMED, RELEASED, TABLET, NO_TABLET
_OF_A_MATCH = COMING, PROPOSED, WITHDRAWN, ENTERED, OBJECTED
_BY = "phone "


@dataclass(frozen=True)
class Act:
    """Something that a phone did, or that the director did about a phone.

    claimed: the phone belongs to this player from now on; released: the player has none; coming:
    the player is on the way to the table, in `score['minutes']`; proposed: the player sent a
    result; withdrawn: the player took it back; entered: the proposal is the result now; objected: a
    table says that its last result is wrong; tablet: the phone belongs to the table that `player`
    names; no tablet: it no longer does.

    A claim applies to all the night's events.
    """

    kind: str = ""
    player: str = ""
    match: str = ""
    score: Mapping[str, int] = field(default_factory=dict)
    event: int = 1


@dataclass(frozen=True)
class Entry(Event):
    """An entry about a phone; its author is the phone, by session and address."""

    what: Act

    @property
    def kind(self) -> str:
        """The action's name."""
        return self.what.kind

    @property
    def phone(self) -> str:
        """The session that did it; '' for the director."""
        return self._author[0]

    @property
    def address(self) -> str:
        """The phone's address."""
        return self._author[1]

    @property
    def _author(self) -> tuple[str, str]:
        if not self.by.startswith(_BY):
            return "", ""
        phone, _, address = self.by.removeprefix(_BY).rpartition(" ")
        return phone, address


def by_phone(phone: str, address: str) -> str:
    """Return the author of a phone's action."""
    return f"{_BY}{phone} {address}"


class Phones:
    """Whose phones are whose, which tablets belong to tables, and current proposals.

    A phone has one player. Claiming another player gives up the first, along with anything proposed
    for them: no one answers for both players. A player's proposal also goes when the phone it came
    from does.

    >>> ann = Entry("19:30", Act(CLAIMED, "Ann"), by_phone("x", "10.0.0.7"))
    >>> bo = Entry("19:31", Act(CLAIMED, "Bo"), by_phone("y", "10.0.0.8"))
    >>> phones = Phones([ann, bo])
    >>> phones.of("x"), phones.sides("F", ("Ann", "Bo")).apart
    ('Ann', True)
    >>> Phones([ann, bo, Entry("19:32", Act(CLAIMED, "Bo"), ann.by)]).of("y")
    ''
    """

    def __init__(self, did: Iterable[Entry] = ()) -> None:
        self.claims: dict[str, Entry] = {}
        self.coming: dict[str, Entry] = {}
        self.objections: dict[str, Entry] = {}
        self.tablets: dict[str, Entry] = {}
        self._proposed: dict[str, dict[str, Entry]] = {}
        for entry in did:
            self.add(entry)

    def add(self, entry: Entry) -> None:
        """Apply the next entry."""
        player, match = entry.what.player, entry.what.match
        match entry.kind:
            case "claimed":
                before = self.claims.get(player)
                if before is None or before.phone != entry.phone:
                    self._free(player)
                    self._free(self.of(entry.phone))
                self.claims[player] = entry
            case "released":
                self._free(player)
            case "coming":
                self.coming[player] = entry
            case "proposed":
                self._proposed.setdefault(match, {})[player] = entry
            case "withdrawn":
                self._proposed.get(match, {}).pop(player, None)
            case "objected":
                self.objections[match] = entry
            case "tablet":
                self.tablets[entry.phone] = entry
            case "no tablet":
                self.tablets = {
                    k: one for k, one in self.tablets.items() if one.what.player != player
                }
            case _:
                self._proposed.pop(match, None)

    def _free(self, player: str) -> None:
        self.claims.pop(player, None)
        for proposed in self._proposed.values():
            proposed.pop(player, None)

    def of(self, phone: str) -> str:
        """Return whose phone it is; '' if it's no one's."""
        return next((who for who, claim in self.claims.items() if claim.phone == phone), "")

    def table_of(self, phone: str) -> int:
        """Return a tablet's table; 0 if it has none."""
        return int(self.tablets[phone].what.player) if phone in self.tablets else 0

    def answer(self, player: str, match: str, since: str) -> int | None:
        """Return how many minutes until a called player arrives; None if they haven't said."""
        note = self.coming.get(player)
        if note is None or note.what.match != match or note.at < since:
            return None
        return note.what.score.get("minutes", 0)

    def tablets_of(self, table: int) -> list[str]:
        """Return a table's tablets."""
        return [phone for phone, one in self.tablets.items() if one.what.player == str(table)]

    def sides(self, match: str, pair: tuple[str, str]) -> Sides:
        """Return the match's current players' proposals, ignoring anyone who was in it before."""
        proposed = self._proposed.get(match, {})
        there = {name: proposed[name] for name in pair if name in proposed}
        now = {name: one for name, one in there.items() if set(one.what.score) == set(pair)}
        claims = {name: self.claims[name] for name in pair if name in self.claims}
        return Sides(match, pair, claims, now)


@dataclass(frozen=True)
class Sides:
    """What a match's two players propose; `claims` are the phones of players who have one."""

    match: str
    pair: tuple[str, str]
    claims: Mapping[str, Entry]
    proposed: Mapping[str, Entry]

    @property
    def scores(self) -> dict[str, tuple[int, int]]:
        """Each player's proposed score, with the first player's games first."""
        one, other = self.pair
        return {
            who: (its.what.score[one], its.what.score[other]) for who, its in self.proposed.items()
        }

    @property
    def agree(self) -> bool:
        """Whether both players propose the same result."""
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
    """Return the matches whose players propose different results."""
    ready = state.standing.to_play if state.drawn else ()
    sides = (phones.sides(name, state.pair(name)) for name in ready)
    return [one for one in sides if len(set(one.scores.values())) == 2]


def objected(state: Evening, phones: Phones) -> list[str]:
    """Return the matches whose current result is wrong, according to a tap at their table."""
    found = []
    for match, entry in phones.objections.items():
        result = state.counted.get(match) if state.drawn else None
        if result is not None and result.games == dict(entry.what.score):
            found.append(match)
    return found


def phones_in(did: Iterable[Entry], state: Evening, event: int = 1) -> Phones:
    """Return the current state of the phones in one of the night's events.

    Claims apply to all events; each player has the name that this event uses now.
    """

    def now(entry: Entry) -> Entry:
        act = entry.what
        score = {state.former.get(who, who): games for who, games in act.score.items()}
        player = state.former.get(act.player, act.player)
        return replace(entry, what=replace(act, player=player, score=score))

    own = (one for one in did if one.what.event == event or one.kind in _FOR_ALL)
    return Phones(map(now, own) if state.former else own)


def enter(
    path: str | Path,
    state: Evening,
    decide: Callable[[Phones], Act | None],
    *,
    at: str,
    by: str = "",
    event: int = 1,
    form: str | None = None,
) -> Phones:
    """Add a phone's action to the log, and return the state of the phones after it.

    `decide` returns the action, or None if there is nothing new; no one else can add anything
    meanwhile. A `form` (its ID) that was accepted before adds nothing, and `decide` isn't called.
    """
    with changing(path) as base:
        earlier = entries(base, path, PHONES, _RULES)
        phones = phones_in(earlier, state, event)
        act = None if was_taken(base, PHONES, form) else decide(phones)
        if act is not None:
            entry = Entry(at, replace(act, event=event), by)
            add(base, PHONES, _RULES, [entry], count=len(earlier), form=form)
            phones.add(entry)
        return phones


def phone_entries(path: str | Path) -> list[Entry]:
    """Return the phones' actions, in the order they came in."""
    with opened(path) as base:
        return entries(base, path, PHONES, _RULES)


class _Acts(Kinds[Act]):
    """A phone's actions use one class, whatever their kind."""

    def __init__(self) -> None:
        super().__init__(dict.fromkeys((*_FOR_ALL, *_OF_A_MATCH), Act))

    def name(self, what: Act) -> str:
        return what.kind

    def read(self, kind: str, text: str) -> Act:
        return replace(super().read(kind, text), kind=kind)


_RULES: Rules[Entry, Phones] = Rules(_Acts(), Entry, Phones)
