"""One ball's way, against the equations of motion and against the paths that are known."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from evenbreak.errors import InputError
from evenbreak.physics.leg import CORNER_MOUTH, POCKET_NAMES, leg_until, pockets, time_to
from evenbreak.physics.objects import Ball, Cloth, PoolTable
from evenbreak.physics.rolling import spin_stop
from evenbreak.physics.shot import shot
from evenbreak.physics.slide import Slide
from evenbreak.physics.strike import strike
from tiers import examples

BALL, CLOTH, TABLE = Ball(), Cloth(), PoolTable()
HUGE = PoolTable(length=400.0, width=400.0)

few = settings(max_examples=examples(30))


def sliding(velocity, rim, place=(200.0, 200.0)):
    spin = np.array(rim) / BALL.radius
    return Slide(BALL, CLOTH, np.array(place), np.array(velocity), spin)


def pushed(_, state):
    """Newton's law for a ball on cloth: x, y, V_x, V_y, omega_x, omega_y."""
    velocity, (turn_x, turn_y) = state[2:4], state[4:6]
    slip = velocity + BALL.radius * np.array([-turn_y, turn_x])
    force = -CLOTH.mu_slide * BALL.mass * CLOTH.gravity * slip / np.linalg.norm(slip)
    torque = np.cross([0.0, 0.0, -BALL.radius], [*force, 0.0])
    return [*velocity, *(force / BALL.mass), *(torque[:2] / BALL.inertia)]


@pytest.mark.parametrize(
    ("velocity", "rim"),
    [
        ((2.0, 0.0), (0.0, -1.5, 0.7)),
        ((0.0, 1.0), (0.0, 2.5, 0.0)),
        ((0.3, 0.8), (-0.4, -2.0, -1.0)),
        ((1.0, 0.0), (0.0, 3.0, 0.0)),
    ],
)
def test_the_slide_is_that_of_the_equations_of_motion(velocity, rim):
    leg = leg_until("cue ball", sliding(velocity, rim), 0.0, HUGE)
    start = [*leg.slide.position, *velocity, *(np.array(rim[:2]) / BALL.radius)]
    # Near natural roll the direction of what is left of the slip is noise; stop before.
    times = np.linspace(0.0, 0.999 * leg.roll_begin, 12)
    found = solve_ivp(pushed, (0.0, times[-1]), start, t_eval=times, rtol=1e-10, atol=1e-12)
    for time, state in zip(times, found.y.T, strict=True):
        now = leg.state(time)
        assert now.position == pytest.approx(state[:2], abs=1e-8)
        assert now.velocity == pytest.approx(state[2:4], abs=1e-8)
        assert now.spin[:2] == pytest.approx(state[4:6], abs=1e-6)
        assert now.spin[2] == rim[2] / BALL.radius


def rolled(_, state):
    """Return the motion of a ball that the cloth slows against its way: x, y, V_x, V_y."""
    velocity = state[2:4]
    pull = CLOTH.mu_roll * CLOTH.gravity / np.linalg.norm(velocity)
    return [*velocity, *(-pull * velocity)]


def test_the_roll_is_that_of_the_equations_of_motion():
    leg = leg_until("cue ball", sliding((0.3, 0.8), (-0.4, -2.0, -1.0)), 0.0, HUGE)
    start = leg.state(leg.roll_begin)
    times = np.linspace(leg.roll_begin, leg.end - 1e-3, 8)
    found = solve_ivp(
        rolled,
        (times[0], times[-1]),
        [*start.position, *start.velocity],
        t_eval=times,
        rtol=1e-10,
        atol=1e-12,
    )
    for time, state in zip(times, found.y.T, strict=True):
        assert leg.state(time).position == pytest.approx(state[:2], abs=1e-7)
        assert leg.state(time).velocity == pytest.approx(state[2:], abs=1e-7)


@few
@given(*[st.floats(-4.0, 4.0)] * 4)
def test_in_natural_roll_nothing_slips_and_the_ball_slows_as_the_cloth_has_it(vx, vy, wx, wy):
    leg = leg_until("cue ball", sliding((vx, vy), (wx, wy, 0.0)), 1.0, HUGE)
    for time in np.linspace(leg.roll_begin + 1e-9, leg.end, 4):
        state = leg.state(time)
        rim = BALL.radius * np.array([state.spin[1], -state.spin[0]])
        assert state.velocity == pytest.approx(rim, abs=1e-9)
    rolled = leg.state(leg.roll_begin).speed
    assert rolled == pytest.approx(CLOTH.mu_roll * CLOTH.gravity * (leg.end - leg.roll_begin))
    assert leg.state(leg.end).speed == pytest.approx(0.0, abs=1e-9)
    assert leg.ending == "rest"


@few
@given(*[st.floats(-4.0, 4.0)] * 4)
def test_the_way_is_as_long_as_its_many_small_steps(vx, vy, wx, wy):
    leg = leg_until("cue ball", sliding((vx, vy), (wx, wy, 0.0)), 0.0, HUGE)
    steps = np.diff(leg.path(1500)[:, :2], axis=0)
    assert leg.length == pytest.approx(np.hypot(*steps.T).sum(), rel=1e-5, abs=1e-9)


def test_a_standing_ball_that_spins_goes_as_far_as_p2_6_says():
    leg = leg_until("cue ball", sliding((0.0, 0.0), (0.0, 1.0, 0.0)), 0.0, HUGE)
    known = spin_stop(1.0, CLOTH)
    assert [phase.length for phase in leg.phases] == [
        pytest.approx(known.slide_distance),
        pytest.approx(known.roll_distance),
    ]


