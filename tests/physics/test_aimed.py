import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from evenbreak import InputError
from evenbreak.physics.aimed import aimed_shot
from evenbreak.physics.leg import pockets
from evenbreak.physics.objects import Ball, PoolTable
from evenbreak.physics.shot import shot, spin_ratios
from evenbreak.physics.strike import strike, strike_for_speed
from evenbreak.physics.throw import aim
from tiers import examples

HUGE = PoolTable(length=400.0, width=400.0)
START = np.array([200.0, 200.0])
RADIUS = Ball().radius

few = settings(max_examples=examples(8))


def aimed(tip, angle, *, gap=0.5, far=1.0, **how):
    """Aim at a target `angle` to the right of the line through the balls."""
    standing = START + np.array([gap, 0.0])
    target = standing + far * np.array([math.cos(angle), -math.sin(angle)])
    return aimed_shot(strike_for_speed(3.0, *tip), START, standing, target, table=HUGE, **how)


@few
@given(
    st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3)),
    st.floats(-0.9, 0.9),
    st.floats(0.2, 1.5),
    st.floats(0.0, 0.2),
)
def test_the_object_ball_goes_to_its_target(tip, angle, gap, mu):
    found = aimed(tip, angle, gap=gap, mu=mu)
    x, y = found.target - found.shot.object_position
    assert found.shot.object_direction == pytest.approx(math.atan2(y, x), abs=1e-9)
    # The line of centres points as far beside as the ball is thrown.
    sign = math.copysign(1.0, found.shot.cut) * math.copysign(1.0, found.unaided.cut)
    assert found.turn == pytest.approx(sign * found.shot.throw, abs=1e-9)
    assert found.unaided.line_of_centres == pytest.approx(
        np.array([x, y]) / found.distance, abs=1e-9
    )


@few
@given(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3), st.floats(0.1, 0.9), st.floats(0.2, 1.0))
def test_it_is_the_aim_of_p4_6_for_the_spin_at_the_hit(up, right, angle, gap):
    found = aimed((up, right), angle, gap=gap)
    assume(found.shot.cut > 0.0)
    spin = spin_ratios(found.shot.at_hit, RADIUS)
    # The cut angle at which the object ball leaves is seen from the direction of the shot.
    wanted = found.shot.direction - found.shot.object_direction
    assume(wanted > 0.0)
    known = aim(wanted, found.distance, *spin)
    assert known.cut == pytest.approx(found.shot.cut, abs=1e-7)
    assert known.offset == pytest.approx(found.offset, abs=1e-7)


@few
@given(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3), st.floats(0.0, 0.9))
def test_aiming_to_the_left_is_the_mirror_image(up, right, angle):
    one, two = aimed((up, right), angle), aimed((up, -right), -angle)
    assert one.shot.cut == pytest.approx(-two.shot.cut, abs=1e-9)
    assert one.shot.direction == pytest.approx(-two.shot.direction, abs=1e-9)


def test_smooth_balls_need_no_allowance():
    found = aimed((-0.2, 0.1), 0.6, mu=0.0)
    assert (found.turn, found.offset, found.miss) == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert found.shot.cut == pytest.approx(found.unaided.cut, abs=1e-9)


def test_unaided_the_shot_misses_by_its_throw():
    found = aimed((-0.25, 0.0), 0.4, far=2.0)
    path = found.unaided.object_leg.slide
    x, y = found.target - path.position
    along = path.velocity / np.linalg.norm(path.velocity)
    missed = (y * along[0] - x * along[1]) / (x * along[0] + y * along[1]) * 2.0
    assert found.miss == pytest.approx(-missed, abs=1e-9)
    assert found.miss > 0.05
    again = shot(
        strike_for_speed(3.0, -0.25),
        found.shot.cut,
        0.5,
        table=HUGE,
        cue_ball=START,
        direction=found.shot.direction,
    )
    assert again.object_direction == found.shot.object_direction


def test_a_ball_that_would_miss_the_pocket_falls_with_the_allowance():
    corner = pockets(PoolTable())[3]
    found = aimed_shot(strike(1.5, -0.2), (0.7, 0.4), (1.2, 0.4), (corner.x, corner.y))
    assert (found.shot.object_leg.ending, found.shot.object_leg.pocket) == ("pocket", "foot-left")
    assert found.unaided.object_leg.ending == "cushion"


def test_a_shot_that_is_too_soft_is_aimed_without_throw():
    found = aimed_shot(strike_for_speed(0.1), START, (201.0, 200.0), (202.0, 200.5), table=HUGE)
    assert not found.shot.reached
    assert (found.turn, found.miss) == (0.0, 0.0)


@pytest.mark.parametrize("mu", [-0.1, math.nan, [0.1, 0.2]])
def test_one_friction_for_one_shot(mu):
    with pytest.raises(InputError, match="mu "):
        aimed((0.0, 0.0), 0.3, mu=mu)


@pytest.mark.parametrize(
    ("places", "message"),
    [
        (((0.5, 0.5), (1.0, 0.5), (0.2, 0.6)), "target cannot be reached"),
        (((0.5, 0.5), (1.0, 0.5), (1.01, 0.5)), "within the object ball"),
        (((0.5, 0.5), (0.54, 0.5), (1.5, 0.5)), "where the balls touch"),
        (((0.5, 0.5), (1.0,), (1.5, 0.5)), "object_ball has shape"),
        (((0.5, 0.5), (1.0, 3.0), (1.5, 0.5)), "object_ball is at"),
    ],
)
def test_what_cannot_be_is_refused(places, message):
    with pytest.raises(InputError, match=message):
        aimed_shot(strike(2.0), *places)
