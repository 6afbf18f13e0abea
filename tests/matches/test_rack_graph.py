import numpy as np
import pytest

from evenbreak.games import Ahead, Race, Rack, alternate_breaks, winner_breaks
from evenbreak.matches.rack_by_rack import breaker_in, rack_moves

MATCHES = [
    Race(4, 3, Rack(0.6)),
    Ahead(2, 3, Rack(0.6, 0.7), breaks=alternate_breaks, first_breaker=2),
    Race(2, 2, Race(2, 1, Rack(0.6, 0.5), breaks=winner_breaks), breaks=alternate_breaks),
    Race(3, 3, Rack(0.6), win_by=2),
]


@pytest.mark.parametrize("match", MATCHES, ids=lambda match: type(match).__name__)
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
    sets = MATCHES[2]
    assert breaker_in(sets, sets.start) == 1
    assert {breaker_in(sets, state) for state in rack_moves(sets)} == {1, 2}
    assert breaker_in(MATCHES[0], (0, 0)) == 1
