import math

import numpy as np
import pytest

from evenbreak.chains import chain_of, mixing_time, spectral_gap
from evenbreak.chains.mixing import apparent_period
from evenbreak.errors import InputError
from evenbreak.handicaps import CHARTS, EQUAL_SKILL, Ladder, chart, ladder_gap, ladder_mixing
from evenbreak.handicaps.ladders.error_chain import period_of
from evenbreak.handicaps.systems.step import margin_system, step_system


def dense(ladder, unit=1):
    """Return P(after | before) by the ladder's own moves, over multiples of `unit` points."""
    states = [error for error in ladder.errors.tolist() if error % unit == 0]
    place = {error: k for k, error in enumerate(states)}
    matrix = np.zeros((len(states), len(states)))
    for before in states:
        for after, chance in ladder.moves(before).items():
            matrix[place[before], place[after]] += chance
    return states, matrix


def decay(ladder, start, unit=1, period=2):
    """Return the rate at which the average over a period nears its limit, match by match."""
    states, matrix = dense(ladder, unit)
    law = np.eye(len(states))[states.index(start)]
    law = np.mean([law @ np.linalg.matrix_power(matrix, k) for k in range(period)], axis=0)
    on = np.linalg.matrix_power(matrix, 60)  # a multiple of all periods here
    first = law @ on @ on @ on
    second = first @ on
    third = second @ on
    return float((np.abs(third - second).sum() / np.abs(second - first).sum()) ** (1 / 60))


def test_gap_of_chart_10_is_1_less_the_largest_eigenvalue_below_1():
    ladder = Ladder(chart("npl_10"))
    assert ladder_gap(ladder) == pytest.approx(0.0217, abs=5e-5)
    _, matrix = dense(ladder)
    values = np.sort(np.linalg.eigvals(matrix).real)
    assert values[0] == pytest.approx(-1.0, abs=1e-9)
    assert ladder_gap(ladder) == pytest.approx(1 - values[-2], rel=1e-6)


@pytest.mark.parametrize(
    ("name", "gap"), [("npl_8", 0.018255), ("npl_12", 0.026294), ("npl_20", 0.036902)]
)
def test_gaps_of_the_other_charts(name, gap):
    assert ladder_gap(Ladder(chart(name))) == pytest.approx(gap, abs=1e-6)


@pytest.mark.parametrize(
    ("system", "unit"),
    [(step_system(1), 1), (step_system(2), 2), (step_system(3), 3), (margin_system(2), 1)],
)
def test_gap_is_how_fast_the_two_match_average_settles(system, unit):
    ladder = Ladder(system, opponents=EQUAL_SKILL)
    assert 1 - ladder_gap(ladder) == pytest.approx(decay(ladder, 6, unit), abs=1e-4)


def test_with_much_drift_the_second_largest_modulus_counts():
    ladder = Ladder("npl", drift=0.2)
    _, matrix = dense(ladder)
    moduli = np.sort(np.abs(np.linalg.eigvals(matrix)))
    assert ladder_gap(ladder) == pytest.approx(1 - moduli[-2], rel=1e-5)


def by_hand(ladder, start, eps, unit=1, period=2):
    states, matrix = dense(ladder, unit)
    law = np.eye(len(states))[states.index(start)]
    before = [np.linalg.matrix_power(matrix, k) for k in range(period)]
    limit = np.mean([law @ np.linalg.matrix_power(matrix, 2**14) @ k for k in before], axis=0)
    for matches in range(2000):
        if np.abs(np.mean([law @ k for k in before], axis=0) - limit).sum() / 2 <= eps:
            return matches
        law = law @ matrix
    return None


@pytest.mark.parametrize("start", [0, 1, -30])
@pytest.mark.parametrize("eps", [0.25, 0.02])
def test_mixing_is_that_of_powers_of_the_matrix(start, eps):
    ladder = Ladder(chart("npl_10"))
    assert ladder_mixing(ladder, start, eps) == by_hand(ladder, start, eps)


