"""Mean, median, mode and spread of samples and of laws; sets taken together."""

import math
import statistics
from fractions import Fraction
from typing import Any

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.stats import Distribution, Moments, merge
from rows import each_of

scores = st.lists(st.integers(-30, 30), min_size=1, max_size=40)
floats = st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=40)
counts = st.lists(st.integers(0, 20), min_size=1, max_size=20).filter(any)


class TestPublished:
    """P5.1: {0, 1, 1, 4, 5} and {0, 1, 1, 8, 9}; P5.2: both together."""

    @pytest.mark.parametrize(
        ("sample", "mean", "variance", "sd"),
        [([0, 1, 1, 4, 5], 2.2, 94 / 25, 1.939), ([0, 1, 1, 8, 9], 3.8, 374 / 25, 3.868)],
    )
    def test_one_set_in_three_forms(
        self, sample: list[int], mean: float, variance: float, sd: float
    ) -> None:
        values = sorted(set(sample))
        many = [sample.count(value) for value in values]
        chance = [Fraction(n, 5) for n in many]
        forms = [
            Distribution.of(sample),
            Distribution.of(values, weights=many),
            Distribution(tuple(values), tuple(chance)),
        ]
        assert len(set(forms)) == 1
        for law in forms:
            assert law.mean == pytest.approx(mean, abs=1e-12)
            assert law.variance == pytest.approx(variance, abs=1e-12)
            assert law.sd == pytest.approx(sd, abs=0.0005)
            assert (law.median, law.mode, law.modes) == (1, 1, (1,))

    def test_the_union_from_its_parts(self) -> None:
        parts = [Moments(5, 11 / 5, math.sqrt(94) / 5), Moments(5, 19 / 5, math.sqrt(374) / 5)]
        union = merge(parts)
        assert union.n == 10
        assert union.mean == 3.0
        assert union.variance == pytest.approx(10, abs=1e-9)
        assert Moments.of([0, 1, 1, 4, 5, 0, 1, 1, 8, 9]) == Moments(10, 3, math.sqrt(10))


class TestTies:
    """The median is the smallest value whose cumulative probability reaches one half."""

    @pytest.mark.parametrize(
        ("sample", "median"),
        [([1, 2], 1), ([1, 2, 3, 4], 2), ([1, 1, 1, 2], 1), ([5], 5), ([1, 2, 2, 3], 2)],
    )
    def test_the_median_of_an_even_set_is_its_lower_middle(
        self, sample: list[int], median: int
    ) -> None:
        assert Distribution.of(sample).median == median

    def test_ten_tenths_in_floats_tie_at_one_half(self) -> None:
        sums = Distribution(tuple(range(10)), (0.1,) * 10)
        assert np.cumsum((0.1,) * 8)[-1] < 0.8  # so that floats compared as they are would say 8
        assert sums.quantile(0.8) == 7
        assert sums.quantile(0.8 + 1e-9) == 8

    def test_fractions_tie_only_where_they_are_equal(self) -> None:
        little = Fraction(1, 10**15)
        law = Distribution((0, 1), (Fraction(1, 2) - little, Fraction(1, 2) + little))
        assert (law.median, law.mode) == (1, 1)
        law = Distribution((0, 1), (0.5 - 1e-15, 0.5 + 1e-15))
        assert (law.median, law.mode, law.modes) == (0, 0, (0, 1))

    def test_all_the_modes(self) -> None:
        assert Distribution.of([3, 1, 3, 1, 2]).modes == (1, 3)
        assert Distribution.of([0.5, 0.25], weights=[0.1 + 0.2, 0.3]).modes == (0.25, 0.5)

    def test_values_that_cannot_occur_are_no_quantile(self) -> None:
        law = Distribution((0, 1, 2, 3), (0.0, 0.5, 0.5, 0.0))
        assert (law.quantile(0), law.quantile(1)) == (1, 2)
        assert law.quantile(1e-15) == 1
        assert law.mean == 1.5


