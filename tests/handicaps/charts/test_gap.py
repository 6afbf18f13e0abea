import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import betainc

from evenbreak.errors import InputError
from evenbreak.games import Race
from evenbreak.handicaps.charts.fair import fair_races
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.matches.odds import match_odds
from evenbreak.matches.races import race_odds
from evenbreak.ratings.scale import SCALES
from rows import each_of
from tiers import examples


def averaged(f, difference, error, scale="npl"):
    """Return the mean of f(p) by quadrature over slices of the normal law."""

    def integrand(z):
        p = SCALES[scale].win_probability(difference + error * z)
        return math.exp(-z * z / 2.0) / math.sqrt(2.0 * math.pi) * f(p)

    return math.fsum(quad(integrand, a / 4, (a + 1) / 4, epsabs=1e-13)[0] for a in range(-36, 36))


@pytest.mark.slow_after(11)
@pytest.mark.parametrize("race", [(1, 1), (5, 5), (7, 2), (13, 5), (25, 25), (100, 60)])
@pytest.mark.parametrize("error", [3.0, 12.0, 42.0, 90.0, 290.0])
def test_win_is_the_integral(race, error):
    for difference in (-20.0, 0.0, 35.0):
        exact = averaged(lambda p: betainc(*race, p), difference, error)
        assert Gap(difference, error).win(*race) == pytest.approx(exact, abs=1e-9)


def test_without_error_it_is_the_plug_in_value():
    p = SCALES["fargo"].win_probability(91.0)
    plug_in = race_odds(7, 4, p).p_win_1
    assert Gap(91.0, scale="fargo").win(7, 4) == pytest.approx(plug_in, rel=1e-13)


@given(st.floats(-200, 200), st.floats(0, 100), st.integers(1, 30), st.integers(1, 30))
@settings(max_examples=examples(50))
def test_the_two_players_share_one_match(difference, error, m, n):
    one = Gap(difference, error).win(m, n)
    other = Gap(-difference, error).win(n, m)
    assert one + other == pytest.approx(1.0, abs=1e-12)
    assert 0.0 <= one <= 1.0 + 1e-12


def test_doubt_pulls_an_even_length_race_toward_even():
    chances = [Gap(30.0, error).win(7, 7) for error in (0.0, 10.0, 30.0, 60.0)]
    assert chances == sorted(chances, reverse=True)
    assert chances[-1] > 0.5


def test_arrays_are_broadcast():
    chances = Gap([[0.0], [30.0]], [0.0, 10.0, 20.0]).win(5, [4, 5, 6])
    assert chances.shape == (2, 3)
    # One rule serves all elements, so they may differ in the last digits.
    assert chances[1, 2] == pytest.approx(Gap(30.0, 20.0).win(5, 6), abs=1e-12)
    assert isinstance(Gap(30.0, 20.0).win(5, 6), float)


def test_length_is_the_integral():
    length = Gap(35.0, 42.0).length(7, 3)
    for games, chance in zip(length.games.tolist(), length.probability, strict=True):
        place = games - 3
        exact = averaged(lambda p, k=place: race_odds(7, 3, p).probability[k], 35.0, 42.0)
        assert chance == pytest.approx(exact, abs=1e-9)
    mean = averaged(lambda p: race_odds(7, 3, p).mean, 35.0, 42.0)
    assert length.mean == pytest.approx(mean, abs=1e-8)


def test_length_without_error_is_that_of_the_race():
    law = race_odds(6, 4, SCALES["npl"].win_probability(25.0))
    length = Gap(25.0).length(6, 4)
    assert length.probability == pytest.approx(law.probability, rel=1e-12)
    assert (length.mean, length.sd) == pytest.approx((law.mean, law.sd), rel=1e-12)
    assert length.quantile(0.9) == law.quantile(0.9)
    many = Gap([25.0, -25.0]).length(6, 4)
    assert many.mean[0] == pytest.approx(law.mean, rel=1e-12)
    assert many.quantile(0.9).shape == (2,)


