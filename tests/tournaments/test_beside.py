"""Several events of one night: one set of tables, one queue, and nobody in two places."""

import random
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import EvenbreakError
from evenbreak.files.store.tournament import (
    add_events,
    begin_beside,
    new_tournament,
    night_of,
    read_night,
    read_tournament,
)
from evenbreak.tournaments.evening import beside, moves, roster, undoing
from evenbreak.tournaments.evening.calling import calls_after
from evenbreak.tournaments.evening.events import (
    Called,
    Changed,
    Entrant,
    Event,
    Opened,
    Plan,
    Result,
)
from evenbreak.tournaments.evening.fold import evening
from evenbreak.tournaments.evening.outlook import Outlook

AT = "2025-03-01T19:30:00"


def entrants(first: int, last: int) -> tuple[Entrant, ...]:
    return tuple(Entrant(f"Player {k}", 600.0 - k) for k in range(first, last))


def begun(path: Path, tables: int = 3, players: int = 8) -> None:
    plan = Plan("double", 3, tables=tables)
    new_tournament(path, [Event(AT, Opened(plan, entrants(0, players)))])
    enter(path, 1, lambda state: moves.draw_next(state, np.random.default_rng(0)))


def enter(path, event, decide, at=AT):
    return add_events(path, lambda state: [Event(at, what) for what in decide(state)], event=event)


def moves_now(state, luck):
    """Return what a director might do next."""
    ready = list(state.standing.to_play)
    name = luck.choice(ready) if ready else "F"
    pair = state.pair(name) if ready else ("", "")
    needs = state.needed(name, pair) if ready else (1, 1)
    over = list(state.counted)
    return luck.choice(
        [
            lambda: [moves.call(state, name, luck.choice([None, 1, 2, 3]))],
            lambda: [moves.call(state, name, None)],
            lambda: [moves.result(state, name, (needs[0], 0))],
            lambda: [moves.result(state, name, (0, needs[1]))],
            lambda: [moves.call_back(state, name)],
            lambda: undoing.undo(state),
            lambda: undoing.undo(state, luck.choice(sorted(undoing.free_entries(state)))),
            lambda: [moves.correct(state, luck.choice(over), (0, 3))],
            lambda: undoing.redo(state),
            lambda: [moves.change(state, tables=luck.randint(1, 4))],
        ]
    )()


def seated(path):
    """Return every table and player in play, over all events."""
    states = night_of(path, read_night(path))
    calls = [on.call for one in states.values() if one.drawn for on in one.on_tables.values()]
    return [call.table for call in calls], [player for call in calls for player in call.players]


@pytest.mark.slow
@given(seed=st.integers(0, 10_000))
def test_no_two_events_ever_have_one_table_or_one_player(seed, tmp_path_factory):
    path, luck = tmp_path_factory.mktemp("night") / "tonight.db", random.Random(seed)
    begun(path)
    shared = Opened(Plan("single", 3), entrants(4, 12))  # four play in both
    begin_beside(path, lambda _: [Event(AT, shared)])
    enter(path, 2, lambda state: moves.draw_next(state, np.random.default_rng(1)))
    for k in range(25):
        at = f"2025-03-01T20:{k:02}:00"
        try:
            enter(path, luck.choice([1, 2]), lambda state: moves_now(state, luck), at)
        except (EvenbreakError, IndexError):
            continue
        tables, players = seated(path)
        assert len(tables) == len(set(tables)), seed
        assert len(players) == len(set(players)), seed
        first = read_tournament(path)
        assert all(table <= first.plan.tables for table in tables)
        assert read_tournament(path, 2).plan.tables == first.plan.tables


@given(cuts=st.lists(st.integers(1, 11), max_size=4))
def test_a_night_is_the_same_however_its_entries_were_written(cuts, tmp_path_factory):
    path = tmp_path_factory.mktemp("night") / "tonight.db"
    begun(path)
    state = read_tournament(path)
    what = [moves.call(state, name, k) for k, name in enumerate(state.standing.to_play[:3], 1)]
    what += [Result(one.match, one.players, (3, 1), one.players[0]) for one in what]
    ends = [0, *sorted({*cuts}), len(what)]
    for start, end in pairwise(ends):
        enter(path, 1, lambda _, part=what[start:end]: part)
    again = evening([*state.events, *(Event(AT, one) for one in what)])
    there = read_tournament(path)
    assert there.events == again.events
    assert (there.counted, there.on_tables) == (again.counted, again.on_tables)


@pytest.mark.slow
def test_the_next_matches_are_those_of_all_events_and_each_gets_a_table_of_its_own(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path, tables=4)
    begin_beside(path, lambda _: [Event(AT, Opened(Plan("single", 3), entrants(20, 24)))])
    enter(path, 2, lambda state: moves.draw_next(state, np.random.default_rng(1)))
    calls = {}
    for event in (1, 2):
        outlook = Outlook(read_tournament(path, event), AT)
        for match, table in outlook.tables_to_call.items():
            assert table not in calls, "both events propose one table"
            calls[table] = event, match
    assert sorted(calls) == [1, 2, 3, 4]
    alone = Outlook(evening(read_night(path)[1]), AT)
    ends = [Outlook(read_tournament(path, event), AT).as_things_are.bands for event in (1, 2)]
    assert ends[0] == ends[1], "one finish for the night"
    assert ends[0][1] > alone.as_things_are.bands[1], "with more to play it ends later"
    for table, (event, match) in calls.items():
        enter(path, event, lambda state, m=match, t=table: [moves.call(state, m, t)])
    assert sorted(seated(path)[0]) == [1, 2, 3, 4]


