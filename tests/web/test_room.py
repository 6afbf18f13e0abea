"""A page for this computer only, until the director lets the phones of the room in."""

import asyncio
import http.client
import socket
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from threading import Thread
from typing import Any
from unittest.mock import patch

import pytest

from evenbreak.web import room
from evenbreak.web.server import server_of
from evenbreak.web.site import Site
from web.phones import Phone, free_port, running

ROOM = "127.0.0.77"  # a second address of this computer, as that in a room's network is


@pytest.fixture
def at_room() -> Iterator[None]:
    with patch.object(room, "addresses", return_value=[ROOM]):
        yield


def answers(port: int, *, host: str = ROOM) -> int | None:
    """Return how the page answers at the room's address; None: nobody listens there."""
    line = http.client.HTTPConnection(ROOM, port, timeout=5)
    with closing(line), suppress(ConnectionError):
        line.request("GET", "/", headers={"Host": f"{host}:{port}"})
        with line.getresponse() as got:
            return got.status
    return None


@pytest.mark.usefixtures("at_room")
def test_phones_are_let_in_and_shut_out_while_the_page_runs(tmp_path: Path) -> None:
    with running(tmp_path / "tonight.db") as site:
        director, home = Phone(site, director=True), site.address
        port = int(home.rpartition(":")[2])
        assert "only this computer" in director.open("/desk/phones").words
        assert answers(port) is None
        shown = director.send("/desk/phones", open="yes")
        assert f"{ROOM}:{port}" in shown.words
        assert "<svg" in shown.text
        assert answers(port) == 200
        assert answers(port, host="evil.example") == 421
        assert site.address == f"http://{ROOM}:{port}"  # where codes and the wall lead

        stream = socket.create_connection((ROOM, port), 5)
        stream.sendall(f"GET /events HTTP/1.1\r\nHost: {ROOM}\r\n\r\n".encode())
        assert stream.recv(99)
        site.address = home  # where this computer's own browser stays
        guest = Phone(site, director=True, address="127.0.0.78")
        refused = guest.send("/desk/phones")
        assert refused.status == 409  # it would shut itself out
        assert home in refused.words
        assert home in guest.open("/desk/phones").words
        assert "Only this computer" in director.send("/desk/phones").words
        assert site.address == home
        with suppress(ConnectionError):
            while stream.recv(999):  # what was open there ends
                pass
        stream.close()
        assert answers(port) is None
        assert ROOM not in site.asked_as
        assert director.open("/desk/phones").status == 200


@pytest.mark.slow
@pytest.mark.usefixtures("at_room")
@pytest.mark.parametrize("name", ["", "pool.example:80"])
def test_lan_lets_them_in_from_the_start(tmp_path: Path, name: str) -> None:
    port, told = free_port(), list[str]()
    site = Site(tmp_path / "tonight.db", address=f"http://127.0.0.1:{port}")
    with started(site, port, told, name):
        assert answers(port) == 200
        assert answers(port, host="pool.example") == (200 if name else 421)
        assert told == [site.address] == [f"http://{name or f'{ROOM}:{port}'}"]


@pytest.mark.usefixtures("at_room")
def test_why_phones_cannot_be_let_in_is_said(tmp_path: Path) -> None:
    with running(tmp_path / "t.db") as site, socket.socket() as other:
        other.bind((ROOM, int(site.address.rpartition(":")[2])))
        other.listen()
        director = Phone(site, director=True)
        assert "already in use" in director.send("/desk/phones", open="yes").words
        with patch.object(room, "addresses", return_value=[]):
            assert "isn't on a network" in director.send("/desk/phones", open="yes").words


@pytest.mark.usefixtures("at_room")
def test_two_who_let_phones_in_at_once_both_do(tmp_path: Path) -> None:
    async def both() -> list[str]:
        server: Any = server_of(Site(tmp_path / "t.db"), port=free_port())
        server.servers = []
        let: room.Room = server.config.app.state.site.room
        await asyncio.gather(let.open(), let.open(), let.close(), let.open())
        places = let.places
        assert len(server.servers) == 1
        await let.close()
        return places

    (place,) = asyncio.run(both())
    assert ROOM in place


@contextmanager
def started(site: Site, port: int, told: list[str], name: str) -> Iterator[None]:
    server = server_of(site, port=port, lan=True, name=name, then=lambda: told.append(site.address))
    thread = Thread(target=server.run, daemon=True)
    thread.start()
    until = time.monotonic() + 10
    while not told and time.monotonic() < until:
        time.sleep(0.01)
    yield
    server.should_exit = True
    thread.join(10)


@pytest.mark.parametrize(
    ("adapters", "named", "found"),
    [
        (["192.168.1.20"], [], ["192.168.1.20"]),
        (["192.168.1.20", "10.0.0.5"], ["192.168.1.20"], ["192.168.1.20", "10.0.0.5"]),
        (["127.0.0.1", "169.254.3.4", "10.0.0.5"], [], ["10.0.0.5"]),
        (["169.254.3.4"], ["127.0.1.1"], ["169.254.3.4"]),  # two computers and a cable
        ([], ["0.0.0.0"], []),  # noqa: S104
    ],
)
def test_every_address_that_phones_may_reach_is_named(
    adapters: list[str], named: list[str], found: list[str]
) -> None:
    with (
        patch.object(room, "_leading", return_value=adapters[:1]),
        patch.object(room, "_of_adapters", return_value=adapters[::-1]),
        patch.object(room, "_of_name", return_value=named),
    ):
        assert room.addresses() == found


def test_this_computer_has_the_address_of_its_adapter() -> None:
    for one in room.addresses():
        with socket.socket() as probe:
            probe.bind((one, 0))
