from fractions import Fraction

import numpy as np
import pytest

from evenbreak.matches.outcomes import NEVER, ScoreChain, ratio


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
