"""Where the balls are: both ways to say it, and what is refused."""

import pytest

PLAIN = "--cut 30 --distance 24 --speed 60"
FROZEN = "--cue-ball 20,10 --object-ball 50,1.125 --pocket foot-right --speed 60"
AIMED = "--cue-ball 25,16 --object-ball 50,25 --pocket foot-left --speed 60"


def test_a_cut_and_a_distance_leave_the_cue_ball_on_the_head_string(ask_physics):
    answer = ask_physics("shot", f"{PLAIN} --table-length 80")
    assert answer["cut_deg"] == pytest.approx(30.0)
    assert answer["phases"][0]["begin_x_in"] == pytest.approx(20.0)
    assert answer["phases"][0]["begin_y_in"] == pytest.approx(20.0)
    assert ask_physics("shot", f"{PLAIN} --cue-ball 30,20")["phases"][0]["begin_x_in"] == 30.0


def test_places_and_a_pocket_are_read_in_the_units_of_the_command(ask_physics):
    inches = ask_physics("shot", AIMED)
    places = "--cue-ball 63.5,40.64 --object-ball 127,63.5 --pocket foot-left"
    metric = ask_physics("shot", f"{places} --speed 1.524 --metric")
    assert inches["object_pocket"] == metric["object_pocket"] == "foot-left"
    assert metric["miss_cm"] == pytest.approx(2.54 * inches["miss_in"])


@pytest.mark.slow_after(10)
@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("--speed 60", ["give --cut and --distance, or"]),
        ("--cut 30 --speed 60", ["give --cut and --distance, or"]),
        ("--object-ball 50,25 --speed 60", ["give --cut and --distance, or"]),
        (PLAIN + " --pocket foot-left", ["--cut", "--pocket"]),
        (AIMED + " --cut 30", ["--cut", "--pocket"]),
        (FROZEN, ["--object-ball 50,1.125", "close to a rail", "--side-offset"]),
        ("--cut 5 --distance 1 --speed 60", ["--distance 1", "2.25 inches"]),
        ("--cut 5 --distance 90 --speed 60", ["--distance 90", "--cue-ball"]),
        (PLAIN + " --cue-ball 0,0", ["--cue-ball 0,0", "100 by 50"]),
        (PLAIN + " --cue-ball 7", ["--cue-ball", "'7'", "25,16"]),
        (AIMED.replace("foot-left", "corner"), ["'corner'", "head-right"]),
        (AIMED.replace("50,25", "98.5,48.5"), ["--object-ball", "foot-left"]),
        (AIMED.replace("foot-left", "head-right"), ["--pocket head-right", "90 degrees"]),
        (AIMED.replace("25,16", "50,24"), ["overlap", "2.25 inches"]),
        (AIMED.replace("25,16", "47.75,25"), ["touch", "2.25 inches"]),
    ],
)
def test_a_layout_that_cannot_be_played_is_refused(run, line, words):
    result = run("physics", "shot", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    said = " ".join(result.stderr.split())
    assert all(word in said for word in words)
