import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.games import Ahead, Race, Rack, alternate_breaks, winner_breaks
from evenbreak.matches import race_win_probability, shutout_probability


def test_a_shutout_is_a_row_of_wins():
    assert shutout_probability(Race(3, 5, Rack(0.25))) == 0.25**3
    assert shutout_probability(Race(3, 5, Rack(0.25)), player=2) == 0.75**5
    broken = Rack(0.75, 0.5)
    assert shutout_probability(Race(3, 3, broken, breaks=winner_breaks)) == 0.75**3
    assert shutout_probability(Race(3, 3, broken, breaks=alternate_breaks)) == 0.75 * 0.5 * 0.75


def test_it_counts_from_the_score_on():
    race = Race(3, 3, Rack(0.25))
    assert shutout_probability(race, (1, 2)) == 0.25**2
    assert shutout_probability(race, (3, 1)) == 1.0
    assert shutout_probability(race, (3, 1), player=2) == 0.0


def test_sets_are_meant_in_a_match_of_sets():
    sets = Race(2, 2, Race(3, 3, Rack(0.6)))
    assert shutout_probability(sets) == pytest.approx(race_win_probability(0.6, 3, 3) ** 2)


def test_arrays_and_tiny_chances():
    found = shutout_probability(Race(200, 2, Rack(np.array([0.01, 1.0]))))
    assert found == pytest.approx([1e-400, 1.0], rel=1e-12)
    assert shutout_probability(Race(100, 2, Rack(0.01))) == pytest.approx(1e-200, rel=1e-12)


def test_only_races_have_one():
    assert shutout_probability(Ahead(2, 2, Rack(0.5))) is None
    with pytest.raises(InputError, match="player is 3"):
        shutout_probability(Race(2, 2, Rack(0.5)), player=3)
