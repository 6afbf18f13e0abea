"""Renames, substitutes, swaps, redo: what a director changes afterward changes nothing else."""

import json
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from evenbreak.answers.tournament.corrections import correction_choices
from evenbreak.answers.tournament.moves import happened, history_words, lost_words
from evenbreak.errors import InputError
from evenbreak.tournaments.evening import moves, roster, tables
from evenbreak.tournaments.evening.events import (
    KINDS,
    CheckedIn,
    Drawn,
    Entrant,
    Event,
    Opened,
    Plan,
    Redone,
    Registered,
    Renamed,
    Substituted,
    Undone,
)
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.undoing import (
    free_entries,
    losses,
    matches_of,
    own_last,
    redo,
    redoable,
    undo,
)
from tournaments.test_losses import AT, FORMS, PHONE, Night
from tries import tries

TRIES = tries("second thoughts of a director", 4)


def facts(state: Evening) -> dict[str, Any]:
    """Return what can be seen of a state."""
    seen: dict[str, Any] = {
        "players": list(state.entrants.values()),
        "order": state.order,
        "dropped": state.dropped,
        "here": (state.arrived, state.paid, dict(state.registered)),
        "aside": [one.result for one in state.aside] if state.drawn else [],
    }
    if state.drawn:
        seen |= {"seats": state.standing.seats, "counted": state.counted}
        seen |= {"tables": state.on_tables, "live": state.live, "waits": state.waiting_for}
    return seen


def in_names(what: Any, names: Mapping[str, str]) -> Any:
    """Return an entry in other names."""
    text = KINDS.text(what)
    for k, name in enumerate(names):
        text = text.replace(json.dumps(name), f'"#{k}"')
    for k, name in enumerate(names.values()):
        text = text.replace(f'"#{k}"', json.dumps(name))
    return KINDS.read(KINDS.name(what), text)


def with_rename(events: list[Event], place: int, *renames: tuple[str, str]) -> list[Event]:
    """Return entries with renames before one of them, and all after it in the new names."""
    found, names, shift = list(events[:place]), {}, len(renames)
    for old, new in renames:
        names = {k: new if v == old else v for k, v in names.items()} | (
            {} if old in names.values() else {old: new}
        )
        found.append(Event(AT, Renamed(old, new)))
    for one in events[place:]:
        what = one.what
        if isinstance(what, Undone) and what.entry and what.entry > place:
            what = Undone(what.entry + shift)
        found.append(replace(one, what=in_names(what, names)))
    return found


def random_night(form: str, seed: int, entries: int = 22) -> Night:
    night = Night(form, 6 if form == "round-robin" else 8, seed)
    for _ in range(entries):
        try:
            night.entry()
        except InputError:
            continue
    return night


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("form", list(FORMS))
@pytest.mark.parametrize("seed", range(TRIES))
def test_a_rename_at_any_time_reads_as_if_it_had_been_the_name(form: str, seed: int) -> None:
    events = random_night(form, seed).events
    rng = np.random.default_rng(seed)
    place = int(rng.integers(1, len(events) + 1))
    for renames, now in (
        ([("P2", "Zoë")], {"P2": "Zoë"}),
        ([("P2", "Zoë"), ("Zoë", "P2")], {}),
        ([("P2", "-"), ("P1", "P2"), ("-", "P1")], {"P1": "P2", "P2": "P1"}),
    ):
        told = with_rename(events, place, *renames)
        as_if = [replace(one, what=in_names(one.what, now)) for one in events]
        state = evening(told)
        assert facts(state) == facts(evening(as_if))
        assert facts(evening(state.events)) == facts(state)  # as pages do to look ahead
        plain = [
            Event(one.at, KINDS.read(KINDS.name(one.what), KINDS.text(one.what)), one.by)
            for one in told
        ]
        assert facts(evening(plain)) == facts(state)
    told = with_rename(events, place, ("P2", "Zoë"))
    assert facts(evening([*told, Event(AT, Undone(place + 1))])) == facts(evening(events))
    last = [*events, Event(AT, Renamed("P2", "Zoë"))]
    assert not losses(evening(events), evening(last))
    assert not losses(evening(last), evening([*last, Event(AT, Undone(len(last)))]))
    assert evening(last).former == {"P2": "Zoë"}
    assert evening(last).entries["Zoë"] == evening(events).entries["P2"]


