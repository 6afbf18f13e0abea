import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from evenbreak.errors import InputError
from evenbreak.stats.compare import compare

BEFORE = [50, 44, 46, 52, 47, 51, 49, 45, 48, 50]
AFTER = [53, 49, 52, 54, 50, 51]
TESTS = ("welch", "student", "anova", "variances", "mann_whitney", "chi_squared")

lists = st.lists(st.integers(0, 60), min_size=2, max_size=12).filter(lambda x: len(set(x)) > 1)


@given(lists, lists, st.floats(0.05, 0.999))
def test_welch_and_student_are_those_of_scipy(before, after, confidence):
    found = compare(before, after, confidence=confidence)
    wanted = stats.ttest_ind(after, before, equal_var=False)
    interval = wanted.confidence_interval(confidence)
    close = {"rel": 1e-9, "abs": 1e-9}
    assert found.welch.statistic == pytest.approx(wanted.statistic, **close)
    assert found.welch.freedom == pytest.approx((wanted.df,), **close)
    assert found.welch.p_value == pytest.approx(wanted.pvalue, **close)
    assert (found.low, found.high) == pytest.approx((interval.low, interval.high), **close)
    student = stats.ttest_ind(after, before)
    assert found.student.statistic == pytest.approx(student.statistic, **close)
    assert found.student.p_value == pytest.approx(student.pvalue, **close)
    assert found.student.freedom == (len(before) + len(after) - 2,)


@given(lists, lists)
def test_analysis_of_variance_of_two_lists_is_student_squared(before, after):
    found = compare(before, after)
    assert found.anova.statistic == pytest.approx(found.student.statistic**2, rel=1e-8, abs=1e-8)
    assert found.anova.p_value == pytest.approx(found.student.p_value, rel=1e-8, abs=1e-8)
    assert found.anova.freedom == (1.0, *found.student.freedom)
    witness = stats.f_oneway(before, after)
    if witness.statistic > 1e-6:  # of nearly equal means scipy's is noise, or NaN
        assert found.anova.statistic == pytest.approx(witness.statistic, rel=1e-6)
        assert found.anova.p_value == pytest.approx(witness.pvalue, rel=1e-6, abs=1e-9)


@given(lists, lists)
def test_swapped_lists_mirror_the_answer(before, after):
    there, back = compare(before, after), compare(after, before)
    assert there.difference == -back.difference
    assert (there.low, there.high) == pytest.approx((-back.high, -back.low), abs=1e-9)
    for name in TESTS:
        one, other = getattr(there, name), getattr(back, name)
        assert (one is None) == (other is None), name
        if one is not None:
            assert one.p_value == pytest.approx(other.p_value, abs=1e-9), name
    assert there.variances.statistic * back.variances.statistic == pytest.approx(1.0)
    assert there.effect.g == pytest.approx(-back.effect.g)
    assert there.effect.p_after_higher + back.effect.p_after_higher == pytest.approx(1.0)


@given(lists, lists, st.integers(1, 5), st.integers(-20, 20))
def test_another_way_to_count_points_changes_no_test(before, after, factor, shift):
    def counted(scores):
        return [factor * score + shift for score in scores]

    plain, other = compare(before, after), compare(counted(before), counted(after))
    for name in TESTS:
        one, two = getattr(plain, name), getattr(other, name)
        assert (one is None) == (two is None)
        if one is not None:
            assert two.p_value == pytest.approx(one.p_value, rel=1e-6, abs=1e-9), name
    assert other.effect == pytest.approx(plain.effect, abs=1e-9)
    assert other.difference == pytest.approx(factor * plain.difference, abs=1e-9)


@given(lists, lists)
def test_the_share_of_pairs_by_counting_pairs(before, after):
    pairs = [(b > a) + (b == a) / 2 for a, b in itertools.product(before, after)]
    assert compare(before, after).effect.p_after_higher == pytest.approx(sum(pairs) / len(pairs))


def test_mann_whitney_by_all_ways_to_deal_the_scores():
    before, after = [12, 3, 7, 9], [8, 14, 15, 21, 10]

    def wins(new):
        old = [x for x in before + after if x not in new]
        return sum(b > a for a, b in itertools.product(old, new))

    middle = len(before) * len(after) / 2
    seen = abs(wins(after) - middle)
    deals = list(itertools.combinations(before + after, len(after)))
    share = sum(abs(wins(deal) - middle) >= seen for deal in deals) / len(deals)
    assert compare(before, after).mann_whitney.p_value == pytest.approx(share, rel=1e-12)


