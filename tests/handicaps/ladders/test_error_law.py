"""The errors that reproduce themselves, against exact rounds, chains of nights and symmetry."""

import sys
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import AccuracyError
from evenbreak.handicaps import (
    AUTOCORRELATED,
    EQUAL_SKILL,
    NATURAL,
    Chart,
    Ladder,
    Opponents,
    chart,
)
from evenbreak.handicaps.ladders.error_law import long_run
from evenbreak.ratings import SCALES
from evenbreak.stats import Distribution
from slow_ladders import chances, exact_law, exact_win, rounded_normal
from tiers import examples

MODELS = (NATURAL, AUTOCORRELATED, EQUAL_SKILL)
CHARTS = ("npl_8", "npl_10", "npl_12", "npl_20")


def test_a_night_of_two_matches_is_the_chain_of_error_match_and_form():
    ladder = Ladder(chart("npl_8"), day_sd=1.5, matches_a_night=2, widest=40)
    days = np.arange(-13, 14)
    weights = rounded_normal(days, 1.5)
    games = SCALES["npl"].win_probability((days[:, None] - days).astype(float))  # own, other's
    races = [chart("npl_8").race(i) for i in range(-40, 41)]
    wins = np.array([exact_win(games, m, n) @ weights for m, n in races])  # error, own
    night, first = np.zeros((2, 81, 81))
    place = np.arange(81)
    for day, weight in enumerate(weights):
        M = np.zeros((81, 81))
        M[np.minimum(place + 1, 80), place] += wins[:, day]
        M[np.maximum(place - 1, 0), place] += 1.0 - wins[:, day]
        first += weight * M
        night += weight * M @ M
    begun = np.zeros(81)
    begun[39:42] = 0.25, 0.5, 0.25  # as often odd as even, and far from the ends
    law = np.linalg.matrix_power(night, 4096) @ begun
    np.testing.assert_allclose(chances(ladder.law()), (law + first @ law) / 2, atol=1e-11)


def test_where_all_ratings_rise_errors_are_measured_from_the_mean():
    law = Ladder("step 2 1", chart("npl_10"), opponents=EQUAL_SKILL).law()
    assert law.mean == pytest.approx(0.0, abs=0.02)
    assert Ladder("step 2 1", chart("npl_10")).law().mean > 10.0


@pytest.mark.parametrize("model", [AUTOCORRELATED, EQUAL_SKILL])
def test_each_round_brings_the_change_down(model):
    changes = Ladder(chart("npl_10"), opponents=model).changes
    assert changes[-1] <= 1e-13
    for before, after in pairwise(changes[:5]):
        assert after < (0.02 if model is AUTOCORRELATED else 0.25) * before


def test_without_symmetry_a_lopsided_start_grows():
    found = Ladder(chart("npl_10"), opponents=AUTOCORRELATED)
    # Opponents who are better than rated by .01 points on average.
    law = 0.99 * chances(found.law()) + 0.01 * np.roll(chances(found.law()), -1)
    means = []
    for _ in range(3):
        means.append(law @ found.errors)
        given = Distribution(tuple(found.errors.tolist()), tuple(law / law.sum()))
        law = chances(
            Ladder(chart("npl_10"), opponents=Opponents(error=given, given="rating")).law()
        )
    for before, after in pairwise(means):
        assert 1.05 < after / before < 1.4


def test_equal_skill_is_the_fixed_point_of_exact_rounds():
    # All games are even, so that every chance is a fraction.
    short = Chart("short", [(0, 0, 2, 2), (1, 2, 3, 2), (3, None, 2, 1)])
    races = {x: exact_win(Fraction(1, 2), *short.race(x)) for x in range(-8, 9)}
    errors = range(-4, 5)
    law = exact_law([races[i] for i in errors])
    for _ in range(120):
        wins = [sum(v * races[i - j] for j, v in zip(errors, law, strict=True)) for i in errors]
        law = [Fraction(round(x * 10**30), 10**30) for x in exact_law(wins)]
    found = Ladder(short, opponents=EQUAL_SKILL, widest=4)
    np.testing.assert_allclose(chances(found.law()), [float(x) for x in law], rtol=1e-11)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("name", CHARTS)
def test_autocorrelated_opponents_err_as_the_player_does(name):
    ladder = Ladder(chart(name), opponents=AUTOCORRELATED, widest=40)
    errors = range(-40, 41)
    games = SCALES["npl"].win_probability(np.arange(-40.0, 41.0))
    law = chances(ladder.opponent_law)
    wins = [float(law @ exact_win(games, *chart(name).race(i))) for i in errors]
    np.testing.assert_allclose(ladder.wins, wins, rtol=1e-12)
    player = [float(x) for x in exact_law([Fraction(win) for win in wins])]
    np.testing.assert_allclose(law, player, rtol=1e-9)


def test_a_rising_skill_meets_steady_opponents():
    ladder = Ladder(chart("npl_10"), opponents=EQUAL_SKILL, drift=0.1)
    steady = Ladder(chart("npl_10"), opponents=EQUAL_SKILL)
    assert chances(ladder.opponent_law) == pytest.approx(chances(steady.law()), abs=1e-13)
    # In the long run the matches bring what the skill gains.
    assert (2 * ladder.wins - 1) @ chances(ladder.law()) == pytest.approx(0.1, rel=1e-9)


@pytest.mark.parametrize("model", MODELS)
@given(
    day_sd=st.floats(0, 12),
    match_sd=st.floats(0, 12),
    matches=st.integers(1, 3),
    name=st.sampled_from(CHARTS),
)
@settings(max_examples=examples(6), deadline=None)
def test_errors_are_symmetric(model, day_sd, match_sd, matches, name):
    ladder = Ladder(
        chart(name),
        opponents=model,
        day_sd=day_sd,
        match_sd=match_sd,
        matches_a_night=matches,
        widest=40,
    )
    law = chances(ladder.law())
    np.testing.assert_allclose(law, law[::-1], atol=1e-12)
    np.testing.assert_allclose(ladder.kernel.sum(axis=1), 1.0, rtol=1e-12)


def test_an_iteration_that_does_not_converge_is_an_error(monkeypatch):
    monkeypatch.setattr(sys.modules[long_run.__module__], "_ROUNDS", 3)
    with pytest.raises(AccuracyError, match="after 3 rounds"):
        Ladder(chart("npl_8"), opponents=AUTOCORRELATED).law()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["npl_8", "npl_20"])
def test_moves_are_right_where_the_law_is_smaller_than_any_float(name):
    kernel = Ladder(chart(name), widest=480).kernel
    np.testing.assert_allclose(kernel.sum(axis=1), 1.0, rtol=0, atol=3e-15)
    np.testing.assert_allclose(kernel[:240], np.broadcast_to(kernel[0], (240, 2)), rtol=1e-14)