def test_mixing_of_longer_steps_is_that_of_their_multiples():
    ladder = Ladder(step_system(3))
    assert ladder_mixing(ladder, 30) == by_hand(ladder, 30, 0.25, unit=3)
    assert ladder_mixing(ladder, 31) < ladder_mixing(Ladder("npl"), 31)


def test_mixing_from_the_worst_start_is_the_mixing_time_of_an_aperiodic_chain():
    ladder = Ladder("npl", drift=0.3, widest=25)
    worst = max(ladder_mixing(ladder, start) for start in (-25, 25))
    # By the average over two matches, it is as near as by either of the two, or nearer.
    assert worst <= mixing_time(chain_of(ladder)) <= worst + 1


UNEVEN = [("step 2 1", 3), ("step 1 3", 4), ("step 4 1", 5)]


@pytest.mark.parametrize(("system", "period"), UNEVEN)
def test_unequal_steps_have_a_period_of_their_own(system, period):
    ladder = Ladder(system, widest=70)
    assert 1 - ladder_gap(ladder) == pytest.approx(decay(ladder, 6, period=period), abs=1e-4)
    assert ladder_mixing(ladder, -30) == by_hand(ladder, -30, 0.25, period=period)


@pytest.mark.parametrize("system", [*(name for name, _ in UNEVEN), "step 1", "step 3 3", "margin"])
def test_period_is_that_of_the_ways_back(system):
    ladder = Ladder(system, widest=200)
    near = {0}
    back = []
    for match in range(1, 21):
        near = {
            after for error in near for after in ladder.moves(error) if ladder.moves(error)[after]
        }
        back += [match] * (0 in near)
    assert period_of(ladder) == math.gcd(*back)


def test_against_opponents_who_rise_as_well_uneven_steps_are_even_ones():
    ladder = Ladder("step 1 3", opponents=EQUAL_SKILL)
    even = Ladder("step 2", opponents=EQUAL_SKILL, widest=ladder.widest)
    assert ladder_gap(ladder) == pytest.approx(ladder_gap(even), rel=1e-9)
    assert ladder_mixing(ladder, -30) == ladder_mixing(even, -30)


def test_a_slight_drift_hardly_slows_a_ladder_down():
    steady, drifting = Ladder("npl"), Ladder("npl", drift=0.001)
    assert ladder_gap(drifting) == pytest.approx(ladder_gap(steady), rel=0.01)
    assert abs(ladder_mixing(drifting, 30) - ladder_mixing(steady, 30)) <= 1


def test_who_is_near_from_the_beginning_need_not_wait():
    assert ladder_mixing(Ladder("npl"), 0, 0.95) == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            (61,),
            (
                "start must be a rating error in whole points from -60 to 60, or make "
                "widest larger; you gave 61"
            ),
        ),
        ((0, 0.0), r"eps must be a number between 0 and 1; you gave 0\.0"),
        ((0, 1.0), r"eps must be a number between 0 and 1; you gave 1\.0"),
    ],
)
def test_nonsense_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        ladder_mixing(Ladder("npl", widest=60), *arguments)


@pytest.mark.parametrize("name", CHARTS)
def test_the_chain_of_a_ladder_settles_as_the_ladder_does(name):
    """A ladder is a game like any other: seen as one, it has the same gap and the same speed."""
    ladder = Ladder(chart(name))
    chain = chain_of(ladder)
    assert spectral_gap(chain) == pytest.approx(ladder_gap(ladder), rel=1e-9)
    slowest = max(ladder_mixing(ladder, end) for end in (-ladder.widest, ladder.widest))
    assert mixing_time(chain) == slowest


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("widest", [60, 510])
@pytest.mark.parametrize(
    ("system", "period"), [("step 2 1", 3), ("step 3 2", 5), ("elo 8", 1), ("margin 2", 1)]
)
def test_the_chain_of_a_wide_ladder_has_its_gap_and_period(system, period, widest):
    """Its law spans up to a thousand decades, and its period ends once in ages."""
    chain = chain_of(Ladder(system, widest=widest))
    assert apparent_period(chain) == period
    settled = Ladder(system, widest=min(widest, 150))  # no wider one has another gap
    assert spectral_gap(chain) == pytest.approx(ladder_gap(settled), rel=1e-4)
