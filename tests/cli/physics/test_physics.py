import math
import subprocess
import sys

import click
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.cli.physics import COMMANDS as PHYSICS_COMMANDS
from evenbreak.cli.physics import physics

USUAL = {
    "speed": "--lag-time 7",
    "throw": "--cut 30",
    "aim": "--cut 30 --distance 36",
    "deflect": "--cut 30",
    "strike": "--offset 0.3 --stick-speed 60 --distance 24",
    "breakcue": "--forearm 36",
}


@pytest.fixture(scope="session")
def refused(run):
    """Return what is said to a command line that is refused."""

    def said(name, line):
        result = run("physics", name, *line.split())
        assert (result.exit_code, result.stdout) == (2, "")
        return result.stderr

    return said


def test_the_group_lists_its_commands(run):
    output = run("physics", "--help").output
    for name, line in PHYSICS_COMMANDS.items():
        assert f"{name} " in output
        assert line in output
    assert run("physics", "thro").exit_code == 2


@pytest.mark.parametrize("name", PHYSICS_COMMANDS)
def test_every_command_of_the_group_exists(name):
    command = physics.get_command(click.Context(physics), name)
    assert command.name == name
    assert "Examples:" in command.epilog
    for option in command.params:
        assert option.help


@pytest.mark.parametrize("name", USUAL)
def test_csv_has_what_json_has(ask_physics, run, name):
    told = ask_physics(name, USUAL[name])
    assert told.pop("schema_version") == 1
    lines = run("physics", name, *USUAL[name].split()).stdout.splitlines()
    assert lines[0] == "quantity,value"
    rows = dict(line.split(",") for line in lines[1:])
    assert list(rows) == list(told)
    for key, value in told.items():
        if isinstance(value, float):
            assert rows[key] == f"{value:.6f}"
        elif isinstance(value, bool):
            assert rows[key] == ("yes" if value else "no")
        else:
            assert rows[key] == (value or "")