def test_a_ball_at_rest_has_no_phases_and_a_path_of_one_point():
    leg = leg_until("object ball", sliding((0.0, 0.0), (0.0, 0.0, 5.0)), 2.0, HUGE)
    assert (leg.phases, leg.length, leg.end, leg.ending) == ((), 0, 2.0, "rest")
    assert leg.path().tolist() == [[200.0, 200.0, 2.0]]
    assert leg.path(motion="rolls").shape == (0, 3)


@few
@given(st.floats(0.0, 2.0 * math.pi), st.floats(0.5, 5.0), st.floats(-4.0, 4.0))
def test_no_ball_leaves_the_table(angle, speed, rim):
    ahead = np.array([math.cos(angle), math.sin(angle)])
    leg = leg_until(
        "cue ball", sliding(speed * ahead, (rim, rim, 0.0), place=(1.0, 0.5)), 0.0, TABLE
    )
    x, y = leg.path(400)[:, :2].T
    slack = 2e-9
    assert BALL.radius - slack <= x.min()
    assert x.max() <= TABLE.length - BALL.radius + slack
    assert BALL.radius - slack <= y.min()
    assert y.max() <= TABLE.width - BALL.radius + slack
    edges = (x[-1], TABLE.length - x[-1], y[-1], TABLE.width - y[-1])
    assert (leg.ending == "rest") == (min(edges) > BALL.radius + slack)


def test_a_curve_that_turns_back_meets_the_line_only_if_it_gets_there():
    # It goes 0.25 m ahead at most: backspin of 2 against 1 of speed.
    slide = sliding((1.0, 0.0), (0.0, -4.0, 0.0), place=(0.0, 0.0))
    farthest = 1.0 / (2.0 * CLOTH.mu_slide * CLOTH.gravity)
    assert time_to(slide, np.array([1.0, 0.0]), 1.001 * farthest) == math.inf
    near = time_to(slide, np.array([1.0, 0.0]), 0.999 * farthest)
    assert slide.at(near)[0] == pytest.approx(0.999 * farthest)
    assert slide.velocity_at(near)[0] > 0.0
    back = time_to(slide, np.array([-1.0, 0.0]), 0.1)
    assert slide.at(back)[0] == pytest.approx(-0.1)


def test_a_ball_that_rolls_along_a_cushion_stays_there():
    slide = sliding((1.0, 1e-17), (0.0, 1.0, 0.0), place=(0.5, TABLE.width - BALL.radius))
    leg = leg_until("cue ball", slide, 0.0, TABLE)
    assert leg.end > 1.0


def test_a_ball_into_a_pocket_differs_from_one_at_the_cushion():
    to_side = sliding((0.0, -1.0), (1.0, 0.0, 0.0), place=(0.5 * TABLE.length, 0.5))
    beside = sliding((0.0, -1.0), (1.0, 0.0, 0.0), place=(0.5 * TABLE.length + 0.1, 0.5))
    legs = [leg_until("object ball", slide, 0.0, TABLE) for slide in (to_side, beside)]
    assert [(leg.ending, leg.pocket) for leg in legs] == [("pocket", "side-right"), ("cushion", "")]


@pytest.mark.parametrize("points", [2.5, 1, 0, -5, "x", None])
def test_a_path_has_two_points_or_more(points):
    leg = shot(strike(1.0), 0.3, 0.5).approach
    with pytest.raises(InputError, match=r"points must be a whole number, 2 or more"):
        leg.path(points)


RADIUS = Ball().radius


def test_the_pockets_go_round_the_table():
    found = pockets(TABLE)
    assert tuple(pocket.name for pocket in found) == POCKET_NAMES
    middle = (0.5 * TABLE.length, 0.5 * TABLE.width)
    turns = [math.atan2(one.y - middle[1], one.x - middle[0]) for one in found]
    assert turns == sorted(turns)
    for one in found:
        assert math.hypot(one.into_x, one.into_y) == pytest.approx(1.0)


@pytest.mark.parametrize("pocket", pockets(TABLE), ids=POCKET_NAMES)
def test_a_ball_through_the_middle_falls_and_one_beside_it_does_not(pocket):
    room = 0.5 * pocket.mouth - RADIUS
    for beside, falls in ((0.0, True), (0.99 * room, True), (1.01 * room, False)):
        x, y = pocket.x - beside * pocket.into_y, pocket.y + beside * pocket.into_x
        assert pocket.takes(x, y, pocket.into_x, pocket.into_y, RADIUS) is falls
    assert not pocket.takes(pocket.x, pocket.y, -pocket.into_x, -pocket.into_y, RADIUS)
    assert not pocket.takes(pocket.x, pocket.y, 0.0, 0.0, RADIUS)


def test_a_ball_along_the_cushion_just_fits_into_the_corner():
    corner = pockets(TABLE)[2]
    start = TABLE.length - 0.7 * CORNER_MOUTH
    assert corner.takes(start, RADIUS + 0.002, 1.0, 0.0, RADIUS)
    assert not corner.takes(start, RADIUS + 0.03, 1.0, 0.0, RADIUS)


def test_a_ball_far_from_a_pocket_is_not_in_it():
    side = pockets(TABLE)[1]
    assert not side.takes(side.x, 0.5, 0.0, -1.0, RADIUS)
