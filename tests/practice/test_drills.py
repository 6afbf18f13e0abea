import csv

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_of, sensitivity, stochastic_limit
from evenbreak.games import Drill
from evenbreak.practice import drill_statistics
from evenbreak.practice.drills import chances_seen, level_gains, level_laws, level_lifts
from places import SHARED

NUMBERS = SHARED / "seed" / "section5_numbers.csv"

chances = st.floats(0.01, 0.99)
drills = st.lists(chances, min_size=1, max_size=9)


def mean_level(success: list[float]) -> float:
    limit = stochastic_limit(chain_of(Drill(success)))
    return sum(level * limit[level] for level in limit)


# p, shares of levels 1 to 9, mean, mode, median, sd
TABLE_5_5 = [
    (0.5, ".210 .419 .280 .080 .011 .001 .000 .000 .000", 2.264, 2, 2, 0.920),
    (0.6, ".138 .346 .324 .149 .037 .005 .000 .000 .000", 2.618, 2, 3, 1.051),
    (0.7, ".069 .231 .318 .237 .107 .031 .006 .001 .000", 3.201, 3, 3, 1.236),
    (0.8, ".018 .088 .195 .256 .222 .135 .060 .020 .005", 4.354, 4, 4, 1.526),
    (0.9, ".000 .004 .017 .052 .110 .177 .223 .227 .190", 6.964, 8, 7, 1.567),
    (0.95, ".000 .000 .000 .002 .011 .038 .112 .272 .565", 8.333, 9, 9, 0.928),
    (0.99, ".000 .000 .000 .000 .000 .000 .005 .076 .918", 8.912, 9, 9, 0.306),
]


@pytest.mark.parametrize("row", TABLE_5_5, ids=lambda row: f"p={row[0]}")
def test_table_5_5(row: tuple[float, str, float, int, int, float]) -> None:
    p, shares, mean, mode, median, sd = row
    law = drill_statistics(Drill.progressive(p)).distribution
    assert law.values == tuple(range(1, 10))
    assert law.probability == pytest.approx([*map(float, shares.split())], abs=6e-4)
    assert (law.mean, law.sd) == pytest.approx((mean, sd), abs=6e-4)
    assert (law.mode, law.median) == (mode, median)


@pytest.mark.skipif(not NUMBERS.exists(), reason="the list of printed numbers is not beside us")
def test_every_row_of_table_5_5_to_its_last_digit() -> None:
    with NUMBERS.open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.reader(file) if row[0] == "Table 5.5"]
    assert len(rows) == 7 * 13
    for _, quantity, inputs, printed, tolerance, computed, *_ in rows:
        law = drill_statistics(Drill.progressive(float(inputs.split()[0][2:]))).distribution
        shares = {f"d{i}": share for i, share in enumerate(law.probability, 1)}
        others = {"mean": law.mean, "mode": law.mode, "median": law.median}
        value = float((shares | others | {"standard deviation": law.sd})[quantity])
        assert value == pytest.approx(float(computed), rel=1e-12)
        assert value == pytest.approx(float(printed), abs=float(tolerance))


@given(drills)
def test_gains_are_the_sensitivities_of_the_chain(success: list[float]) -> None:
    n = len(success)
    chain = chain_of(Drill(success))
    slopes = sensitivity(chain, {level: level for level in range(1, n + 1)})
    gain = drill_statistics(Drill(success)).gain
    for level, worth in enumerate(gain, 1):
        up, down = min(level + 1, n), max(level - 1, 1)
        along = slopes.along({(level, up): 1, (level, down): -1}) if up != down else 0.0
        assert worth == pytest.approx(along, rel=1e-6, abs=1e-13)


@given(st.lists(st.sampled_from([0.0, 0.3, 0.8, 1.0]), min_size=1, max_size=6))
def test_laws_and_gains_at_the_edges(success: list[float]) -> None:
    """Levels that always or never succeed: against the chain, and against a small change."""
    statistics = drill_statistics(Drill(success))
    law = statistics.distribution.probability
    assert level_laws(np.array(success)) == pytest.approx(law, abs=1e-15)
    for i, (p, gain) in enumerate(zip(success, statistics.gain, strict=True)):
        step = -1e-7 if p == 1.0 else 1e-7
        moved = mean_level([*success[:i], p + step, *success[i + 1 :]]) - mean_level(success)
        if np.isinf(gain):
            assert moved > 0.1
        else:
            assert moved / step == pytest.approx(gain, rel=1e-3, abs=1e-5)


def test_a_level_that_never_succeeds_is_the_last_one() -> None:
    statistics = drill_statistics(Drill([0.5, 0.0, 0.9]))
    assert statistics.distribution.probability == pytest.approx((2 / 3, 1 / 3, 0))
    assert statistics.gain[1] > 0
    assert statistics.gain[2] == 0


