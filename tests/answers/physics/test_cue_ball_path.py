import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.answers.physics.hit import Hit, cue_ball_path_answer, path_words
from evenbreak.answers.physics.units import IMPERIAL
from evenbreak.physics import collide

MU = 4 / 72


def hit(cut, topspin=1.0, side=0.0, mu=MU):
    return Hit(cut, topspin, side, mu, "limited")


def path(*how):
    return cue_ball_path_answer(hit(*how), IMPERIAL).to_dict()


def test_deflections_of_the_text():
    found = path(30.0)
    assert found["deflection_deg"] == pytest.approx(33.67, abs=0.005)
    assert found["largest_deflection_deg"] == pytest.approx(33.749, abs=5e-4)
    assert found["largest_deflection_cut_deg"] == pytest.approx(28.1255057)
    assert found["departure_deg"] == pytest.approx(90 - found["throw_deg"])
    assert found["equal_energy_cut_deg"] == pytest.approx(33.2109108)
    assert found["right_angle_cut_deg"] is None
    back = path(39.2315205, -1.0)
    assert back["deflection_deg"] == pytest.approx(90.0)
    assert back["right_angle_cut_deg"] == pytest.approx(39.2315205)
    assert back["largest_deflection_deg"] is None


def test_energy_is_shared_evenly_at_the_cut_that_says_so():
    cut = path(1.0)["equal_energy_cut_deg"]
    found = path(cut)
    assert found["object_energy_share"] == pytest.approx(0.5)
    assert found["object_energy_share_rolling"] == pytest.approx(0.5)
    assert found["deflection_deg"] == pytest.approx(cut)


@pytest.mark.parametrize("cut", [5.0, 30.0, 80.0])
@pytest.mark.parametrize("topspin", [1.0, 0.3, -1.0])
def test_without_friction_both_deflections_are_one(cut, topspin):
    found = path(cut, topspin, 0.0, 0.0)
    assert found["deflection_thrown_deg"] == pytest.approx(found["deflection_deg"])
    assert found["departure_deg"] == 90.0


def test_the_sensitivity_is_the_slope_of_the_deflection():
    low, high = (path(cut)["deflection_deg"] for cut in (19.999, 20.001))
    assert path(20.0)["sensitivity"] == pytest.approx((high - low) / 0.002, rel=1e-6)


def test_a_full_stun_shot_stands_still():
    found = path(0.0, 0.0)
    assert found["deflection_deg"] is found["deflection_thrown_deg"] is None
    assert found["departure_deg"] is None
    assert found["object_energy_share"] == 1.0


@pytest.mark.parametrize(
    ("rough", "smooth", "how", "words"),
    [
        (35.73, 33.67, hit(30.0), ["goes 35.73 degrees to the left", "go 33.67 degrees"]),
        (
            33.67,
            33.67,
            hit(-30.0),
            ["the cue ball goes 33.67 degrees to the right."],
        ),
        (0.0, 0.0, hit(0.0), ["goes straight on."]),
        (-180.0, 180.0, hit(0.0, -1.0), ["comes straight back."]),
        (-90.0, None, hit(0.0, 0.0, 3.0), ["90.00 degrees to the right", "would stop dead"]),
        (
            -5.0,
            2.5,
            hit(-1.0, 1.0, -3.0),
            ["5.00 degrees to the left", "2.50 degrees to"],
        ),
        (None, None, hit(0.0, 0.0), ["The cue ball stops dead."]),
    ],
)
def test_where_the_cue_ball_goes_in_words(rough, smooth, how, words):
    said = path_words(rough, smooth, how)
    assert all(word in said for word in words)


def test_the_words_go_where_the_balls_of_the_library_go():
    # Right english on a full hit sends the cue ball to the right.
    assert collide(0.0, 1.0, 0.5).cue_velocity[1] < 0.0
    thrown = path(0.0, 1.0, 0.5)["deflection_thrown_deg"]
    assert "degrees to the right" in path_words(thrown, 0.0, hit(0.0, 1.0, 0.5))


spins = st.floats(-100, 100)


@pytest.mark.slow
@given(st.floats(-90, 90).filter(bool), spins, spins, st.floats(0, 1))
def test_hits_of_all_kinds_are_answered_and_mirrored(cut, topspin, side, mu):
    right, left = path(cut, topspin, side, mu), path(-cut, topspin, -side, mu)
    mirrored = {"cut_deg", "side", "heading", "sentences"}
    assert {key: right[key] for key in right if key not in mirrored} == {
        key: left[key] for key in left if key not in mirrored
    }
    assert abs(right["throw_deg"]) <= math.degrees(math.atan(mu)) + 1e-9
