"""A guest who opens connection after connection keeps nobody else out, and fills no terminal."""

import asyncio
import random
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing, suppress
from pathlib import Path
from types import SimpleNamespace
from typing import NamedTuple

import pytest

from evenbreak.web.server import KEPT, Door, in_few_lines
from tries import tries
from web.phones import free_port
from web.test_kills import begun

ATTACKER = "127.0.9.9"
SOON = 6.0  # seconds; a server that has no room answers nothing for 20 or more
ASKED = b"GET /evenbreak.css HTTP/1.1\r\nHost: 127.0.0.1\r\n"
STREAM = ASKED.replace(b"/evenbreak.css", b"/events") + b"\r\n"
BODY = ASKED.replace(b"GET /evenbreak.css", b"POST /pin") + b"Content-Length: 50\r\n\r\nx"

resource = pytest.importorskip("resource", reason="this system has no limits of descriptors")
pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="other systems have one loopback address"
)


class Served(NamedTuple):
    """A server in a process of its own."""

    port: int
    errors: Path

    def line(self, address: str, stack: ExitStack) -> socket.socket:
        """Return a connection from an address."""
        to = "127.0.0.1", self.port
        return stack.enter_context(socket.create_connection(to, 5, source_address=(address, 0)))

    def answers(self, address: str) -> bool:
        """Return whether an address gets a page soon."""
        until = time.monotonic() + SOON
        with suppress(OSError), ExitStack() as stack:
            line = self.line(address, stack)
            line.settimeout(max(until - time.monotonic(), 0.01))
            line.sendall(ASKED + b"Connection: close\r\n\r\n")
            return line.recv(100).startswith(b"HTTP/1.1 200")
        return False


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """A tournament, served by a process that may hold 256 descriptors and no more."""
    folder = tmp_path_factory.mktemp("flood")
    path, port = folder / "tonight.db", free_port()
    begun(path, 4)
    found = Served(port, folder / "errors.txt")
    serve = f"ulimit -n 256; exec {sys.executable} -m evenbreak serve {path}"
    with found.errors.open("wb") as errors:
        server = subprocess.Popen(["sh", "-c", f"{serve} --port {port}"], stderr=errors)
    try:
        until = time.monotonic() + 20.0
        while not found.answers("127.0.0.1"):
            assert server.poll() is None
            assert time.monotonic() < until
        yield found
    finally:
        server.terminate()
        server.wait(10)


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("sent", [b"", ASKED, ASKED + b"\r\n"], ids=["nothing", "half", "whole"])
def test_idle_connections_keep_nobody_out(server: Served, sent: bytes) -> None:
    with ExitStack() as stack:
        for _ in range(400):
            with suppress(OSError):
                server.line(ATTACKER, stack).sendall(sent)
        asked = ["127.0.0.1", "127.0.0.2", "127.0.0.3", ATTACKER]
        assert {address: server.answers(address) for address in asked} == dict.fromkeys(asked, True)
        assert server.errors.stat().st_size < 5000


@pytest.mark.slow
@pytest.mark.parametrize(
    "sent", [STREAM, BODY, ASKED + b"\r\n" + ASKED * 40], ids=["streams", "bodies", "many"]
)
def test_connections_that_stay_busy_keep_nobody_else_out(server: Served, sent: bytes) -> None:
    with ExitStack() as stack:
        for _ in range(400):
            with suppress(OSError):
                server.line(ATTACKER, stack).sendall(sent)
        assert all(server.answers(address) for address in ("127.0.0.1", "127.0.0.2"))
        assert server.errors.stat().st_size < 5000


def test_no_mix_of_connections_keeps_others_out(server: Served) -> None:
    whole = ASKED + b"\r\n"
    for seed in range(tries("floods of connections", 2)):
        luck = random.Random(seed)
        kinds = luck.choices([b"", ASKED, whole, STREAM, BODY, whole + ASKED * 40], k=3)
        with ExitStack() as stack:
            for _ in range(luck.randrange(200, 400)):
                with suppress(OSError):
                    server.line(ATTACKER, stack).sendall(luck.choice(kinds))
            for address in ("127.0.0.1", f"127.0.3.{seed % 200 + 1}"):
                assert server.answers(address), (seed, address)
    assert server.errors.stat().st_size < 5000


def test_a_room_full_of_phones_is_served_at_a_low_limit(server: Served) -> None:
    with ExitStack() as stack:
        for k in range(140):  # each holds its connection, as browsers do
            line = server.line(f"127.0.2.{k + 1}", stack)
            line.sendall(ASKED + b"\r\n")
            assert line.recv(20).startswith(b"HTTP/1.1 200"), k
        assert server.answers("127.0.0.1")
        assert server.errors.stat().st_size < 5000


@pytest.mark.slow
def test_more_descriptors_are_asked_for() -> None:
    ask = "from evenbreak.web.server import descriptors; print(descriptors())"
    words = ["sh", "-c", f"ulimit -Sn 128; exec {sys.executable} -c '{ask}'"]
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    assert int(subprocess.check_output(words)) == min(hard, 4096)


@pytest.mark.slow
def test_that_no_more_can_connect_is_said_once_a_minute(caplog: pytest.LogCaptureFixture) -> None:
    times = iter([0.0] * 2 + [30.0] * 500 + [61.0] * 2)
    handle = in_few_lines(lambda: next(times))
    context = {
        "message": "socket.accept() out of system resource",
        "exception": OSError(24, "Too many open files"),
    }
    with closing(asyncio.new_event_loop()) as loop:
        for _ in range(502):
            handle(loop, context)
        assert len(caplog.records) == 2
        assert not caplog.records[0].exc_info
        handle(loop, {"message": "something else failed"})
    assert caplog.records[-1].getMessage() == "something else failed"


class Line:
    """A connection that has asked for nothing, or waits for an answer."""

    def __init__(self, address: str, *, busy: bool = False) -> None:
        self.client = address, 5000
        self.cycle = SimpleNamespace(response_complete=False) if busy else None
        self.transport = self
        self.ended = False

    def abort(self) -> None:
        self.ended = True


@pytest.mark.slow
def test_one_address_takes_half_at_most_even_if_all_its_connections_are_busy() -> None:
    door = Door(100, frozenset({"127.0.0.1"}))
    assert [door.lets_in(Line("10.0.0.7", busy=True)) for _ in range(60)].count(True) == 50
    assert all(door.lets_in(Line(f"10.0.1.{k}", busy=True)) for k in range(50 - KEPT))
    assert not door.lets_in(Line("10.0.0.8", busy=True))  # what is left is this computer's
    assert all(door.lets_in(Line("127.0.0.1", busy=True)) for _ in range(KEPT))


@pytest.mark.slow
def test_the_connection_that_has_been_idle_longest_makes_room() -> None:
    door = Door(100, frozenset())
    lines = [Line("10.0.0.7") for _ in range(50)]
    assert all(map(door.lets_in, lines))
    door.answered(lines[0])
    assert door.lets_in(Line("10.0.0.7"))
    assert [line.ended for line in lines[:3]] == [False, True, False]
