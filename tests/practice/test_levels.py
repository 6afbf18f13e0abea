import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.games import Drill
from evenbreak.practice import drill_statistics
from evenbreak.practice.drills import chances_seen, level_gains, level_laws, level_lifts

drills = st.lists(st.floats(0.01, 0.99), min_size=1, max_size=9)


@given(drills)
def test_laws_of_many_drills_are_those_of_the_chain(success: list[float]) -> None:
    law = drill_statistics(Drill(success)).distribution.probability
    assert level_laws(np.array([success, success]))[1] == pytest.approx(law, rel=1e-11)


@given(st.lists(drills.map(lambda drill: (drill * 3)[:3]), min_size=1, max_size=4))
def test_each_row_is_a_drill_of_its_own(rows: list[list[float]]) -> None:
    success = np.array(rows)
    laws = level_laws(success)
    gains, lifts = level_gains(success, laws), level_lifts(success)
    for k, one in enumerate(success):
        assert laws[k] == pytest.approx(level_laws(one), rel=1e-12)
        assert gains[k] == pytest.approx(level_gains(one, level_laws(one)), rel=1e-12)
        assert lifts[k] == pytest.approx(level_lifts(one), abs=1e-14)


@given(drills)
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
