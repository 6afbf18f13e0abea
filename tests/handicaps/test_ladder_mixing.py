import numpy as np
import pytest

from evenbreak.chains import chain_of, mixing_time
from evenbreak.errors import InputError
from evenbreak.handicaps import EQUAL_SKILL, Ladder, chart, ladder_gap, ladder_mixing
from evenbreak.handicaps.systems import margin_system, step_system


def dense(ladder, unit=1):
    """Return P(after | before) by the ladder's own moves, over multiples of `unit` points."""
    states = [error for error in ladder.errors.tolist() if error % unit == 0]
    place = {error: k for k, error in enumerate(states)}
    matrix = np.zeros((len(states), len(states)))
    for before in states:
        for after, chance in ladder.moves(before).items():
            matrix[place[before], place[after]] += chance
    return states, matrix


def decay(ladder, start, unit=1):
    """Return the rate at which the two-match average nears its limit, match by match."""
    states, matrix = dense(ladder, unit)
    two = matrix @ matrix
    law = np.eye(len(states))[states.index(start)]
    law = (law + law @ matrix) / 2
    for _ in range(150):
        law = law @ two
    first = law
    second = law @ two
    third = second @ two
    return float(np.sqrt(np.abs(third - second).sum() / np.abs(second - first).sum()))


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


def test_with_drift_no_eigenvalue_is_set_aside():
    ladder = Ladder("npl", drift=0.2)
    _, matrix = dense(ladder)
    moduli = np.sort(np.abs(np.linalg.eigvals(matrix)))
    assert ladder_gap(ladder) == pytest.approx(1 - moduli[-2], rel=1e-5)


def by_hand(ladder, start, eps, unit=1):
    states, matrix = dense(ladder, unit)
    law = np.eye(len(states))[states.index(start)]
    limit = np.linalg.matrix_power(matrix, 2**14)[states.index(start)]
    limit = (limit + limit @ matrix) / 2
    for matches in range(2000):
        if np.abs((law + law @ matrix) / 2 - limit).sum() / 2 <= eps:
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
    # The average over two matches is as near as its first or second half, or nearer.
    assert worst <= mixing_time(chain_of(ladder)) <= worst + 1


def test_who_is_near_from_the_beginning_need_not_wait():
    assert ladder_mixing(Ladder("npl"), 0, 0.95) == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [((61,), "start is 61"), ((0, 0.0), "eps is 0.0"), ((0, 1.0), "eps is 1.0")],
)
def test_nonsense_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        ladder_mixing(Ladder("npl", widest=60), *arguments)
