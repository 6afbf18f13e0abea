"""Within how many racks a match ends, against the distribution of its length."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.games import Ahead, Race, Rack, alternate_breaks, winner_breaks
from evenbreak.matches import match_length, rack_by_rack
from evenbreak.matches.rack_by_rack import breaker_in, rack_moves, racks_within

MATCHES = [
    Ahead(4, 2, Rack(0.55)),
    Race(5, 3, Rack(0.6, 0.7), breaks=winner_breaks, first_breaker=2),
    Race(3, 2, Race(2, 3, Rack(0.5)), score=(1, 0)),
    Race(4, 4, Rack(0.6, 0.55), breaks=alternate_breaks, win_by=2),
]
WAYS = {"plain": {}, "scipy": {"_PATIENCE": 0}, "doubling": {"_PATIENCE": 0, "_LONGEST": 0}}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("match", MATCHES, ids=lambda match: type(match).__name__)
def test_all_ways_find_the_quantiles_of_the_length(
    match: Any, way: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in WAYS[way].items():
        monkeypatch.setattr(rack_by_rack, name, value)
    length = match_length(match)
    levels = (0.05, 0.3, 0.5, 0.77, 0.9, 0.999)
    found = racks_within(rack_moves(match), [(match.start, q) for q in levels], {})
    assert found == [length.quantile(q) for q in levels]


@given(st.integers(1, 60), st.floats(0.05, 0.95))
def test_a_geometric_wait(trials: int, leave: float) -> None:
    # Two states in a row, then a geometric wait.
    moves = {"a": [("b", 1.0)], "b": [("b", 1.0 - leave), ("over", leave)]}
    level = 1.0 - (1.0 - leave) ** trials
    if level < 1.0 - 1e-6:
        asked = [("a", level * (1 - 1e-9)), ("b", level * (1 + 1e-9)), ("over", 0.5)]
        assert racks_within(moves, asked, {}) == [trials + 1, trials + 1, 0]


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("states", [1, 1_500])
def test_a_wait_of_a_million_racks(states: int) -> None:
    # -log(.5) / 1e-6 racks to get out of the last state, after one rack in each of the others.
    moves: dict[Any, Any] = {k: [(k + 1, 1.0)] for k in range(states - 1)}
    moves[states - 1] = [(states - 1, 1.0 - 1e-6), ("over", 1e-6)]
    (found,) = racks_within(moves, [(0, 0.5)], {})
    assert found == (693_147 if states == 1 else None)


def test_a_match_that_may_never_end_has_no_quantile_beyond() -> None:
    moves = {"on": [("on", 0.5), ("over", 0.4), ("stuck", 0.1)], "stuck": [("stuck", 1.0)]}
    never = {"on": 0.2, "stuck": 1.0}
    asked = [("on", 0.4), ("on", 0.79), ("on", 0.81), ("stuck", 0.1)]
    assert racks_within(moves, asked, never) == [1, 7, None, None]


LISTED = [
    Race(4, 3, Rack(0.6)),
    Ahead(2, 3, Rack(0.6, 0.7), breaks=alternate_breaks, first_breaker=2),
    Race(2, 2, Race(2, 1, Rack(0.6, 0.5), breaks=winner_breaks), breaks=alternate_breaks),
    Race(3, 3, Rack(0.6), win_by=2),
]


@pytest.mark.parametrize("match", LISTED, ids=lambda match: type(match).__name__)
def test_the_moves_are_those_of_the_match(match):
    for state, moves in rack_moves(match).items():
        assert dict(moves) == match.moves(state)


def test_a_rack_that_cannot_be_won_is_listed_all_the_same():
    assert rack_moves(Race(2, 1, Rack(0.0)))[0, 0] == (((1, 0), 0.0), ((0, 1), 1.0))


def test_chances_may_be_arrays():
    p = np.array([0.1, 0.2])
    (_, won), (_, lost) = rack_moves(Race(1, 1, Rack(p)))[0, 0]
    assert won.tolist() == [0.1, 0.2]
    assert lost.tolist() == [0.9, 0.8]


def test_a_match_that_is_over_has_no_moves():
    assert rack_moves(Race(2, 2, Rack(0.5), score=(2, 0))) == {}


def test_the_breaker_of_a_set_is_in_its_innermost_state():
    sets = LISTED[2]
    assert breaker_in(sets, sets.start) == 1
    assert {breaker_in(sets, state) for state in rack_moves(sets)} == {1, 2}
    assert breaker_in(LISTED[0], (0, 0)) == 1
