"""Section 1, beside numbers worked out by hand."""

import math

import pytest
from scipy.integrate import solve_ivp

from evenbreak.source_text.answers import compute
from evenbreak.source_text.physics.sections_1_2 import ANSWERS


def test_sections_1_and_2_and_nothing_else_are_answered_here():
    problems = {problem for problem, _ in ANSWERS}
    section_1 = {"Section 1", *(f"P1.{n}" for n in range(1, 8))}
    assert problems == section_1 | {"Section 2", "Exercise 2.1", *(f"P2.{n}" for n in range(1, 7))}


def test_the_moment_of_inertia_of_a_ball_is_two_fifths():
    assert compute("P1.3", "I/(M R^2)", "") == pytest.approx(0.4)
    assert compute("P1.3", "S_zz/(M R^2), integrated", "") == pytest.approx(0.4 / 2.0)
    assert compute("P1.3", "I_xy/(M R^2), integrated", "") == pytest.approx(0.0, abs=1e-12)


def test_a_block_stops_after_the_square_of_its_speed():
    quantity = "distance, when the velocity doubles, over the one before"
    assert compute("Section 1", quantity, "V_0=50in/s mu=0.2") == pytest.approx(4.0)


def test_table_speed_is_nearly_twice_the_square_of_the_seconds():
    assert compute("P1.5", "table speed", "t=7.00s") == pytest.approx(386 * 49 / (2 * 97.75))


def test_a_tip_slips_where_the_angle_of_its_force_is_too_flat():
    assert compute("P1.7", "b_max/R", "mu=1") == pytest.approx(math.sqrt(0.5))
    assert compute("P1.7", "mu of a tip that slips at b/R", "b/R=1/2") == pytest.approx(3**-0.5)


# Section 2, beside numbers worked out by hand.


def test_natural_roll_takes_five_sevenths_of_the_speed_and_two_of_the_spin():
    assert compute("P2.2", "V_NR/V_0", "J=-1") == pytest.approx(3 / 7)
    assert compute("P2.2", "J at which V_NR is 0", "") == pytest.approx(-5 / 2)


def test_a_drag_shot_goes_at_the_mean_of_its_two_speeds():
    mean = compute("Exercise 2.1", "mean speed of a drag shot over V_0", "J=-1")
    assert mean == pytest.approx((1 + 3 / 7) / 2)


def test_a_sliding_ball_slips_one_way_and_so_draws_a_parabola():
    inputs = "V_x=60in/s V_y=10in/s w_x=25 w_y=-40 w_z=3"
    spread = compute("P2.3", "spread of the direction of friction during a slide, rad", inputs)
    assert spread == pytest.approx(0.0, abs=1e-12)


def test_on_the_moon_a_lag_takes_the_root_of_the_gravities_longer():
    assert compute("P2.5", "sqrt(g/g on the moon)", "") == pytest.approx(math.sqrt(386 / 63.8))


def drift(speed: float, rim: float, time: float) -> float:
    """Integrate how far a ball goes down a slope of 1e-5, across its line, with mu g = 1.

    The state is y, the velocity v of the ball and u of its rim, equal in natural roll; friction
    acts against the slip v - u, and changes u by 5/2 of what it takes from v. Below a slip of
    1e-6 it is less than mu g: so the ball stays in natural roll.
    """

    def motion(_: float, state: list[float]) -> list[float]:
        _, v_x, v_y, u_x, u_y = state
        slip = math.hypot(v_x - u_x, v_y - u_y, 1e-6)
        pull_x, pull_y = (u_x - v_x) / slip, (u_y - v_y) / slip
        return [v_y, pull_x, 1e-5 + pull_y, -2.5 * pull_x, -2.5 * pull_y]

    start = [0.0, speed, 0.0, rim, 0.0]
    solved = solve_ivp(motion, (0.0, time), start, method="LSODA", rtol=1e-10, atol=1e-15)
    return float(solved.y[0, -1])


def test_the_drift_of_a_drag_shot_is_that_of_the_equations_of_motion():
    # From J = -1 the slip 2 V_0 ends after 2 V_0 / (7/2 mu g), at 3/7 V_0 and a mean of 5/7 V_0.
    slide = 2.0 / 3.5
    dragged, rolled = drift(1.0, -1.0, slide), drift(3 / 7, 3 / 7, slide * 5 / 3)
    assert dragged / rolled == pytest.approx(54 / 125, rel=1e-5)
    quantity = "by how much off-level drift falls against natural roll all the way, %"
    saved = compute("Exercise 2.1", quantity, "J=-1")
    assert saved == pytest.approx(100 * (1 - dragged / rolled), rel=1e-5)
