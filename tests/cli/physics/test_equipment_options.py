import pytest

from evenbreak.cli.physics.equipment_options import ball_of, cue_of, doubts
from evenbreak.cli.physics.units import METRIC, PLAYERS
from evenbreak.physics import Ball, Cue
from evenbreak.physics.units import OUNCE

SHOT = "--cut 0 --distance 24 --stick-speed 40"
STRIKE = "--offset 0 --stick-speed 40"


def test_what_is_not_typed_is_a_pool_ball_and_a_playing_cue():
    assert ball_of(None, METRIC) == Ball()
    assert cue_of(None, 0.6, METRIC) == Cue(tip_friction=0.6)


def test_weights_are_in_the_units_of_the_command():
    assert ball_of(5.5, PLAYERS) == Ball(mass=5.5 * OUNCE)
    assert ball_of(170.0, METRIC).mass == pytest.approx(0.17)
    assert cue_of(19.0, 0.7, PLAYERS) == Cue(mass=19.0 * OUNCE, tip_friction=0.7)


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


def test_a_rougher_tip_holds_farther_out_in_both(run):
    strike = ["physics", "strike", "--offset", "-0.55", "--json"]
    shot = ["physics", "shot", *SHOT.split(), "--offset", "-0.55", "--json"]
    assert '"miscue": true' in run(*strike).stdout
    assert '"miscue": false' in run(*strike, "--tip-mu", "0.7").stdout
    assert "is a miscue" in run(*shot).stderr
    assert run(*shot, "--tip-mu", "0.7").exit_code == 0


@pytest.mark.parametrize(
    ("units", "typed", "words"),
    [
        (METRIC, {"stick": 18.0}, "Is --stick 18 grams? 280 to 850 are usual; without --metric it"),
        (
            PLAYERS,
            {"stick": 540.0},
            "Is --stick 540 ounces? 10 to 30 are usual; --metric takes gra",
        ),
        (METRIC, {"forearm": 36.0}, "without --metric it is ounces."),
        (METRIC, {"speed": 60.0}, "60 metres a second? 0 to 15 are usual; without --metric it is"),
        (PLAYERS, {"stick_speed": 6e3}, "Is --stick-speed 6000 inches a second?"),
    ],
)
def test_units_that_were_mistaken_are_asked_about(units, typed, words):
    assert words in doubts(units, **typed)


def test_what_players_use_is_not_doubted():
    usual = {"stick": 19.0, "ball": 6.0, "forearm": 36.0, "speed": 80.0, "stick_speed": None}
    assert doubts(PLAYERS, **usual) == ""
    assert doubts(METRIC, stick=538.0, ball=170.0, forearm=1020.0, speed=2.0) == ""


@pytest.mark.parametrize(
    "line",
    [
        "strike --offset 0.1 --stick 540",
        "shot --cut 30 --distance 24 --speed 80 --ball 170",
        "breakcue --forearm 36 --metric",
    ],
)
def test_the_commands_ask_on_a_terminal(run, monkeypatch, line):
    monkeypatch.setattr("evenbreak.cli.kit.output.to_terminal", lambda: True)
    assert "are usual;" in " ".join(run("physics", *line.split()).stdout.split())
