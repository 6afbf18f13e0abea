from fractions import Fraction
from itertools import pairwise
from math import comb, sqrt

import numpy as np
import pytest

from evenbreak.chains import chain_of
from evenbreak.errors import InputError
from evenbreak.game import Game
from evenbreak.handicaps import Chart, ClosedPair, chart, in_step_law
from evenbreak.handicaps.systems.step import step_system

SHORT = Chart("short", [(0, 0, 2, 2), (1, 2, 3, 2), (3, None, 2, 1)])


def exact_win(p, m, n):
    games = m + n - 1
    return sum(comb(games, k) * p**k * (1 - p) ** (games - k) for k in range(m, games + 1))


def exact_pair(by, parity, widest=60):
    """Return differences and law of two equal players by detailed balance, without rounding."""
    states = [x for x in range(-widest, widest + 1) if x % 2 == parity]
    wins = [exact_win(Fraction(1, 2), *by.race(x)) for x in states]
    weights = [Fraction(1)]
    for up, down in pairwise(wins):
        weights.append(weights[-1] * up / (1 - down))
    return states, [weight / sum(weights) for weight in weights]


@pytest.mark.parametrize("name", ["npl_8", "npl_10", "npl_12", "npl_20"])
@pytest.mark.parametrize("parity", [0, 1])
def test_a_closed_pair_has_the_exact_law(name, parity):
    states, law = exact_pair(chart(name), parity)
    found = ClosedPair("npl", chart(name), start=parity).law()
    assert found.values == tuple(states)
    np.testing.assert_allclose(found.probability, [float(x) for x in law], rtol=1e-12)


def test_a_closed_pair_wanders_less_than_a_ladder():
    pair = ClosedPair("npl", chart("npl_10"))
    assert pair.error_law().sd == pytest.approx(3.04, abs=5e-3)
    assert pair.error_law().sd == pair.law().sd / 2
    assert pair.error_law().mean == pytest.approx(0.0, abs=1e-12)


def test_a_closed_pair_is_a_game_that_conserves_the_sum():
    pair = ClosedPair("npl", SHORT, widest=4, start=1)
    assert isinstance(pair, Game)
    assert pair.winner(1) is None
    assert pair.moves(3) == pytest.approx({1: 0.75, 3: 0.25})  # beyond 4 nobody moves
    assert sorted(chain_of(pair).states) == [-3, -1, 1, 3]


def test_ratings_of_a_pair_come_near_the_difference_of_skill():
    pair = ClosedPair("npl", chart("npl_20"), skill_difference=20)
    assert pair.law().mean == pytest.approx(20, abs=0.5)
    assert pair.error_law().mean == pytest.approx((pair.law().mean - 20) / 2, abs=1e-12)


def test_a_pair_whose_sum_changes_has_a_difference_only():
    pair = ClosedPair(step_system(2, 1))
    assert pair.law().mean == pytest.approx(0.0, abs=1e-12)
    with pytest.raises(InputError, match="change the sum of the two ratings"):
        pair.error_law()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"start": 61},
            (
                "start must be a rating difference in whole points from -60 to 60, or "
                "make widest larger; you gave 61"
            ),
        ),
        (
            {"start": 0.5},
            (
                r"start must be a rating difference in whole points from -60 to 60, or "
                r"make widest larger; you gave 0\.5"
            ),
        ),
        ({"skill_difference": float("nan")}, "finite number of points"),
        ({"widest": 0}, "widest must"),
    ],
)
def test_a_pair_refuses(options, message):
    with pytest.raises(InputError, match=message):
        ClosedPair("npl", **options)


@pytest.mark.parametrize(
    ("name", "sd"), [("npl_8", 4.754), ("npl_10", 4.305), ("npl_12", 4.205), ("npl_20", 3.690)]
)
def test_in_step_law_is_the_fixed_point_of_a_dense_iteration(name, sd):
    errors = np.arange(-60, 61)
    difference = errors[:, None] - errors
    win = np.array(
        [float(exact_win(Fraction(1, 2), *chart(name).race(x))) for x in range(-120, 121)]
    )
    met = np.where(difference % 2 == 0, win[difference + 120], 0.0)
    law = np.exp(-((errors / 4.5) ** 2) / 2)
    law /= law.sum()
    for _ in range(60):
        up = met @ law / ((difference % 2 == 0) @ law)
        law = np.cumprod(np.concatenate([[1.0], up[:-1] / (1 - up[1:])]))
        law = (law + law[::-1]) / (2 * law.sum())
    found = in_step_law("npl", chart(name))
    np.testing.assert_allclose(found.probability, law, atol=1e-12)
    assert found.sd == pytest.approx(sd, abs=5e-4)


def test_in_step_law_of_longer_steps_is_on_their_multiples():
    law = in_step_law(step_system(3))
    assert set(np.diff(law.values)) == {3}
    assert law.sd > in_step_law("npl").sd


@pytest.mark.parametrize("system", [step_system(2, 1), "margin"])
def test_players_who_do_not_stay_in_step_are_refused(system):
    with pytest.raises(InputError, match="players don't stay in step"):
        in_step_law(system)


def league_sd(ratings, nights, seed):
    """Return the standard deviation of equal players' ratings who meet by lot, and its error."""
    rng = np.random.default_rng(seed)
    by = chart("npl_10")
    win = np.array([float(exact_win(Fraction(1, 2), *by.race(x))) for x in range(-200, 201)])
    half = len(ratings) // 2
    squares = []
    for night in range(nights + 300):
        order = rng.permutation(len(ratings))
        a, b = order[:half], order[half:]
        turn = np.where(rng.random(half) < win[ratings[a] - ratings[b] + 200], 1, -1)
        ratings[a] += turn
        ratings[b] -= turn
        if night >= 300:
            squares.append(float((ratings**2).mean()))
    batches = np.array(squares).reshape(10, -1).mean(axis=1)
    variance, error = batches.mean(), batches.std(ddof=1) / sqrt(10)
    assert ratings.sum() == 0
    return sqrt(variance), error / (2 * sqrt(variance))


@pytest.mark.slow
def test_a_simulated_closed_league_is_in_step_or_not():
    many = 4000
    right, error = league_sd(np.zeros(many, dtype=int), 2000, seed=5)
    exact = in_step_law("npl", chart("npl_10")).sd
    assert abs(right - exact) < 4.5 * error
    assert error < 0.015
    # A quarter one up, a quarter one down: parities by halves, the sum 0.
    begun = np.repeat([1, -1, 0, 0], many // 4)
    mixed, error = league_sd(begun, 2000, seed=6)
    assert abs(mixed - 4.4168) < 4.5 * error
    assert mixed - right > 0.05


@pytest.mark.parametrize("state", [-61, 61])
def test_a_pair_has_no_state_beyond_the_ends(state):
    with pytest.raises(InputError, match="state must be a rating difference from -60"):
        ClosedPair("npl").moves(state)
