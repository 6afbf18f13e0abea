"""The program as a whole: its help, its exit codes, its streams."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import click
import pytest

from evenbreak import __version__
from evenbreak.cli.program import COMMANDS, SECTIONS, program

ARCS = "source,target,probability\nS,W,0.6\nS,L,0.4\n"


def run_program(*words, **options):
    return subprocess.run(
        [sys.executable, "-m", "evenbreak", *words], capture_output=True, text=True, **options
    )


def loaded_by(*words):
    code = f"import sys\nsys.argv = {['evenbreak', *words]!r}\nfrom evenbreak.cli import main\n"
    code += "try: main()\nexcept SystemExit: pass\n"
    code += "print('LOADED', *sorted(sys.modules), file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stderr.rpartition("LOADED")[2].split())


def test_help_lists_every_command_under_its_heading(run):
    output = run("--help").output
    assert all(f"\n{section}:\n" in output for section in SECTIONS)
    for name, entry in COMMANDS.items():
        assert f"{name} " in output
        assert entry.help in " ".join(output.split())


def test_help_imports_no_command():
    assert {name for name in loaded_by("--help") if name.startswith("evenbreak.cli.")} == {
        "evenbreak.cli.kit",
        "evenbreak.cli.kit.groups",
        "evenbreak.cli.program",
    }


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_of_the_table_exists(run, name):
    result = run(name, "--help")
    assert result.exit_code == 0
    assert f"Usage: evenbreak {name}" in result.output


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_says_what_it_is(name):
    command = program.get_command(click.Context(program), name)
    for option in command.params:
        assert isinstance(option, click.Argument) or option.help


def test_version(run):
    assert run("--version").output == f"evenbreak {__version__}\n"


def test_a_mistyped_command_gets_a_suggestion(run):
    for typed, meant in [("dril", "drill"), ("one-ball", "oneball"), ("brakes", "breaks")]:
        result = run(typed, "0.5")
        assert result.exit_code == 2
        assert f"No such command {typed!r}. Did you mean {meant!r}?" in result.stderr
    assert "Did you mean" not in run("xyzzy").stderr


@pytest.mark.parametrize("words", [(), ("nope",), ("--nope",), ("odds", "--nope")])
def test_wrong_use_ends_with_2_on_stderr(run, words):
    result = run(*words)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert "Usage:" in result.stderr


def test_errors_pass_through_where_the_caller_asks_for_them():
    with pytest.raises(click.UsageError, match="missing"):
        program.main(["odds", "1", "2"], standalone_mode=False)


def test_ctrl_c_ends_with_130(tmp_path):
    fifo = tmp_path / "arcs.csv"
    os.mkfifo(fifo)
    running = subprocess.Popen(
        [sys.executable, "-m", "evenbreak", "chain", str(fifo)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    with fifo.open("w", encoding="utf-8"):  # opens once the program has opened it to read
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=30)
    assert (running.returncode, out) == (130, "")
    assert err.strip() == "Interrupted."


def test_an_interrupt_caught_during_an_import_ends_with_130(tmp_path):
    """Python by itself would end `python -m` by a signal then."""
    (tmp_path / "stopped.py").write_text(
        "import sys\nfrom evenbreak import cli\nfrom evenbreak.cli.program import program\n"
        "def invoke(_):\n    exec('raise KeyboardInterrupt')\n"
        "program.invoke = invoke\nsys.argv[1:] = ['odds']\ncli.main()\n"
    )
    ended = subprocess.run(
        [sys.executable, "-m", "stopped"], cwd=tmp_path, capture_output=True, text=True
    )
    assert (ended.returncode, ended.stdout, ended.stderr.strip()) == (130, "", "Interrupted.")


def test_a_reader_that_leaves_is_not_an_error(tmp_path):
    arcs = tmp_path / "arcs.csv"
    rows = (f"{i},{i + 1},1\n" for i in range(20_000))
    arcs.write_text("source,target,probability\n" + "".join(rows), encoding="utf-8")
    command = f"{sys.executable} -m evenbreak chain {arcs} --steps 1 | head -n 1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True)  # noqa: S602
    assert done.stdout == "state,probability\n"
    assert "Error" not in done.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")
def test_a_full_disk_is_one_line():
    with open("/dev/full", "w") as full:  # noqa: PTH123
        done = subprocess.run(
            [sys.executable, "-m", "evenbreak", "--version"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
        )
    assert done.returncode == 1
    assert done.stderr == "Error: standard output: No space left on device\n"


def test_module_runs_as_a_program():
    done = run_program("chain", "-", input=ARCS)
    assert done.returncode == 0
    assert done.stdout == "state,probability\nS,0.0\nW,0.6\nL,0.4\n"


def test_output_is_utf_8_in_any_locale():
    arcs = ARCS.replace("W", "Ærø")
    done = run_program(
        "chain",
        "-",
        input=arcs,
        encoding="utf-8",
        env={**os.environ, "PYTHONIOENCODING": "ascii", "LC_ALL": "C"},
    )
    assert done.stdout == "state,probability\nS,0.0\nÆrø,0.6\nL,0.4\n"
