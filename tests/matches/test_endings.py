import numpy as np
import pytest

from evenbreak.games import BREAK_FORMATS, Ahead, Race, Rack, alternate_breaks, winner_breaks
from evenbreak.matches import race_odds
from evenbreak.matches.endings import endings_of, is_bounded, race_endings


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


P1, P2 = np.meshgrid([0.0, 0.3, 0.75, 1.0], [0.2, 0.5, 1.0])


@pytest.mark.parametrize("breaks", BREAK_FORMATS.values(), ids=list(BREAK_FORMATS))
@pytest.mark.parametrize("first", [1, 2])
def test_arrays_have_the_endings_of_plain_numbers(breaks, first):
    endings = race_endings(4, 3, Rack(P1, P2), breaks, first)
    assert endings.win_1.shape == (7, *P1.shape)
    for at in np.ndindex(P1.shape):
        race = race_odds(4, 3, Rack(P1[at], P2[at]), breaks, first)
        for array, plain in zip(endings, (race.win_1, race.win_2), strict=True):
            assert array[(slice(3, None), *at)] == pytest.approx(plain, rel=1e-13)


def test_one_rack_decides_a_race_to_one():
    endings = race_endings(1, 1, Rack(0.75), None, 1)
    assert (endings.win_1.tolist(), endings.win_2.tolist()) == ([0.0, 0.75], [0.0, 0.25])


def test_somebody_wins():
    endings = race_endings(9, 7, Rack(P1, P2), winner_breaks, 1)
    total = endings.win_1.sum(axis=0) + endings.win_2.sum(axis=0)
    assert total == pytest.approx(np.ones(P1.shape), rel=1e-14)


def test_blocks_of_parameters_change_nothing(monkeypatch):
    rack = Rack(np.linspace(0, 1, 50), 0.6)
    whole = race_endings(5, 5, rack, alternate_breaks, 2)
    monkeypatch.setattr("evenbreak.matches.endings._BLOCK", 30)
    in_blocks = race_endings(5, 5, rack, alternate_breaks, 2)
    assert np.array_equal(whole.win_1, in_blocks.win_1)
    assert np.array_equal(whole.win_2, in_blocks.win_2)
