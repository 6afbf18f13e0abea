import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import click
import pytest

from evenbreak import __version__
from evenbreak.cli.kit.failures import report_error
from evenbreak.cli.program import COMMANDS, program
from evenbreak.errors import AccuracyError, ChainError, DataError, InputError

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


def test_help_lists_every_command_with_its_line(run):
    output = run("--help").output
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


def test_a_mistyped_command_is_answered_with_the_nearest(run):
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


@pytest.mark.parametrize(
    ("error", "code", "told"),
    [
        (InputError("p is 2; give less"), 2, "Error: p is 2; give less\n"),
        (DataError(["a.csv:2: x", "a.csv:3: y"]), 3, "Error: a.csv:2: x\nError: a.csv:3: y\n"),
        (ChainError("the state\n'A'"), 1, "Error: the state 'A'\n"),
        (AccuracyError("too stiff"), 1, "Error: too stiff\n"),
        (click.Abort(), 130, "Interrupted.\n"),
        (KeyboardInterrupt(), 130, "Interrupted.\n"),
        (click.UsageError("no"), 2, "Error: no\n"),
        (OSError(errno.ENOSPC, "No space left", "out.csv"), 1, "Error: out.csv: No space left\n"),
        (OSError(errno.EIO, "Input/output error"), 1, "Error: Input/output error\n"),
        (OSError("odd"), 1, "Error: odd\n"),
        (
            OverflowError(34, "Numerical result out of range"),
            1,
            "Error: the answer is beyond the largest number that a computer holds\n",
        ),
        (MemoryError(), 1, "Error: not enough memory for this question; ask a smaller one\n"),
    ],
)
def test_each_error_has_its_exit_code_and_a_line_for_each_problem(capsys, error, code, told):
    assert report_error(error) == code
    assert capsys.readouterr() == ("", told)


def broken_import(cause):
    """Return what an import makes of what happens in the midst of it."""
    try:
        try:
            raise cause
        except type(cause) as inner:
            raise RuntimeError("Error calling __set_name__ on 'cached_property'") from inner
    except RuntimeError as error:
        return error


def test_an_interrupt_is_one_whatever_an_import_makes_of_it(capsys):
    assert report_error(broken_import(KeyboardInterrupt())) == 130
    assert capsys.readouterr().err == "Interrupted.\n"
    with pytest.raises(RuntimeError, match="cached_property"):  # a fault of the program
        report_error(broken_import(ValueError()))


def test_errors_pass_through_where_the_caller_asks_for_them():
    with pytest.raises(click.UsageError, match="what is played is missing"):
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


def test_an_interrupt_that_somebody_caught_in_an_import_ends_with_130(tmp_path):
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


def test_a_reader_that_leaves_is_no_error_to_tell(tmp_path):
    arcs = tmp_path / "arcs.csv"
    rows = (f"{i},{i + 1},1\n" for i in range(20_000))
    arcs.write_text("source,target,probability\n" + "".join(rows), encoding="utf-8")
    command = f"{sys.executable} -m evenbreak chain {arcs} --steps 1 | head -n 1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True)  # noqa: S602
    assert (done.stdout, done.stderr) == ("state,probability\n", "")


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
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "state,probability\nS,0.0\nW,0.6\nL,0.4\n"


def test_output_is_utf_8_in_any_locale():
    arcs = ARCS.replace("W", "Ærø")
    done = program(
        "chain",
        "-",
        input=arcs,
        encoding="utf-8",
        env={**os.environ, "PYTHONIOENCODING": "ascii", "LC_ALL": "C"},
    )
    assert done.stdout == "state,probability\nS,0.0\nÆrø,0.6\nL,0.4\n"