def test_the_tables_are_those_of_the_first_event(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path, tables=4)
    begin_beside(path, lambda _: [Event(AT, Opened(Plan("single", 3, tables=9), entrants(9, 12)))])
    enter(path, 1, lambda _: [Changed(tables=2, labels=("TV", "Bar"))])
    assert read_tournament(path, 2).plan.table_name(1) == "TV"
    assert read_tournament(path, 2).plan.tables == 2
    with pytest.raises(ValueError, match="tables belong to the first event"):
        enter(path, 2, lambda state: [moves.change(state, tables=5)])
    with pytest.raises(ValueError, match="has no event 3"):
        read_tournament(path, 3)
    chips = Plan("chips", 1)
    with pytest.raises(ValueError, match="a chip tournament needs all the tables"):
        begin_beside(path, lambda _: [Event(AT, Opened(chips, entrants(9, 12)))])


def test_a_second_chance_is_for_those_who_are_out(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    with pytest.raises(ValueError, match="fewer than two players are out"):
        beside.second_chance(read_tournament(path))
    played = []
    while len(beside.out(read_tournament(path))) < 4:
        state = read_tournament(path)
        name = state.standing.to_play[0]
        enter(path, 1, lambda state, n=name: [moves.result(state, n, (3, 0))])
        played.append(name)
    state = read_tournament(path)
    out = beside.out(state)
    lost = [one.loser for one in state.counted.values()]
    assert {name for name in state.order if lost.count(name) == 2} == set(out)
    number = begin_beside(path, lambda now: [Event(AT, beside.second_chance(now))])
    assert number == 2
    assert list(read_tournament(path, 2).entrants) == out
    enter(path, 2, lambda state: moves.draw_next(state, np.random.default_rng(0)))
    ready = read_tournament(path, 2).standing.to_play
    enter(path, 2, lambda state: [moves.call(state, ready[0], None)])
    taken = read_tournament(path, 1).elsewhere
    assert list(taken.values()) == [read_tournament(path, 2).pair(ready[0])]
    assert isinstance(read_tournament(path, 2).events[-1].what, Called)


def test_a_result_calls_the_next_match_of_whichever_event_and_takes_it_back(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path, tables=2)
    begin_beside(path, lambda _: [Event(AT, Opened(Plan("single", 3), entrants(20, 24)))])
    enter(path, 2, lambda state: moves.draw_next(state, np.random.default_rng(1)))
    for match in ("W1.1", "W1.2"):
        enter(path, 1, lambda state, m=match: [moves.call(state, m, None)])
    first_of_two = [(2, name) for name in read_tournament(path, 2).standing.to_play]

    def over(match: str, *, event: int = 1):
        return add_events(
            path,
            lambda state: [Event(AT, moves.result(state, match, (3, 0)))],
            event=event,
            more=lambda before, after: calls_after(before, after, first_of_two),
        )

    seats = night_of(path, read_night(path))
    over("W1.1")
    (name,) = read_tournament(path, 2).on_tables
    assert (2, name) == first_of_two[0]
    assert read_tournament(path, 2).on_tables[name].call.table == 1
    assert undoing.own_last(read_tournament(path, 2)) == 2, "its director called nothing"
    enter(path, 1, undoing.undo)
    again = night_of(path, read_night(path))
    assert [one.on_tables.keys() for one in again.values()] == [
        one.on_tables.keys() for one in seats.values()
    ]
    enter(path, 1, undoing.redo)
    assert list(read_tournament(path, 2).on_tables) == [name]
    pair = read_tournament(path, 2).pair(name)
    enter(path, 2, lambda state: [moves.score(state, name, (1, 0))])
    enter(path, 1, undoing.undo)
    assert read_tournament(path, 2).pair(name) == pair, "what has begun stays on its table"
    assert list(read_tournament(path, 2).on_tables) == [name]
    over(name, event=2)
    assert sorted(seated(path)[0]) == [1, 2], "the table goes to the other event's match"


def test_a_person_has_one_name_in_all_events_of_the_night(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    begin_beside(path, lambda _: [Event(AT, Opened(Plan("single", 3), entrants(4, 12)))])
    enter(path, 1, lambda state: [roster.rename(state, "Player 5", "Zoë")])
    assert all("Zoë" in read_tournament(path, n).entrants for n in (1, 2))
    enter(path, 2, lambda state: [roster.rename(state, "Player 9", "Yves")])
    enter(path, 1, undoing.undo)
    assert all("Player 5" in read_tournament(path, n).entrants for n in (1, 2))
    enter(path, 1, undoing.redo)
    assert all("Zoë" in read_tournament(path, n).entrants for n in (1, 2))
    entries = [len(each) for each in read_night(path).values()]
    enter(path, 1, lambda state: [roster.rename(state, "Player 0", "Ann")])
    assert [len(each) for each in read_night(path).values()] == [entries[0] + 1, entries[1]]
    enter(path, 2, lambda state: [roster.rename(state, "Player 10", "Bo")])
    with pytest.raises(EvenbreakError):  # somebody in the other event is called so
        enter(path, 1, lambda state: [roster.rename(state, "Player 4", "Bo")])
    assert "Player 4" in read_tournament(path, 1).entrants
