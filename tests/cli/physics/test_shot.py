"""`evenbreak physics shot`: both ways to say where the balls are, and what it answers."""

import math
from functools import partial

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.physics import shot, strike_for_speed
from evenbreak.physics.units import INCH

PLAIN = "--cut 30 --distance 24 --speed 60 --offset -0.3"
FROZEN = "--cue-ball 20,1.125 --object-ball 50,1.125 --pocket foot-right --speed 60"
FLAT = "--cue-ball 90,40 --object-ball 70,44 --pocket side-left --speed 60"
AIMED = "--cue-ball 25,16 --object-ball 50,25 --pocket foot-left --speed 60"


@pytest.fixture(scope="session")
def ask(ask_physics):
    return partial(ask_physics, "shot")


def test_it_answers_what_the_library_finds(ask):
    told = ask(PLAIN)
    found = shot(strike_for_speed(60 * INCH, -0.3), math.radians(30), 24 * INCH)
    assert told["deflection_thrown_deg"] == pytest.approx(math.degrees(found.deflection))
    assert told["throw_deg"] == pytest.approx(math.degrees(found.throw))
    assert told["hit_s"] == found.approach.end
    x, y = found.cue_leg.path()[-1, :2] / INCH
    assert (told["cue_end_x_in"], told["cue_end_y_in"]) == (pytest.approx(x), pytest.approx(y))
    assert (told["cue_end"], told["object_end"], told["reached"]) == ("rest", "rest", True)
    motions = [(phase["ball"], phase["motion"]) for phase in told["phases"]]
    assert motions[0] == ("cue ball", "slides")
    assert motions[-1] == ("object ball", "rolls")
    assert told["phases"][0]["begin_energy_j"] == pytest.approx(found.strike.energy.total)
    assert told["aim_offset_in"] is None


@pytest.mark.parametrize("offset", [-0.4, 0.0, 0.4])
def test_the_energy_of_the_phases_and_of_the_hit_adds_up(ask, offset):
    told = ask(f"--cut 20 --distance 20 --speed 80 --offset {offset} --side-offset 0.2 --mu 0.2")
    before = [row for row in told["phases"] if row["end_s"] == told["hit_s"]]
    after = [row for row in told["phases"] if row["begin_s"] == told["hit_s"]]
    assert (len(before), len(after)) == (1, 2)
    left = sum(row["begin_energy_j"] for row in after)
    lost = told["energy_lost_at_hit_j"]
    assert lost > 0.0
    assert before[0]["end_energy_j"] == pytest.approx(left + lost)


def test_units_change_the_words_and_not_the_shot(ask):
    inches = ask(PLAIN)
    metric = ask("--cut 30 --distance 60.96 --speed 1.524 --offset -0.3 --metric")
    assert metric["cue_end_x_cm"] == pytest.approx(2.54 * inches["cue_end_x_in"])
    assert metric["hit_speed_m_s"] == pytest.approx(0.0254 * inches["hit_speed_in_s"])
    assert metric["deflection_deg"] == pytest.approx(inches["deflection_deg"])


def test_the_speed_of_the_cue_in_place_of_that_of_the_ball(ask):
    told = ask("--cut 0 --distance 24 --stick-speed 40")
    assert told["ball_speed_in_s"] == pytest.approx(60.0)
    assert told["stick_speed_in_s"] == pytest.approx(40.0)


def test_a_cut_to_the_left_is_the_mirror_image(ask):
    right = ask(f"{PLAIN} --side-offset 0.1")
    left = ask("--cut -30 --distance 24 --speed 60 --offset -0.3 --side-offset -0.1")
    same = ("throw_deg", "deflection_deg", "deflection_thrown_deg", "cue_roll_in", "object_end_s")
    for key in same:
        assert left[key] == pytest.approx(right[key])
    for key in ("cut_deg", "object_cut_deg", "side_spin_speed_ratio"):
        assert left[key] == pytest.approx(-right[key])
    assert left["cue_end_y_in"] - 25.0 == pytest.approx(25.0 - right["cue_end_y_in"])


def test_aimed_at_a_pocket_the_ball_falls(ask):
    told = ask(AIMED)
    assert (told["object_end"], told["object_pocket"]) == ("pocket", "foot-left")
    # A cut to the left is thrown to the right, so aim to the left.
    assert told["cut_deg"] < 0.0
    assert told["aim_offset_in"] < 0.0 < told["miss_in"]
    mirror = ask("--cue-ball 25,34 --object-ball 50,25 --pocket foot-right --speed 60")
    assert mirror["aim_offset_in"] == pytest.approx(-told["aim_offset_in"])
    assert mirror["direction_deg"] == pytest.approx(-told["direction_deg"])


def test_a_straight_shot_has_no_angles_that_rounding_made(ask):
    backwards = ask("--cue-ball 60,5 --object-ball 30,25 --pocket head-left --speed 60")
    assert -180.0 <= backwards["direction_deg"] <= 180.0
    told = ask(FROZEN)
    for key in ("cut_deg", "throw_deg", "object_cut_deg", "aim_turn_deg", "direction_deg"):
        assert told[key] == 0.0
    assert (told["target_y_in"], told["object_pocket"]) == (pytest.approx(1.125), "foot-right")


def test_csv_has_what_json_has_but_the_phases(ask, run):
    told = ask(AIMED)
    del told["schema_version"], told["phases"]
    lines = run("physics", "shot", *AIMED.split()).stdout.splitlines()
    rows = dict(line.split(",") for line in lines[1:])
    assert lines[0] == "quantity,value"
    assert list(rows) == list(told)
    assert float(rows["aim_turn_deg"]) == pytest.approx(told["aim_turn_deg"], abs=1e-6)
    assert rows["approach_pocket"] == ""


