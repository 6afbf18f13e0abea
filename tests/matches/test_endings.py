import numpy as np
import pytest

from evenbreak.games import Ahead, Race, Rack, winner_breaks
from evenbreak.matches.endings import endings_of, is_bounded


@pytest.mark.parametrize(
    ("match", "bounded"),
    [
        (Race(3, 3, Rack(0.5)), True),
        (Race(3, 3, Rack(0.5), win_by=2), False),
        (Race(3, 3, Rack(0.5), win_by=2, score=(3, 1)), True),
        (Race(2, 2, Race(3, 3, Rack(0.5))), True),
        (Race(2, 2, Race(3, 3, Rack(0.5), win_by=2)), False),
        (Race(2, 2, Ahead(2, 2, Rack(0.5))), False),
        (Ahead(2, 2, Rack(0.5)), False),
    ],
)
def test_which_matches_have_a_longest_length(match, bounded):
    assert is_bounded(match) is bounded


def test_a_match_that_is_over_ends_after_no_rack():
    endings = endings_of(Race(3, 3, Rack([0.5, 0.6]), score=(1, 3)), 0.0, 0.0)
    assert (endings.win_1.tolist(), endings.win_2.tolist()) == ([[0.0, 0.0]], [[1.0, 1.0]])


def test_sets_of_one_rack_are_racks():
    rack = Rack(np.array([0.25, 0.5]), 0.75)
    racks = endings_of(Race(3, 2, rack, breaks=winner_breaks), 0.0, 0.0)
    sets = endings_of(Race(3, 2, Race(1, 1, rack, breaks=winner_breaks)), 0.0, 0.0)
    assert sets.win_1 == pytest.approx(racks.win_1, rel=1e-14)
    assert sets.win_2 == pytest.approx(racks.win_2, rel=1e-14)


def test_two_ahead_ends_after_an_even_number_of_racks():
    endings = endings_of(Ahead(2, 2, Rack(0.5)), 0.0, 1e-3)
    # From level half of the pairs of racks are won by one player.
    assert endings.win_1[:7].tolist() == [0, 0, 1 / 4, 0, 1 / 8, 0, 1 / 16]
    assert len(endings.win_1) == 21  # 2^-10 is still going on after 20 racks


def test_what_never_ends_is_not_waited_for():
    certain = Ahead(2, 2, Rack(1.0, 1.0), breaks=lambda breaker, _: 3 - breaker)
    assert len(endings_of(certain, 1.0, 1e-12).win_1) == 1