class TestLaws:
    @given(scores)
    def test_it_agrees_with_the_standard_library(self, sample: list[int]) -> None:
        law = Distribution.of(sample)
        assert law.mean == pytest.approx(statistics.fmean(sample), abs=1e-12)
        assert law.variance == pytest.approx(statistics.pvariance(sample), abs=1e-9)
        assert law.median == statistics.median_low(sample)
        assert law.modes == tuple(sorted(statistics.multimode(sample)))
        assert sum(law.probability) == 1

    @given(scores)
    def test_the_median_is_the_middle_element(self, sample: list[int]) -> None:
        assert Distribution.of(sample).median == sorted(sample)[(len(sample) + 1) // 2 - 1]

    @given(counts, st.fractions(0, 1))
    def test_a_quantile_is_the_least_that_reaches(self, many: list[int], q: Fraction) -> None:
        law = Distribution.of(range(len(many)), weights=many)
        reached = law.quantile(q)
        total = Fraction(sum(many))
        assert sum(many[: reached + 1]) / total >= q
        assert many[reached] > 0
        assert all(sum(many[:i]) / total < q for i in range(reached + 1) if sum(many[:i]))

    @given(counts, st.integers(0, 100))
    def test_float_and_exact_weights_give_the_same_quantiles(
        self, many: list[int], percent: int
    ) -> None:
        law = Distribution.of(range(len(many)), weights=many)
        same = Distribution(law.values, tuple(float(p) for p in law.probability))
        assert law.exact
        assert not same.exact
        assert same.quantile(percent / 100) == law.quantile(percent / 100)
        assert same.modes == law.modes

    @given(scores, st.integers(-31, 31), st.integers(-31, 31))
    def test_between_counts(self, sample: list[int], low: int, high: int) -> None:
        law = Distribution.of(sample)
        inside = sum(low <= x <= high for x in sample) / len(sample)
        assert law.between(low, high) == pytest.approx(inside, abs=1e-15)
        assert law.at_least(low) + law.between(-math.inf, low - 1) == pytest.approx(1)

    @given(st.lists(floats, min_size=1, max_size=6))
    def test_merging_is_pooling(self, sets: list[list[float]]) -> None:
        pooled = Moments.of([x for one in sets for x in one])
        merged = merge(Moments.of(one) for one in sets)
        assert merged.n == pooled.n
        assert merged.mean == pytest.approx(pooled.mean, abs=1e-8)
        assert merged.sd == pytest.approx(pooled.sd, abs=1e-6, rel=1e-9)
        assert merged.sd == pytest.approx(np.std(np.concatenate(sets)), abs=1e-6, rel=1e-9)

    @given(st.integers(1, 50), st.floats(-1e3, 1e3), st.floats(0, 1e3))
    def test_one_part_merged_is_itself(self, n: int, mean: float, sd: float) -> None:
        merged = merge([Moments(n, mean, sd)])
        assert (merged.n, merged.mean) == (n, pytest.approx(mean))
        assert merged.sd == pytest.approx(sd, rel=1e-14, abs=1e-12)

    @pytest.mark.parametrize("scale", [1e-200, 1e150])
    def test_merging_at_any_scale(self, scale: float) -> None:
        merged = merge([Moments(3, 0, 3 * scale), Moments(3, 2 * scale, scale)])
        assert (merged.n, merged.mean) == (6, scale)
        assert merged.sd == pytest.approx(math.sqrt(6) * scale, rel=1e-15, abs=0)

    def test_a_small_spread_far_from_zero_keeps_its_digits(self) -> None:
        far = [1e9 + x for x in (0, 1, 1, 4, 5)]
        assert Distribution.of(far).variance == pytest.approx(94 / 25, rel=1e-12)
        assert merge([Moments.of(far), Moments.of(far)]).variance == pytest.approx(94 / 25)


def test_a_sum_that_falls_short_of_1_leaves_the_last_quantiles_to_the_largest_value() -> None:
    law = Distribution((0, 1, 2), (0.5, 0.5 - 1e-10, 0.0))
    assert law.quantile(1 - 1e-11) == law.quantile(1) == 1


def test_cumulative_and_quartiles() -> None:
    law = Distribution.of([0, 1, 1, 4, 5])
    assert law.cumulative == (Fraction(1, 5), Fraction(3, 5), Fraction(4, 5), 1)
    assert law.quartiles == (1, 1, 4)
    assert law.quantile(0.9) == 5
    assert Distribution((0, 1), (0.25, 0.75)).cumulative == (0.25, 1.0)


@pytest.mark.parametrize(
    "sample",
    [
        np.array([0, 1, 1, 4, 5]),
        np.array([0, 1, 1, 4, 5], dtype=float),
        pd.Series([0, 1, 1, 4, 5]),
        (Fraction(x) for x in (0, 1, 1, 4, 5)),
        iter([0, True, 1, 4, 5]),
    ],
    ids=["int array", "float array", "series", "fractions", "iterator"],
)
def test_any_iterable_of_numbers_is_a_sample(sample: Any) -> None:
    assert Distribution.of(sample) == Distribution.of([0, 1, 1, 4, 5])


def test_values_print_as_plain_numbers() -> None:
    law = Distribution.of(np.array([1.5, 2.0]), weights=np.array([0.25, 0.75]))
    assert repr(law) == "Distribution(values=(1.5, 2.0), probability=(0.25, 0.75))"
    assert repr(Distribution.of(np.array([3])).median) == "3"


def test_a_weight_of_none_leaves_its_value_out() -> None:
    assert Distribution.of([1, 2, 1], weights=[0.5, 0, 1.5]) == Distribution.of([1])


@each_of(
    "values, weights, message",
    [
        ([], None, "values must not be empty"),
        (3, None, "values must be a list of numbers; you gave 3"),
        ("123", None, "values must be a list of numbers; you gave '123'"),
        ([1, math.nan], None, "values[1] must be a finite number; you gave nan"),
        ([1, -math.inf], None, "values[1] must be a finite number; you gave -inf"),
        ([1, "2"], None, "values[1] must be a finite number; you gave '2'"),
        ([1, None], None, "values[1] must be a finite number; you gave None"),
        ([10**400], None, f"values[0] must be a finite number; you gave {10**400}"),
        ([1, 2], [1], "weights has 1 entries for 2 values"),
        ([1, 2], [1, -1], "weights[1] must be a finite number, 0 or more; you gave -1"),
        ([1, 2], [1, math.nan], "weights[1] must be a finite number, 0 or more; you gave nan"),
        ([1, 2], [0, 0], "weights are all 0"),
    ],
)
def test_wrong_samples_are_refused(values: Any, weights: Any, message: str) -> None:
    with pytest.raises(InputError) as caught:
        Distribution.of(values, weights)
    assert str(caught.value).startswith(message)


def test_weights_that_overflow_are_refused() -> None:
    with pytest.raises(InputError, match="sum is too large for a float"):
        Distribution.of([1, 2, 3], weights=[1.5e308, 1.5e308, 0.5])


@pytest.mark.parametrize(
    ("values", "probability", "message"),
    [
        ((), (), "values must not be empty"),
        (
            (1, 1),
            (0.5, 0.5),
            r"values must increase; they don't\. Sort them, or use Distribution\.of",
        ),
        ((2, 1), (0.5, 0.5), "values must increase"),
        ((1, math.nan), (0.5, 0.5), r"values\[1\] must be a finite number; you gave nan"),
        ((1, 2), (1,), "probability has 1 entries for 2 values"),
        ((1, 2), (1.5, -0.5), "probability.*; you gave 1.5"),
        ((1, 2), (0.5, 0.6), r"probability must sum to 1; it sums to 1\.1"),
        ((1, 2), (0.5, math.nan), "probability.*; you gave nan"),
        ((1, 2), (Fraction(1, 3), Fraction(1, 3)), "probability must sum to 1; it sums to 0.666"),
    ],
)
def test_what_is_no_law_is_refused(values: Any, probability: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Distribution(values, probability)


@pytest.mark.parametrize("q", [-0.1, 1.1, math.nan, "x"])
def test_a_quantile_is_of_a_probability(q: Any) -> None:
    with pytest.raises(InputError, match=r"q must be a number from 0 to 1"):
        Distribution.of([1]).quantile(q)


def test_between_wants_two_numbers() -> None:
    with pytest.raises(InputError, match="the ends must be two numbers; you gave nan and 3"):
        Distribution.of([1]).between(math.nan, 3)


@pytest.mark.parametrize(
    ("moments", "message"),
    [
        ((0, 1, 1), "n must be"),
        ((2.5, 1, 1), r"gave 2\.5"),
        ((2, math.nan, 1), "mean must be a finite number; you gave nan"),
        ((2, 1, -1), "sd must be a finite number, 0 or more; you gave -1"),
        ((2, 1, math.inf), "sd must be a finite number, 0 or more; you gave inf"),
    ],
)
def test_wrong_moments_are_refused(moments: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Moments(*moments)


def test_something_is_needed_to_merge() -> None:
    with pytest.raises(InputError, match="parts must not be empty"):
        merge([])
