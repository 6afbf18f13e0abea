from fractions import Fraction
from itertools import accumulate

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.stats.innings import InningsScore
from evenbreak.stats.runs import RunLength
from rows import each_of

INNINGS = (1, 2, 4, 8, 16)
TABLE_5_3 = {
    "mode": """
        .5 0 0  2  6  14
        .6 0 1  4 10  22
        .7 0 2  6 16  34
        .8 0 3 11 27  59
        .9 0 8 26 62 134""",
    "mean": """
        .5 1.0 2.0   4.0  8.0  16.0
        .6 1.5 3.0   6.0 12.0  24.0
        .7 2.3 4.7   9.3 18.7  37.3
        .8 4.0 8.0  16.0 32.0  64.0
        .9 9.0 18.0 36.0 72.0 144.0""",
    "median": """
        .5 0  1  3  7  15
        .6 1  2  5 11  23
        .7 1  4  8 18  36
        .8 3  7 15 31  63
        .9 6 15 33 69 141""",
}
ROWS = [
    (quantity, float(p), m, float(value))
    for quantity, table in TABLE_5_3.items()
    for p, *values in (line.split() for line in table.strip().split("\n"))
    for m, value in zip(INNINGS, values, strict=True)
]
TOP = 40

chances = st.fractions(0, Fraction(29, 30), max_denominator=30)
safeties = st.fractions(0, 1, max_denominator=10)


@each_of("quantity, p, m, printed", ROWS)
def test_table_5_3(quantity, p, m, printed):
    assert getattr(InningsScore(p, m), quantity) == pytest.approx(
        printed, abs=0.051 if quantity == "mean" else 0
    )


@pytest.mark.parametrize(
    ("innings", "mean", "mode", "median", "sd", "relative"),
    [(5, 120, 95, 112, 54.8, 0.4564), (50, 1200, 1175, 1192, 173.2, 0.1443)],
)
def test_five_and_fifty_innings(innings, mean, mode, median, sd, relative):
    law = InningsScore(Fraction(24, 25), innings)
    assert law.fair_line == (mean, median, mode)
    assert round(law.sd, 1) == sd
    assert round(law.relative_sd, 4) == relative
    assert int(law.median_estimate + 0.5) == median


def brute_force(p, safety, innings):
    """Return P(score = n) for n up to TOP, run after run."""
    run = [1 - safety * p] + [safety * p**n * (1 - p) for n in range(1, TOP + 1)]
    law = [Fraction(1)] + [Fraction(0)] * TOP
    for _ in range(innings):
        law = [sum(law[i] * run[n - i] for i in range(n + 1)) for n in range(TOP + 1)]
    return law


@given(chances, safeties, st.integers(1, 7))
def test_all_sums_are_those_of_runs_added_up(p, safety, innings):
    law, n = InningsScore(p, innings, safety), np.arange(TOP + 1)
    exact = brute_force(p, safety, innings)
    below = list(accumulate(exact))
    assert [law.exact_cumulative(k) for k in range(TOP + 1)] == below
    for got, wanted in [
        (law.probability(n), exact),
        (law.cumulative(n), below),
        (law.at_least(n), [1 - b + e for b, e in zip(below, exact, strict=True)]),
    ]:
        np.testing.assert_allclose(got, [float(x) for x in wanted], rtol=1e-12, atol=1e-300)


@pytest.mark.slow
@given(chances, safeties, st.integers(1, 7))
def test_mode_and_median_are_exact(p, safety, innings):
    law = InningsScore(p, innings, safety)
    exact = brute_force(p, safety, innings)
    if law.mode <= TOP and max(exact) >= law.probability(law.mode) * (1 - 1e-9):
        assert law.mode == exact.index(max(exact))
    else:
        assert law.mode > TOP
    half = Fraction(1, 2)
    assert law.exact_cumulative(law.median) >= half > law.exact_cumulative(law.median - 1)


