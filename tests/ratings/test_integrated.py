"""Chances of scores, averaged over what is not known of a difference."""

import math
from itertools import product

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import expit
from scipy.stats import norm

from evenbreak.matches.win import race_win_probability
from evenbreak.ratings import Results
from evenbreak.ratings.integrated import Scores, normal_nodes


def scores_of(results, *, breaks=False):
    return Scores.of(results.played().results, results.won_only(), breaks=breaks)


def chances(results, mean, variance, advantage=0.0, *, breaks=False):
    scores = scores_of(results, breaks=breaks)
    shape = (1, len(scores.player_a))
    log = scores.log_chances(np.full(shape, mean), np.full(shape, variance), np.array([advantage]))
    return np.exp(log[0])


def averaged(chance, mean, variance):
    sd = math.sqrt(variance)
    known = norm(mean, sd)
    return quad(
        lambda d: chance(d) * known.pdf(d), mean - 12 * sd, mean + 12 * sd, epsabs=0.0, limit=200
    )[0]


@given(st.floats(-2.0, 2.0), st.floats(0.01, 2.0))
@example(0.0, 1.0)
@example(0.0, 2.0)
def test_a_score_is_as_likely_as_on_average_over_the_difference(mean, variance):
    results = Results.from_names(["A"] * 3, ["B"] * 3, [7, 1, 0], [4, 0, 9])
    expected = [
        averaged(lambda d: expit(d) ** x * expit(-d) ** y, mean, variance)  # noqa: B023
        for x, y in ((7, 4), (1, 0), (0, 9))
    ]
    right_to = 1e-4 if variance <= 1.0 else 3e-3
    np.testing.assert_allclose(chances(results, mean, variance), expected, rtol=right_to)


def test_all_scores_of_a_race_are_likely_to_1():
    m, n = 5, 3
    rows = [(m, y) for y in range(n)] + [(x, n) for x in range(m)]
    orders = [math.comb(x + y - 1, min(x, y) if x == m else x) for x, y in rows]
    won, lost = zip(*rows, strict=True)
    results = Results.from_names(["A"] * len(rows), ["B"] * len(rows), won, lost)
    assert chances(results, 0.4, 0.8) @ orders == pytest.approx(1.0)


def test_who_wins_a_race_is_as_likely_as_on_average():
    results = Results.from_names(
        ["A"] * 2, ["B"] * 2, [0, 0], [0, 0], race_a=[7, 7], race_b=[5, 5],
        winner=[1, 2], unscored=[True, True],
    )  # fmt: skip
    expected = averaged(lambda d: float(race_win_probability(expit(d), 7, 5)), 0.3, 0.5)
    np.testing.assert_allclose(chances(results, 0.3, 0.5), [expected, 1.0 - expected], rtol=1e-6)


def test_racks_of_which_the_score_alone_says_who_broke_are_the_sum_over_how_they_were_won():
    """In a race to 3 with winner breaks: all orders of the racks of a score."""
    results = Results.from_names(
        ["A"], ["B"], [3], [1], race_a=[3], race_b=[3], first_break=[1], break_format=[1]
    )
    mean, variance, advantage = 0.2, 0.5, 0.3

    def chance(d):
        total = 0.0
        for order in product("ab", repeat=4):
            if order.count("a") != 3 or order[-1] != "a":
                continue
            each, breaker = 1.0, "a"
            for winner in order:
                p = expit(d + (advantage if breaker == "a" else -advantage))
                each *= p if winner == "a" else 1.0 - p
                breaker = winner
            total += each
        return total

    found = chances(results, mean, variance, advantage, breaks=True)
    assert found == pytest.approx([averaged(chance, mean, variance)])


def test_several_ways_are_as_each_alone():
    rng = np.random.default_rng(1)
    many = 400
    won = rng.integers(0, 8, many)
    results = Results(("A", "B"), np.zeros(many, int), np.ones(many, int), won, 7 - won)
    scores = scores_of(results)
    mean, variance = rng.normal(size=(60, many)), rng.random((60, many))
    together = scores.log_chances(mean, variance, np.zeros(60))
    alone = [
        scores.log_chances(mean[k : k + 1], variance[k : k + 1], np.zeros(1))[0] for k in (0, 59)
    ]
    np.testing.assert_allclose(together[[0, 59]], alone)


def test_a_long_score_does_not_underflow():
    results = Results.from_names(["A"], ["B"], [2000], [1900])
    scores = scores_of(results)
    log = scores.log_chances(np.zeros((1, 1)), np.full((1, 1), 0.01), np.zeros(1))
    assert log[0, 0] == pytest.approx(3900 * math.log(0.5), rel=1e-2)


def test_the_rule_is_that_of_a_normal():
    points, weights = normal_nodes()
    assert weights @ points**4 == pytest.approx(3.0)
