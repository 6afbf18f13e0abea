"""Brackets written for brackets-manager: what it saves itself, and what is read again."""

import json

import pytest

from evenbreak.errors import InputError
from evenbreak.files.brackets_manager_writer import brackets_manager_file
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Called, Event, Scored
from evenbreak.tournaments.evening.fold import evening
from tournament_nights import AT, SAVED, imported, night


@pytest.mark.parametrize("name", ["double12", "double8_all", "single8"])
def test_it_is_what_brackets_manager_saves_itself(name):
    path = SAVED / f"brackets_manager_{name}.json"
    content, warnings = brackets_manager_file(imported(path), "Cup")
    assert not warnings
    assert json.loads(content) == json.loads(path.read_text())


@pytest.mark.parametrize(
    ("form", "plan"),
    [
        ("double", {}),
        ("double", {"final": "single", "drops": "usual"}),
        ("single", {"third_place": True}),
        ("round-robin", {}),
    ],
)
@pytest.mark.parametrize("players", [3, 4, 6, 9, 13, 32])
def test_what_is_written_is_read_again(tmp_path, form, plan, players):
    if form == "round-robin" and players > 9:
        return
    path = tmp_path / "cup.json"
    for results in (0, players, 999):
        state = night(players, form, results, **plan)
        events = list(state.events)
        ready = state.standing.to_play
        if len(ready) > 1:
            gone, pair = state.pair(ready[0])[0], state.pair(ready[1])
            what = [
                moves.forfeit(state, gone, ready[0]),
                Called(ready[1], 2, pair),
                Scored(ready[1], pair, (3, 1)),
            ]
            state = evening([*events, *(Event(AT, one) for one in what)])
        content, _ = brackets_manager_file(state, "Cup")
        path.write_bytes(content)
        again = imported(path)
        assert again.counted == state.counted
        assert again.standing.seats == state.standing.seats
        assert set(again.standing.to_play) == set(state.standing.to_play)
        assert again.bracket.places == state.bracket.places
        assert {n: one.what for n, one in again.live.items()} == {
            n: one.what for n, one in state.live.items()
        }


def test_the_order_of_drops_has_a_name_up_to_64():
    assert not brackets_manager_file(night(64, "double", 0), "Cup")[1]
    assert brackets_manager_file(night(65, "double", 0), "Cup")[1]


@pytest.mark.parametrize(
    ("players", "form", "plan"),
    [(16, "pods", {}), (8, "swiss", {}), (8, "double", {"qualifiers": 4}), (2, "double", {})],
)
def test_what_brackets_manager_cannot_hold_is_refused(players, form, plan):
    with pytest.raises(InputError, match="cannot hold"):
        brackets_manager_file(night(players, form, 0, **plan), "Cup")
