"""The commands that answer a hit: throw, aim and deflect."""

import json
import math

import pytest

from evenbreak.cli.physics_aim import _advice
from evenbreak.cli.physics_deflect import _where
from evenbreak.cli.physics_hit import Hit
from evenbreak.cli.physics_units import PLAYERS


@pytest.fixture(scope="session")
def ask(run):
    def answer(name, line):
        result = run("physics", name, "--json", *line.split())
        assert (result.exit_code, result.stderr) == (0, "")
        return json.loads(result.stdout)

    return answer


def test_throw_of_the_text(ask):
    told = ask("throw", "--cut 30")
    assert told["throw_factor"] == pytest.approx(0.5)
    assert told["throw_deg"] == pytest.approx(math.degrees(math.atan(0.5 * 4 / 72)))
    assert told["object_cut_deg"] == 30 - told["throw_deg"]
    assert told["no_throw_side"] == pytest.approx(-0.5)
    assert (told["english"], told["friction_stops"]) == (None, False)
    with_side = ask("throw", "--cut 30 --topspin -1 --side -0.2")
    assert with_side["throw_factor"] == pytest.approx(0.327326835)
    assert with_side["english"] == "outside"


def test_outside_english_is_on_the_side_away_from_the_cut(ask):
    assert ask("throw", "--cut 30 --side -0.5")["throw_deg"] == pytest.approx(0.0, abs=1e-9)
    assert ask("throw", "--cut -30 --side 0.5")["throw_deg"] == pytest.approx(0.0, abs=1e-9)
    assert ask("throw", "--cut 30 --side -0.9")["throw_deg"] < 0
    english = [
        ask("throw", line)["english"]
        for line in (
            "--cut 30 --side 0.1",
            "--cut -30 --side 0.1",
            "--cut -30 --side -0.1",
            "--cut 0 --side -0.1",
        )
    ]
    assert english == ["inside", "outside", "inside", "left"]


def test_the_slip_ends_within_a_full_stun_shot(ask):
    line = "--cut 10 --topspin 0"
    told = ask("throw", line)
    assert told["friction_stops"] is True
    assert math.tan(math.radians(told["throw_deg"])) == pytest.approx(
        math.tan(math.radians(10)) / 7
    )
    text = ask("throw", f"{line} --friction shepard")
    assert text["throw_deg"] == pytest.approx(3.17983012)
    assert text["friction_stops"] is False
    assert ask("throw", "--cut 90")["friction_stops"] is False
    assert ask("throw", "--cut 0 --side 0")["friction_stops"] is False
    assert ask("throw", "--cut 21.3 --topspin 0")["friction_stops"] is False
    assert ask("throw", "--cut 21.2 --topspin 0")["friction_stops"] is True


def test_the_spin_that_the_object_ball_gets(ask):
    told = ask("throw", "--cut 30 --side 0.4")
    # R omega_z = -5/2 V_sideways, over the ball's speed.
    assert told["object_side"] == pytest.approx(-2.5 * math.sin(math.radians(told["throw_deg"])))
    assert ask("throw", "--cut -30 --side -0.4")["object_side"] == -told["object_side"]


def test_the_example_of_an_aim(ask):
    cut = math.degrees(math.asin(0.25))
    told = ask("aim", f"--cut {cut!r} --distance 36")
    assert told["rule_offset_in"] == pytest.approx(0.5)
    assert told["offset_in"] == pytest.approx(0.528, abs=5e-4)
    assert told["aim_cut_deg"] - told["throw_deg"] == pytest.approx(cut)
    left = ask("aim", f"--cut -{cut!r} --distance 36")
    assert left["offset_in"] == -told["offset_in"]
    assert left["rule_offset_in"] == -told["rule_offset_in"]
    assert left["aim_cut_deg"] == -told["aim_cut_deg"]


@pytest.mark.parametrize("how", ["--topspin 0", "--side 0.5", "--topspin -0.4 --side -0.8"])
def test_a_ball_aimed_so_goes_where_it_should(ask, how):
    told = ask("aim", f"--cut 20 --distance 36 {how}")
    hit = ask("throw", f"--cut {told['aim_cut_deg']!r} {how}")
    assert hit["object_cut_deg"] == pytest.approx(20.0)
    assert told["offset_in"] == pytest.approx(
        36 * math.tan(math.radians(told["aim_cut_deg"] - 20)), rel=1e-9
    )


