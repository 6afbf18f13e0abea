"""The program as a whole: its help, its exit codes, its streams."""

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import click
import pytest

from evenbreak import __version__
from evenbreak.cli.program import COMMANDS, SECTIONS, program
from rows import each_of, posix

ARCS = "source,target,probability\nS,W,0.6\nS,L,0.4\n"


def run_program(*words, **options):
    return subprocess.run(
        [sys.executable, "-m", "evenbreak", *words], capture_output=True, text=True, **options
    )


def loaded_by(*words, **options):
    code = f"import sys\nsys.argv = {['evenbreak', *words]!r}\nfrom evenbreak.cli import main\n"
    code += "try: main()\nexcept SystemExit: pass\n"
    code += "print('LOADED', *sorted(sys.modules), file=sys.stderr)"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, **options
    )
    return set(done.stderr.rpartition("LOADED")[2].split())


def test_help_lists_every_command_under_its_heading(run):
    output = run("--help").output
    assert all(f"\n{section}:\n" in output for section in SECTIONS)
    for name, entry in COMMANDS.items():
        assert f"{name} " in output
        assert entry.help in " ".join(output.split())


def test_help_imports_no_command():
    assert {name for name in loaded_by("--help") if name.startswith("evenbreak.cli.")} == {
        "evenbreak.cli.interrupts",
        "evenbreak.cli.kit",
        "evenbreak.cli.kit.groups",
        "evenbreak.cli.program",
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "content", "needed"),
    [
        ("arcs.csv", ARCS, set()),
        ("matrix.mtx", "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n", set()),
        (
            "graph.json",
            '{"directed": true, "nodes": [{"id": "S"}],'
            ' "edges": [{"source": "S", "target": "S", "probability": 1}]}',
            {"networkx"},
        ),
    ],
    ids=["arcs", "matrix", "graph"],
)
def test_a_chain_loads_what_its_form_needs(file, content, needed, tmp_path):
    (tmp_path / file).write_text(content)
    loaded = loaded_by("chain", file, "--steps", "2", cwd=tmp_path)
    assert "evenbreak.chains.limits" in loaded
    assert loaded & {"pandas", "networkx", "matplotlib", "jinja2", "rich"} == needed


@each_of("name", COMMANDS)
def test_every_command_of_the_table_exists(run, name):
    result = run(name, "--help")
    assert result.exit_code == 0
    assert f"Usage: evenbreak {name}" in result.output


@each_of("name", COMMANDS)
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


def interrupted(running, times=10):
    """Interrupt a program that waits for input, again if the wait began just after the signal."""
    for _ in range(times):
        running.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            return running.communicate(timeout=3)
    running.kill()
    return running.communicate()


def opened_by(running, fifo):
    """Return the end that writes, once the program has opened the other one to read."""
    while running.poll() is None:
        with contextlib.suppress(OSError):
            return os.fdopen(os.open(fifo, os.O_WRONLY | os.O_NONBLOCK), "w")
        time.sleep(0.01)
    raise AssertionError(running.communicate())