def test_variances_against_the_beta_function():
    found = compare(BEFORE, AFTER).variances
    ratio = np.var(AFTER, ddof=1) / np.var(BEFORE, ddof=1)
    assert found.statistic == pytest.approx(ratio)
    assert found.freedom == (5, 9)
    # F = x d2 / (d1 (1 - x)) for x of the beta law (d1 / 2, d2 / 2).
    below = stats.beta.cdf(5 * ratio / (5 * ratio + 9), 2.5, 4.5)
    assert found.p_value == pytest.approx(2 * min(below, 1 - below))


def test_chi_squared_counts_about_the_median_of_all():
    found = compare(BEFORE, AFTER)
    # The 16 scores have the median 50; the four 50s are left out.
    assert found.counts == ((6, 2), (1, 4))
    wanted = 13 * (6 * 4 - 2 * 1) ** 2 / (8 * 5 * 7 * 6)
    assert found.chi_squared.statistic == pytest.approx(wanted)
    assert found.chi_squared.p_value == pytest.approx(math.erfc(math.sqrt(wanted / 2)))


def test_ties_are_equal_scores_in_either_list_or_both():
    assert compare([1, 2], [3, 4]).ties is False
    assert compare([1, 1], [3, 4]).ties is True
    assert compare([1, 2], [2, 4]).ties is True


def test_effect_of_known_lists():
    found = compare(BEFORE, AFTER)
    pooled = math.sqrt((9 * np.var(BEFORE, ddof=1) + 5 * np.var(AFTER, ddof=1)) / 14)
    factor = math.gamma(7) / (math.sqrt(7) * math.gamma(6.5))
    assert factor == pytest.approx(1 - 3 / (4 * 14 - 1), abs=2e-4)
    g = factor * (51.5 - 48.2) / pooled
    assert found.effect.g == pytest.approx(g)
    half = 1.959963984540054 * math.sqrt(16 / 60 + g * g / 32)
    assert (found.effect.low, found.effect.high) == pytest.approx((g - half, g + half))


@pytest.mark.slow
def test_welch_errs_as_often_as_said_where_student_does_not():
    rng = np.random.default_rng(11)
    welch = student = 0
    for _ in range(1000):
        found = compare(rng.normal(50, 8, 5), rng.normal(50, 1, 20))
        welch += found.welch.p_value < 0.05
        student += found.student.p_value < 0.05
    assert 30 <= welch <= 75
    assert student > 150


@pytest.mark.parametrize(
    ("before", "after", "confidence", "remedy"),
    [
        (
            [],
            [1, 2],
            0.9,
            "before must hold two numbers or more, to show a spread; it holds no scores",
        ),
        (
            [1, 2],
            [3],
            0.9,
            "after must hold two numbers or more, to show a spread; it holds 1 score",
        ),
        (
            [1, 2],
            [3, math.nan],
            0.9,
            r"after must be a list of finite numbers, at most 1e\+09; it holds nan",
        ),
        ([1, 2], ["x", 3], 0.9, "after must be .*"),
        (
            [1, 2],
            [3, 4],
            1.0,
            r"confidence must be a number between 0 and 1, such as 0\.95; you gave 1\.0",
        ),
    ],
)
def test_lists_that_cannot_be_compared(before, after, confidence, remedy):
    with pytest.raises(InputError, match=remedy):
        compare(before, after, confidence=confidence)


def test_no_spread_at_all():
    same, moved = compare([5, 5], [5, 5, 5]), compare([0.1] * 3, [0.2] * 4)
    for found in (same, moved):
        assert (found.welch, found.student, found.anova, found.variances) == (None,) * 4
        assert (found.low, found.high, found.effect.g) == (None, None, None)
    assert same.mann_whitney is None
    assert same.chi_squared is None
    assert same.effect.p_after_higher == 0.5
    assert moved.effect.p_after_higher == 1.0
    # Of 35 ways to deal seven scores, two set the lists apart; ties make scipy's a rough one.
    assert moved.mann_whitney.p_value < 0.05


def test_one_list_without_spread():
    found = compare([0.1, 0.1, 0.1], [1.0, 2.0, 3.0])
    assert found.variances is None
    assert found.welch.freedom == pytest.approx((2.0,))


any_numbers = st.floats() | st.sampled_from([0.0, 0.1, 1e-300, 1e-61, 1e9, 1e8 + 0.1, -5.0])


@given(st.lists(any_numbers, max_size=5), st.lists(any_numbers, max_size=5))
def test_any_numbers_are_compared_or_refused(before, after):
    try:
        found = compare(before, after)
    except InputError:
        return
    numbers = [found.difference, found.effect.p_after_higher]
    numbers += [test.p_value for name in TESTS if (test := getattr(found, name)) is not None]
    assert all(math.isfinite(number) for number in numbers)
