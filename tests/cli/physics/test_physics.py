"""The group: its commands, what they load, and what each of them refuses."""

import subprocess
import sys

import click
import pytest

from evenbreak.cli.groups import PHYSICS as COMMANDS
from evenbreak.cli.groups import physics as command
from rows import each_of

USUAL = {
    "speed": "--lag-time 7",
    "throw": "--cut 30",
    "aim": "--cut 30 --distance 36",
    "deflect": "--cut 30",
    "strike": "--offset 0.3 --stick-speed 60 --distance 24",
    "breakcue": "--forearm 36",
}


def in_another_process(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


def test_the_group_lists_its_commands(run):
    output = run("physics", "--help").output
    for name, entry in COMMANDS.items():
        assert f"{name} " in output
        assert entry.help in output
    assert "'throw'" in run("physics", "thro").stderr


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_of_the_group_exists(name):
    found = command.get_command(click.Context(command), name)
    assert found.name == name
    assert "Examples:" in found.epilog
    for option in found.params:
        assert option.help


def test_commands_load_numpy_and_nothing_heavy():
    heavy = "{'scipy', 'pandas', 'networkx', 'matplotlib', 'rich', 'dask', 'jinja2'}"
    lines = [["physics", name, *line.split()] for name, line in USUAL.items()]
    done = in_another_process(
        "import sys\nfrom evenbreak.cli.program import program\n"
        f"for line in {lines!r}:\n    program(line, standalone_mode=False)\n"
        f"sys.exit(','.join({heavy} & set(sys.modules)) or 0)"
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("quantity,value") == len(USUAL)


def test_help_loads_no_numpy():
    done = in_another_process(
        "import sys\nfrom evenbreak.cli.program import program\n"
        "program(['physics', 'strike', '--help'], standalone_mode=False)\n"
        "sys.exit('numpy' in sys.modules)"
    )
    assert done.returncode == 0
    assert "--side-offset" in done.stdout


@each_of(
    "line, words",
    [
        ("speed", ["--lag-time", "0.1 to 1,000"]),
        ("speed --lag-time 7 --table-length 2.54 --metric", ["--table-length 2.54"]),
        ("throw --cut 91", ["--cut", "'91'", "-90 to 90"]),
        ("throw --cut 30 --mu -0.1", ["--mu", "'-0.1'", "0 to 1"]),
        ("throw --cut 30 --mu fast", ["--mu", "'fast'", "0 to 1", "by-speed"]),
        ("throw --cut 30 --mu by-speed", ["--mu by-speed", "--speed"]),
        ("deflect --cut 30 --mu 0.06 --speed 20", ["--mu 0.06", "--speed 20"]),
        ("throw --cut 30 --friction none", ["--friction", "'none'", "'limited'"]),
        ("aim --cut 89.5 --distance 36", ["--cut 89.5", "smaller"]),
        ("aim --cut 30 --distance -1", ["--distance", "'-1'"]),
        ("deflect --cut 30 --topspin 1e9", ["--topspin", "'1e9'", "-100"]),
        ("strike --offset 1.2", ["--offset", "'1.2'", "-1 to 1"]),
        ("strike --offset 0.8 --side-offset 0.7", ["--offset 0.8", "--side-offset 0.7", "less"]),
        ("strike --offset 0.2 --distance 9", ["--distance 9", "--stick-speed"]),
        ("breakcue --forearm -36", ["--forearm", "'-36'"]),
    ],
)
def test_refusals_name_option_value_and_remedy(run, line, words):
    result = run("physics", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    said = " ".join(result.stderr.split())
    assert all(word in said for word in words)
