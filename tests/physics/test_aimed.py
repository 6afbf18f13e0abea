import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from evenbreak import InputError
from evenbreak.physics.aimed import aimed_shot, pocketed_shot
from evenbreak.physics.leg import pockets
from evenbreak.physics.objects import Ball, PoolTable
from evenbreak.physics.shot import shot, spin_ratios
from evenbreak.physics.strike import strike, strike_for_speed
from evenbreak.physics.throw import aim
from evenbreak.physics.units import INCH
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
    # The line of centers points as far beside as the ball is thrown.
    sign = math.copysign(1.0, found.shot.cut) * math.copysign(1.0, found.unaided.cut)
    assert found.turn == pytest.approx(sign * found.shot.throw, abs=1e-9)
    assert found.unaided.line_of_centers == pytest.approx(
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
        (((0.5, 0.5), (1.0, 0.5), (0.2, 0.6)), "target can't be reached"),
        (((0.5, 0.5), (1.0, 0.5), (1.01, 0.5)), "inside the object ball"),
        (((0.5, 0.5), (0.54, 0.5), (1.5, 0.5)), "where the balls touch"),
        (((0.5, 0.5), (1.0,), (1.5, 0.5)), "object_ball must have x and y; its shape"),
        (((0.5, 0.5), (1.0, 3.0), (1.5, 0.5)), "object_ball is at"),
    ],
)
def test_what_cannot_be_is_refused(places, message):
    with pytest.raises(InputError, match=message):
        aimed_shot(strike(2.0), *places)


POCKETS = {pocket.name: pocket for pocket in pockets(PoolTable())}
FROZEN = Ball().radius / INCH


def at(start, standing, name, *, side=0.0, **how):
    """Shoot at a pocket; places in inches."""
    places = (np.array(place) * INCH for place in (start, standing))
    return pocketed_shot(strike_for_speed(1.5, 0.0, side), *places, POCKETS[name], **how)


def test_with_nothing_in_the_way_the_middle_of_the_mouth_is_played_at():
    found = at((25, 16), (50, 25), "foot-left")
    assert found.target == pytest.approx([POCKETS["foot-left"].x, POCKETS["foot-left"].y])
    assert found.shot.object_leg.pocket == "foot-left"


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(
    ("start", "standing", "name"),
    [
        ((20, FROZEN), (50, FROZEN), "foot-right"),
        ((20, 50 - FROZEN), (50, 50 - FROZEN), "foot-left"),
        ((60, FROZEN), (30, FROZEN), "head-right"),
        ((100 - FROZEN, 10), (100 - FROZEN, 25), "foot-left"),
        ((50, 8), (70, 1.2), "foot-right"),
    ],
)
def test_a_ball_at_a_cushion_goes_along_it_into_the_corner(start, standing, name):
    found = at(start, standing, name)
    assert found.shot.object_leg.pocket == name
    pocket = POCKETS[name]
    beside = found.target - [pocket.x, pocket.y]
    assert 0.0 < float(np.linalg.norm(beside)) < 0.5 * pocket.mouth - Ball().radius
    assert beside @ [pocket.into_x, pocket.into_y] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.slow
def test_throw_into_the_cushion_needs_outside_english():
    blocked = at((20, 10), (50, FROZEN), "foot-right")
    assert (blocked.shot.reached, blocked.shot.approach.ending) == (False, "cushion")
    # Seen from the shot the ball is cut to the left, so right english is outside.
    helped = at((20, 10), (50, FROZEN), "foot-right", side=0.15)
    assert helped.shot.object_leg.pocket == "foot-right"
    assert helped.shot.throw < 0.0
    smooth = at((20, 10), (50, FROZEN), "foot-right", mu=0.0)
    assert smooth.shot.object_leg.pocket == "foot-right"


@pytest.mark.slow
def test_a_mouth_that_is_too_flat_is_played_at_in_its_middle():
    found = at((90, 40), (70, 44), "side-left")
    assert found.shot.object_leg.ending == "cushion"
    assert found.target[0] == POCKETS["side-left"].x
    assert (
        POCKETS["side-left"].width_from(*found.shot.object_leg.slide.velocity) < 2 * FROZEN * INCH
    )


@pytest.mark.slow
@settings(max_examples=examples(5))
@given(st.floats(20.0, 60.0), st.floats(0.0, 1.0), st.floats(2.0, 10.0))
def test_left_and_right_are_mirror_images(x, off, gap):
    right = at((x, FROZEN + gap), (x + 20.0, FROZEN + off), "foot-right")
    left = at((x, 50 - FROZEN - gap), (x + 20.0, 50 - FROZEN - off), "foot-left")
    assert right.shot.approach.ending == left.shot.approach.ending
    assert right.target[0] == pytest.approx(left.target[0], abs=1e-9)
    assert right.shot.cut == pytest.approx(-left.shot.cut, abs=1e-9)


def test_a_pocket_behind_the_cue_ball_is_refused():
    with pytest.raises(InputError, match="target can't be reached"):
        at((25, 16), (50, 25), "head-right")
    assert math.isfinite(at((25, 16), (50, 25), "foot-right").turn)