@pytest.mark.parametrize("name", USUAL)
def test_a_command_loads_numpy_and_nothing_heavy(name):
    heavy = "{'scipy', 'pandas', 'networkx', 'matplotlib', 'rich', 'dask', 'jinja2'}"
    code = (
        "import sys\nfrom evenbreak.cli.program import program\n"
        f"program({['physics', name, *USUAL[name].split()]!r}, standalone_mode=False)\n"
        f"sys.exit(','.join({heavy} & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout


def test_help_loads_no_numpy():
    code = (
        "import sys\nfrom evenbreak.cli.program import program\n"
        "program(['physics', 'strike', '--help'], standalone_mode=False)\n"
        "sys.exit('numpy' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert "--side-offset" in done.stdout


@pytest.mark.parametrize(
    ("name", "line", "words"),
    [
        ("speed", "", "Missing option '--lag-time'. Give a number from 0.1 to 1,000"),
        ("speed", "--lag-time 7,5", "'7,5'; give a number from 0.1 to 1,000, such as 7.0"),
        ("speed", "--lag-time 7,5", "(with a decimal point: 7.5)"),
        ("speed", "--lag-time 0", "'--lag-time': '0'; give a number"),
        ("speed", "--lag-time nan", "'nan'; give a number"),
        (
            "speed",
            "--lag-time 7 --table-length 2.54 --metric",
            "--table-length 2.54 leaves no room",
        ),
        ("throw", "--cut 91", "'--cut': '91'; give a number from -90 to 90"),
        ("throw", "--cut 30 --mu -0.1", "'--mu': '-0.1'; give a number from 0 to 1"),
        ("throw", "--cut 30 --friction none", "'--friction': 'none' is not one of 'limited', "),
        ("aim", "--cut 89.5 --distance 36", "--cut 89.5 cannot be reached: friction throws"),
        ("aim", "--cut 30 --distance -1", "'--distance': '-1'; give a number from 0.1"),
        ("deflect", "--cut 30 --topspin 1e9", "'--topspin': '1e9'; give a number from -100"),
        ("strike", "--offset 1.2", "'--offset': '1.2'; give a number from -1 to 1"),
        (
            "strike",
            "--offset 0.8 --side-offset 0.7",
            "--offset 0.8 with --side-offset 0.7 is besid",
        ),
        ("strike", "--offset 0.2 --distance 9", "--distance 9 needs the speed of the cue; give --"),
        ("breakcue", "--forearm -36", "'--forearm': '-36'; give a number from 0"),
    ],
)
def test_refusals_name_option_value_and_remedy(refused, name, line, words):
    assert words in refused(name, line)


spins = st.floats(-100, 100)
cuts = st.floats(-90, 90).filter(bool)


@settings(max_examples=40)
@given(cuts, spins, spins, st.floats(0, 1), st.sampled_from(["limited", "shepard"]))
def test_hits_of_all_kinds_are_answered_and_mirrored(ask_physics, cut, topspin, side, mu, friction):
    rest = f"--topspin {topspin!r} --mu {mu!r} --friction {friction}"
    for name in ("throw", "deflect"):
        right = ask_physics(name, f"--cut {cut!r} --side {side!r} {rest}")
        left = ask_physics(name, f"--cut {-cut!r} --side {-side!r} {rest}")
        assert abs(right["throw_deg"]) <= math.degrees(math.atan(mu)) + 1e-9
        for key in right:
            if key in ("cut_deg", "side", "object_cut_deg", "no_throw_side", "object_side"):
                assert left[key] == -right[key]
            else:
                assert left[key] == right[key]


weights = st.floats(0.01, 1e5)
metric = st.sampled_from(["", "--metric"])


@settings(max_examples=40)
@given(
    st.floats(-0.999, 0.999),
    st.floats(-0.999, 0.999),
    weights,
    weights,
    st.floats(0.01, 1e5),
    st.floats(0, 1e5),
    st.floats(0.01, 10),
    metric,
)
def test_strikes_of_all_kinds_are_answered(
    ask_physics, up, right, stick, ball, speed, far, tip, units
):
    right = math.copysign(min(abs(right), math.sqrt(1.0 - up * up) * 0.999), right)
    told = ask_physics(
        "strike",
        f"--offset {up!r} --side-offset {right!r} --stick {stick!r} --ball {ball!r} "
        f"--stick-speed {speed!r} --distance {far!r} --tip-mu {tip!r} {units}",
    )
    if told["miscue"]:
        assert told["spin_speed_ratio"] is None
        return
    spins = [told["spin_speed_ratio"], told["later_spin_speed_ratio"]]
    # Sliding only ever brings the ball nearer to natural roll.
    assert abs(spins[1] - 1.0) <= abs(spins[0] - 1.0) + 1e-9
    assert 0.0 < told["ball_speed_ratio"] < 2.0


@settings(max_examples=20)
@given(st.floats(0, 85), spins, spins, st.floats(0, 0.05), st.floats(0.1, 1e5), metric)
def test_aims_of_all_kinds_go_where_they_should(ask_physics, cut, topspin, side, mu, far, units):
    told = ask_physics(
        "aim",
        f"--cut {cut!r} --topspin {topspin!r} --side {side!r} --mu {mu!r} "
        f"--distance {far!r} {units}",
    )
    assert told["aim_cut_deg"] - told["throw_deg"] == pytest.approx(cut, abs=1e-6)


@settings(max_examples=20)
@given(st.floats(0, 1e6), weights, weights, metric)
def test_no_cue_breaks_better_than_the_best(ask_physics, arm, ball, stick, units):
    told = ask_physics("breakcue", f"--forearm {arm!r} --ball {ball!r} --stick {stick!r} {units}")
    assert told["stick_speed_share"] <= 1.0 + 1e-12
    assert 0.0 < told["energy_share"] <= 1.0 + 1e-12


@settings(max_examples=20)
@given(st.floats(0.1, 1000), st.floats(1, 1e5), st.floats(0.01, 0.9), metric)
def test_lags_of_all_kinds_are_answered(ask_physics, seconds, length, share, units):
    told = ask_physics(
        "speed",
        f"--lag-time {seconds!r} --table-length {length!r} "
        f"--ball-diameter {max(0.01, share * length)!r} {units}",
    )
    assert told["table_speed"] * told["mu_roll"] == pytest.approx(1.0)
    assert told["cloth"]