def test_aim_in_centimetres(ask):
    inches = ask("aim", "--cut 20 --distance 36")
    metric = ask("aim", f"--cut 20 --distance {36 * 2.54!r} --metric")
    assert metric["offset_cm"] == pytest.approx(2.54 * inches["offset_in"])
    assert metric["aim_cut_deg"] == inches["aim_cut_deg"]
    assert "offset_in" not in metric


def hit(cut, topspin=1.0, side=0.0):
    return Hit(cut, topspin, side, 4 / 72, "limited")


def test_advice_names_the_side():
    assert _advice(0.5, hit(14.0), PLAYERS) == (
        "Aim 0.50 inches to the right of the pocket's centre, a thinner cut: the throw "
        "brings the ball back."
    )
    assert "to the left of the pocket's centre, a thinner cut" in _advice(-0.5, hit(-14), PLAYERS)
    assert "to the left of the pocket's centre, a fuller cut" in _advice(-0.5, hit(14), PLAYERS)
    assert "to the left of the pocket's centre: the" in _advice(-0.5, hit(0.0), PLAYERS)
    assert "no throw to speak of" in _advice(0.001, hit(14.0), PLAYERS)


def test_deflections_of_the_text(ask):
    told = ask("deflect", "--cut 30")
    assert told["deflection_deg"] == pytest.approx(33.67, abs=0.005)
    assert told["largest_deflection_deg"] == pytest.approx(33.749, abs=5e-4)
    assert told["largest_deflection_cut_deg"] == pytest.approx(28.1255057)
    assert told["departure_deg"] == pytest.approx(90 - told["throw_deg"])
    assert told["equal_energy_cut_deg"] == pytest.approx(33.2109108)
    assert told["right_angle_cut_deg"] is None
    back = ask("deflect", "--cut 39.2315205 --topspin -1")
    assert back["deflection_deg"] == pytest.approx(90.0)
    assert back["right_angle_cut_deg"] == pytest.approx(39.2315205)
    assert back["largest_deflection_deg"] is None


def test_energy_is_shared_evenly_at_the_cut_that_says_so(ask):
    cut = ask("deflect", "--cut 1")["equal_energy_cut_deg"]
    told = ask("deflect", f"--cut {cut!r}")
    assert told["object_energy_share"] == pytest.approx(0.5)
    assert told["object_energy_share_rolling"] == pytest.approx(0.5)
    assert told["deflection_deg"] == pytest.approx(cut)


@pytest.mark.parametrize("cut", [5.0, 30.0, 80.0])
@pytest.mark.parametrize("topspin", [1.0, 0.3, -1.0])
def test_without_friction_both_deflections_are_one(ask, cut, topspin):
    told = ask("deflect", f"--cut {cut} --topspin {topspin} --mu 0")
    assert told["deflection_thrown_deg"] == pytest.approx(told["deflection_deg"])
    assert told["departure_deg"] == 90.0


def test_the_sensitivity_is_the_slope_of_the_deflection(ask):
    low, high = (ask("deflect", f"--cut {cut}")["deflection_deg"] for cut in (19.999, 20.001))
    slope = ask("deflect", "--cut 20")["sensitivity"]
    assert slope == pytest.approx((high - low) / 0.002, rel=1e-6)


def test_a_full_stun_shot_stands_still(ask):
    told = ask("deflect", "--cut 0 --topspin 0")
    assert (told["deflection_deg"], told["deflection_thrown_deg"]) == (None, None)
    assert told["object_energy_share"] == 1.0
    assert _where(None, None, hit(0.0, 0.0)) == "The cue ball stands still."


def test_where_the_cue_ball_goes_in_words():
    assert _where(33.67, 35.73, hit(30.0)) == (
        "Once it rolls, the cue ball goes 33.67 degrees to the left of where it was going, "
        "and 35.73 with friction between the balls."
    )
    assert "to the right of where" in _where(33.67, 35.73, hit(-30.0))
    assert _where(0.0, 0.0, hit(0.0)) == "The cue ball goes straight on."
    assert _where(180.0, 180.0, hit(0.0, -1.0)) == "The cue ball comes straight back."
    assert "still without friction" in _where(None, -90.0, hit(0.0, 0.0, 3.0))
