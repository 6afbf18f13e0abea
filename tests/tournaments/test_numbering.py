"""Matches are numbered as printed sheets number them, and a number once given stays."""

from dataclasses import replace

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.tournaments import (
    CHIP_CHARTS,
    double_elimination,
    groups_then_knockout,
    single_elimination,
)
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.brackets.drafts import Draft, winner
from evenbreak.tournaments.brackets.laid_out import laid_out
from evenbreak.tournaments.brackets.numbering import match_numbers
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan, Result
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.plan import FORMATS

AT = "2026-11-24T19:30:00"


def night(form: str, players: int, **planned: object) -> list[Event]:
    names = [f"P{k:02}" for k in range(players)]
    plan = Plan(form, 5, tables=4, **planned)  # type: ignore[arg-type]
    if form == "chips":
        plan = replace(plan, chips=CHIP_CHARTS["hoboken"], scale="fargo")
    opened = Event(AT, Opened(plan, tuple(Entrant(name, 600.0) for name in names)))
    state = evening([opened])
    return [opened, *(Event(AT, what) for what in moves.draw_next(state, np.random.default_rng(1)))]


def test_nineteen_players_are_numbered_as_on_paper() -> None:
    numbers = match_numbers(double_elimination(19))
    rounds: dict[str, list[int]] = {}
    for name, number in numbers.items():
        rounds.setdefault(name.split(".")[0], []).append(number)
    assert [(name, found[0], found[-1]) for name, found in rounds.items()] == [
        *(("W1", 1, 3), ("W2", 4, 11), ("L2", 12, 14), ("W3", 15, 18), ("L3", 19, 22)),
        *(("L4", 23, 26), ("W4", 27, 28), ("L5", 29, 30), ("L6", 31, 32), ("W5", 33, 33)),
        *(("L7", 34, 34), ("L8", 35, 35), ("F", 36, 36), ("F2", 37, 37)),
    ]
    assert list(match_numbers(single_elimination(6, third_place=True)))[-2:] == ["T", "F"]
    assert list(match_numbers(groups_then_knockout(8, 2)))[:6] == [
        *("A:1.1", "A:1.2", "B:1.1", "B:1.2", "A:2.1", "A:2.2")
    ]


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("players", [9, 19])
def test_every_format_counts_from_one_and_after_those_that_feed_a_match(
    form: str, players: int
) -> None:
    state = evening(night(form, players))
    numbers = {match.name: state.number_of(match.name) for match in state.whole.matches}
    assert sorted(numbers.values()) == list(range(1, len(numbers) + 1))
    for match in state.whole.matches:
        for slot in match.slots:
            if isinstance(slot, Source) and slot.match in numbers:
                assert numbers[slot.match] < numbers[match.name]
    for name in state.bracket.by_name:
        spoken = str(state.match_words(name))
        assert spoken == f"{'rack' if form == 'chips' else 'match'} {numbers[name]}"
        for text in (name, name.lower(), f"#{numbers[name]}", spoken, f" {spoken.upper()} "):
            assert moves.known_match(state, text) == name
        if form != "chips":
            assert moves.known_match(state, str(numbers[name])) == name
    with pytest.raises(InputError, match="there's no match '999'; the matches are 1, 2"):
        moves.known_match(state, "999")


def test_a_bare_number_is_a_table_in_a_chip_tournament() -> None:
    events = night("chips", 9)
    rack = evening(events).chip_night.playing[1]
    one, other = rack.players
    state = evening([*events, Event(AT, Result(rack.name, (one, other), (1, 0), one))])
    assert moves.known_match(state, "2") == state.chip_night.tables[2] != rack.name
    assert (
        moves.known_match(state, "rack 2") == rack.name == moves.known_match(state, "2", over=True)
    )


def test_a_late_player_moves_no_number() -> None:
    events = night("double", 19)
    before = evening(events)
    state: Evening = before
    for k in range(3):
        events.append(Event(AT, moves.late(state, Entrant(f"Late {k}", 600.0))))
        state = evening(events)
    assert state.match_numbers.items() > before.match_numbers.items()
    assert sorted(state.match_numbers.values()) == list(range(1, len(state.match_numbers) + 1))
    assert state.number_of("L9.9") == 0
    assert state.match_words("L9.9") == "L9.9"


def test_a_bracket_of_another_program_keeps_the_numbers_of_its_file() -> None:
    drafts = [Draft("7", "winners", 1, (0, 1)), Draft("3", "winners", 1, (2, 3))]
    drafts.append(Draft("12", "final", 2, (winner("7"), winner("3"))))
    bracket = laid_out("single", ("Ann", "Bo", "Cy", "Di"), drafts)
    assert match_numbers(bracket) == {"7": 7, "3": 3, "12": 12}
    named = [
        Draft("W1.2", "winners", 1, (0, 1)),
        Draft("W1.1", "winners", 1, (2, 3)),
        Draft("F", "final", 2, (winner("W1.2"), winner("W1.1"))),
    ]
    plan = Plan("single elimination, imported", 5, layout=tuple(named))
    players = tuple(Entrant(name, 600.0) for name in ("Ann", "Bo", "Cy", "Di"))
    what = Opened(plan, players), Drawn(tuple(one.name for one in players), None)
    state = evening([Event(AT, one) for one in what])
    assert state.match_numbers == {"W1.2": 1, "W1.1": 2, "F": 3}
