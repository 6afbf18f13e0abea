"""What has happened in an evening's matches: results, calls, scores, reasons to wait."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeAlias

from evenbreak.tournaments.evening.events import (
    Called,
    CalledBack,
    Event,
    LaterDraw,
    Ranked,
    Result,
    Scored,
    Substituted,
    Swapped,
    Waits,
)

Pairing: TypeAlias = tuple[str, frozenset[str]]
"""A match and its players: a correction may send others into it, or bring them back."""


class Played(NamedTuple):
    """A result, and when it came in."""

    result: Result
    at: str


def played_matches(records: Mapping[str, Sequence[Played]]) -> list[Played]:
    """Return the last result between each two players in each match, including those set aside."""
    found = {
        (name, frozenset(one.result.players)): one
        for name, played in records.items()
        for one in played
    }
    return list(found.values())


class OnTable(NamedTuple):
    """A match that has been called, and when."""

    call: Called
    at: str


class LiveScore(NamedTuple):
    """The last score of a match in play, and when it came in."""

    what: Scored
    at: str

    def of(self, pair: tuple[str | None, ...]) -> tuple[int, int]:
        """Return it in its players' order."""
        return self.what.score if self.what.players == pair else self.what.score[::-1]


class Matches:
    """What has happened in the matches so far."""

    def __init__(self) -> None:
        self.records: dict[str, list[Played]] = {}
        self.calls: dict[Pairing, OnTable] = {}
        self.scores: dict[Pairing, LiveScore] = {}
        self.waits: dict[Pairing, Waits] = {}
        self.ties: dict[str, Ranked] = {}
        self.later: dict[str, tuple[str | None, ...]] = {}

    @property
    def begun(self) -> set[str]:
        """The matches that have been called, scored or played."""
        return {*self.records, *(name for name, _ in (*self.calls, *self.scores))}

    def take(self, event: Event, *, in_pairs: bool) -> None:
        """Apply an event; `in_pairs`: in a Swiss round."""
        match event.what:
            case Result() as result:
                self.records.setdefault(result.match, []).append(Played(result, event.at))
            case Called() | CalledBack() | Waits() as call:
                self.call(call, event.at)
            case Scored() as scored:
                pairing = scored.match, frozenset(scored.players)
                self.scores[pairing] = LiveScore(scored, event.at)
            case Ranked() as tie:
                self.ties[tie.group] = tie
            case LaterDraw(stage=stage, order=seats):
                self.later[stage] = seats
            case Swapped(one=one, other=other) if in_pairs:
                self.trade({one: other, other: one})
            case Substituted(name=name, entrant=now):
                self.trade({name: now.name})

    def call(self, call: Called | CalledBack | Waits, at: str) -> None:
        """Put a match on a table, take it off, or let it wait."""
        pairing = call.match, frozenset(call.players)
        if isinstance(call, Waits) and not call:
            self.waits.pop(pairing, None)
            return
        earlier = self.calls.pop(pairing, None)
        if isinstance(call, Waits):
            self.waits[pairing] = call
        elif isinstance(call, Called):  # anew, so that calls are in the order of time
            self.waits.pop(pairing, None)
            moved = earlier is not None and call.match not in self.records
            self.calls[pairing] = OnTable(call, earlier.at if earlier and moved else at)

    def move(self, places: Mapping[int, int]) -> None:
        """Keep matches on renumbered tables, and remove them from tables that are gone."""
        self.calls = {
            key: one._replace(call=replace(one.call, table=places[one.call.table]))
            for key, one in self.calls.items()
            if one.call.table in places
        }

    def trade(self, names: Mapping[str, str]) -> None:
        """Put players where others were, in the last round and in calls."""
        if self.later:
            last = next(reversed(self.later))
            self.later[last] = tuple(names.get(str(name), name) for name in self.later[last])
        calls, self.calls = self.calls, {}
        for (match, _), one in calls.items():
            first, second = (names.get(name, name) for name in one.call.players)
            pairing = match, frozenset((first, second))
            self.calls[pairing] = one._replace(call=replace(one.call, players=(first, second)))
        self.waits = {key: one for key, one in self.waits.items() if not key[1] & names.keys()}