def test_names_that_collide_or_are_empty_are_refused() -> None:
    state = Night("single", 4, 0).state
    for wrong in ("P1", "p1", " ", "", "bye", "P2"):
        with pytest.raises(InputError):
            roster.rename(state, "P2", wrong)
    assert roster.rename(state, "P2", "p2") == Renamed("P2", "p2")


def test_a_name_or_a_rating_that_is_corrected_before_the_draw_keeps_the_seed() -> None:
    entrants = tuple(Entrant(f"P{k}", 600.0 - k) for k in range(5))
    for seeding in ("listed", "rating"):
        events = [Event(AT, Opened(Plan("single", 3, scale="fargo", seeding=seeding), entrants))]
        events.append(Event(AT, roster.rename(evening(events), "P0", "Zoë")))
        events.append(Event(AT, moves.edit(evening(events), "Zoë", name="Zoë V.")))
        events.append(Event(AT, moves.edit(evening(events), "Zoë V.", rating=599.5)))
        events.append(Event(AT, roster.rename(evening(events), "Zoë V.", "Ann")))
        drawn = moves.draw(evening(events), np.random.default_rng(1))
        assert drawn.order == ("Ann", "P1", "P2", "P3", "P4")
        assert evening([*events, Event(AT, drawn)]).entrants["Ann"].rating == 599.5


def test_history_is_told_in_the_names_of_now() -> None:
    night = Night("single", 4, 0)
    night.add(moves.result(night.state, "W1.1", (3, 1)))
    one = night.state.pair("W1.1")[0]
    night.add(roster.rename(night.state, one, "Zoë"))
    night.add(*undo(night.state, 3))
    said = history_words(night.events, night.state)
    assert said[2].startswith("Zoë 3-1 ")
    assert said[3] == f"{one} is now called Zoë"
    assert said[4].startswith("entry 3 undone: Zoë 3-1 ")


@pytest.mark.parametrize("form", ["double", "single", "groups", "king-of-the-hill"])
def test_a_substitute_takes_a_place_and_a_table(form: str) -> None:
    night = Night(form, 8, 1)
    name = night.state.standing.to_play[0]
    night.add(moves.call(night.state, name, 2))
    player, other = night.state.pair(name)
    night.add(CheckedIn(player, arrived=True))
    before, after = night.add(roster.substitute(night.state, player, Entrant("Cy", 620.0)))
    assert not losses(before, after)
    assert after.on_tables[name].call.players in (("Cy", other), (other, "Cy"))
    assert after.on_tables[name].at == before.on_tables[name].at
    assert after.order.index("Cy") == before.order.index(player)
    assert (player in after.entrants, "Cy" in after.arrived) == (False, False)
    assert after.ratings.max() == 620.0
    _, back = night.add(*undo(after))
    assert facts(back) == facts(before)
    night.add(Substituted(player, Entrant("Cy", 620.0)))
    night.add(moves.result(night.state, name, (3, 1)))
    with pytest.raises(InputError, match="already played match"):
        roster.substitute(night.state, "Cy", Entrant("Di", 1.0))
    with pytest.raises(InputError, match="depend on entry"):
        undo(night.state, len(night.events) - 1)


def test_whoever_takes_the_place_of_a_player_who_went_home_plays() -> None:
    night = Night("groups", 8, 1)
    name = night.state.standing.to_play[0]
    player, other = night.state.pair(name)
    _, gone = night.add(moves.drop(night.state, player))
    assert gone.counted[name].winner == other
    _, after = night.add(roster.substitute(gone, player, Entrant("Cy", 620.0)))
    assert after.dropped == ()
    assert name in after.standing.to_play
    assert Outlook(after, AT).odds.title.all()


