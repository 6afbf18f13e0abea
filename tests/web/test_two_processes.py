"""Several programs on one file: whatever was acknowledged is in it, whoever opens and closes it."""

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from evenbreak.files.tournament_store import (
    add_events,
    new_tournament,
    read_events,
    read_tournament,
)
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.site import Site
from tries import tries
from web.phones import Phone, free_port, running

EVENINGS = tries("evenings of two processes", 1)

AT = "2025-03-01T19:30:00"
MATCHES = 8

COMMANDS = """
import sys
from click.testing import CliRunner
from evenbreak.cli.program import program
from evenbreak.files.tournament_store import read_tournament
path = sys.argv[1]
print("ready", flush=True)
while True:
    ran = CliRunner().invoke(program, ["tournament", "next", "--file", path])
    assert ran.exit_code == 0, ran.output
    read_tournament(path)
"""
BACKUPS = """
import sys
from datetime import datetime
from evenbreak.files.tournament_desk import back_up
from evenbreak.files.tournament_store import read_tournament
path = sys.argv[1]
print("ready", flush=True)
while True:
    copy = back_up(path, datetime.now())
    read_tournament(copy)
    copy.unlink()
"""
HOLDS = """
import sys
from evenbreak.files.evening_file import opened
from evenbreak.files.tournament_store import read_tournament
path = sys.argv[1]
read_tournament(path)
with opened(path) as base:
    base.execute("SELECT * FROM event").fetchall()
    print("open", flush=True)
    sys.stdin.read()
"""
EACH = """
import json
from click.testing import CliRunner
from evenbreak.cli.program import program
for words in json.loads(sys.argv[1]):
    CliRunner().invoke(program, ["tournament", *words])
"""
COMMANDS_OF_A_FILE = (
    ("show", "--file", "{path}"),
    ("result", "W1.2", "5:1", "--file", "{path}"),
    ("undo", "--file", "{path}"),
    ("import", "{path}", "--out", "{path}.new"),
    ("export", "--events", "--file", "{path}"),
    ("prizes", "--fee", "20", "--file", "{path}"),
)
SERVE = "from evenbreak.cli import main; main()"
WATCHED = """
import os, sys
def look(event, args):
    if event == "open" and isinstance(args[0], (str, bytes, os.PathLike)):
        if os.path.realpath(os.fsdecode(args[0])).startswith({path!r}):
            sys.stderr.write("opened " + str(args) + chr(10))
sys.addaudithook(look)
"""


def begun(path: Path, *, in_place_of: int = 0) -> list[str]:
    """Begin a tournament, and return the matches of its first round."""
    entrants = tuple(Entrant(f"P{k}", 600.0 - k) for k in range(2 * MATCHES))
    names = tuple(one.name for one in entrants)
    plan = Plan("single", 5, scale="fargo", tables=MATCHES)
    both = [Opened(plan, entrants), Drawn(names, tuple(range(len(names))))]
    state = new_tournament(path, [Event(AT, what) for what in both], in_place_of=in_place_of)
    return list(state.standing.to_play)


@contextmanager
def companion(log: Path, *words: str) -> Iterator[subprocess.Popen[str]]:
    """Run another program until the block ends; it must still run then. It complains to `log`."""
    with log.open("w") as complaints:
        program = subprocess.Popen(
            [sys.executable, *words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=complaints,
            text=True,
        )
    try:
        yield program
        assert program.poll() is None, log.read_text()
    finally:
        program.kill()
        program.communicate()


@contextmanager
def server(path: Path, code: str = SERVE) -> Iterator[Site]:
    """Serve a file by a process of its own, which complains to `log` beside it."""
    port = free_port()
    site = Site(path, address=f"http://127.0.0.1:{port}")
    with companion(path.with_name("log"), "-c", code, "serve", str(path), "--port", str(port)):
        until_it_answers(Phone(site))
        yield site


def until_it_answers(phone: Phone) -> None:
    """Wait for a server that starts."""
    for _ in range(300):
        try:
            phone.open("/pin")
        except OSError:
            time.sleep(0.02)
        else:
            return
    raise AssertionError("the server does not answer")


def enter(phone: Phone, matches: list[str], acknowledged: list[str]) -> None:
    """Enter results at one server, and look at its pages."""
    for match in matches:
        if phone.send("/desk/result", match=match, a=5, b=2, how="new").status == 200:
            acknowledged.append(match)
        phone.open("/")


def play(path: Path, phones: list[Phone]) -> None:
    """Play evenings, with results entered by several phones at once, and look for all of them."""
    for _ in range(EVENINGS):
        matches = begun(path, in_place_of=len(read_events(path)))
        acknowledged: list[str] = []
        threads = [
            threading.Thread(target=enter, args=(phone, matches[k :: len(phones)], acknowledged))
            for k, phone in enumerate(phones)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert sorted(acknowledged) == sorted(matches)
        assert set(acknowledged) <= set(read_tournament(path).counted)


@pytest.mark.parametrize("company", ["a server", "commands", "backups"])
def test_nothing_acknowledged_is_lost_in_company(tmp_path: Path, company: str) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    with running(path) as site:
        phones = [Phone(site, director=True), Phone(site, director=True)]
        if company == "a server":
            with server(path) as second:
                play(path, [phones[0], Phone(second, director=True)])
        else:
            loop = COMMANDS if company == "commands" else BACKUPS
            with companion(tmp_path / "log", "-c", loop, str(path)) as program:
                assert program.stdout is not None
                assert program.stdout.readline() == "ready\n"
                play(path, phones)


def test_a_page_and_a_command_in_the_middle_of_an_entry_take_nothing_away(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    matches = begun(path)
    with ExitStack() as others:

        def decide(_: Evening) -> list[Event]:
            state = read_tournament(path)  # a phone of this process asks for a page
            program = others.enter_context(companion(tmp_path / "log", "-c", HOLDS, str(path)))
            assert program.stdout is not None
            assert program.stdout.readline() == "open\n"
            return [Event(AT, moves.result(state, matches[0], (5, 2)))]

        add_events(path, decide)
        assert matches[0] in read_tournament(path).counted
    assert matches[0] in read_tournament(path).counted


def test_the_file_is_opened_through_sqlite_alone(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    code = WATCHED.format(path=os.path.realpath(path)) + SERVE
    own = {"entrants": path.read_bytes()}
    with server(path, code) as site:
        director = Phone(site, director=True)
        for page in ("/", "/desk", "/bracket", "/players", "/new", "/league", "/screen"):
            assert director.open(page).status == 200
        assert director.send("/desk/result", match="W1.1", a=5, b=2, how="new").status == 200
        assert director.send_files("/new", own, format="double").status == 400
    said = (tmp_path / "log").read_text()
    asked = [[word.format(path=path) for word in words] for words in COMMANDS_OF_A_FILE]
    commands = f"{WATCHED.format(path=os.path.realpath(path))}\n{EACH}"
    ran = subprocess.run(
        [sys.executable, "-c", commands, json.dumps(asked)],
        check=True,
        capture_output=True,
        text=True,
    )
    said += ran.stderr
    assert "opened" not in said
