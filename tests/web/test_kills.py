"""The command itself: it starts soon, and a kill at any moment loses nothing acknowledged."""

import http.client
import random
import signal
import socket
import subprocess
import sys
import threading
import time
from contextlib import ExitStack
from datetime import datetime
from pathlib import Path

import pytest

from evenbreak.files.store.desk import back_up, kept_secrets
from evenbreak.files.store.tournament import new_tournament, read_tournament
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
from evenbreak.web.site import Site
from rows import posix
from tries import tries
from web.phones import Phone, free_port, running

KILLS = tries("kills", 1)


def begun(path: Path, players: int) -> None:
    entrants = tuple(Entrant(f"P{k}", 600.0 - k) for k in range(players))
    names = tuple(one.name for one in entrants)
    plan = Plan("single", 5, scale="fargo", tables=players)
    both = [Opened(plan, entrants), Drawn(names, tuple(range(players)))]
    new_tournament(path, [Event("2025-03-01T19:30:00", what) for what in both])


def started(path: Path, port: int) -> subprocess.Popen[bytes]:
    """Start the server, and wait until it answers."""
    words = [sys.executable, "-m", "evenbreak", "serve", str(path), "--port", str(port)]
    server = subprocess.Popen(words, cwd=path.parent)
    for _ in range(3000):
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", port)) == 0:
                return server
        assert server.poll() is None
        time.sleep(0.02)
    raise AssertionError("the server does not answer")


@pytest.mark.slow
@posix
@pytest.mark.parametrize("company", [False, True], ids=["alone", "beside another server"])
def test_a_killed_server_has_lost_nothing(tmp_path: Path, company: bool) -> None:
    path, port, luck = tmp_path / "tonight.db", free_port(), random.Random(1)
    begun(path, 256)
    matches = list(read_tournament(path).standing.to_play)
    acknowledged: set[str] = set()
    beside = ExitStack()
    other = Phone(beside.enter_context(running(path)), director=True) if company else None
    server = started(path, port)
    site = Site(path, address=f"http://127.0.0.1:{port}")
    phone = Phone(site, director=True)
    try:
        for _ in range(KILLS):
            moment = threading.Timer(luck.uniform(0.02, 0.4), server.kill)
            moment.start()
            while matches:
                try:
                    shown = phone.send("/desk/result", match=matches[0], a=5, b=2)
                except (OSError, http.client.HTTPException):
                    break
                assert shown.status == 200
                acknowledged.add(matches.pop(0))
                if other is not None and matches:
                    shown = other.send("/desk/result", match=matches[-1], a=2, b=5)
                    assert shown.status == 200
                    acknowledged.add(matches.pop())
            moment.join()
            server.wait()
            assert acknowledged <= set(read_tournament(path).counted)
            done = read_tournament(path).counted  # the last may be there though not acknowledged
            matches = [name for name in matches if name not in done] or sorted(
                set(read_tournament(path).standing.to_play)
            )
            server = started(path, port)
            # The same cookie is the director's still.
            assert phone.open("/desk").status == 200
        server.send_signal(signal.SIGINT)
        assert server.wait(10) in (0, 130)
    finally:
        server.kill()
        server.wait()
        beside.close()


def test_copies_of_one_second_are_all_kept(tmp_path: Path) -> None:
    path, now = tmp_path / "tonight.db", datetime(2025, 3, 1, 19, 30)
    begun(path, 4)
    copies = [back_up(path, now) for _ in range(3)]
    assert len({*copies}) == 3
    assert {read_tournament(copy).drawn for copy in copies} == {True}
    assert {one.name for one in tmp_path.glob("*20250301*")} == {one.name for one in copies}


@pytest.mark.slow
def test_secrets_are_kept_and_each_start_leaves_a_copy(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    begun(path, 4)
    first, second = Site(path), Site(path)
    assert (first.pin, first.cookie_key) == (second.pin, second.cookie_key)
    assert kept_secrets(path, {"pin": "x"})["pin"] == first.pin
    assert first.player_codes() == second.player_codes()
    server = started(path, free_port())
    server.terminate()
    server.wait(10)
    [copy] = tmp_path.glob("*.backup.db")
    assert read_tournament(copy).drawn