@pytest.mark.parametrize("form", ["double", "single", "round-robin", "groups", "swiss"])
def test_players_trade_places_before_they_have_begun(form: str) -> None:
    if form == "swiss":
        entrants = tuple(Entrant(f"P{k}", 500.0) for k in range(8))
        night = Night("single", 4, 1)
        night.events = [Event(AT, Opened(Plan("swiss", 3, scale="fargo"), entrants))]
        for what in moves.draw_next(night.state, np.random.default_rng(1)):
            night.add(what)
    else:
        night = Night(form, 6, 1)
    one, other = night.state.order[0], night.state.order[-1]
    before, after = night.add(roster.swap(night.state, one, other))
    trade = {one: other, other: one}
    for match in before.standing.to_play:
        now = after.pair(match) if match in after.standing.to_play else ()
        assert {trade.get(name, name) for name in before.pair(match)} == {*now}
    _, again = night.add(roster.swap(after, other, one))
    assert facts(again) == facts(before)
    name = next(n for n in again.standing.to_play if {one, other} & {*again.pair(n)})
    night.add(moves.call(again, name, 1))
    with pytest.raises(InputError, match=r"has been called to table 1\. Take match \d+ off it"):
        roster.swap(night.state, one, other)
    night.add(moves.result(night.state, name, (3, 0)))
    with pytest.raises(InputError, match="already played"):
        roster.swap(night.state, one, other)


def test_two_called_matches_trade_tables_and_back() -> None:
    night = Night("double", 8, 1)
    for table, name in ((1, "W1.1"), (3, "W1.2")):
        night.add(moves.call(night.state, name, table))
        night.add(moves.score(night.state, name, (1, table % 2)), PHONE)
    before = night.state
    for call in tables.swap_tables(before, "1", "match 2"):
        night.add(call)
    now = night.state
    assert {n: one.call.table for n, one in now.on_tables.items()} == {"W1.1": 3, "W1.2": 1}
    assert now.live == before.live
    assert not losses(before, now)
    for what in undo(now):
        night.add(what)
    assert redoable(night.state) == own_last(now)
    assert facts(night.state) == facts(before)
    for again in redo(night.state):
        night.add(again)
    assert facts(night.state) == facts(now)
    with pytest.raises(InputError, match="3 isn't on a table"):
        tables.swap_tables(now, "1", "3")
    with pytest.raises(InputError, match=r"taken by match 1.*swap-tables 2 1"):
        moves.call(now, "2", 3)


def follow(night: Night, rounds: int) -> tuple[Evening, Evening]:
    """Play on from a wrong result, with its followers on tables, and correct it."""
    for name in ("W1.1", "W1.2", "W1.3", "W1.4", "W2.1", "W2.2", "L1.1", "L1.2")[: 4 + 2 * rounds]:
        night.add(moves.result(night.state, name, (3, 1)))
    for table, name in enumerate(night.state.standing.to_play[:3], 1):
        night.add(moves.call(night.state, name, table))
        night.add(moves.score(night.state, name, (2, table % 2)), PHONE)
    return night.state, night.state


@pytest.mark.parametrize("rounds", [0, 1, 2])
def test_a_correction_stops_or_keeps_what_is_played_and_comes_back(rounds: int) -> None:
    night = Night("double", 8, 1)
    before, _ = follow(night, rounds)
    kept = [moves.correct(before, "W1.1", (1, 3), follow="keep")]
    night.add(*kept)
    assert night.state.standing.seats == before.standing.seats
    assert (night.state.on_tables, night.state.live) == (before.on_tables, before.live)
    assert night.state.counted["W1.1"].score == (1, 3)
    assert not losses(before, night.state)
    night.add(*undo(night.state))
    for what in moves.corrections(before, "W1.1", (1, 3), follow="stop"):
        night.add(what)
    after = night.state
    lost = losses(before, after)
    assert lost
    for one in lost:
        if one.table is not None and one.match in after.on_tables:
            on = after.on_tables[one.match].call
            assert on.table == one.table
            assert {*on.players} == {*after.pair(one.match)} != {*one.players}
            assert one.match not in after.live
    for what in undo(after):
        night.add(what)
    assert facts(night.state) == facts(before)
    assert redoable(night.state) == own_last(after)  # the correction, not a call that it needed
    for again in redo(night.state):
        night.add(again)
    assert facts(night.state) == facts(after)


