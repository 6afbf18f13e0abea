import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.stats.runs import RunLength, median_ratio_limit, shot_chance
from rows import each_of

TABLE_5_2 = """
.5  1.0  0.0  0  .000
.6  1.5  0.4  1  .667
.7  2.3  0.9  1  .429
.8  4.0  2.1  3  .750
.9  9.0  5.6  6  .667
.91 10.1 6.3  7  .692
.92 11.5 7.3  8  .696
.93 13.3 8.6  9  .677
.94 15.7 10.2 11 .702
.95 19.0 12.5 13 .684
.96 24.0 15.9 16 .667
.97 32.3 21.8 22 .680
.98 49.0 33.3 34 .694
.99 99.0 67.9 68 .687
"""
TRUNCATED = {0.96: 16.0, 0.99: 68.0}
"""Bounds that the text cuts off after a digit: what rounding gives."""

ROWS = [[float(x) for x in line.split()] for line in TABLE_5_2.split("\n") if line]

chances = st.fractions(0, Fraction(99, 100), max_denominator=300)
safeties = st.fractions(0, 1, max_denominator=20)


@each_of("p, mean, bound, median, ratio", ROWS)
def test_table_5_2(p, mean, bound, median, ratio):
    law = RunLength(p)
    assert law.mean == pytest.approx(mean, abs=0.051)
    assert round(law.median_bound, 1) == TRUNCATED.get(p, bound)
    assert law.median == median
    assert round(law.median_ratio, 3) == ratio


def test_a_player_who_runs_24():
    law = RunLength.of_mean(24.0)
    assert law.p == Fraction(24, 25)
    assert law.between(50, 75) == pytest.approx(0.96**50 - 0.96**76, rel=1e-13)
    assert round(law.between(50, 75), 3) == 0.085
    assert round(law.at_least(100), 3) == 0.017
    assert (round(law.cumulative(20), 3), round(law.at_least(21), 3)) == (0.576, 0.424)
    assert law.fair_line == (24.0, 16, 0)


@pytest.mark.parametrize(
    ("safety", "ratio"), [(1, 0.69), (0.9, 0.65), (0.8, 0.59), (0.7, 0.48), (0.6, 0.30), (0.5, 0)]
)
def test_safety_play_takes_more_from_the_median_than_from_the_mean(safety, ratio):
    assert median_ratio_limit(safety) == pytest.approx(ratio, abs=0.005)
    long = RunLength.of_mean(50_000, safety)
    assert long.median_ratio == pytest.approx(median_ratio_limit(safety), abs=1e-4)
    assert long.median_estimate == pytest.approx(long.median, abs=1)


def test_the_median_is_nothing_where_half_of_the_innings_are_blank():
    assert median_ratio_limit(0.3) == 0.0
    assert RunLength(0.99, 0.3).median == 0


@given(chances, safeties, st.integers(0, 300))
def test_sums_are_those_of_fractions(p, safety, n):
    law = RunLength(p, safety)
    exact = [1 - safety * p] + [safety * p**k * (1 - p) for k in range(1, n + 1)]
    below = sum(exact)
    assert law.exact_cumulative(n) == below
    assert law.probability(n) == pytest.approx(float(exact[n]), rel=1e-12, abs=1e-300)
    assert law.cumulative(n) == pytest.approx(float(below), rel=1e-13)
    above = 1 if n == 0 else safety * p**n
    assert law.at_least(n) == pytest.approx(float(above), rel=1e-12, abs=1e-300)
    assert max(exact) == exact[law.mode]


@given(chances, safeties)
def test_mean_sd_and_median(p, safety):
    law = RunLength(p, safety)
    n = np.arange(20_000)
    chance = law.probability(n)
    assert chance.sum() == pytest.approx(1.0, rel=1e-12)
    assert law.mean == pytest.approx((n * chance).sum(), rel=1e-10, abs=1e-12)
    assert law.sd**2 == pytest.approx(((n - law.mean) ** 2 * chance).sum(), rel=1e-9, abs=1e-12)
    assert law.exact_cumulative(law.median) >= Fraction(1, 2) > law.exact_cumulative(law.median - 1)
    assert law.median == math.ceil(max(0.0, round(law.median_bound, 9)))


@given(st.fractions(0, 1000), st.fractions(Fraction(1, 50), 1))
def test_the_mean_gives_the_shot_chance_back(mean, safety):
    p = shot_chance(mean, safety)
    assert safety * p / (1 - p) == mean
    assert RunLength.of_mean(mean, safety).mean == float(mean)


def test_a_chance_is_the_decimal_that_it_prints_as():
    # As binary fractions, 1 - .9 would be a little under a tenth and the tie would be lost.
    assert RunLength(0.9, 0.5) != RunLength(0.9, 0.6)
    assert RunLength(0.9).quantile(0.19) == 1
    assert RunLength(0.9).exact_cumulative(1) == Fraction(19, 100)


def test_rare_runs_keep_their_digits():
    p = Fraction(99_999, 10**5)
    law = RunLength(p, Fraction(1, 11))
    assert law.at_least(10**7) == pytest.approx(math.exp(1e7 * math.log1p(-1e-5)) / 11, rel=1e-12)
    assert RunLength(0.5).at_least(1000) == pytest.approx(0.5**1000, rel=1e-12)
    assert RunLength(1e-9).cumulative(0) == 1 - 1e-9
    assert RunLength(p).cumulative(0) == pytest.approx(1e-5, rel=1e-14)


def test_arrays_and_what_cannot_be():
    law = RunLength(0.5)
    assert law.probability([[-1, 0], [1, 2]]).tolist() == [[0, 0.5], [0.25, 0.125]]
    assert law.cumulative([-1, 0, 1]).tolist() == [0, 0.5, 0.75]
    assert law.at_least([-1, 0, 1]).tolist() == [1, 1, 0.5]
    never = RunLength(0)
    assert (never.mean, never.sd, never.median, never.median_ratio) == (0.0, 0.0, 0, None)
    assert RunLength(0.9, 0).median_bound == -math.inf


@each_of(
    "make, remedy",
    [
        (lambda: RunLength(1), "p must be below 1"),
        (lambda: RunLength(1.2), r"p must be a number from 0 to 1; you gave 1\.2"),
        (lambda: RunLength(0.5, 2), "safety must"),
        (lambda: RunLength(0.9999999), "ive a smaller p"),
        (lambda: RunLength.of_mean(-1), "must be a number of balls, 0 or more"),
        (lambda: RunLength.of_mean("many"), "must be a number of balls, 0 or more"),
        (lambda: RunLength.of_mean(math.inf), "must be a number of balls, 0 or more"),
        (lambda: RunLength.of_mean(10, 0), "must be greater than 0;"),
        (lambda: RunLength(0.5).probability(0.5), r"n must be whole numbers; it is 0\.5"),
        (lambda: RunLength(0.5).quantile(1), "q must be below 1"),
    ],
)
def test_wrong_values_say_how_to_mend_them(make, remedy):
    with pytest.raises(InputError, match=remedy):
        make()
