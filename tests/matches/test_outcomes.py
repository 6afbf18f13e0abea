"""Outcomes of racks, sets and matches: chances, means and standard deviations by result."""

from fractions import Fraction
from math import sqrt

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.games import Ahead, Race, Rack, alternate_breaks, winner_breaks
from evenbreak.matches import race_win_probability, shutout_probability
from evenbreak.matches.outcomes import NEVER, ScoreChain, outcomes_of, ratio, unit_outcomes


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


def test_gamblers_ruin_to_the_last_digits() -> None:
    # The chance to gain 20 before losing 20 with odds 1 : 10^6 is of the order 1e-120.
    up = 1e-6
    down = 1.0 - up
    walk = ScoreChain({k: {k + 1: up, k - 1: down} for k in range(1, 40)})
    odds = Fraction(up) / Fraction(down)
    exact = sum(odds**k for k in range(20, 40)) / sum(odds**k for k in range(40))
    assert walk.solve({40: 1.0})[20] == pytest.approx(float(exact), rel=1e-13, abs=0)


def test_rewards_of_each_visit_add_up() -> None:
    walk = ScoreChain({k: {k + 1: 0.5, k - 1: 0.5} for k in range(1, 10)})
    steps = walk.solve(reward=lambda _: 1.0)
    assert [steps[k] for k in range(1, 10)] == pytest.approx([k * (10 - k) for k in range(1, 10)])


def test_a_self_loop_is_what_the_ways_out_leave_over() -> None:
    slow = ScoreChain({"on": {"on": 0.999, "won": 1e-20, "lost": 3e-20}})
    assert slow.solve({"won": 1.0})["on"] == pytest.approx(0.25, rel=1e-15)


def test_a_closed_set_of_states_leads_to_never() -> None:
    rows = {0: {1: 0.5, "x": 0.5}, "x": {"y": 1.0}, "y": {"x": 1.0}}
    chain = ScoreChain(rows)
    assert chain.solve({NEVER: 1.0})[0] == 0.5
    assert chain.solve({NEVER: 3.0, 1: 1.0})[0] == 2.0
    assert chain.solve({1: 1.0})[0] == 0.5
    assert chain.solve({1: 1.0})["y"] == 0.0


def test_arrays_are_many_chains_at_once() -> None:
    p = np.array([0.0, 0.5, 1.0])
    rows = {0: {1: p, -1: 1.0 - p}, 1: {0: p, 2: 1.0 - p}}
    chain = ScoreChain(rows)
    assert chain.solve({2: 1.0})[0].tolist() == pytest.approx([0.0, 1 / 3, 0.0])
    assert chain.solve({-1: 1.0})[0].tolist() == pytest.approx([1.0, 2 / 3, 0.0])
    assert chain.solve({NEVER: 1.0})[0].tolist() == [0.0, 0.0, 1.0]


def test_ratio_takes_nothing_for_none() -> None:
    assert ratio(1.0, 0.0) == 0.0
    assert ratio(np.array([1.0, 2.0]), np.array([0.0, 4.0])).tolist() == [0.0, 0.5]
    assert ratio(0.0, np.array([0.0, 4.0])).tolist() == [0.0, 0.0]


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
    with pytest.raises(InputError, match="player must"):
        shutout_probability(Race(2, 2, Rack(0.5)), player=3)
