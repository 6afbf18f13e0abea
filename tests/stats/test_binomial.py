"""Games won of a number of games: the text's numbers, enumeration, and exactness."""

import math
from fractions import Fraction
from itertools import combinations, product
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.stats import (
    Distribution,
    GamesWon,
    coverage_within,
    critical_value,
    score_probability,
)
from rows import each_of

sizes = st.integers(0, 25)
chances = st.one_of(
    st.integers(0, 100).map(lambda percent: percent / 100), st.fractions(0, 1, max_denominator=30)
)


def by_enumeration(games: int, p: Any) -> list[Fraction]:
    """P(n games won), by adding up all the 2^games orders of wins and losses."""
    law = [Fraction(0)] * (games + 1)
    chance = Fraction(str(p))
    for order in product((0, 1), repeat=games):
        law[sum(order)] += math.prod(chance if won else 1 - chance for won in order)
    return law


def exact_law(games: int, p: Any) -> list[Fraction]:
    chance = Fraction(str(p))
    return [math.comb(games, n) * chance**n * (1 - chance) ** (games - n) for n in range(games + 1)]


class TestPublished:
    def test_ways_to_choose_from_four(self) -> None:
        """P5.3: 1, 4, 6, 4, 1 subsets of {1, 2, 3, 4}."""
        ways = [len(list(combinations((1, 2, 3, 4), m))) for m in range(5)]
        assert ways == [1, 4, 6, 4, 1]
        half = Fraction(1, 2)
        assert [16 * score_probability(half, m, 4 - m) for m in range(5)] == ways

    def test_three_to_one(self) -> None:
        """P5.4: four orders, each of probability 8/81."""
        orders = [order for order in product("WL", repeat=4) if order.count("W") == 3]
        assert ["".join(order) for order in reversed(orders)] == ["LWWW", "WLWW", "WWLW", "WWWL"]
        assert score_probability(Fraction(2, 3), 3, 1) == len(orders) * Fraction(8, 81)
        assert score_probability(2 / 3, 3, 1) == pytest.approx(0.3950617283950617, abs=1e-12)

    def test_the_table_of_scores(self) -> None:
        """P5.6, by the recursion that the text builds its table with."""
        p = Fraction(2, 3)
        table: dict[tuple[int, int], Fraction] = {(0, 0): Fraction(1)}
        for m, n in product(range(10), repeat=2):
            if m or n:
                table[m, n] = p * table.get((m - 1, n), 0) + (1 - p) * table.get((m, n - 1), 0)
        games = np.arange(10)
        found = score_probability(2 / 3, games[:, None], games)
        assert found.shape == (10, 10)
        for (m, n), chance in table.items():
            assert found[m, n] == pytest.approx(float(chance), rel=1e-13)
            assert score_probability(p, m, n) == chance

    def test_a_long_session(self) -> None:
        """P5.10: 120 games at .52."""
        law = GamesWon(120, 0.52)
        assert law.mean == pytest.approx(62.4, abs=1e-9)
        assert law.sd == pytest.approx(5.47, abs=0.005)
        assert law.between(59, 66) == pytest.approx(0.535, abs=0.0005)

    def test_its_ranges(self) -> None:
        """P5.10: 59..66 as the text says; its 51..73 starts at 51.67, which is nearer to 52."""
        law = GamesWon(120, 0.52)
        assert law.normal_range(0.5)[:2] == (59, 66)
        assert law.normal_range(0.95)[:2] == (52, 73)
        assert law.mean - critical_value(0.95) * law.sd == pytest.approx(51.67, abs=0.005)
        assert law.normal_range(0.95).probability == pytest.approx(0.9560, abs=5e-5)
        assert law.between(51, 73) == pytest.approx(0.9644, abs=5e-5)

    @each_of(
        "coverage, z",
        [
            (0.9973, 3),
            (0.99, 2.58),
            (0.98, 2.33),
            (0.96, 2.05),
            (0.9545, 2),
            (0.95, 1.96),
            (0.90, 1.645),
            (0.80, 1.28),
            (0.6827, 1),
            (0.50, 0.6745),
        ],
    )
    def test_critical_values(self, coverage: float, z: float) -> None:
        """Table 5.1, to its last digit, in both directions."""
        digits = len(str(z).partition(".")[2])
        assert round(critical_value(coverage), digits) == z
        assert coverage_within(critical_value(coverage)) == pytest.approx(coverage, rel=1e-15)