def test_a_level_that_always_succeeds_is_the_first_one() -> None:
    statistics = drill_statistics(Drill([0.5, 1.0, 0.5]))
    assert statistics.distribution.probability == pytest.approx((0, 1 / 3, 2 / 3))
    assert statistics.gain[0] == 0


def test_a_mean_that_jumps_has_an_infinite_gain() -> None:
    assert drill_statistics(Drill([0.5, 0.0, 1.0])).gain == (pytest.approx(1 / 1.5**2), np.inf, 0.0)


def test_to_and_fro_for_ever() -> None:
    statistics = drill_statistics(Drill([1.0, 0.0]))
    assert statistics.distribution.probability == (0.5, 0.5)
    assert statistics.period == 2
    assert drill_statistics(Drill([0.9, 0.0])).period == 1


def test_one_level() -> None:
    statistics = drill_statistics(Drill([0.3]))
    assert (statistics.distribution.mean, statistics.gain) == (1.0, (0.0,))


@given(drills)
def test_the_lift_is_what_five_points_more_bring(chances: list[float]) -> None:
    statistics = drill_statistics(Drill(chances))
    for i, lift in enumerate(statistics.lift):
        more = [*chances[:i], min(chances[i] + 0.05, 1.0), *chances[i + 1 :]]
        rise = mean_level(more) - statistics.distribution.mean
        assert lift == pytest.approx(rise, abs=1e-12)


def test_a_level_that_always_succeeds_lifts_nothing() -> None:
    statistics = drill_statistics(Drill([1.0, 0.98, 0.5]))
    assert statistics.gain[0] > 0
    assert statistics.lift[0] == 0.0
    # With 1 at the second level the first is never seen again: 2 is tried after each miss at 3.
    assert statistics.lift[1] == pytest.approx(8 / 3 - statistics.distribution.mean)


def test_practice_next_is_the_level_that_lifts_most() -> None:
    chances = [0.9, 0.8, 0.4, 0.1]
    means = [
        mean_level([p + 0.05 * (i == j) for j, p in enumerate(chances)])
        for i in range(len(chances))
    ]
    assert drill_statistics(Drill(chances)).practice_next == np.argmax(means) + 1
    assert drill_statistics(Drill([1.0, 1.0])).practice_next is None


inner_drills = st.lists(st.floats(0.01, 0.99), min_size=1, max_size=9)


@given(inner_drills)
def test_laws_of_many_drills_are_those_of_the_chain(success: list[float]) -> None:
    law = drill_statistics(Drill(success)).distribution.probability
    assert level_laws(np.array([success, success]))[1] == pytest.approx(law, rel=1e-11)


@given(st.lists(inner_drills.map(lambda drill: (drill * 3)[:3]), min_size=1, max_size=4))
def test_each_row_is_a_drill_of_its_own(rows: list[list[float]]) -> None:
    success = np.array(rows)
    laws = level_laws(success)
    gains, lifts = level_gains(success, laws), level_lifts(success)
    for k, one in enumerate(success):
        assert laws[k] == pytest.approx(level_laws(one), rel=1e-12)
        assert gains[k] == pytest.approx(level_gains(one, level_laws(one)), rel=1e-12)
        assert lifts[k] == pytest.approx(level_lifts(one), abs=1e-14)


@given(inner_drills)
def test_between_two_levels_as_many_attempts_go_up_as_come_down(success: list[float]) -> None:
    p = np.array(success)
    law = level_laws(p)
    assert law.sum() == pytest.approx(1.0)
    assert law[:-1] * p[:-1] == pytest.approx(law[1:] * (1.0 - p[1:]), rel=1e-9)


def test_gains_keep_their_digits_where_a_level_is_hardly_reached() -> None:
    # Two levels: mean = 1 + p1 / (p1 + q2), so d mean / d p2 = p1 / (p1 + q2)^2.
    p1, p2 = 1e-200, 0.25
    success = np.array([p1, p2])
    gain = level_gains(success, level_laws(success))
    assert gain == pytest.approx([0.75 / 0.75**2, p1 / 0.75**2], rel=1e-12)


def test_untried_levels_below_all_others_always_succeed_and_the_rest_never() -> None:
    attempts = np.array([[0, 4, 0, 2, 0], [1, 0, 0, 0, 0]])
    successes = np.array([[0, 3, 0, 1, 0], [0, 0, 0, 0, 0]])
    seen = chances_seen(attempts, successes).tolist()
    assert seen == [[1.0, 0.75, 0.0, 0.5, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0]]


def test_a_lift_is_never_negative_and_stops_at_certainty() -> None:
    lifts = level_lifts(np.array([1.0, 0.98, 0.5]))
    assert lifts[0] == 0.0
    assert lifts[1] == pytest.approx(
        level_laws(np.array([1.0, 1.0, 0.5])) @ [1, 2, 3]
        - level_laws(np.array([1.0, 0.98, 0.5])) @ [1, 2, 3]
    )
