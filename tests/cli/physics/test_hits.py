"""The commands that answer a hit: throw, aim and deflect."""

import math

import pytest

from evenbreak.cli.physics.aim import _advice
from evenbreak.cli.physics.deflect import _where
from evenbreak.cli.physics.hit_options import Hit
from evenbreak.cli.physics.throw import throw_text
from evenbreak.cli.physics.units import PLAYERS
from evenbreak.physics import collide


def test_throw_of_the_text(ask_physics):
    told = ask_physics("throw", "--cut 30")
    assert told["throw_factor"] == pytest.approx(0.5)
    assert told["throw_deg"] == pytest.approx(math.degrees(math.atan(0.5 * 4 / 72)))
    assert told["object_cut_deg"] == 30 - told["throw_deg"]
    assert told["no_throw_side"] == pytest.approx(-0.5)
    assert (told["english"], told["friction_stops"]) == (None, False)
    with_side = ask_physics("throw", "--cut 30 --topspin -1 --side -0.2")
    assert with_side["throw_factor"] == pytest.approx(0.327326835)
    assert with_side["english"] == "outside"


def test_outside_english_is_on_the_side_away_from_the_cut(ask_physics):
    assert ask_physics("throw", "--cut 30 --side -0.5")["throw_deg"] == pytest.approx(0.0, abs=1e-9)
    assert ask_physics("throw", "--cut -30 --side 0.5")["throw_deg"] == pytest.approx(0.0, abs=1e-9)
    assert ask_physics("throw", "--cut 30 --side -0.9")["throw_deg"] < 0
    english = [
        ask_physics("throw", line)["english"]
        for line in (
            "--cut 30 --side 0.1",
            "--cut -30 --side 0.1",
            "--cut -30 --side -0.1",
            "--cut 0 --side -0.1",
        )
    ]
    assert english == ["inside", "outside", "inside", "left"]


@pytest.mark.parametrize("line", ["--cut 30 --side -0.5", "--cut -30 --side 0.5"])
@pytest.mark.parametrize("friction", ["limited", "shepard"])
def test_english_that_leaves_no_slip_leaves_no_throw(ask_physics, line, friction):
    line = f"{line} --topspin 0 --friction {friction}"
    told = ask_physics("throw", line)
    assert told["throw_deg"] == told["throw_factor"] == 0.0
    assert told["friction_stops"] is False
    assert told["sensitivity"] is None
    assert ask_physics("aim", f"{line} --distance 36")["offset_in"] == 0.0
    assert ask_physics("deflect", line)["throw_deg"] == 0.0


def test_the_slip_ends_within_a_full_stun_shot(ask_physics):
    line = "--cut 10 --topspin 0"
    told = ask_physics("throw", line)
    assert told["friction_stops"] is True
    assert math.tan(math.radians(told["throw_deg"])) == pytest.approx(
        math.tan(math.radians(10)) / 7
    )
    text = ask_physics("throw", f"{line} --friction shepard")
    assert text["throw_deg"] == pytest.approx(3.17983012)
    assert text["friction_stops"] is False
    assert ask_physics("throw", "--cut 90")["friction_stops"] is False
    assert ask_physics("throw", "--cut 0 --side 0")["friction_stops"] is False
    assert ask_physics("throw", "--cut 21.3 --topspin 0")["friction_stops"] is False
    assert ask_physics("throw", "--cut 21.2 --topspin 0")["friction_stops"] is True


def test_the_spin_that_the_object_ball_gets(ask_physics):
    told = ask_physics("throw", "--cut 30 --side 0.4")
    # R omega_z = -5/2 V_sideways, over the ball's speed.
    assert told["object_side"] == pytest.approx(-2.5 * math.sin(math.radians(told["throw_deg"])))
    assert ask_physics("throw", "--cut -30 --side -0.4")["object_side"] == -told["object_side"]


def test_the_example_of_an_aim(ask_physics):
    cut = math.degrees(math.asin(0.25))
    told = ask_physics("aim", f"--cut {cut!r} --distance 36")
    assert told["rule_offset_in"] == pytest.approx(0.5)
    assert told["offset_in"] == pytest.approx(0.528, abs=5e-4)
    assert told["aim_cut_deg"] - told["throw_deg"] == pytest.approx(cut)
    left = ask_physics("aim", f"--cut -{cut!r} --distance 36")
    assert left["offset_in"] == -told["offset_in"]
    assert left["rule_offset_in"] == -told["rule_offset_in"]
    assert left["aim_cut_deg"] == -told["aim_cut_deg"]


@pytest.mark.parametrize("how", ["--topspin 0", "--side 0.5", "--topspin -0.4 --side -0.8"])
def test_a_ball_aimed_so_goes_where_it_should(ask_physics, how):
    told = ask_physics("aim", f"--cut 20 --distance 36 {how}")
    hit = ask_physics("throw", f"--cut {told['aim_cut_deg']!r} {how}")
    assert hit["object_cut_deg"] == pytest.approx(20.0)
    assert told["offset_in"] == pytest.approx(
        36 * math.tan(math.radians(told["aim_cut_deg"] - 20)), rel=1e-9
    )


def test_aim_in_centimetres(ask_physics):
    inches = ask_physics("aim", "--cut 20 --distance 36")
    metric = ask_physics("aim", f"--cut 20 --distance {36 * 2.54!r} --metric")
    assert metric["offset_cm"] == pytest.approx(2.54 * inches["offset_in"])
    assert metric["aim_cut_deg"] == inches["aim_cut_deg"]
    assert "offset_in" not in metric


