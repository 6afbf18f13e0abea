"""Rewards: the text's stakes, and totals that can be counted by hand."""

from fractions import Fraction

import numpy as np
import pandas as pd
import pytest

from evenbreak.chains import chain_of
from evenbreak.chains.passage_times import steps_to_absorption
from evenbreak.chains.rewards import long_run_reward, total_reward
from evenbreak.errors import ChainError
from evenbreak.games import (
    OneBall,
    Race,
    Rack,
    Series,
    alternate_breaks,
    loser_breaks,
    winner_breaks,
)

STAKES = [
    (winner_breaks, Fraction(1, 2)),
    (loser_breaks, Fraction(-1, 14)),
    (alternate_breaks, Fraction(1, 10)),
]


@pytest.mark.parametrize(("breaks", "expected"), STAKES)
def test_stakes(breaks, expected):
    """P5.25: player 1 wins 1 point a game won and loses 2 a game lost; p1 = .9, p2 = .5."""
    series = Series(Rack(0.9, 0.5), breaks=breaks)
    points = {b: series.rack.chance(1, b) - 2 * series.rack.chance(2, b) for b in (1, 2)}
    earned = long_run_reward(chain_of(series), per_state=points)
    assert earned == pytest.approx(float(expected), rel=1e-13)


def test_stakes_by_arc():
    """With winner breaks, the next breaker is the winner of the last rack."""
    chain = chain_of(Series(Rack(0.9, 0.5), breaks=winner_breaks))
    points = {(1, 1): 1, (1, 2): -2, (2, 1): 1, (2, 2): -2}
    assert long_run_reward(chain, per_arc=points) == pytest.approx(0.5, rel=1e-14)


def test_fraction_of_games_won():
    """P5.24: W^LB = p1 / (p1 + p2)."""
    series = Series(Rack(0.9, 0.5), breaks=loser_breaks)
    won = {b: series.rack.chance(1, b) for b in (1, 2)}
    assert long_run_reward(chain_of(series), per_state=won) == pytest.approx(9 / 14, rel=1e-14)


def test_state_and_arc_rewards_add():
    chain = chain_of([("a", "b", 1.0), ("b", "a", 1.0)], start="a")
    assert long_run_reward(chain, per_state={"a": 3}, per_arc={("b", "a"): 5}) == 4.0
    assert long_run_reward(chain, per_state=np.array([1.0, 2.0])) == 1.5


def test_one_for_each_step_is_the_mean_number_of_steps():
    chain = chain_of(Race(4, 3, Rack(0.6, 0.7), breaks=winner_breaks))
    ones = np.ones(len(chain))
    assert total_reward(chain, per_state=ones) == pytest.approx(
        steps_to_absorption(chain).mean, rel=1e-14
    )


def test_winner_takes_all():
    """A prize on the arcs into W is the prize times the chance to win."""
    chain = chain_of(OneBall(0.4, 0.8))
    assert total_reward(chain, per_arc={("S1", "W"): 100}) == pytest.approx(40 / 0.88, rel=1e-14)


def test_what_is_earned_after_absorption_does_not_count():
    chain = chain_of([("s", "x", 1.0), ("x", "y", 1.0), ("y", "x", 1.0)])
    rewards = {"s": 2.0, "x": 7.0, "y": 1.0}
    assert total_reward(chain, "s", per_state=rewards) == 2.0
    assert long_run_reward(chain, "s", per_state=rewards) == 4.0
    assert total_reward(chain, "x", per_state=rewards) == 0.0


@pytest.mark.parametrize(
    ("rewards", "message"),
    [
        ({}, "Give per_state or per_arc"),
        ({"per_state": {"X": 1}}, "state 'X'"),
        ({"per_state": np.ones(2)}, r"shape \(4,\); its shape is \(2,\)"),
        ({"per_state": {"S1": np.nan}}, "nan for state 'S1'"),
        ({"per_arc": {("S1", "L"): 1}}, "no arc 'S1' -> 'L'"),
    ],
)
def test_refusals(rewards, message):
    with pytest.raises(ChainError, match=message):
        long_run_reward(chain_of(OneBall(0.4, 0.8)), **rewards)


def test_a_series_is_read_by_its_labels():
    chain = chain_of([("a", "b", 1.0), ("b", "c", 1.0)], start="a")
    rewards = pd.Series([3.0, 1.0], index=["b", "a"])
    assert total_reward(chain, per_state=rewards) == 4.0
    assert total_reward(chain, "b", per_state=rewards) == 3.0
    assert chain.density(pd.Series([0.75, 0.25], index=["b", "a"])).tolist() == [0.25, 0.75, 0.0]
    for labels, message in (
        ([0, 1], "state 0 isn't in the chain"),
        (["a", "a"], "the same label twice"),
    ):
        with pytest.raises(ChainError, match=message):
            total_reward(chain, per_state=pd.Series([1.0, 2.0], index=labels))
