"""Where a tournament stands after some results."""

from __future__ import annotations

import pytest

from evenbreak.errors import InputError
from evenbreak.tournaments import consolation, double_elimination, round_robin, standing
from evenbreak.tournaments.brackets.standing import NOBODY, ranked

NAMES = ["Ann", "Bo", "Cy", "Di"]


def test_matches_open_as_results_come() -> None:
    bracket = double_elimination(NAMES)
    assert standing(bracket).to_play == ("W1.1", "W1.2")
    now = standing(bracket, {"W1.1": "Di", "W1.2": "Bo"})
    assert now.to_play == ("L1.1", "W2.1")
    assert now.seats["L1.1"] == (0, 2)
    assert [match.name for match in now.remaining.matches] == ["L1.1", "W2.1", "L2.1", "F", "F2"]
    assert now.remaining.match("W2.1").slots == (3, 1)


def test_a_second_final_that_is_not_needed() -> None:
    bracket = double_elimination(NAMES)
    results = {"W1.1": "Ann", "W1.2": "Bo", "W2.1": "Ann", "L1.1": "Cy", "L2.1": "Cy"}
    needed = standing(bracket, {**results, "F": "Cy"})
    assert needed.to_play == ("F2",)
    assert needed.seats["F2"] == (0, 2)
    over = standing(bracket, {**results, "F": "Ann"})
    assert over.to_play == ()
    assert over.winners["F2"] == NOBODY
    with pytest.raises(InputError, match="F2"):
        standing(bracket, {**results, "F": "Ann", "F2": "Cy"})


def test_nobody_comes_to_the_consolation_from_a_lost_second_match() -> None:
    bracket = consolation(["Ann", "Bo", "Cy", "Di", "Ed", "Flo"])  # byes for Ann and Bo
    now = standing(bracket, {"W1.2": "Di", "W1.4": "Cy", "W2.1": "Ann"})
    into = {slot: match.name for match in bracket.matches for slot in match.slots}
    name = next(name for slot, name in into.items() if slot == bracket.match("C1.1").slots[0])
    assert name == "C1.1"
    # Di lost a second match and is out; Ed, who lost the first, has a bye.
    seats = [seat for key, pair in now.seats.items() if key[0] == "C" for seat in pair]
    assert NOBODY in seats
    assert 3 not in seats


def test_what_is_assumed_is_kept_apart() -> None:
    now = standing(double_elimination(NAMES), {"F": "Ann"})
    assert now.assumed == {"F": 0}
    assert now.winners == {}


def test_a_group_is_settled_when_nobody_is_level() -> None:
    bracket = round_robin(["Ann", "Bo", "Cy"])
    clear = standing(bracket, {"R1.1": "Bo", "R2.1": "Ann", "R3.1": "Ann"})
    assert clear.remaining.matches == ()
    level = {"R1.1": "Bo", "R2.1": "Cy", "R3.1": "Ann"}
    assert len(standing(bracket, level).remaining.matches) == 3
    lots = standing(bracket, {**level, "R": ["Cy", "Bo", "Ann"]})
    assert lots.remaining.groups == ()
    with pytest.raises(InputError, match="group R"):
        standing(bracket, {**level, "R": ["Cy", "Bo"]})


def test_ranks_go_by_wins_then_by_wins_among_those_level() -> None:
    members = [0, 1, 2, 3]
    pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    # 0 and 1 have two wins, 0 beat 1; 2 and 3 have one, 3 beat 2.
    assert ranked(members, pairs, [0, 2, 0, 1, 1, 3]) == [0, 1, 3, 2]
    # 0, 1, 2 beat each other in a circle and all beat 3.
    assert ranked(members, pairs, [0, 2, 0, 1, 1, 2]) == [0, 0, 0, 3]