def hit(cut, topspin=1.0, side=0.0):
    return Hit(cut, topspin, side, 4 / 72, "limited")


def test_advice_names_the_side():
    assert _advice(0.5, 0.2, hit(14.0), PLAYERS) == (
        "Aim 0.50 inches to the right of the pocket's centre, a thinner cut: the throw "
        "brings the ball back."
    )
    assert "to the left of the pocket's centre, a thinner cut" in _advice(
        -0.5, 0.2, hit(-14), PLAYERS
    )
    assert "to the left of the pocket's centre, a fuller cut" in _advice(
        -0.5, 0.2, hit(14), PLAYERS
    )
    assert "to the left of the pocket's centre: the" in _advice(-0.5, 0.2, hit(0.0), PLAYERS)
    assert "centre, a cut to the left: the" in _advice(-2.0, -0.04, hit(1.0), PLAYERS)
    assert "throw is less than 0.01 inches there" in _advice(0.001, 0.2, hit(14.0), PLAYERS)


def test_deflections_of_the_text(ask_physics):
    told = ask_physics("deflect", "--cut 30")
    assert told["deflection_deg"] == pytest.approx(33.67, abs=0.005)
    assert told["largest_deflection_deg"] == pytest.approx(33.749, abs=5e-4)
    assert told["largest_deflection_cut_deg"] == pytest.approx(28.1255057)
    assert told["departure_deg"] == pytest.approx(90 - told["throw_deg"])
    assert told["equal_energy_cut_deg"] == pytest.approx(33.2109108)
    assert told["right_angle_cut_deg"] is None
    back = ask_physics("deflect", "--cut 39.2315205 --topspin -1")
    assert back["deflection_deg"] == pytest.approx(90.0)
    assert back["right_angle_cut_deg"] == pytest.approx(39.2315205)
    assert back["largest_deflection_deg"] is None


def test_energy_is_shared_evenly_at_the_cut_that_says_so(ask_physics):
    cut = ask_physics("deflect", "--cut 1")["equal_energy_cut_deg"]
    told = ask_physics("deflect", f"--cut {cut!r}")
    assert told["object_energy_share"] == pytest.approx(0.5)
    assert told["object_energy_share_rolling"] == pytest.approx(0.5)
    assert told["deflection_deg"] == pytest.approx(cut)


@pytest.mark.parametrize("cut", [5.0, 30.0, 80.0])
@pytest.mark.parametrize("topspin", [1.0, 0.3, -1.0])
def test_without_friction_both_deflections_are_one(ask_physics, cut, topspin):
    told = ask_physics("deflect", f"--cut {cut} --topspin {topspin} --mu 0")
    assert told["deflection_thrown_deg"] == pytest.approx(told["deflection_deg"])
    assert told["departure_deg"] == 90.0


def test_the_sensitivity_is_the_slope_of_the_deflection(ask_physics):
    low, high = (
        ask_physics("deflect", f"--cut {cut}")["deflection_deg"] for cut in (19.999, 20.001)
    )
    slope = ask_physics("deflect", "--cut 20")["sensitivity"]
    assert slope == pytest.approx((high - low) / 0.002, rel=1e-6)


def test_a_full_stun_shot_stands_still(ask_physics):
    told = ask_physics("deflect", "--cut 0 --topspin 0")
    assert told["deflection_deg"] is told["deflection_thrown_deg"] is told["departure_deg"] is None
    assert told["object_energy_share"] == 1.0


@pytest.mark.parametrize(
    ("smooth", "thrown", "how", "words"),
    [
        (
            *(33.67, 35.73, hit(30.0)),
            "Once it rolls, the cue ball goes 33.67 degrees to the left; with friction between the "
            "balls it goes 35.73 degrees to the left.",
        ),
        (33.67, 33.67, hit(-30.0), "Once it rolls, the cue ball goes 33.67 degrees to the right."),
        (0.0, 0.0, hit(0.0), "Once it rolls, the cue ball goes straight on."),
        (180.0, -180.0, hit(0.0, -1.0), "Once it rolls, the cue ball comes straight back."),
        (
            *(None, -90.0, hit(0.0, 0.0, 3.0)),
            "The cue ball stands still; with friction between the balls it goes 90.00 degrees to "
            "the right.",
        ),
        (
            *(2.5, -5.0, hit(-1.0, 1.0, -3.0)),
            "Once it rolls, the cue ball goes 2.50 degrees to the right; with friction between the "
            "balls it goes 5.00 degrees to the left.",
        ),
        (None, None, hit(0.0, 0.0), "The cue ball stands still."),
    ],
)
def test_where_the_cue_ball_goes_in_words(smooth, thrown, how, words):
    assert _where(smooth, thrown, how) == words


def test_the_words_go_where_the_balls_of_the_library_go(ask_physics):
    # Right english on a full hit throws the object ball to the left, and the cue ball to the right.
    found = collide(0.0, 1.0, 0.5)
    assert found.object_velocity[1] > 0.0 > found.cue_velocity[1]
    assert throw_text(math.degrees(found.throw), hit(0.0, 1.0, 0.5)).endswith("to the left.")
    thrown = ask_physics("deflect", "--cut 0 --side 0.5")["deflection_thrown_deg"]
    assert _where(0.0, thrown, hit(0.0, 1.0, 0.5)).endswith("degrees to the right.")
    assert throw_text(-1.0, hit(0.0, 1.0, -0.5)).endswith("to the right.")


def test_one_degree_is_one():
    assert hit(-1.0).text.startswith("A cut of 1 degree to the left;")
    assert hit(2.0).text.startswith("A cut of 2 degrees to the right;")
