import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy import stats

from evenbreak.errors import InputError
from evenbreak.stats.confidence import mean_interval, sd_of_mean, was_it_luck
from rows import each_of

WEEKS = [50, 44, 46, 52, 47, 51, 49, 45, 48, 50]
values = st.lists(st.integers(-9, 9), min_size=1, max_size=5)


def population_sd(numbers):
    return float(np.std(numbers))


@given(values, st.integers(1, 4))
def test_with_replacement_is_the_spread_over_all_products(population, n):
    means = [sum(draw) / n for draw in itertools.product(population, repeat=n)]
    wanted = population_sd(means)
    assert sd_of_mean(population_sd(population), n) == pytest.approx(wanted, abs=1e-12)


@given(values, st.data())
def test_without_replacement_is_the_spread_over_all_subsets(population, data):
    n = data.draw(st.integers(1, len(population)))
    means = [sum(draw) / n for draw in itertools.combinations(population, n)]
    found = sd_of_mean(population_sd(population), n, population=len(population))
    assert found == pytest.approx(population_sd(means), abs=1e-12)


def test_the_means_of_two_of_four_values():
    values = [1, 2, 4, 5]
    assert population_sd(values) == pytest.approx(math.sqrt(5 / 2), rel=1e-15)
    assert sd_of_mean(population_sd(values), 2) == pytest.approx(math.sqrt(5) / 2, rel=1e-15)
    assert sd_of_mean(population_sd(values), 2, population=4) == pytest.approx(
        math.sqrt(5 / 6), rel=1e-15
    )


def test_drawing_all_leaves_no_doubt():
    assert sd_of_mean(3.0, 7, population=7) == 0.0
    assert sd_of_mean(3.0, 1, population=1) == 0.0


@pytest.mark.parametrize(
    ("arguments", "remedy"),
    [
        ((-1.0, 2), r"sd must be a finite number, 0 or more; you gave -1\.0"),
        ((math.nan, 2), "sd must be a finite number, 0 or more; you gave nan"),
        (("x", 2), "sd must be a finite number, 0 or more; you gave 'x'"),
        ((1.0, 0), "n must be"),
        ((1.0, 2.5), r"gave 2\.5"),
    ],
)
def test_sd_of_mean_says_what_it_needs(arguments, remedy):
    with pytest.raises(InputError, match=remedy):
        sd_of_mean(*arguments)


def test_more_cannot_be_drawn_than_there_are():
    with pytest.raises(InputError, match="population must"):
        sd_of_mean(1.0, 5, population=3)


def test_the_range_of_the_ten_weeks():
    text = mean_interval(WEEKS, 0.8, method="normal")
    assert (text.mean, text.n) == (48.2, 10)
    assert text.sd == pytest.approx(2.5219040425836985, rel=1e-14)
    assert text.sd_of_mean == pytest.approx(0.7974960814950754, rel=1e-14)
    assert (round(text.low, 1), round(text.high, 1)) == (47.2, 49.2)


@given(
    st.lists(st.floats(-100, 100).map(lambda x: round(x, 2)), min_size=2, max_size=20),
    st.floats(0.01, 0.999),
)
def test_intervals_are_those_of_scipy(scores, confidence):
    assume(len(set(scores)) > 1)
    t = mean_interval(scores, confidence)
    wanted = stats.ttest_1samp(scores, 0.0).confidence_interval(confidence)
    assert (t.low, t.high) == pytest.approx((wanted.low, wanted.high), rel=1e-9, abs=1e-9)
    z = mean_interval(scores, confidence, method="normal")
    wanted = stats.norm.interval(confidence, np.mean(scores), np.std(scores) / len(scores) ** 0.5)
    assert (z.low, z.high) == pytest.approx(wanted, rel=1e-9, abs=1e-9)
    assert z.high - z.low < t.high - t.low


@pytest.mark.parametrize(("method", "low", "high"), [("t", 0.785, 0.815), ("normal", 0.63, 0.67)])
def test_only_student_covers_as_often_as_said(method, low, high):
    rng = np.random.default_rng(5)
    lists = rng.normal(50.0, 3.0, size=(4000, 4))
    covered = 0
    for scores in lists:
        found = mean_interval(scores, 0.8, method=method)
        covered += found.low <= 50.0 <= found.high
    assert low < covered / len(lists) < high