def on_a_terminal(run, monkeypatch, line):
    for module in ("output", "physics_shot"):
        monkeypatch.setattr(f"evenbreak.cli.{module}.to_terminal", lambda: True)
    result = run("physics", "shot", *line.split())
    assert result.exit_code == 0
    assert max(map(len, result.stdout.splitlines())) <= 80
    return " ".join(result.stdout.split())


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (PLAIN, "comes to rest after"),
        (PLAIN, "rolling by then"),
        (PLAIN + " --metric", "centimetres"),
        (AIMED, "Aim 0.36 inches to the left of the middle of the pocket"),
        (AIMED, "falls into the pocket foot-left at 20.18 inches a second"),
        (
            "--cut 30 --distance 24 --speed 5",
            "never reaches the object ball: it stops after 1.7 inches.",
        ),
        ("--cut 30 --distance 24 --speed 80 --offset -0.3", "still sliding"),
        ("--cut 30 --distance 24 --speed 200", "it is not followed from there"),
        ("--cut 0 --distance 2.25 --speed 50", "hits at once with stun."),
        ("--cut 0 --distance 2.25 --speed 50", "The cue ball stays where it is."),
        ("--cut 0 --distance 9 --speed 50 --offset 0.4", "natural roll, rolling from the tip on."),
        ("--cut 0 --distance 9 --speed 0", "it stops after 0.0 inches."),
        (AIMED + " --mu 0", "there is no throw to speak of"),
        (FROZEN, "so play it 0.47 inches to the right of that. Aim at that point: there is no"),
        (FROZEN, "falls into the pocket foot-right"),
        (FROZEN.replace("20,1.125", "20,10") + " --side-offset 0.1", "throw brings the ball back"),
        (AIMED.replace("60", "30"), "The object ball does not fall: it comes to rest 35.7 inches"),
        (FLAT, "The object ball does not fall: it comes so flat that the mouth is 1.43 inches"),
    ],
)
def test_a_terminal_tells_it_in_sentences(run, monkeypatch, line, words):
    if "--metric" in line:
        line = "--cut 30 --distance 60 --speed 1.5 --metric"
    assert words in on_a_terminal(run, monkeypatch, line)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("--cut 30 --distance 24", "Give --speed, of the cue ball, or --stick-speed"),
        (PLAIN + " --stick-speed 3", "one of the two"),
        ("--speed 60", "give --cut and --distance, or --cue-ball, --object-ball"),
        ("--cut 30 --speed 60", "give --cut and --distance, or"),
        (PLAIN + " --pocket foot-left", "give --cut and --distance, or"),
        (AIMED + " --cut 30", "in one way, not with --cut beside --pocket: give"),
        (FROZEN.replace("20,1.125", "20,10"), "so near a cushion that the cue ball would have to"),
        ("--object-ball 50,25 --speed 60", "give --cut and --distance, or"),
        ("--cut 95 --distance 9 --speed 60", "'--cut': '95'; give a number from -89 to 89"),
        ("--cut 5 --distance 1 --speed 60", "--distance 1 is between the centres; give 2.25"),
        ("--cut 5 --distance 90 --speed 60", "--distance 90 puts the object ball off the table"),
        (PLAIN + " --cue-ball 0,0", "--cue-ball 0,0 is not on the table, which is 100 by 50"),
        (PLAIN + " --cue-ball 7", "'--cue-ball': '7'; give two numbers with a comma"),
        (PLAIN + " --side-offset 0.45", "is a miscue: the tip slips beyond 0.5"),
        (AIMED.replace("foot-left", "corner"), "--pocket 'corner'; give one of head-right"),
        (AIMED.replace("50,25", "98.5,48.5"), "--object-ball hangs in --pocket foot-left, where"),
        (AIMED.replace("foot-left", "head-right"), "where no cut sends the object ball"),
        (AIMED.replace("25,16", "50,24"), "overlap; put them more than 2.25 inches apart"),
        (AIMED.replace("25,16", "47.75,25"), "the object ball goes along the line through them"),
        (PLAIN + " --plot shot.gif", "name a file that ends in .png or .svg"),
    ],
)
def test_refusals_name_option_value_and_remedy(run, line, words):
    result = run("physics", "shot", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert words in " ".join(result.stderr.split())


@settings(max_examples=20)
@given(
    st.floats(-89.0, 89.0),
    st.floats(2.3, 20.0),
    st.floats(0.0, 1000.0),
    st.floats(-0.35, 0.35),
    st.floats(-0.35, 0.35),
    st.floats(0.0, 1.0),
    st.sampled_from(["limited", "shepard"]),
)
def test_shots_of_all_kinds_are_answered(ask, cut, distance, speed, up, right, mu, law):
    told = ask(
        f"--cut {cut!r} --distance {distance!r} --speed {speed!r} --offset {up!r} "
        f"--side-offset {right!r} --mu {mu!r} --friction {law}"
    )
    # JSON has no NaN, so an answer is an answer; the balls end on the table.
    for name in ("approach", "cue", "object"):
        x, y = told[f"{name}_end_x_in"], told[f"{name}_end_y_in"]
        assert (x is None) == (not told["reached"] and name != "approach")
        assert x is None or (1.1 < x < 98.9 and 1.1 < y < 48.9)


def test_plot(run, tmp_path):
    path = tmp_path / "shot.svg"
    result = run("physics", "shot", *AIMED.split(), "--plot", str(path))
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert path.read_bytes()[:4] == b"<?xm"
