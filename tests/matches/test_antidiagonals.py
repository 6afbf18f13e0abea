import numpy as np
import pytest

from evenbreak.games import BREAK_FORMATS, Rack, alternate_breaks, winner_breaks
from evenbreak.matches import endings as antidiagonals
from evenbreak.matches import race_odds
from evenbreak.matches.endings import race_endings

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
    monkeypatch.setattr(antidiagonals, "_BLOCK", 30)
    in_blocks = race_endings(5, 5, rack, alternate_breaks, 2)
    assert np.array_equal(whole.win_1, in_blocks.win_1)
    assert np.array_equal(whole.win_2, in_blocks.win_2)