@each_of(
    "scores, remedy",
    [
        ([], "scores must hold two numbers or more, to show a spread; it holds no scores"),
        ([48], "scores must hold two numbers or more, to show a spread; it holds 1 score"),
        ([48, 48, 48], "scores are all 48"),
        ([48, math.nan], r"scores must be a list of finite numbers, at most 1e\+09; it holds nan"),
        ([48, 1e200], r"scores must be a list of finite numbers, at most 1e\+09; it holds 1e\+200"),
        ([1e-300, 2e-320], "scores are all 1e-300"),
        ([0.1, 0.1, 0.1], "scores are all 0.1"),
        ([math.inf, 48], r"scores must be a list of finite numbers, at most 1e\+09; it holds inf"),
        (
            ["a", "b"],
            r"scores must be a list of finite numbers, at most 1e\+09; it is \['a', 'b'\]",
        ),
        ([[1, 2], [3, 4]], "scores must be one list of numbers; it has 2 dimensions"),
        (48, "scores must be one list of numbers; it has 0 dimensions"),
    ],
)
def test_scores_that_tell_nothing(scores, remedy):
    with pytest.raises(InputError, match=remedy):
        mean_interval(scores)
    with pytest.raises(InputError, match=remedy):
        was_it_luck(scores, 50)


@pytest.mark.parametrize("confidence", [0, 1, -0.5, 2, math.nan, "much"])
def test_confidence_lies_between_none_and_all(confidence):
    with pytest.raises(InputError, match="confidence must"):
        mean_interval(WEEKS, confidence)
    with pytest.raises(InputError, match="confidence must"):
        was_it_luck(WEEKS, 53, confidence=confidence)


def test_unknown_method():
    with pytest.raises(InputError, match="method must be 't' or 'normal'; you gave 'z'"):
        mean_interval(WEEKS, method="z")


def test_was_fifty_three_luck():
    luck = was_it_luck(WEEKS, 53, confidence=0.8)
    assert luck.normal.units == pytest.approx(1.9033238057235446, rel=1e-13)
    # Inside the central 95%, outside the central 90%, as the text says.
    assert 0.05 < luck.normal.as_far < 0.10
    upper = mean_interval(WEEKS, 0.8, method="normal").high
    assert luck.cautious.units == pytest.approx((53 - upper) / np.std(WEEKS), rel=1e-13)
    # 13% by chance, not 87%.
    assert luck.cautious.as_far == pytest.approx(0.13, abs=0.005)
    assert luck.as_high_by_rank == 1 / 11
    assert luck.as_low_by_rank == 1.0


def test_the_better_reading_is_that_of_a_list_with_one_score_more():
    # Whether one new score is of the same law is the two-sample t test with a sample of one.
    for score in (40.0, 48.0, 53.0, 60.0):
        luck = was_it_luck(WEEKS, score)
        with np.errstate(all="ignore"):
            test = stats.ttest_ind_from_stats(score, 0.0, 1, 48.2, np.std(WEEKS, ddof=1), 10)
        assert luck.t.units == pytest.approx(float(test.statistic), rel=1e-12)
        assert luck.t.as_far == pytest.approx(float(test.pvalue), rel=1e-12)


@given(st.lists(st.integers(0, 100), min_size=2, max_size=12), st.integers(-50, 150))
def test_readings_agree_with_themselves_and_mirror(scores, score):
    assume(len(set(scores)) > 1)
    luck = was_it_luck(scores, score)
    mirror = was_it_luck([-x for x in scores], -score)
    for reading, other in zip(luck[3:6], mirror[3:6], strict=True):
        assert reading.as_far == pytest.approx(2 * min(reading.as_high, reading.as_low))
        assert reading.as_high + reading.as_low == pytest.approx(1.0)
        assert other.units == pytest.approx(-reading.units, abs=1e-9)
        assert other.as_high == pytest.approx(reading.as_low, abs=1e-9)
    assert luck.as_high_by_rank == mirror.as_low_by_rank
    assert abs(luck.cautious.units) <= abs(luck.normal.units)


def test_a_score_within_the_interval_is_no_news():
    luck = was_it_luck(WEEKS, 48.5)
    assert luck.cautious == (0.0, 1.0, 0.5, 0.5)


def test_ranks_hold_for_any_law():
    rng = np.random.default_rng(7)
    lists = rng.exponential(size=(3000, 10))
    best = np.mean([was_it_luck(row[:9], row[9]).as_high_by_rank <= 0.1 for row in lists])
    assert best == pytest.approx(0.1, abs=0.02)


def test_far_tails_keep_their_digits():
    luck = was_it_luck(WEEKS, 138)
    assert 0.0 < luck.normal.as_high < 1e-250
    assert luck.t.as_high == pytest.approx(stats.t.sf(luck.t.units, 9), rel=1e-12)


def test_new_score_must_be_a_number():
    with pytest.raises(InputError, match="score must be a finite number; you gave nan"):
        was_it_luck(WEEKS, math.nan)
