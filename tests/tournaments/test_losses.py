"""Corrections and undos take nothing away that they do not name, and give it back."""

from typing import Any

import numpy as np
import pytest

from evenbreak.answers.tournament.night import night_answer
from evenbreak.errors import InputError
from evenbreak.tournaments import CHIP_CHARTS
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan, Scored, Undone
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.undoing import losses, matches_of, undo, undoable
from tries import tries

AT = "2025-03-01T20:00:00"
TRIES = tries("moves of a tournament", 6)
PHONE = "phone: Ann"


FORMS: dict[str, dict[str, Any]] = {
    "double": {},
    "single": {},
    "consolation": {},
    "round-robin": {},
    "groups": {"groups": 2, "qualifiers": 1},
    "king-of-the-hill": {"rounds": 3},
    "chips": {"race": 1, "chips": CHIP_CHARTS["hoboken"]},
}


def begun(form: str, players: int) -> list[Event]:
    entrants = tuple(Entrant(f"P{k}", 500.0) for k in range(players))
    plan = {"race": 3, "scale": "fargo", "tables": 3, **FORMS[form]}
    events = [Event(AT, Opened(Plan(form, **plan), entrants))]
    drawn = moves.draw_next(evening(events), np.random.default_rng(1))
    return [*events, *(Event(AT, what) for what in drawn)]


class Night:
    def __init__(self, form: str, players: int, seed: int) -> None:
        self.events, self.rng = begun(form, players), np.random.default_rng(seed)

    @property
    def state(self) -> Evening:
        return evening(self.events)

    def add(self, what: object, by: str = "") -> tuple[Evening, Evening]:
        before, events = self.state, [*self.events, Event(AT, what, by)]  # type: ignore[arg-type]
        after = evening(events)
        self.events = events
        return before, after

    def score(self, needs: tuple[int, int]) -> tuple[int, int]:
        won, lost = needs[0], int(self.rng.integers(needs[1]))
        return (won, lost) if self.rng.random() < 0.5 else (lost, won)

    def entry(self) -> tuple[Evening, Evening]:
        """Enter anything that can be entered now."""
        state, what = self.state, self.rng.random()
        ready = list(state.standing.to_play)
        name = ready[int(self.rng.integers(len(ready)))] if ready else ""
        if name and what < 0.3:
            return self.add(
                moves.result(state, name, self.score(state.needed(name, state.pair(name))))
            )
        if not name and what < 0.3:
            return self.add(moves.draw_next(state, self.rng)[0])
        if name and what < 0.5 and state.free_tables and name not in state.on_tables:
            return self.add(moves.call(state, name, None))
        if name and what < 0.65:
            return self.add(moves.score(state, name, (1, int(self.rng.integers(3)))), PHONE)
        if name and what < 0.7:
            return self.add(moves.forfeit(state, state.pair(name)[0], name))
        if what < 0.72 and len(state.dropped) < 2:
            return self.add(moves.drop(state, str(self.rng.choice(state.order))))
        if what < 0.85 and state.counted:
            decided = list(state.counted)
            name = decided[int(self.rng.integers(len(decided)))]
            needs = state.needed(name, state.pair(name))
            return self.add(moves.correct(state, name, self.score(needs)))
        return self.add(*undo(state))


@pytest.mark.slow_after(30)
@pytest.mark.parametrize("form", list(FORMS))
@pytest.mark.parametrize("seed", range(TRIES))
def test_nothing_disappears_that_is_not_named(form: str, seed: int) -> None:
    night = Night(form, 6 if form == "round-robin" else 8, seed)
    for _ in range(25):
        try:
            before, after = night.entry()
        except InputError:
            continue
        named = {one.match for one in losses(before, after)} | matches_of(before, after)
        if not after.drawn:
            assert {*before.on_tables, *before.counted} <= named
            night.events.pop()
            continue
        for name, one in before.on_tables.items():
            there = after.on_tables.get(name)
            stays = there == one or (
                there and form == "chips" and {*there.call.players} == {*one.call.players}
            )
            ended = name in after.counted and not after.counted[name].forfeit
            forfeited = name in after.counted and after.dropped != before.dropped
            assert stays or ended or forfeited or name in named, name
        for name, live in before.live.items():
            kept = after.live.get(name) == live or not any(live.what.score)
            ended = name in after.counted and not after.counted[name].forfeit
            assert kept or ended or name in named, name
        for name, result in before.counted.items():
            entered = any(one.result == result for one in before.records.get(name, ()))
            assert not entered or after.counted.get(name) == result or name in named, name
    assert len(night.events) > 5


@pytest.mark.parametrize("seed", range(TRIES))
def test_what_a_correction_set_aside_comes_back_with_its_score(seed: int) -> None:
    night = Night("double", 8, seed)
    for name in ("W1.1", "W1.2", "W1.3", "W1.4"):
        night.add(moves.result(night.state, name, (3, 1)))
    for table, name in enumerate(("W2.2", "L1.2", "W2.1"), 1):
        night.add(moves.call(night.state, name, table))
        night.add(moves.score(night.state, name, (2, table % 2)), PHONE)
    before = night.state
    _, after = night.add(moves.correct(before, "W1.3", (0, 3)))
    assert {(one.match, one.table, one.score) for one in losses(before, after)} == {
        ("W2.2", 1, (2, 1)),
        ("L1.2", 2, (2, 0)),
    }
    assert after.on_tables.keys() == {"W2.1"}
    if seed % 2:  # the others have been called, and have begun
        night.add(moves.call(after, "W2.2", 1 + seed % 3 if seed % 3 != 2 else 1))
        night.add(moves.score(night.state, "W2.2", (0, 1)), PHONE)
    night.add(moves.correct(night.state, "W1.3", (3, 1)))
    assert night.state.on_tables == before.on_tables
    assert night.state.live == before.live


