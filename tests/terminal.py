"""A command run on a terminal, as a person would, and what the screen then shows.

Each is forked from a process that has loaded numpy, all of evenbreak and the like already, which
takes a small part of the time of a new start.
"""

import multiprocessing
import os
import re
import shlex
import struct
import subprocess
import sys
from collections.abc import Iterator
from multiprocessing.connection import wait
from pathlib import Path

import pytest

from places import SRC

LOADED = [
    *("jinja2", "matplotlib.backends.backend_agg", "matplotlib.backends.backend_pdf"),
    *("matplotlib.backends.backend_svg", "matplotlib.figure", "networkx", "numpy", "pandas"),
    *("rich.console", "scipy.optimize", "scipy.sparse.linalg", "scipy.special", "scipy.stats"),
    *(
        ".".join(module.relative_to(SRC.parent).with_suffix("").parts)
        for module in sorted(SRC.rglob("*.py"))
        if not module.name.startswith("__")
    ),
]
FOR_A_SHELL = re.compile(r"[|<>;&$]|^(?!evenbreak )")
LINES_AND_COLUMNS = struct.pack("HHHH", 40, 100, 0, 0)


def on_a_terminal(command: str) -> str:
    """Run a command line, which must end well, and return what the screen shows."""
    pty = pytest.importorskip("pty", reason="a terminal to look at needs a POSIX system")
    import fcntl
    import termios

    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(LOADED)
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, LINES_AND_COLUMNS)
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    environment = {**os.environ, "PATH": path, "NO_COLOR": "1", "TERM": "dumb", "PYTHONUTF8": "1"}
    environment.pop("COLUMNS", None)
    process = context.Process(
        target=_sit_down, args=(command, environment, str(Path.cwd()), os.ttyname(theirs))
    )
    process.start()
    shown = b"".join(_pieces(ours, process.sentinel))
    process.join()
    os.close(ours)
    os.close(theirs)
    text = shown.decode().replace("\r\n", "\n")
    assert process.exitcode == 0, text
    # Such a terminal has no bar: very long work says once that it goes on.
    return re.sub(r"(?m)^.* \((?:\d+%\), .*|.* so far) \.\.\.\n", "", text)


def _pieces(screen: int, end: int) -> Iterator[bytes]:
    """Yield what is shown until a process has ended and all is read."""
    while screen in wait([screen, end]):
        yield os.read(screen, 65536)


def _sit_down(command: str, environment: dict[str, str], place: str, terminal: str) -> None:
    """Type a command at a terminal; this process is then the shell or the program."""
    os.environ.clear()
    os.environ.update(environment)
    os.chdir(place)
    screen = os.open(terminal, os.O_RDWR | os.O_NOCTTY)
    os.dup2(screen, 1)
    os.dup2(screen, 2)
    if FOR_A_SHELL.search(command):
        sys.exit(subprocess.call(command, shell=True, stdin=subprocess.DEVNULL))  # noqa: S602
    sys.stdout = open(1, "w", buffering=1, encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stderr = open(2, "w", buffering=1, encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.argv = shlex.split(command.replace("\\\n", " "))
    from evenbreak.cli import main

    main()