class TestLaws:
    @each_of("games", range(9))
    @each_of("p", [0, 0.3, Fraction(2, 3), 1])
    def test_enumeration(self, games: int, p: Any) -> None:
        law = GamesWon(games, p)
        chances = by_enumeration(games, p)
        n = np.arange(games + 1)
        oracle = Distribution(tuple(n), tuple(chances))
        assert law.probability(n) == pytest.approx([float(x) for x in chances], abs=1e-15)
        assert [law.exact_cumulative(i) for i in n] == list(oracle.cumulative)
        assert law.mean == pytest.approx(oracle.mean, abs=1e-14)
        assert law.sd == pytest.approx(oracle.sd, abs=1e-14)
        assert law.modes == oracle.modes
        assert law.mode == oracle.mode
        assert law.median == oracle.median
        assert law.quantile(1) == law.most == oracle.quantile(1)

    @given(st.integers(1, 60), chances)
    def test_the_mode_is_where_the_text_says(self, games: int, p: Any) -> None:
        chance = Fraction(str(p))
        law = GamesWon(games, p)
        assert law.mode == max(math.ceil(games * chance - (1 - chance)), 0)
        assert abs(law.mode - games * chance) <= 1
        table = exact_law(games, p)
        assert law.modes == tuple(n for n, x in enumerate(table) if x == max(table))

    @given(sizes, chances, st.fractions(0, 1))
    def test_a_quantile_is_the_least_that_reaches(self, games: int, p: Any, q: Fraction) -> None:
        n = GamesWon(games, p).quantile(q)
        assert sum(exact_law(games, p)[: n + 1]) >= q
        assert n == 0 or sum(exact_law(games, p)[:n]) < q

    @given(st.integers(0, 300), chances, st.integers(-2, 302))
    def test_the_tails_make_one(self, games: int, p: Any, n: int) -> None:
        law = GamesWon(games, p)
        assert law.cumulative(n) + law.at_least(n + 1) == pytest.approx(1, abs=1e-12)
        assert law.cumulative(n) - law.cumulative(n - 1) == pytest.approx(
            law.probability(n), abs=1e-12
        )
        mirrored = GamesWon(games, 1 - Fraction(str(p)))
        assert law.at_least(n) == mirrored.cumulative(games - n)

    @pytest.mark.slow_after(1)
    @pytest.mark.parametrize(
        ("games", "p"), [(120, 0.52), (500, 0.01), (500, 0.99), (1000, 0.3), (40, 1e-9)]
    )
    def test_far_tails_keep_their_digits(self, games: int, p: float) -> None:
        law, table = GamesWon(games, p), exact_law(games, p)
        below = Fraction(0)
        for n, chance in enumerate(table):
            above = 1 - below
            below += chance
            pairs = [
                (law.probability(n), chance),
                (law.cumulative(n), below),
                (law.at_least(n), above),
                (law.between(n, n + 3), sum(table[n : n + 4])),
                (score_probability(p, n, games - n), chance),
            ]
            for found, right in pairs:
                if right > Fraction(1, 10**280):
                    assert found == pytest.approx(float(right), rel=1e-12, abs=0)

    @pytest.mark.parametrize("games", [1, 3, 119, 10**6 + 1])
    def test_an_odd_number_of_even_games_ties_at_the_median(
        self, games: int, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        law = GamesWon(games, 0.5)
        if games > 10**4:  # where the sum would take a minute
            monkeypatch.setattr("evenbreak.stats.binomial._lower_sum", None)
        assert law.median == (games - 1) // 2
        assert law.modes == ((games - 1) // 2, (games + 1) // 2)

    def test_far_quantiles_of_many_games_need_no_long_sums(
        self, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr("evenbreak.stats.binomial._lower_sum", None)
        law = GamesWon(10**6, 0.5)
        for q in (1e-12, 1e-3, 0.3, 0.7, 1 - 1e-12):
            n = law.quantile(q)
            assert law.cumulative(n - 1) < q <= law.cumulative(n)
        assert law.quantile(1e-12) + law.quantile(1 - 1e-12) == 10**6
        low, high, inside = law.exact_range(1 - 1e-12)
        assert low + high == 10**6
        assert 1 - inside == pytest.approx(1e-12, rel=0.1)
        assert law.exact_range(1) == (0, 10**6, 1.0)

    def test_rare_spans_keep_their_digits_at_both_ends(self) -> None:
        law = GamesWon(300, 0.5)
        chance = float(sum(exact_law(300, 0.5)[5:8]))
        assert law.between(5, 7) == pytest.approx(chance, rel=1e-12, abs=0)
        assert law.between(293, 295) == pytest.approx(chance, rel=1e-12, abs=0)

    @pytest.mark.slow
    def test_a_billion_games_take_no_more_room_than_their_spread(self) -> None:
        low, high, inside = GamesWon(10**9, 0.5).exact_range(0.5)
        assert low + high == 10**9 - 1
        assert (high - low + 1) / (10**9 / 4) ** 0.5 == pytest.approx(2 * 0.67449, rel=1e-4)
        assert 0.5 <= inside < 0.50003

    @pytest.mark.parametrize("n", [-1, 0, 40, 59, 60, 119, 120, 121])
    def test_the_exact_sum_from_either_end(self, n: int) -> None:
        law = GamesWon(120, 0.52)
        assert law.exact_cumulative(n) == sum(exact_law(120, 0.52)[: max(n + 1, 0)])
        assert float(law.exact_cumulative(n)) == pytest.approx(law.cumulative(n), rel=1e-13)


class TestRanges:
    @given(sizes, chances, st.integers(0, 100).map(lambda percent: percent / 100))
    def test_the_exact_range_is_the_shortest(self, games: int, p: Any, coverage: float) -> None:
        table, wanted = exact_law(games, p), Fraction(str(coverage))
        sums = {
            (low, high): sum(table[low : high + 1])
            for low in range(games + 1)
            for high in range(low, games + 1)
        }
        least = min(high - low for (low, high), inside in sums.items() if inside >= wanted)
        best = max(inside for (low, high), inside in sums.items() if high - low == least)
        low, high, inside = GamesWon(games, p).exact_range(coverage)
        assert high - low == least
        assert sums[low, high] == best
        assert inside == pytest.approx(float(best), abs=1e-13)

    def test_the_lower_of_two_equal_ranges(self) -> None:
        assert GamesWon(3, 0.5).exact_range(0.3)[:2] == (1, 1)
        assert GamesWon(119, 0.5).exact_range(0.2)[:2] == (58, 60)

    def test_a_coverage_that_is_met_exactly_is_enough(self) -> None:
        assert GamesWon(2, 0.5).exact_range(0.75)[:2] == (0, 1)
        a_little = Fraction(1, 10**15)
        assert GamesWon(3, 0.5).exact_range(0.75)[:2] == (1, 2)
        assert GamesWon(3, 0.5).exact_range(Fraction(3, 4) + a_little)[:2] == (0, 2)

    def test_everything(self) -> None:
        assert GamesWon(120, 0.52).exact_range(1) == (0, 120, 1.0)
        assert GamesWon(5, 1).exact_range(1) == (5, 5, 1.0)
        assert GamesWon(0, 0.5).exact_range(0.9) == (0, 0, 1.0)

    @given(st.integers(0, 200), chances, st.floats(0, 0.999))
    def test_the_normal_range_holds_the_mean(self, games: int, p: Any, coverage: float) -> None:
        low, high, inside = GamesWon(games, p).normal_range(coverage)
        mean = games * Fraction(str(p))
        assert 0 <= low <= mean + Fraction(1, 2)
        assert mean - Fraction(1, 2) <= high <= games
        assert inside == pytest.approx(float(sum(exact_law(games, p)[low : high + 1])), abs=1e-12)

    def test_the_normal_range_comes_near_the_exact_one(self) -> None:
        law = GamesWon(10_000, 0.6)
        for coverage in (0.5, 0.9, 0.95, 0.99):
            normal, exact = law.normal_range(coverage), law.exact_range(coverage)
            assert abs(normal.low - exact.low) <= 1
            assert abs(normal.high - exact.high) <= 1
            assert normal.probability == pytest.approx(coverage, abs=0.01)


class TestShapes:
    def test_numbers_give_floats(self) -> None:
        law = GamesWon(10, 0.5)
        assert type(law.cumulative(5)) is float
        assert type(law.at_least(5)) is float
        assert type(law.probability(5)) is float
        assert type(score_probability(0.5, 1, 2)) is float
        assert type(critical_value(0.5)) is float
        assert type(coverage_within(1)) is float

    def test_arrays_broadcast(self) -> None:
        found = score_probability(np.array([[0.5], [1.0]]), [0, 1, 2], 1)
        assert found == pytest.approx(np.array([[0.5, 0.5, 0.375], [0, 0, 0]]), rel=1e-14)
        assert critical_value([[0.5, 0.9]]).shape == (1, 2)

    def test_a_count_that_cannot_be_has_no_probability(self) -> None:
        law = GamesWon(3, 0.5)
        assert law.probability([-1, 4]).tolist() == [0, 0]
        assert law.cumulative([-1, 3, 4]).tolist() == [0, 1, 1]
        assert law.at_least([-1, 0, 4]).tolist() == [1, 1, 0]

    def test_a_float_is_the_decimal_that_it_prints_as(self) -> None:
        assert math.ceil(24 * 0.8 - (1 - 0.8)) == 20  # 19.000000000000004, and 19 is right
        assert GamesWon(24, 0.8).modes == (19, 20)
        assert 100 * 0.29 < 29
        assert GamesWon(99, 0.29).modes == (28, 29)
        assert GamesWon(99, np.float64(0.29)) == GamesWon(99, 0.29)


@pytest.mark.parametrize(
    ("games", "p", "message"),
    [
        (-1, 0.5, "games must be a whole number, 0 or more; you gave -1"),
        (2.5, 0.5, r"games must be a whole number, 0 or more; you gave 2\.5"),
        (10, 1.5, r"gave 1\.5"),
        (10, math.nan, "gave nan"),
        (10, "0.5", r"gave '0\.5'"),
        (10, [0.5, 0.6], "p must be .*number from 0 to 1"),
    ],
)
def test_wrong_parameters_are_refused(games: Any, p: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        GamesWon(games, p)


@pytest.mark.parametrize(
    ("p", "m", "n", "message"),
    [
        (0.5, -1, 2, "m must be .*-1"),
        (0.5, 1, 2.5, r"is 2\.5"),
        (1.5, 1, 2, r"gave 1\.5"),
        (Fraction(3, 2), 1, 2, "p must be a number from 0 to 1"),
        (Fraction(1, 2), -1, 2, "m must be .*-1"),
        (0.5, [1, 2], [1, 2, 3], r"m has shape \(2,\), n has shape \(3,\)"),
    ],
)
def test_a_score_that_cannot_be_is_refused(p: Any, m: Any, n: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        score_probability(p, m, n)


@pytest.mark.parametrize("coverage", [-0.1, 1.1, math.nan, "all"])
def test_a_coverage_is_a_probability(coverage: Any) -> None:
    law = GamesWon(10, 0.5)
    for ask in (law.normal_range, law.exact_range, critical_value):
        with pytest.raises(InputError, match=r"coverage must be .*"):
            ask(coverage)


def test_no_z_covers_everything() -> None:
    for ask in (GamesWon(10, 0.5).normal_range, critical_value):
        with pytest.raises(InputError, match="coverage must"):
            ask(1)


@pytest.mark.parametrize("z", [-1, math.nan, "x", [1, -2]])
def test_standard_units_are_not_negative(z: Any) -> None:
    with pytest.raises(InputError, match=r"z must be .*"):
        coverage_within(z)