def test_the_two_ways_of_a_correction_are_said_as_people_say_them() -> None:
    entrants = [("Aleksandra W", 500.0), ("José Á", 500.0), ("Karl-Heinz M", 500.0)]
    entrants += [("Zoë V", 500.0), *((f"P{k}", 500.0) for k in range(4))]
    plan = Plan("double", 5, scale="fargo", labels=("1", "2", "TV"))
    night = Night("double", 8, 1)
    night.events = [Event(AT, Opened(plan, tuple(Entrant(*one) for one in entrants)))]
    order = ("José Á", "P0", "P1", "Aleksandra W", "P2", "Zoë V", "P3", "Karl-Heinz M")
    lines = tuple(order.index(name) for name in (order[0], order[7], *order[3:5], *order[1:3]))
    night.add(Drawn(order, (*lines, order.index("Zoë V"), order.index("P3"))))
    for name in night.state.standing.to_play:
        night.add(moves.result(night.state, name, (5, 4)))
    first = night.state.counted["W1.1"]
    assert set(first.players) == {"José Á", "Karl-Heinz M"}
    for name, table in (("W2.1", 3), ("L1.1", 2)):
        night.add(moves.call(night.state, name, table))
        night.add(moves.score(night.state, name, (3, 1) if table == 3 else (0, 2)))
    before = night.state
    what = moves.corrections(before, "1", (4, 5), follow="stop")
    stop = evening([*night.events, *(Event(AT, one) for one in what)])
    stopped, kept = correction_choices(before, stop, "W1.1")
    assert stopped.headline == "Stop both. José and Karl-Heinz trade places."
    assert stopped.details[-1] == "3-1 and 0-2 stay in the history."
    assert "Table TV: " in stopped.details[0]
    assert "race to 5, starting at 0-0." in stopped.details[0]
    assert stopped.button == "Change it and stop both"
    assert kept.headline == "Let both finish as they are."
    assert kept.details == ["The bracket stays; only the record of match 1 changes."]
    keep = Event(AT, moves.correct(before, "1", (4, 5), follow="keep"))
    said = happened(before, evening([*night.events, keep]), keep)
    assert said[0] == (
        "Karl-Heinz M beat José Á 5-4, but José Á keeps the winner's place in match 1."
    )


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("form", list(FORMS))
@pytest.mark.parametrize("seed", range(TRIES))
def test_an_entry_is_free_if_nothing_else_changes_without_it(form: str, seed: int) -> None:
    night = random_night(form, seed, 16)
    state = night.state
    free = free_entries(state)
    for number, event in list(zip(state.numbers, state.events, strict=True))[1:]:
        if event.by == PHONE or number in free:
            assert not (event.by == PHONE and KINDS.name(event.what) == "scored") or (
                number not in free
            )
            if number not in free:
                continue
            gone = [Event(AT, what) for what in undo(state, number)]
            after = evening([*night.events, *gone])
            about = matches_of(state, after)
            for name, result in state.counted.items():
                entered = any(one.result == result for one in state.records.get(name, ()))
                assert not entered or after.counted.get(name) == result or name in about
            assert {*state.live} <= {*after.live} | about | {*after.counted}
        else:
            with pytest.raises(InputError):
                undo(state, number) if number != own_last(state) else undo(state, -1)


@pytest.mark.parametrize("form", list(FORMS))
@pytest.mark.parametrize("seed", range(TRIES))
def test_looking_ahead_is_what_is_entered_then(form: str, seed: int) -> None:
    night = random_night(form, seed, 14)
    night.add(roster.rename(night.state, "P3", "Zoë"))
    for _ in range(6):
        before, events = night.state, list(night.events)
        try:
            night.entry()
        except InputError:
            continue
        added = night.events[len(events) :]
        ahead, after = before.then(*added), night.state
        assert facts(ahead) == facts(after)
        assert (ahead.numbers, ahead.entries) == (after.numbers, after.entries)
        assert losses(before, ahead) == losses(before, after)


