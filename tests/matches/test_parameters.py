import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.games import OneBall, Race, Rack, alternate_breaks
from evenbreak.matches.parameters import (
    at_score,
    checked_match,
    first_breaker,
    in_shape,
    with_rack,
)

SETS = Race(3, 1, Race(3, 3, Rack(0.6, 0.5), breaks=alternate_breaks), first_breaker=2)


def test_other_games_are_refused():
    assert checked_match(SETS) is SETS
    with pytest.raises(InputError, match="OneBall"):
        checked_match(OneBall(0.5, 0.5))


def test_the_innermost_rack_is_replaced():
    changed = with_rack(SETS, Rack(0.1, 0.2))
    assert changed.innermost_rack == Rack(0.1, 0.2)
    assert (changed.m, changed.rack.m, changed.first_breaker) == (3, 3, 2)


def test_the_first_breaker_in_states():
    assert first_breaker(SETS) == 2
    assert first_breaker(Race(3, 3, Rack(0.6), first_breaker=2)) == 1


def test_p1_and_p2_get_one_shape():
    match, shape = at_score(with_rack(SETS, Rack([0.1, 0.2, 0.3], 0.5)), None)
    assert shape == match.innermost_rack.p2.shape == (3,)
    assert at_score(SETS, None) == (SETS, ())


def test_a_score_replaces_that_of_the_match():
    match, _ = at_score(SETS, (1, 0))
    assert match.score == (1, 0)
    with pytest.raises(InputError, match="4:0"):
        at_score(SETS, (4, 0))


def test_an_answer_gets_the_shape_of_the_parameters():
    assert in_shape(np.float64(0.5), ()) == 0.5
    assert isinstance(in_shape(np.float64(0.5), ()), float)
    assert in_shape(0.5, (2, 2)).tolist() == [[0.5, 0.5], [0.5, 0.5]]