def test_undo_takes_back_the_directors_own_entry_and_leaves_what_players_tap() -> None:
    night = Night("single", 4, 0)
    night.add(moves.call(night.state, "W1.1", 1))
    entry = len(night.events)
    for k in range(5):
        night.add(moves.score(night.state, "W1.1", (k % 3, 1)), PHONE)
        assert list(undoable(night.state)) == [entry]
    _, after = night.add(*undo(night.state))
    assert night.events[-1].what == Undone(entry)
    assert not after.on_tables
    assert after.live["W1.1"].what.score == (1, 1)
    assert sum(isinstance(one.what, Scored) for one in after.events) == 5


def test_a_result_of_both_players_is_taken_back_only_by_its_number() -> None:
    night = Night("single", 4, 0)
    night.add(moves.call(night.state, "W1.2", 1))
    night.add(moves.result(night.state, "W1.1", (3, 1)), "phones: P0 and P3")
    assert list(undoable(night.state)) == [4, 3]
    assert undo(night.state) == [Undone(3)]
    with pytest.raises(InputError, match="depend on entry 2"):
        undo(night.state, 2)
    _, after = night.add(*undo(night.state, 4))
    assert not after.counted
    assert after.on_tables.keys() == {"W1.2"}


def test_of_what_players_entered_only_the_last_result_can_be_taken_back() -> None:
    night = Night("single", 4, 0)
    drawn = len(night.events)
    night.add(moves.result(night.state, "W1.1", (3, 1)), "phones: P0 and P3")
    night.add(moves.result(night.state, "W1.2", (3, 1)), "phones: P1 and P2")
    assert list(undoable(night.state)) == [drawn + 2, drawn]


def test_an_entry_without_a_number_takes_back_the_last_one() -> None:
    night = Night("single", 4, 0)
    night.add(moves.call(night.state, "W1.1", 1))
    night.add(moves.score(night.state, "W1.1", (1, 1)), PHONE)
    night.add(Undone())
    assert night.state.on_tables
    assert not night.state.live


def test_a_match_called_back_keeps_its_score_and_may_be_called_again() -> None:
    night = Night("single", 4, 0)
    night.add(moves.call(night.state, "W1.1", 1))
    night.add(moves.score(night.state, "W1.1", (2, 1)), PHONE)
    before, after = night.add(moves.call_back(night.state, "w1.1"))
    assert not after.on_tables
    assert after.live == before.live
    assert after.free_tables == [1, 2, 3]
    with pytest.raises(InputError, match="1 isn't on a table"):
        moves.call_back(after, "W1.1")
    _, again = night.add(moves.call(after, "W1.1", 2))
    assert again.on_tables["W1.1"].call.table == 2


def test_a_name_or_a_rating_is_corrected_in_its_place() -> None:
    entrants = tuple(Entrant(name, 500.0) for name in ("Ann", "Bo", "Cy"))
    events = [Event(AT, Opened(Plan("single", 3, scale="fargo", seeding="listed"), entrants))]
    events += [Event(AT, moves.edit(evening(events), "Ann", name="Anne"))]
    events += [Event(AT, moves.edit(evening(events), "Bo", rating=620.0))]
    assert list(evening(events).entrants) == ["Anne", "Bo", "Cy"]
    for wrong in ({"name": "Cy"}, {}, {"name": "Bo"}):
        with pytest.raises(InputError):
            moves.edit(evening(events), "Bo", **wrong)
    drawn = [*events, Event(AT, moves.draw(evening(events), np.random.default_rng(1)))]
    assert evening(drawn).order == ("Anne", "Bo", "Cy")
    assert evening(drawn).ratings.tolist() == [500.0, 620.0, 500.0]
    with pytest.raises(InputError, match="draw has been made"):
        moves.edit(evening(drawn), "Bo", name="Bob")


def test_a_result_of_a_round_whose_draw_is_undone_is_set_aside_in_words() -> None:
    entrants = tuple(Entrant(f"P{k}", 500.0) for k in range(4))
    events = [Event(AT, Opened(Plan("swiss", 3, scale="fargo", rounds=2), entrants))]
    events.append(Event(AT, moves.draw(evening(events), np.random.default_rng(1))))
    events += [Event(AT, one) for one in moves.draw_next(evening(events), np.random.default_rng(2))]
    name = evening(events).standing.to_play[0]
    events.append(Event(AT, moves.result(evening(events), name, (3, 1)), "phones: P0 and P1"))
    events.append(Event(AT, *undo(evening(events))))
    answer = night_answer(Outlook(evening(events), AT))
    (warning,) = answer.warnings
    assert "in match 1, but the match is no longer in the draw" in warning