@pytest.mark.slow
@posix
def test_ctrl_c_ends_with_130(tmp_path):
    fifo = tmp_path / "arcs.csv"
    os.mkfifo(fifo)
    running = subprocess.Popen(
        [sys.executable, "-m", "evenbreak", "chain", str(fifo)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    with opened_by(running, fifo):
        out, err = interrupted(running)
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


SWALLOWED = """
import os, signal, sys, time
from evenbreak import cli
from evenbreak.cli.kit.terminal import write
from evenbreak.cli.program import program
def invoke(_):
    {happens}
    write("went on")
program.invoke = invoke
sys.argv[1:] = ["odds"]
cli.main()
"""


@posix
@pytest.mark.parametrize(
    "happens",
    [
        "import swallows; time.sleep(5)",  # in an import: it waits, and comes right after
        "type('X', (), {'__del__': lambda _: os.kill(os.getpid(), signal.SIGINT)})()",
    ],
)
def test_an_interrupt_that_something_swallows_ends_the_run(tmp_path, happens):
    (tmp_path / "swallows.py").write_text(
        "import os, signal, time\ntry:\n os.kill(os.getpid(), signal.SIGINT)\n time.sleep(0.1)\n"
        "except BaseException: pass\n"
    )
    (tmp_path / "run.py").write_text(SWALLOWED.format(happens=happens))
    begun = time.monotonic()
    ended = subprocess.run([sys.executable, "run.py"], cwd=tmp_path, capture_output=True, text=True)
    assert (ended.returncode, ended.stdout) == (130, "")
    assert ended.stderr.endswith("Interrupted.\n")
    assert time.monotonic() - begun < 4.5


IN_C = """
import sys
import numpy as np
def invoke(_):
    print("begins", flush=True)
    np.linalg.eigvals(np.random.default_rng(1).random((2500, 2500)))
    print("went on")
from evenbreak import cli
from evenbreak.cli.program import program
program.invoke = invoke
sys.argv[1:] = ["odds"]
cli.main()
"""


@pytest.mark.slow
@posix
def test_an_interrupt_ends_a_long_call_into_c_at_once():
    """Python itself would raise nothing before LAPACK returns, many seconds later."""
    running = subprocess.Popen(
        [sys.executable, "-c", IN_C], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert running.stdout is not None
    running.stdout.readline()
    time.sleep(0.5)
    begun = time.monotonic()
    running.send_signal(signal.SIGINT)
    out, err = running.communicate(timeout=60)
    assert (running.returncode, out, err) == (130, "", "Interrupted.\n")
    assert time.monotonic() - begun < 2.0


def test_python_m_runs_no_code_of_the_working_folder(tmp_path):
    for name in ("click", "pickle", "numpy", "difflib"):
        (tmp_path / f"{name}.py").write_text("print('run')\n", encoding="utf-8")
    done = run_program("odds", "60", "50", "--race", "7", cwd=tmp_path)
    assert done.returncode == 0
    assert "run" not in done.stdout


@pytest.mark.slow
@posix
@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize(
    "words", ["--help", "odds 60 50 --race 7", "odds x y", "drill --p 0.8 --plot d.svg", "chain -"]
)
def test_closed_streams_are_no_bug(tmp_path, words, closed):
    command = f"{sys.executable} -m evenbreak {words} {closed}"
    done = subprocess.run(command, shell=True, cwd=tmp_path, capture_output=True, text=True)  # noqa: S602
    assert done.returncode in (0, 2, 3)
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    if words.endswith("svg"):
        assert (tmp_path / "d.svg").read_bytes().endswith(b"</svg>\n")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("MPLBACKEND", "absent"),
        ("MPLBACKEND", "module://absent.inline"),
        ("SOURCE_DATE_EPOCH", "yesterday"),
    ],
)
def test_settings_of_matplotlib_in_the_environment_do_not_matter(tmp_path, name, value):
    words = ("drill", "--p", "0.8", "--plot", "d.svg", "--text")
    done = run_program(*words, cwd=tmp_path, env={**os.environ, name: value})
    assert (done.returncode, done.stderr) == (0, "Wrote d.svg\n")


@posix
def test_a_working_folder_that_is_gone_does_not_matter(tmp_path):
    command = f"mkdir gone; cd gone; rmdir ../gone; {sys.executable} -m evenbreak --version"
    done = subprocess.run(command, shell=True, cwd=tmp_path, capture_output=True, text=True)  # noqa: S602
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.slow
def test_somebodys_matplotlibrc_changes_nothing(tmp_path):
    words = ("drill", "--p", "0.8", "--plot", "d.svg", "--text")
    pictures = []
    for settings in ("", "text.usetex: True\nfont.size: 30\naxes.facecolor: red\n"):
        (tmp_path / "matplotlibrc").write_text(settings)
        done = run_program(*words, cwd=tmp_path)
        assert (done.returncode, done.stderr) == (0, "Wrote d.svg\n")
        pictures.append((tmp_path / "d.svg").read_bytes())
    assert pictures[0] == pictures[1]


@pytest.mark.slow
def test_a_matplotlibrc_that_is_no_text_is_one_line(tmp_path):
    (tmp_path / "matplotlibrc").write_bytes(b"\xff\xfe")
    done = run_program("drill", "--p", "0.8", "--plot", "d.svg", "--text", cwd=tmp_path)
    assert done.returncode == 2
    assert "remove the file matplotlibrc" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
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


@pytest.mark.slow
def test_module_runs_as_a_program():
    done = run_program("chain", "-", input=ARCS)
    assert done.returncode == 0
    assert done.stdout == "state,probability\nS,0.0\nW,0.6\nL,0.4\n"


@pytest.mark.slow
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


@pytest.mark.parametrize(
    ("words", "same"), [(["help"], ["--help"]), (["help", "odds"], ["odds", "--help"])]
)
def test_help_needs_no_dashes(run, words, same):
    assert run(*words).stdout == run(*same).stdout


def test_version_needs_no_dashes(run):
    assert run("version").stdout == run("--version").stdout