@pytest.mark.slow
def test_lengths_whose_chance_is_nothing_at_some_difference():
    length = Gap([0.0, 40.0], 200.0).length(60, 50)
    assert length.games.tolist() == list(range(50, 110))
    assert length.probability.sum(axis=-1) == pytest.approx([1.0, 1.0], abs=1e-12)
    certain = Gap(1e6).length(5, 3)
    assert (certain.mean, certain.quantile(0.9)) == (5.0, 5)


@pytest.mark.parametrize("limits", [{"games": (7, 13)}, {"games": (1, 4)}, {"race_to": 6}])
def test_without_error_the_races_are_those_of_fair_races(limits):
    differences = np.arange(-90, 91, 5)
    m, n = Gap(differences).fair_races(**limits)
    for k, difference in enumerate(differences.tolist()):
        best = fair_races(SCALES["npl"].win_probability(difference), top=1, **limits)[0]
        assert (m[k], n[k]) == (best.race_1, best.race_2)


def test_with_error_the_race_is_the_nearest_of_all():
    for difference, error in ((20.0, 30.0), (55.0, 42.0), (-33.0, 15.0)):
        m, n = Gap(difference, error).fair_races(games=(5, 11))
        every = {
            (i, longest + 1 - i): abs(Gap(difference, error).win(i, longest + 1 - i) - 0.5)
            for longest in range(5, 12)
            for i in range(1, longest + 1)
        }
        assert every[int(m), int(n)] == pytest.approx(min(every.values()), abs=1e-9)


def test_many_pairs_go_in_parts():
    rng = np.random.default_rng(5)
    differences, errors = rng.uniform(-80, 80, 20_000), rng.uniform(0, 40, 20_000)
    m, n = Gap(differences, errors).fair_races(games=(7, 13))
    for k in (0, 9_999, 19_999):
        alone = Gap(differences[k], errors[k]).fair_races(games=(7, 13))
        assert (m[k], n[k]) == alone


@each_of(
    "call, remedy",
    [
        (lambda: Gap(math.inf, 1.0).win(5, 5), "difference must be a finite number; it is inf"),
        (lambda: Gap(0.0, -1.0).win(5, 5), "is -1"),
        (lambda: Gap(0.0, 301.0).win(5, 5), "is 301"),
        (lambda: Gap([0.0, 1.0], 1.0).win([1, 2, 3], 5), "m has shape"),
        (lambda: Gap(0.0, 1.0).win(1.5, 5), "whole number"),
        (lambda: Gap(0.0, 1.0).length(0, 5), "1 or more"),
        (lambda: Gap(0.0, 1.0).fair_races(), "games is None and race_to is None"),
        (lambda: Gap(0.0, 1.0).fair_races(games=(9, 7)), "smaller number first"),
        (lambda: Gap(0.0, 1.0).fair_races(race_to=0), "1 or more"),
        (lambda: Gap(0.0, 1.0).fair_races(race_to=5, target=2.0), "from 0 to 1"),
    ],
)
def test_refused(call, remedy):
    with pytest.raises(InputError, match=remedy):
        call()


def test_form_is_one_more_error_that_keeps_the_chance_of_a_game() -> None:
    for form in (0.2, 0.6):
        game = Gap([35.0, -200.0], [0.0, 20.0], form=form).win(1, 1)
        assert game == pytest.approx(Gap([35.0, -200.0], [0.0, 20.0]).win(1, 1), rel=1e-9)
    odds = match_odds(Race(7, 5, SCALES["npl"].rack(25.0)), form=0.4)
    assert Gap(25.0, form=0.4).win(7, 5) == pytest.approx(odds.p_win_1, abs=1e-9)
    length = Gap(25.0, form=0.4).length(7, 5)
    assert length.mean == pytest.approx(odds.mean_games, abs=1e-9)
    (best,) = Gap(25.0, 8.0, form=0.4).nearest_races(race_to=7, top=1)
    m, n = Gap(25.0, 8.0, form=0.4).fair_races(race_to=7)
    assert (best.race_1, best.race_2) == (m, n)
    same = Gap([25.0, 3.0], 8.0, form=0.0).win(7, 5)
    assert (same == Gap([25.0, 3.0], 8.0).win(7, 5)).all()