def test_undo_is_the_directors_own_and_redo_brings_it_back() -> None:
    night = Night("double", 8, 1)
    night.add(moves.call(night.state, "W1.1", 1))
    night.add(moves.score(night.state, "W1.1", (2, 1)), PHONE)
    night.add(moves.result(night.state, "W1.2", (3, 1)), "phones: P1 and P2")
    before = night.state
    assert own_last(before) == 3
    assert own_last(before, "phones: P1 and P2") == 5
    assert own_last(before, PHONE) is None
    with pytest.raises(InputError, match="nothing to redo"):
        redo(before)
    night.add(*undo(before))
    assert night.state.undone[3].event.what == before.events[2].what
    assert redo(night.state) == [Redone(3)]
    _, again = night.add(*redo(night.state))
    assert facts(again) == facts(before)
    night.add(*undo(again))
    night.add(moves.call(night.state, "W1.3", 1))
    with pytest.raises(InputError, match="nothing to redo"):
        redo(night.state)
    draw = evening([*night.events, Event(AT, Undone(2))])
    assert "The draw would be undone, and a new one may be different." in lost_words(
        night.state, draw
    )


def test_nobody_comes_to_a_second_table_when_it_is_undone_that_they_left_one() -> None:
    night = Night("round-robin", 4, 1)
    one, other = [n for n in night.state.standing.to_play if "P1" in night.state.pair(n)][:2]
    night.add(moves.call(night.state, one, 1))
    night.add(moves.call_back(night.state, one))
    night.add(moves.call(night.state, other, 2))
    _, after = night.add(*undo(night.state, 4))
    assert {name: on.call.table for name, on in after.on_tables.items()} == {other: 2}


def test_a_match_waits_until_it_is_called() -> None:
    night = Night("double", 8, 1)
    night.add(moves.call(night.state, "W1.1", 1))
    late = night.state.pair("W1.1")[0]
    until = "2025-03-01T20:15:00"
    what = tables.wait(night.state, "match 1", absent=[late], until=until)
    _, after = night.add(what)
    assert after.waiting_for["W1.1"].absent == (late,)
    assert not after.on_tables
    assert "W1.1" not in Outlook(after, AT).to_call
    assert "W1.1" in Outlook(evening(night.events[:-2]), AT).to_call
    assert after.waiting_for["W1.1"].until == until  # the desk proposes the forfeit then
    _, again = night.add(tables.wait(after, "1"))
    assert not again.waiting_for
    with pytest.raises(InputError, match="1 isn't waiting"):
        tables.wait(again, "1")
    night.add(tables.wait(again, "1", reason="eats"))
    _, called = night.add(moves.call(night.state, "1", 2))
    assert not called.waiting_for
    with pytest.raises(InputError, match="P99 isn't in match 1"):
        tables.wait(called, "1", absent=["P99"])


def test_a_match_may_end_before_its_race_does() -> None:
    night = Night("double", 8, 1)
    one, other = night.state.pair("W1.1")
    assert moves.result(night.state, "1", (2, 1), ended="time").winner == one
    with pytest.raises(InputError, match=f"say who won match 1, {one} or {other}"):
        moves.result(night.state, "1", (1, 1), ended="time")
    assert moves.result(night.state, "1", (1, 1), ended="time", winner=other).winner == other
    gave_up = moves.result(night.state, "1", (2, 1), ended="conceded", winner=other)
    assert (gave_up.winner, gave_up.ended) == (other, "conceded")
    assert moves.result(night.state, "1", (3, 1), ended="time").ended == ""
    night.add(gave_up)
    (games,) = Outlook(night.state, AT).games
    assert sorted(games[2:4]) == [1, 2]
    night.add(moves.correct(night.state, "1", (1, 1), ended="time", winner=one))
    assert night.state.winners["W1.1"] == one
    with pytest.raises(InputError, match="final score"):
        moves.result(night.state, "2", (2, 1))
    chips = Night("chips", 6, 1).state
    with pytest.raises(InputError, match="rack"):
        moves.result(chips, "1", (0, 0), ended="time")