@given(chances, safeties, st.integers(1, 40))
def test_mean_and_sd(p, safety, innings):
    law, n = InningsScore(p, innings, safety), np.arange(3000)
    chance = law.probability(n)
    assert chance.sum() == pytest.approx(1.0, rel=1e-11)
    assert law.mean == pytest.approx((n * chance).sum(), rel=1e-10, abs=1e-12)
    assert law.sd**2 == pytest.approx(((n - law.mean) ** 2 * chance).sum(), rel=1e-9, abs=1e-12)


@given(chances, safeties)
def test_one_inning_is_a_run(p, safety):
    score, run, n = InningsScore(p, 1, safety), RunLength(p, safety), np.arange(-2, 60)
    for name in ("mean", "sd", "mode", "median"):
        assert getattr(score, name) == pytest.approx(getattr(run, name), rel=1e-14)
    for name in ("probability", "cumulative", "at_least"):
        np.testing.assert_allclose(
            getattr(score, name)(n), getattr(run, name)(n), rtol=1e-12, atol=1e-300
        )


def test_safety_play_of_one_is_none_in_the_limit():
    almost, plain = InningsScore(0.9, 6, 1 - 1e-12), InningsScore(0.9, 6)
    n = np.arange(200)
    np.testing.assert_allclose(almost.cumulative(n), plain.cumulative(n), rtol=1e-9)
    assert (almost.mode, almost.median) == (plain.mode, plain.median)


def test_half_of_the_scores_are_one_below_the_mean_where_heads_and_tails_tie():
    for innings in (2, 8, 64, 512):
        law = InningsScore(0.5, innings)
        assert law.median == innings - 1
        assert law.exact_cumulative(innings - 1) == Fraction(1, 2)


def test_the_smaller_of_two_modes():
    law = InningsScore(0.9, 2)
    assert law.mode == 8
    assert law.probability(8) == pytest.approx(law.probability(9), rel=1e-14)
    tied = InningsScore(Fraction(1, 2), 3, Fraction(2, 3))
    assert tied.mode == brute_force(Fraction(1, 2), Fraction(2, 3), 3).index(
        max(brute_force(Fraction(1, 2), Fraction(2, 3), 3))
    )


def test_shapes_and_rare_scores():
    law = InningsScore(0.5, 3, 0.5)
    assert law.probability(np.zeros((2, 0))).shape == (2, 0)
    assert law.probability([[-1, 0]]).tolist() == [[0, pytest.approx(0.75**3, rel=1e-15)]]
    assert isinstance(law.at_least(3), float)
    # 600 balls or more in 3 innings, of 1/2 each: fewer than 3 misses in 602 shots
    exact = Fraction(1 + 602 + 602 * 601 // 2, 2**602)
    assert InningsScore(0.5, 3).at_least(600) == pytest.approx(float(exact), rel=1e-12)


@pytest.mark.parametrize(
    ("p", "innings", "safety", "scores"),
    [
        (Fraction(24, 25), 50, 1, (100, 400, 1192, 2000, 6000)),
        (Fraction(24, 25), 50, Fraction(4, 5), (10, 100, 800, 4000)),
        (Fraction(1, 5), 200, 1, (1, 10, 50, 400)),
        (Fraction(99, 100), 7, Fraction(1, 2), (5, 300, 9000)),
    ],
)
def test_both_tails_keep_their_digits(p, innings, safety, scores):
    law = InningsScore(p, innings, safety)
    for n in scores:
        below, at_most = law.exact_cumulative(n - 1), law.exact_cumulative(n)
        assert law.cumulative(n) == pytest.approx(float(at_most), rel=1e-13)
        assert law.at_least(n) == pytest.approx(float(1 - below), rel=1e-13)
        assert law.probability(n) == pytest.approx(float(at_most - below), rel=1e-13)


@pytest.mark.parametrize(
    ("arguments", "remedy"),
    [
        ((0.5, 0), "innings must be"),
        ((0.5, 2.5), r"innings must be a whole number, 1 or more; you gave 2\.5"),
        ((1, 3), "at 1 a run never ends"),
        ((0.99, 10_000), "fewer innings"),
        ((0.9, 3, -0.1), r"safety must be a number from 0 to 1; you gave -0\.1"),
    ],
)
def test_wrong_values_say_how_to_mend_them(arguments, remedy):
    with pytest.raises(InputError, match=remedy):
        InningsScore(*arguments)
