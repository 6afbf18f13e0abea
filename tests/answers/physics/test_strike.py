import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.answers.physics.strike import strike_answer, tip_words
from evenbreak.answers.physics.units import IMPERIAL, METRIC
from evenbreak.physics import Ball, Cloth, Cue, Slide, strike
from evenbreak.physics.units import INCH, OUNCE
from rows import each_of


def struck(up, right=0.0, *, speed=None, far=None, units=IMPERIAL, tip=3**-0.5, ounces=18):
    found = strike(
        1.0 if speed is None else speed * units.speed.size,
        up,
        right,
        cue=Cue(mass=ounces * OUNCE, tip_friction=tip),
    )
    return strike_answer(
        found,
        units,
        cloth=Cloth(),
        distance=None if far is None else far * units.length.size,
        speed_known=speed is not None,
    ).to_dict()


def test_struck_into_natural_roll():
    found = struck(0.4)
    assert found["spin_speed_ratio"] == pytest.approx(1.0)
    assert found["roll_speed_ratio"] == found["ball_speed_ratio"]
    assert found["ball_speed_ratio"] == pytest.approx(2 / (1 + 1 / 3 + 2.5 * 0.16))
    assert found["ball_speed_in_s"] is found["slide_in"] is found["stun_in"] is None


def test_a_hit_in_the_center_at_a_speed():
    found = struck(0.0, speed=40)
    assert found["ball_speed_in_s"] == pytest.approx(60.0)
    assert found["stick_speed_after_in_s"] == pytest.approx(20.0)
    assert found["roll_speed_in_s"] == pytest.approx(60 * 5 / 7)
    assert found["stun_in"] is None
    assert struck(0.0, ounces=19)["ball_speed_ratio"] == pytest.approx(1.52)
    assert struck(0.0, speed=1, units=METRIC)["ball_speed_m_s"] == pytest.approx(1.5)


def test_right_of_the_center_is_right_english():
    found = struck(-0.2, 0.3)
    assert found["side_spin_speed_ratio"] == pytest.approx(0.75)
    assert found["roll_side_spin_speed_ratio"] == pytest.approx(3.5 * 0.3 / 0.8)
    assert found["off_center"] == pytest.approx(math.hypot(0.2, 0.3))


def test_a_miscue_gives_no_spin():
    found = struck(0.45, 0.3, speed=60)
    assert found["miscue"] is True
    assert found["miscue_offset"] == pytest.approx(0.5)
    assert (
        found["spin_speed_ratio"] is found["ball_speed_ratio"] is found["ball_speed_in_s"] is None
    )
    assert "tip_mu 0.643" in found["sentences"][0]
    held = struck(0.45, 0.3, tip=0.8)
    assert held["miscue"] is False
    assert held["spin_speed_ratio"] == pytest.approx(1.125)


@each_of("offset", [-0.3, -0.1, 0.1, 0.45])
@each_of("inches", [0.0, 5.0, 15.0, 200.0])
def test_the_spin_after_a_distance_is_that_of_the_slide(offset, inches):
    found = struck(offset, speed=50, far=inches)
    speed = found["ball_speed_in_s"] * INCH
    ball = Ball()
    spin = [0.0, found["spin_speed_ratio"] * speed / ball.radius, 0.0]
    slide = Slide(ball, Cloth(), [0.0, 0.0], [speed, 0.0], spin)
    assert slide.at(slide.slide_time)[0] / INCH == pytest.approx(found["slide_in"])
    low, high = 0.0, float(slide.slide_time)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if slide.at(middle)[0] < inches * INCH else (low, middle)
    rim = ball.radius * slide.spin_at(high)[1]
    assert found["later_spin_speed_ratio"] == pytest.approx(
        rim / slide.velocity_at(high)[0], abs=1e-9
    )
    assert found["later_offset"] == pytest.approx(found["later_spin_speed_ratio"] / 2.5)


def test_draw_is_gone_at_the_stun_distance():
    found = struck(-0.3, speed=60)
    there = struck(-0.3, speed=60, far=found["stun_in"])
    assert there["later_spin_speed_ratio"] == pytest.approx(0.0, abs=1e-12)
    assert there["stun_offset"] == pytest.approx(-0.3)
    assert "stun" in there["sentences"][0]
    assert struck(-0.3, speed=60, far=900)["stun_offset"] is None


def test_the_heading_says_where_the_tip_hits():
    assert "above" in tip_words(strike(1.0, 0.2))
    assert "0.2 radii left of" in tip_words(strike(1.0, 0.0, -0.2))


@given(
    st.floats(-0.999, 0.999),
    st.floats(-0.999, 0.999),
    st.floats(0.01, 1e5),
    st.floats(0.01, 1e5),
    st.floats(0, 1e5),
    st.floats(0.01, 10),
    st.sampled_from([IMPERIAL, METRIC]),
)
def test_strikes_of_all_kinds_are_answered(up, right, ounces, speed, far, tip, units):
    right = math.copysign(min(abs(right), math.sqrt(1.0 - up * up) * 0.999), right)
    found = struck(up, right, speed=speed, far=far, units=units, tip=tip, ounces=ounces)
    if found["miscue"]:
        assert found["spin_speed_ratio"] is None
        return
    spins = [found["spin_speed_ratio"], found["later_spin_speed_ratio"]]
    # Sliding only ever brings the ball nearer to natural roll.
    assert abs(spins[1] - 1.0) <= abs(spins[0] - 1.0) + 1e-9
    assert 0.0 < found["ball_speed_ratio"] < 2.0
