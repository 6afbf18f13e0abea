"""A shot traced whole: each of its laws, and the pieces that it is made of."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak import InputError
from evenbreak.physics.deflection import deflection
from evenbreak.physics.objects import Cloth, Cue, PoolTable
from evenbreak.physics.offset import stun_offset
from evenbreak.physics.shot import shot
from evenbreak.physics.slide import Slide
from evenbreak.physics.strike import strike, strike_for_speed
from evenbreak.physics.units import INCH
from rows import each_of
from tiers import examples

RADIUS = 1.125 * INCH
HUGE = PoolTable(length=400.0, width=400.0)
MIDDLE = (200.0, 200.0)
SPEEDS = st.floats(0.8, 8.0)
CUTS = st.floats(-1.5, 1.5)
TIPS = st.tuples(st.floats(-0.35, 0.35), st.floats(-0.35, 0.35))
few = settings(max_examples=examples(20))
DISTANCES = st.floats(2.25 * INCH, 40.0 * INCH)


def on_a_plain(speed, tip, cut, distance, **how):
    """Trace a shot far from every cushion."""
    return shot(strike_for_speed(speed, *tip), cut, distance, table=HUGE, cue_ball=MIDDLE, **how)


def test_a_stun_shot_has_lost_its_backspin_when_it_hits():
    cloth, travel = Cloth(), 20.0 * INCH
    tip = stun_offset(2.0, travel, cloth)
    found = on_a_plain(2.0, (tip, 0.0), 0.0, travel + 2.0 * RADIUS, mu=0.0)
    assert found.at_hit.spin[1] == pytest.approx(0.0, abs=1e-9)
    # All its speed goes to the object ball, and it stays where it is.
    assert found.object_leg.slide.velocity == pytest.approx(found.at_hit.velocity)
    assert found.cue_leg.ending == "rest"
    assert found.cue_leg.length == pytest.approx(0.0, abs=1e-9)
    assert found.deflection is None


@few
@given(SPEEDS, st.floats(-0.35, 0.35), st.floats(0.02, 1.5), DISTANCES)
def test_the_deflection_is_that_of_p4_13_where_the_balls_are_smooth(speed, up, cut, distance):
    found = on_a_plain(speed, (up, 0.0), cut, distance, mu=0.0)
    state = found.at_hit
    topspin = RADIUS * state.spin[1] / state.velocity[0]
    assert found.deflection == pytest.approx(deflection(cut, topspin), abs=1e-9)
    assert found.throw == 0.0


def test_friction_between_the_balls_changes_the_deflection_a_little():
    smooth = on_a_plain(2.0, (0.0, 0.0), 0.5, 1.0, mu=0.0)
    rough = on_a_plain(2.0, (0.0, 0.0), 0.5, 1.0)
    assert 0.0 < abs(rough.deflection - smooth.deflection) < math.radians(3.0)
    assert math.degrees(rough.throw) > 1.0


@few
@given(SPEEDS, TIPS, CUTS, DISTANCES, st.floats(-3.0, 3.0))
def test_energy_never_grows(speed, tip, cut, distance, direction):
    found = on_a_plain(speed, tip, cut, distance, direction=direction)
    times = np.unique([0.0, *(leg.roll_begin for leg in found.legs), *np.linspace(0, found.end, 9)])
    totals = [found.energy(time).total for time in times]
    assert totals[0] <= found.strike.energy.total * (1.0 + 1e-12)
    assert all(b <= a * (1.0 + 1e-12) for a, b in pairwise(totals))


@few
@given(SPEEDS, TIPS, CUTS, DISTANCES)
def test_the_path_is_continuous_and_its_slope_is_the_velocity(speed, tip, cut, distance):
    found = on_a_plain(speed, tip, cut, distance)
    phases = found.phases
    for first, second in pairwise(phases):
        if first.ball != second.ball or first.end.time == found.approach.end:
            continue
        assert first.end.position == pytest.approx(second.begin.position, abs=1e-9)
        assert first.end.velocity == pytest.approx(second.begin.velocity, abs=1e-9)
        assert first.end.spin == pytest.approx(second.begin.spin, abs=1e-6)
    if found.reached:
        assert found.cue_leg.slide.position == pytest.approx(found.at_hit.position, abs=1e-9)
    for leg, phase in [(one, phase) for one in found.legs for phase in one.phases]:
        # A constant acceleration: the mean velocity is the velocity in the middle.
        took = phase.end.time - phase.begin.time
        middle = leg.state(phase.begin.time + 0.5 * took)
        way = phase.end.position - phase.begin.position
        assert way == pytest.approx(middle.velocity * took, abs=1e-9)
        first, second = phase.begin.velocity, phase.end.velocity
        assert middle.velocity == pytest.approx(0.5 * (first + second), abs=1e-9)


@few
@given(SPEEDS, TIPS, CUTS, DISTANCES)
def test_all_balls_end_in_natural_roll_at_the_speed_of_p2_2(speed, tip, cut, distance):
    found = on_a_plain(speed, tip, cut, distance)
    assert found.reached
    for leg in (found.cue_leg, found.object_leg):
        start = leg.slide
        rim = RADIUS * np.array([start.spin[1], -start.spin[0]])
        rolls = leg.state(leg.roll_begin)
        assert rolls.velocity == pytest.approx((5.0 * start.velocity + 2.0 * rim) / 7.0, abs=1e-9)
        assert leg.ending == "rest"


@few
@given(SPEEDS, TIPS, CUTS, DISTANCES, st.floats(-3.0, 3.0))
def test_the_mirror_image_of_a_shot_is_a_shot(speed, tip, cut, distance, direction):
    up, right = tip
    found = on_a_plain(speed, tip, cut, distance, direction=direction)
    other = on_a_plain(speed, (up, -right), -cut, distance, direction=-direction)
    for one, two in zip(found.legs, other.legs, strict=True):
        assert (one.end, one.ending) == (pytest.approx(two.end), two.ending)
        here, there = one.path(5)[:, :2] - MIDDLE, two.path(5)[:, :2] - MIDDLE
        assert here == pytest.approx(there * [1.0, -1.0], abs=1e-9)
    # A full hit, or next to one, may count as a cut to either side.
    if cut:
        assert found.throw == pytest.approx(other.throw)
        assert (found.deflection or 0.0) == pytest.approx(other.deflection or 0.0)


@few
@given(SPEEDS, TIPS, CUTS, DISTANCES, st.floats(-3.0, 3.0))
def test_a_shot_turned_on_the_table_is_the_same_shot(speed, tip, cut, distance, direction):
    ahead = on_a_plain(speed, tip, cut, distance)
    turned = on_a_plain(speed, tip, cut, distance, direction=direction)
    sin, cos = math.sin(direction), math.cos(direction)
    for one, two in zip(ahead.legs, turned.legs, strict=True):
        rows = one.path(5)[:, :2] - MIDDLE
        back = rows @ np.array([[cos, sin], [-sin, cos]])
        assert two.path(5)[:, :2] - MIDDLE == pytest.approx(back, abs=1e-9)


@few
@given(SPEEDS, TIPS, CUTS, DISTANCES)
def test_the_balls_touch_at_the_hit_and_never_again(speed, tip, cut, distance):
    found = on_a_plain(speed, tip, cut, distance)
    begin = found.approach.end
    gaps = [
        np.linalg.norm(found.cue_leg.state(t).position - found.object_leg.state(t).position)
        for t in begin + (found.end - begin) * np.linspace(0.0, 1.0, 12) ** 3
    ]
    assert gaps[0] == pytest.approx(2.0 * RADIUS)
    assert min(gaps) > 2.0 * RADIUS - 1e-9
    assert np.linalg.norm(found.object_position - MIDDLE) == pytest.approx(distance)


@few
@given(SPEEDS, TIPS, st.floats(0.02, 1.5), DISTANCES)
def test_the_two_balls_part_at_a_right_angle_less_the_throw(speed, tip, cut, distance):
    found = on_a_plain(speed, tip, cut, distance)
    object_ball, cue_ball = found.object_leg.slide.velocity, found.cue_leg.slide.velocity
    angle = math.acos(
        np.clip(
            object_ball @ cue_ball / np.linalg.norm(object_ball) / np.linalg.norm(cue_ball), -1, 1
        )
    )
    assert angle == pytest.approx(found.collision.departure, abs=1e-6)
    heading = math.atan2(object_ball[1], object_ball[0])
    assert heading == pytest.approx(found.object_direction, abs=1e-9)


def test_a_cut_to_the_right_sends_the_object_ball_to_the_right():
    right, left = (on_a_plain(2.0, (0.0, 0.0), cut, 0.5) for cut in (0.5, -0.5))
    assert right.object_leg.path()[-1, 1] < MIDDLE[1] < right.cue_leg.path()[-1, 1]
    assert left.cue_leg.path()[-1, 1] < MIDDLE[1] < left.object_leg.path()[-1, 1]


def test_a_cue_ball_may_stop_before_the_object_ball():
    for speed in (0.0, 0.1):
        found = on_a_plain(speed, (0.1, 0.1), 0.5, 1.0)
        assert (found.reached, found.approach.ending) == (False, "rest")
        assert (found.throw, found.deflection, found.at_hit) == (None, None, None)
        assert (found.cue_leg, found.object_leg, found.object_direction) == (None, None, None)
        assert found.legs == (found.approach,)


def test_a_cushion_may_be_in_the_way():
    # The ghost ball of a ball at the cushion, hit from behind itself, is in the cushion.
    table, direction, cut = PoolTable(), math.radians(60.0), math.radians(-45.0)
    standing = np.array([table.length - RADIUS, 0.8])
    line = direction - cut
    ghost = standing - 2.0 * RADIUS * np.array([math.cos(line), math.sin(line)])
    start = ghost - 0.4 * np.array([math.cos(direction), math.sin(direction)])
    distance = float(np.linalg.norm(standing - start))
    found = shot(strike(2.0), cut, distance, cue_ball=start, direction=direction)
    assert found.object_position == pytest.approx(standing)
    assert (found.reached, found.approach.ending) == (False, "cushion")


def test_the_stroke_that_would_just_touch_the_object_ball_does_not_hit_it():
    cue_ball = strike_for_speed(1.0)
    room = Slide(cue_ball.ball, Cloth(), np.zeros(2), cue_ball.velocity, cue_ball.spin)
    reach = float(room.stop_position[0]) + 2.0 * RADIUS
    found = [
        shot(cue_ball, 0.0, reach + more, table=HUGE, cue_ball=MIDDLE).reached
        for more in (-1e-6, 0.0, 1e-6)
    ]
    assert found == [True, False, False]


def test_frozen_balls_are_hit_at_once():
    found = on_a_plain(2.0, (0.0, 0.0), 0.0, 2.0 * RADIUS)
    assert found.approach.end == 0.0
    assert found.object_leg.begin == 0.0
    assert found.at_hit.speed == pytest.approx(2.0)


def test_where_a_ball_meets_a_cushion_its_path_ends():
    found = shot(strike(3.0), 0.3, 0.5)
    assert found.object_leg.ending == "cushion"
    x, y = found.object_leg.path()[-1, :2]
    gaps = (x, PoolTable().length - x, y, PoolTable().width - y)
    assert min(gaps) == pytest.approx(RADIUS, abs=2e-9)
    assert found.object_leg.state(found.end).speed > 0.0


@each_of(
    "how, message",
    [
        ({"cut": 1.6}, r"cut must be an angle between -pi/2 and pi/2; you gave 1\.6"),
        ({"distance": 0.05}, "where the balls touch"),
        ({"distance": 5.0}, "the object ball is at"),
        ({"cue_ball": (0.0, 0.0)}, "cue_ball is at"),
        ({"cue_ball": 0.5}, "have x and y"),
        ({"strike": strike(1.0, 0.4, 0.4)}, "a miscue: this tip slips beyond 0.5"),
        ({"strike": strike([1.0, 2.0])}, "strike must be a single strike; you gave 2"),
        ({"mu": -1.0}, r"mu must be a number from 0 to 1e\+50; you gave -1\.0"),
        (
            {"mu": -1.0, "strike": strike(0.01)},
            r"mu must be a number from 0 to 1e\+50; you gave -1\.0",
        ),
        ({"mu": [0.1, 0.2]}, "mu must"),
        ({"friction": "none"}, "friction must be 'limited' or 'shepard'; you gave 'none'"),
        ({"cut": [0.1, 0.2]}, "cut must"),
        ({"direction": math.nan}, "direction"),
    ],
)
def test_what_cannot_be_is_refused(how, message):
    with pytest.raises(InputError, match=message):
        shot(**{"strike": strike(1.0), "cut": 0.3, "distance": 0.5, **how})


def test_a_tip_with_more_friction_may_hit_farther_out():
    found = shot(strike(1.0, 0.0, 0.6, cue=Cue(tip_friction=1.0)), 0.3, 0.5)
    assert found.reached
