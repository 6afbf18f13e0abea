import pytest

from evenbreak.answers.physics.asked import ball_of, cue_of
from evenbreak.answers.physics.units import IMPERIAL, METRIC
from evenbreak.physics import Ball, Cue
from evenbreak.physics.units import OUNCE

SHOT = "--cut 0 --distance 24 --stick-speed 40"
STRIKE = "--offset 0 --stick-speed 40"


def test_the_defaults_are_a_pool_ball_and_a_playing_cue():
    assert ball_of(None, METRIC) == Ball()
    assert cue_of(None, 0.6, METRIC) == Cue(tip_friction=0.6)


def test_weights_are_in_the_units_of_the_command():
    assert ball_of(5.5, IMPERIAL) == Ball(mass=5.5 * OUNCE)
    assert ball_of(170.0, METRIC).mass == pytest.approx(0.17)
    assert cue_of(19.0, 0.7, IMPERIAL) == Cue(mass=19.0 * OUNCE, tip_friction=0.7)


@pytest.mark.parametrize("weights", ["", "--stick 19", "--ball 5.5", "--stick 20 --ball 7"])
def test_strike_and_shot_are_played_with_the_same(ask_physics, weights):
    struck = ask_physics("strike", f"{STRIKE} {weights}")
    traced = ask_physics("shot", f"{SHOT} {weights}")
    assert traced["ball_speed_in_s"] == pytest.approx(struck["ball_speed_in_s"])
    words = f"{weights} --stick 18 --ball 6".split()
    stick, ball = (float(words[words.index(name) + 1]) for name in ("--stick", "--ball"))
    assert struck["ball_speed_in_s"] == pytest.approx(40.0 * 2.0 / (1.0 + ball / stick))


def test_the_cloth_is_the_same_too(ask_physics):
    slow, fast = (
        [
            ask_physics("strike", f"{STRIKE} --cloth-mu {mu}")["slide_in"],
            ask_physics("shot", f"--cut 0 --distance 60 --stick-speed 40 --cloth-mu {mu}")[
                "approach_slide_in"
            ],
        ]
        for mu in (0.2, 0.4)
    )
    assert slow == pytest.approx([2.0 * length for length in fast])
    assert slow[0] == pytest.approx(slow[1])


def test_a_rougher_tip_holds_farther_out_in_both(ask_physics, run):
    strike, shot = "--offset -0.55", f"{SHOT} --offset -0.55"
    assert ask_physics("strike", strike)["miscue"] is True
    assert ask_physics("strike", f"{strike} --tip-mu 0.7")["miscue"] is False
    assert run("physics", "shot", *shot.split()).exit_code == 2
    assert ask_physics("shot", f"{shot} --tip-mu 0.7")["reached"] is True


@pytest.mark.parametrize(
    "line",
    [
        "strike --offset 0.1 --stick 540",
        "shot --cut 30 --distance 24 --speed 80 --ball 170",
        "breakcue --forearm 36 --metric",
    ],
)
def test_a_value_in_other_units_is_warned_of(run, line):
    result = run("physics", *line.split())
    assert result.exit_code == 0
    assert "Warning: --" in result.stderr
    assert "--metric" in result.stderr
