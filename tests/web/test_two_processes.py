"""Several programs on one file: whatever was acknowledged is in it, whoever opens and closes it."""

import itertools
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

from evenbreak.files.store.desk import PROPOSED, phone_entries
from evenbreak.files.store.team_night import read_team_events
from evenbreak.files.store.tournament import (
    add_events,
    new_tournament,
    read_events,
    read_tournament,
)
from evenbreak.teams.evening.fold import team_evening
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan, Scored
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.site import Site
from night_views import views_are_right
from tries import tries
from web.phones import Phone, free_port, running
from web.test_who_may import TEAMS

EVENINGS = tries("evenings of two processes", 1)
EVENINGS_OF_PHONES = tries("evenings of phones at two servers", 1)
NIGHTS = tries("team nights at two servers", 1)

AT = "2025-03-01T19:30:00"
MATCHES = 8

COMMANDS = """
import sys
from click.testing import CliRunner
from evenbreak.cli.program import program
from evenbreak.files.store.tournament import read_tournament
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
from evenbreak.files.store.desk import back_up
from evenbreak.files.store.tournament import read_tournament
path = sys.argv[1]
print("ready", flush=True)
while True:
    copy = back_up(path, datetime.now())
    read_tournament(copy)
    copy.unlink()
"""
HOLDS = """
import sys
from evenbreak.files.store.evening_file import opened
from evenbreak.files.store.tournament import read_tournament
path = sys.argv[1]
read_tournament(path)
with opened(path) as base:
    base.execute("SELECT * FROM entry").fetchall()
    print("open", flush=True)
    sys.stdin.read()
"""
EACH = """
import itertools
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
            sys.stderr.write("opened besides " + str(args) + chr(10))
sys.addaudithook(look)
"""


def begun(path: Path, *, in_place_of: int = 0) -> list[str]:
    """Start a tournament, and return the matches of its first round."""
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
    for _ in range(1500):  # a busy machine starts a program in ten seconds
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
        if phone.send("/desk/result", match=match, a=5, b=2).status == 200:
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


@pytest.mark.slow
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
    views_are_right(path)


@pytest.mark.slow
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
    views_are_right(path)


@pytest.mark.slow
def test_the_file_is_opened_through_sqlite_alone(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    code = WATCHED.format(path=os.path.realpath(path)) + SERVE
    own = {"entrants": path.read_bytes()}
    with server(path, code) as site:
        director = Phone(site, director=True)
        for page in ("/", "/desk", "/bracket", "/players", "/new", "/league", "/screen"):
            assert director.open(page).status == 200
        assert director.send("/desk/result", match="W1.1", a=5, b=2).status == 200
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
    assert "opened besides" not in said


def by_phones(sites: list[Site], match: str, kept: list[str]) -> None:
    """Let the two players of a match tap and propose, each at a server of their own."""
    pair = read_tournament(sites[0].path).pair(match)
    number = int(match.rpartition(".")[2])
    for side, site in enumerate(sites):
        phone = Phone(site, address=f"127.0.{side + 2}.{number}")
        assert phone.claims(pair[side]).status == 200
        for score in ((1, 0), (1, 1), (5, 2)):
            shown = phone.taps(match, *score)
            assert shown.status == 200, shown.words
            kept.append(f"{match} {side} {score}")


@pytest.mark.slow
def test_what_phones_are_told_at_two_servers_is_in_the_file(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    with running(path) as site, server(path) as second:
        for _ in range(EVENINGS_OF_PHONES):
            matches = begun(path, in_place_of=len(read_events(path)))
            kept: list[str] = []
            threads = [
                threading.Thread(target=by_phones, args=([site, second][::turn], match, kept))
                for match, turn in zip(matches, itertools.cycle((1, -1)))
            ]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            assert len(kept) == 6 * len(matches)
            state = read_tournament(path)
            assert {name: one.score for name, one in state.counted.items()} == dict.fromkeys(
                matches, (5, 2)
            )
            proposed = [one for one in phone_entries(path) if one.kind == PROPOSED]
            assert len(proposed) == 2 * len(matches)
            taps = [one.what for one in state.events if isinstance(one.what, Scored)]
            assert {one.match for one in taps} == {*matches}


@pytest.mark.slow
def test_what_captains_are_told_at_two_servers_is_in_the_file(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    with running(path) as site:
        director = Phone(site, director=True)
        assert director.send("/team/new", **TEAMS).status == 200
        with server(path) as second:
            for _ in range(NIGHTS):
                events = read_team_events(path)
                night = team_evening(events)
                assert night is not None
                phones = [Phone(at) for at in (site, second)]
                for side, phone in enumerate(phones):
                    pin = site.captain_pin(night.began, side)
                    assert phone.send("/team/pin", pin=pin).status == 200
                threads = [
                    threading.Thread(target=captain, args=(phone, side, night.began))
                    for side, phone in enumerate(phones)
                ]
                for thread in threads:
                    thread.start()
                for thread in threads:
                    thread.join()
                after = team_evening(read_team_events(path))
                assert after is not None
                assert [line.score for line in after.sets] == [(5, 3), (5, 3), (5, 3)]
                assert director.send("/team/new", **TEAMS).status == 200


def captain(phone: Phone, side: int, night: int) -> None:
    """Hand in a lineup, and propose every result, each form twice."""
    own = {"night": night, "by": side}
    picks = {f"pick{k}": k - 1 for k in (1, 2, 3)}
    for once in ("x", "x"):
        assert phone.send("/team/hand", **own, **picks, once=f"{once}{night}").status == 200
    other = 1 - side
    while phone.site and not both_in(phone.site.path, other):
        time.sleep(0.01)
    for number in (1, 2, 3):
        for once in ("y", "y"):
            fields = {**own, "number": number, "a": 5, "b": 3, "once": f"{once}{number}{night}"}
            shown = phone.send("/team/result", **fields)
            assert shown.status in (200, 400), shown.words


def both_in(path: Path, side: int) -> bool:
    state = team_evening(read_team_events(path))
    return state is not None and bool(state.sets[0].picks[side])
