"""Outcomes of racks, sets and matches: chances, means and standard deviations by result."""

from math import sqrt

import numpy as np
import pytest

from evenbreak.games import Ahead, Race, Rack, alternate_breaks, winner_breaks
from evenbreak.matches.outcomes import outcomes_of, unit_outcomes


def test_a_rack_takes_one_rack():
    units = unit_outcomes(Race(3, 3, Rack(0.75, 0.5), breaks=winner_breaks))
    assert units[1].by_result == {(1, 1): (0.75, 1.0, 0.0), (2, 2): (0.25, 1.0, 0.0)}
    assert units[2].by_result == {(1, 1): (0.5, 1.0, 0.0), (2, 2): (0.5, 1.0, 0.0)}


def test_a_race_by_winner_and_next_breaker():
    found = outcomes_of(Race(2, 2, Rack(0.75, 0.5), breaks=alternate_breaks)).by_result
    # Two racks in a row, or one each and then one more on player 1's break.
    assert found[1, 1].chance == pytest.approx(0.75 * 0.5)
    assert found[1, 2].chance == pytest.approx((0.75 * 0.5 + 0.25 * 0.5) * 0.75)
    assert (found[1, 1].mean, found[1, 2].mean) == (2.0, 3.0)


def test_a_race_to_two_by_length():
    length = outcomes_of(Race(2, 2, Rack(0.5))).length
    assert length == pytest.approx((1.0, 2.5, 0.5))


def test_two_ahead_is_a_geometric_number_of_pairs():
    p, q = 0.6, 0.4
    outcomes = outcomes_of(Ahead(2, 2, Rack(p)))
    assert outcomes.p_win(1) == pytest.approx(p**2 / (p**2 + q**2))
    end = p**2 + q**2
    assert outcomes.length.mean == pytest.approx(2 / end)
    assert outcomes.length.sd == pytest.approx(2 * sqrt(1 - end) / end)


def test_arrays_are_many_matches_at_once():
    p = np.array([0.0, 0.3, 1.0])
    outcomes = outcomes_of(Race(2, 1, Race(2, 2, Rack(p))))
    each = [outcomes_of(Race(2, 1, Race(2, 2, Rack(float(x))))) for x in p]
    assert outcomes.p_win(1) == pytest.approx([one.p_win(1) for one in each])
    assert outcomes.length.sd == pytest.approx([one.length.sd for one in each])


def test_what_never_ends_is_counted():
    assert outcomes_of(Ahead(2, 2, Rack(1.0, 1.0), breaks=alternate_breaks)).never == 1.0
    assert outcomes_of(Ahead(2, 2, Rack(0.9, 1.0), breaks=alternate_breaks)).never == 0.0


def test_lengths_are_left_out_on_demand():
    outcomes = outcomes_of(Race(3, 3, Rack(0.5)), lengths=False)
    assert outcomes.length == (1.0, 0.0, 0.0)
