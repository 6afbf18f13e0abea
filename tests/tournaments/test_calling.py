"""Which match is called to which table: by hand as proposed, and with the result before it."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest

from evenbreak.errors import InputError
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.calling import (
    calls_after,
    proposed_calls,
    ready_matches,
)
from evenbreak.tournaments.evening.events import (
    BY_ITSELF,
    Called,
    CalledBack,
    Changed,
    Drawn,
    Entrant,
    Event,
    Opened,
    Plan,
    Waits,
    What,
)
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.undoing import free_entries, own_last, redo, undo, undoable

NAMES = [f"P{k}" for k in range(8)]


class Night:
    """An evening to which things happen, a minute apart."""

    def __init__(self, form: str = "double", **plan: object) -> None:
        players = tuple(Entrant(name, 600.0) for name in NAMES)
        lines = tuple(range(8)) if form == "double" else None
        self.events = [
            self._at(0, Opened(Plan(form, 3, **plan), players)),  # type: ignore[arg-type]
            self._at(1, Drawn(tuple(NAMES), lines)),
        ]

    @staticmethod
    def _at(minute: int, what: What) -> Event:
        return Event(f"2025-03-01T{19 + minute // 60}:{minute % 60:02d}:00", what)

    @property
    def state(self) -> Evening:
        return evening(self.events)

    def add(self, *whats: What) -> Evening:
        self.events += [self._at(len(self.events), what) for what in whats]
        return self.state

    def enter(self, match: str, score: tuple[int, int] = (3, 1)) -> Evening:
        """Enter a result with the calls that follow from it."""
        before = self.state
        found = moves.result(before, match, score)
        after = evening([*self.events, self._at(len(self.events), found)])
        self.add(found)
        for _, one in calls_after({1: before}, {1: after}):
            self.events.append(replace(self._at(len(self.events), one), by=BY_ITSELF))
        return self.state


def called(night: Night) -> Night:
    for _, one in proposed_calls({1: night.state}):
        night.add(one)
    return night


@pytest.mark.parametrize("form", ["double", "round-robin"])
def test_a_whole_evening_needs_no_call_after_the_first(form: str) -> None:
    """Whatever the results: while a match is ready, no table is free, and nobody plays twice."""
    for seed in range(6):
        rng, night = random.Random(seed), called(Night(form, tables=3))
        while night.state.on_tables:
            state = night.state
            busy = [name for one in state.on_tables.values() for name in one.call.players]
            assert len(set(busy)) == len(busy)
            assert not (state.free_tables and ready_matches(state))
            night.enter(rng.choice(list(state.on_tables)), rng.choice([(3, 1), (0, 3)]))
        assert not night.state.standing.to_play


def test_tables_that_somebody_keeps_free_stay_free() -> None:
    night = called(Night(tables=2))
    state = night.add(CalledBack("W1.2", night.state.pair("W1.2")))
    assert [one.table for _, one in proposed_calls({1: state})] == [2]
    after = night.enter("W1.1")
    assert [one.call.table for one in after.on_tables.values()] == [1]


def test_a_reserved_table_and_a_match_that_waits_are_left_alone() -> None:
    night = Night(tables=4)
    night.add(Changed(reserved=(1, 2)), Waits("W1.1", night.state.pair("W1.1"), reason="late"))
    state = night.state
    assert state.free_tables == [3, 4]
    assert [(c.match, c.table) for _, c in proposed_calls({1: state})] == [("W1.2", 3), ("W1.3", 4)]
    state = night.add(Called("W1.1", 1, state.pair("W1.1")))
    assert "W1.1" in state.on_tables


def test_the_order_worked_out_comes_first_then_the_numbers_and_what_was_taken_off_last() -> None:
    night = Night(tables=1)
    assert ready_matches(night.state, ["W1.3"]) == ["W1.3", "W1.1", "W1.2", "W1.4"]
    called(night)
    state = night.add(CalledBack("W1.1", night.state.pair("W1.1")))
    assert ready_matches(state) == ["W1.2", "W1.3", "W1.4", "W1.1"]


def test_a_result_is_taken_back_with_the_calls_that_it_made() -> None:
    night = called(Night(tables=3))
    before = night.state
    state = night.enter("W1.1")
    assert state.events[-1].by == BY_ITSELF
    entry = own_last(state)
    assert entry == state.numbers[-2]
    assert {entry} == {*undoable(state)} == free_entries(state) & {*state.numbers[-2:]}
    back = night.add(*undo(state))
    assert (back.on_tables, back.counted) == (before.on_tables, before.counted)
    again = night.add(*redo(back))
    assert (again.on_tables, again.counted) == (state.on_tables, state.counted)


def test_what_cannot_be_taken_back_says_why() -> None:
    night = called(Night(tables=3))
    result = len(night.enter("W1.1").log) - 1
    again = night.add(CalledBack("W1.2", night.state.pair("W1.2")))
    calls = {
        number: event.what.match
        for number, event in zip(again.numbers, again.events, strict=True)
        if isinstance(event.what, Called)
    }
    why = {number: f"match {again.number_of(name)} has been played or called again"
           for number, name in calls.items() if name in ("W1.1", "W1.2")}  # fmt: skip
    assert len(why) == 2
    why |= {result + 1: f"entry {result + 1} came with entry {result}", 99: "there is no entry 99"}
    assert not {*why} & free_entries(again)
    for entry, words in why.items():
        with pytest.raises(InputError, match=words):
            undo(again, entry)
    back = night.add(*undo(again))
    with pytest.raises(InputError, match="is an undo or a redo"):
        undo(back, len(back.log))


def test_a_match_that_was_called_by_itself_and_has_begun_stays_on_its_table() -> None:
    night = called(Night(tables=3))
    state = night.enter("W1.1")
    name = state.events[-1].what.match  # type: ignore[union-attr]
    state = night.add(moves.score(state, name, (1, 0)))
    back = night.add(*undo(state, state.numbers[-3]))
    assert name in back.on_tables
    assert "W1.1" not in back.counted
    assert state.numbers[-2] in free_entries(back)  # the call that is left is like any other
