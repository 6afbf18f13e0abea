"""Tables close, open and change their names: a match stays on its table as long as there is one."""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.files.store.tournament import (
    add_events,
    begin_beside,
    new_tournament,
    night_of,
    read_night,
)
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import (
    Called,
    Changed,
    Entrant,
    Event,
    Opened,
    Plan,
    Scored,
    Undone,
)
from evenbreak.tournaments.evening.fold import evening

NAMES = st.lists(st.sampled_from(["1", "2", "3", "TV", "Bar", "tv"]), min_size=1, max_size=4)
HOUSES = NAMES.filter(lambda names: len({one.casefold() for one in names}) == len(names))


def at(minute: int) -> str:
    return f"2025-03-01T19:{minute:02}:00"


def night(plan: Plan, first: int = 0):
    players = tuple(Entrant(f"Player {first + k}", 600.0 - k) for k in range(8))
    events = [Event(at(0), Opened(plan, players))]
    return [*events, Event(at(0), moves.draw(evening(events), np.random.default_rng(0)))]


@given(HOUSES, HOUSES, st.data())
@settings(max_examples=25, deadline=None)
def test_a_match_follows_the_name_of_its_table(old, new, data):
    some = st.sets(st.integers(1, len(old)))
    reserved = tuple(data.draw(some))
    events = night(Plan("single", 5, tables=len(old), labels=tuple(old), reserved=reserved))
    state = evening(events)
    for table, name in zip(range(1, len(old) + 1), state.standing.to_play, strict=False):
        events.append(Event(at(1), Called(name, table, state.pair(name))))
        events.append(Event(at(1), Scored(name, state.pair(name), (table, 0))))
    before = evening(events)
    change = Changed(tables=len(new), labels=tuple(new))
    after = before.then(Event(at(2), change))
    for name, on in before.on_tables.items():
        was = old[on.call.table - 1].casefold()
        here = [one.casefold() for one in new]
        if was in here:
            there = here.index(was) + 1
        else:  # as many tables as before: one whose name is new is the same table
            fresh = here[on.call.table - 1 :][:1]
            same = len(old) == len(new) and fresh[0] not in [one.casefold() for one in old]
            there = on.call.table if same else None
        assert (name in after.on_tables) == (there is not None)
        assert name not in after.on_tables or after.on_tables[name].call.table == there
        assert after.live[name].what.score == before.live[name].what.score
        assert there is None or (there in after.plan.reserved) == (on.call.table in reserved)
    assert after.then(Event(at(3), Undone())).on_tables == before.on_tables


def test_a_table_that_closes_takes_its_match_alone_in_all_events_of_the_night(tmp_path):
    path = tmp_path / "tonight.db"
    plan = Plan("single", 3, tables=4, labels=("1", "2", "TV", "4"))
    new_tournament(path, night(plan))
    begin_beside(path, lambda _: night(replace(plan, labels=()), 50))

    def enter(event, *what, minute):
        add_events(path, lambda _: [Event(at(minute), one) for one in what], event=event)

    def seated():
        return {
            n: {k: on.call.table for k, on in one.on_tables.items()} for n, one in now().items()
        }

    def now():
        return night_of(path, read_night(path))

    enter(1, moves.call(now()[1], "W1.1", 2), minute=5)
    enter(1, moves.call(now()[1], "W1.2", 3), minute=5)
    enter(2, moves.call(now()[2], "W1.1", 4), minute=5)
    enter(1, moves.change(now()[1], tables=3, labels=("1", "2", "4")), minute=6)
    assert seated() == {1: {"W1.1": 2}, 2: {"W1.1": 3}}
    enter(2, moves.call(now()[2], "W1.2", 1), minute=7)
    assert seated() == {1: {"W1.1": 2}, 2: {"W1.1": 3, "W1.2": 1}}
    assert now()[2].then(Event(at(8), moves.call_back(now()[2], "W1.2"))).on_tables.keys() == {
        "W1.1"
    }
