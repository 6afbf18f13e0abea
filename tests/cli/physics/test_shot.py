import pytest

PLAIN = "--cut 30 --distance 24"


def test_the_speed_of_the_cue_in_place_of_that_of_the_ball(ask_physics):
    answer = ask_physics("shot", "--cut 0 --distance 24 --stick-speed 40")
    assert answer["ball_speed_in_s"] == pytest.approx(60.0)
    assert answer["stick_speed_in_s"] == pytest.approx(40.0)


def test_a_faster_table_lets_the_balls_roll_farther(ask_physics):
    slow, fast = (
        ask_physics("shot", f"--cut 60 --distance 24 --speed 30 --table-speed {speed}")
        for speed in (50, 100)
    )
    assert fast["object_roll_in"] > 1.5 * slow["object_roll_in"]


def test_a_cut_that_cannot_be_is_refused(run):
    result = run("physics", "shot", *PLAIN.replace("--cut 30", "--cut 95").split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert all(word in result.stderr for word in ("--cut", "'95'", "-89 to 89"))


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("", ["--speed", "--stick-speed"]),
        ("--speed 60 --stick-speed 3", ["--speed", "--stick-speed"]),
        ("--speed 60 --side-offset 0.45 --offset -0.3", ["--side-offset 0.45", "miscue", "0.5"]),
        ("--speed 60 --plot shot.gif", ["shot.gif", ".png or .svg"]),
    ],
)
def test_refusals_name_option_value_and_remedy(run, line, words):
    result = run("physics", "shot", *f"{PLAIN} {line}".split())
    assert (result.exit_code, result.stdout) == (2, "")
    said = " ".join(result.stderr.split())
    assert all(word in said for word in words)


def test_plot(run, tmp_path):
    path = tmp_path / "shot.svg"
    result = run("physics", "shot", *PLAIN.split(), "--speed", "60", "--text", "--plot", str(path))
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert path.read_bytes()[:4] == b"<?xm"