def test_who_is_not_here_is_left_out_and_let_in_late() -> None:
    entrants = tuple(Entrant(f"P{k}", 500.0 - k) for k in range(8))
    night = Night("single", 4, 1)
    night.events = [Event(AT, Opened(Plan("single", 3, scale="fargo"), entrants))]
    for name in ("P0", "P1", "P2", "P3", "P4"):
        night.add(roster.check_in(night.state, name, arrived=True))
    night.add(roster.check_in(night.state, "P0", paid=True))
    night.add(roster.register(night.state, "Zoë", 510.0))
    assert night.state.registered == {"Zoë": 510.0}
    everyone = evening(
        [*night.events, Event(AT, moves.draw(night.state, np.random.default_rng(1)))]
    )
    assert lost_words(night.state, everyone) == ["In the draw, but not here yet: P5, P6, P7."]
    rng = np.random.default_rng(1)
    before, after = night.add(moves.draw(night.state, rng, without=["P5", "P6", "P7"]))
    assert lost_words(before, after) == []
    assert after.order == ("P0", "P1", "P2", "P3", "P4")
    assert dict(after.registered) == {"Zoë": 510.0, "P5": 495.0, "P6": 494.0, "P7": 493.0}
    _, let_in = night.add(roster.accept(after, "P6"))
    assert "P6" in let_in.order
    assert "P6" not in let_in.registered
    _, declined = night.add(roster.decline(let_in, "Zoë"))
    assert list(declined.registered) == ["P5", "P7"]
    with pytest.raises(InputError, match="isn't on the list"):
        roster.accept(declined, "Zoë")
    assert isinstance(night.events[7].what, Registered)


def test_tables_have_names_and_some_are_given_out_by_hand() -> None:
    plan = Plan("double", 3, scale="fargo", labels=("5", "6", "TV"), reserved=(3,), tables=4)
    night = Night("double", 8, 1)
    night.events[0] = Event(AT, Opened(plan, night.events[0].what.entrants))
    assert night.state.free_tables == [1, 2, 4]
    assert moves.call(night.state, "1", 3).table == 3
    away = replace(night.state, elsewhere={1: ("P9", night.state.pair("W1.2")[0])})
    assert away.free_tables == [2, 4]
    with pytest.raises(InputError, match="table 5 is taken by P9"):
        moves.call(away, "1", 1)
    with pytest.raises(InputError, match="is playing on table 5"):
        moves.call(away, "2", 2)
    assert plan.table_number("tv") == 3
    for wrong in ({"labels": ("5", "5")}, {"labels": ("4",)}, {"reserved": (9,)}):
        with pytest.raises(InputError):
            moves.change(night.state, **wrong)


@pytest.mark.parametrize("form", list(FORMS))
@pytest.mark.parametrize("seed", range(TRIES))
def test_every_move_fits_every_format_or_says_why_not(form: str, seed: int) -> None:
    night = random_night(form, seed, 5)
    if not night.state.drawn:
        night = Night(form, 6, seed)
    ready = list(night.state.standing.to_play)
    name = ready[seed % len(ready)] if ready else "1"
    one, other = night.state.order[:2]
    new = Entrant("New", 500.0)
    for decide in (
        lambda s: [roster.check_in(s, one, arrived=True, paid=True)],
        lambda s: [roster.rename(s, other, "Zoë")],
        lambda s: [roster.substitute(s, one, new)],
        lambda s: [roster.swap(s, one, "Zoë")],
        lambda s: [tables.wait(s, name, reason="eats")],
        lambda s: [moves.result(s, name, (1, 0), ended="time")],
        lambda s: tables.swap_tables(s, *[*s.on_tables, name, name][:2]),
        lambda s: moves.corrections(s, next(iter(s.counted), name), (0, 3), follow="stop"),
        lambda s: [moves.correct(s, next(iter(s.counted), name), (3, 0), follow="keep")],
        undo,
        redo,
    ):
        before = night.state
        try:
            added = list(decide(before))
        except InputError:
            continue
        for what in added:
            night.add(what)
        after = night.state
        if not after.drawn:
            return
        assert before.then(*(Event(AT, what) for what in added)).numbers == after.numbers
        taken = [on.call.table for on in after.on_tables.values()]
        assert len(taken) == len({*taken})
        for match in after.standing.to_play:
            assert min(after.needed(match, after.pair(match))) >= 1
