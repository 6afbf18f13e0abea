import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.answers.physics.hit import Hit, throw_answer, throw_words
from evenbreak.answers.physics.units import IMPERIAL, METRIC
from evenbreak.physics import SlipFriction, collide

MU = 4 / 72


def throw(cut, topspin=1.0, side=0.0, mu=MU, friction="limited"):
    return throw_answer(Hit(cut, topspin, side, mu, friction), IMPERIAL).to_dict()


def test_throw_of_the_text():
    found = throw(30.0)
    assert found["throw_factor"] == pytest.approx(0.5)
    assert found["throw_deg"] == pytest.approx(math.degrees(math.atan(0.5 * MU)))
    assert found["object_cut_deg"] == 30 - found["throw_deg"]
    assert found["no_throw_side"] == pytest.approx(-0.5)
    assert (found["english"], found["friction_stops"]) == (None, False)
    assert throw(30.0, -1.0, -0.2)["throw_factor"] == pytest.approx(0.327326835)


def test_outside_english_cancels_throw_and_reverses_it():
    assert throw(30.0, side=-0.5)["throw_deg"] == pytest.approx(0.0, abs=1e-9)
    assert throw(-30.0, side=0.5)["throw_deg"] == pytest.approx(0.0, abs=1e-9)
    assert throw(30.0, side=-0.9)["throw_deg"] < 0


@pytest.mark.parametrize(("cut", "side"), [(30.0, -0.5), (-30.0, 0.5)])
@pytest.mark.parametrize("friction", ["limited", "shepard"])
def test_english_that_leaves_no_slip_leaves_no_throw(cut, side, friction):
    found = throw(cut, 0.0, side, friction=friction)
    assert found["throw_deg"] == found["throw_factor"] == 0.0
    assert found["friction_stops"] is False
    assert found["sensitivity"] is None


def test_the_slip_ends_within_a_full_stun_shot():
    found = throw(10.0, 0.0)
    assert found["friction_stops"] is True
    assert math.tan(math.radians(found["throw_deg"])) == pytest.approx(
        math.tan(math.radians(10)) / 7
    )
    text = throw(10.0, 0.0, friction="shepard")
    assert text["throw_deg"] == pytest.approx(3.17983012)
    assert text["friction_stops"] is False
    assert throw(90.0)["friction_stops"] is False
    assert throw(0.0)["friction_stops"] is False
    assert throw(21.3, 0.0)["friction_stops"] is False
    assert throw(21.2, 0.0)["friction_stops"] is True


def test_the_spin_that_the_object_ball_takes_on():
    found = throw(30.0, side=0.4)
    # R omega_z = -5/2 V_sideways, over the ball's speed.
    assert found["object_side"] == pytest.approx(-2.5 * math.sin(math.radians(found["throw_deg"])))
    assert throw(-30.0, side=-0.4)["object_side"] == -found["object_side"]


def test_the_words_go_where_the_balls_go():
    # Right english on a full hit throws the object ball to the left.
    found = collide(0.0, 1.0, 0.5)
    assert found.object_velocity[1] > 0.0
    full = Hit(0.0, 1.0, 0.5, MU, "limited")
    assert throw_words(math.degrees(found.throw), full).endswith("to the left.")
    assert throw_words(-1.0, full).endswith("to the right.")
    cut = Hit(30.0, 1.0, 0.0, MU, "limited")
    assert "thick" in throw_words(1.0, cut)
    assert "thin" in throw_words(-1.0, cut)


def test_the_friction_that_was_used_is_said():
    at_any = throw(30.0, 0.0)
    assert (at_any["mu"], at_any["mu_by_speed"], at_any["hit_speed_in_s"]) == (MU, False, None)
    answer = throw_answer(Hit(30.0, 0.0, 0.0, SlipFriction(), "limited", 4.0), METRIC)
    found = answer.to_dict()
    mu = SlipFriction().at(2.0)
    assert (found["mu"], found["mu_by_speed"]) == (pytest.approx(mu), True)
    assert found["hit_speed_m_s"] == 4.0
    assert math.tan(math.radians(found["throw_deg"])) == pytest.approx(mu)
    assert "0.0222" in answer.heading
    assert "4 meters per second" in answer.heading
    slow = throw_answer(Hit(30.0, 0.0, 0.0, SlipFriction(), "limited", 0.5), METRIC).to_dict()
    assert slow["friction_stops"]


spins = st.floats(-100, 100)


@given(
    st.floats(-90, 90).filter(bool),
    spins,
    spins,
    st.floats(0, 1),
    st.sampled_from(["limited", "shepard"]),
)
def test_hits_of_all_kinds_are_answered_and_mirrored(cut, topspin, side, mu, friction):
    right = throw(cut, topspin, side, mu, friction)
    left = throw(-cut, topspin, -side, mu, friction)
    assert abs(right["throw_deg"]) <= math.degrees(math.atan(mu)) + 1e-9
    for key in ("object_cut_deg", "no_throw_side", "object_side"):
        assert left[key] == -right[key]
    for key in ("throw_deg", "throw_factor", "sensitivity", "friction_stops"):
        assert left[key] == right[key]
