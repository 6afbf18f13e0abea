"""Whether phones at the venue can open the page, and at which of this computer's addresses."""

from __future__ import annotations

import asyncio
import socket
import sys
from collections.abc import Callable, Collection, Iterator
from contextlib import suppress
from ipaddress import IPv4Address
from typing import Protocol

from evenbreak.web.guard import RefusalError

_IOCTLS = {"linux": 0x8915, "darwin": 0xC0206921}  # SIOCGIFADDR: the address of an adapter
_NO_ROOM = ("docker", "br-", "veth", "virbr", "tun", "utun", "wg", "tailscale")
"""Names of network adapters that no phone can reach: containers, virtual machines, tunnels."""


class Listening(Protocol):
    """Starts and stops listening on addresses."""

    async def listen_at(self, address: str) -> asyncio.Server:
        """Also listen on this one of the computer's addresses."""

    def leave(self, at: str, server: asyncio.Server) -> None:
        """Stop listening there, and close the connections that came in there."""


class Room:
    """The addresses where phones are let in: none until it is opened.

    `asked_as` are this computer's names in requests, to which names for phones are added;
    `found_at` is called with each new page address. `name` is where phones find the page (and at
    which port) if not at these addresses, as in a container.
    """

    def __init__(
        self,
        asked_as: set[str],
        found_at: Callable[[str], object],
        port: int,
        server: Listening,
        name: str = "",
    ) -> None:
        self.asked_as, self.found_at = asked_as, found_at
        self.port, self.server, self.name = port, server, name
        self.open_at: dict[str, asyncio.Server] = {}
        self._added: set[str] = set()
        self._turn = asyncio.Lock()

    @property
    def here(self) -> str:
        """The page's address for this computer's own browser."""
        return f"http://127.0.0.1:{self.port}"

    @property
    def places(self) -> list[str]:
        """The page's addresses for phones, likeliest first."""
        return places_of(self.open_at, self.port, self.name)

    async def open(self) -> None:
        """Let phones in; raises RefusalError without a network, or if the port is taken there."""
        async with self._turn:
            self._close()  # the network may be another one by now
            await self._open()

    async def close(self) -> None:
        """Let only this computer in."""
        async with self._turn:
            self._close()

    async def _open(self) -> None:
        there = await asyncio.to_thread(addresses)
        if not there:
            raise RefusalError("This computer isn't on a network. Join the room's Wi-Fi first.")
        why = ""
        for one in there:
            try:
                self.open_at[one] = await self.server.listen_at(one)
            except OSError as error:
                why = error.strerror or str(error)
        if not self.open_at:
            raise RefusalError("Phones can't be let in: {why}", why=why)
        own = socket.gethostname().lower()
        named = {self.name.partition(":")[0]} if self.name else {own, f"{own}.local"}
        self._added = {*self.open_at, *named} - self.asked_as
        self.asked_as |= self._added
        self.found_at(self.places[0])

    def _close(self) -> None:
        for address, server in self.open_at.items():
            self.server.leave(address, server)
        self.open_at = {}
        self.asked_as -= self._added
        self._added = set()
        self.found_at(self.here)


def places_of(there: Collection[str], port: int, name: str) -> list[str]:
    """Return where phones find the page: under a name if it has one, else at each address.

    >>> places_of(["192.168.1.20"], 8000, ""), places_of(["172.17.0.2"], 8000, "pool.example")
    (['http://192.168.1.20:8000'], ['http://pool.example:8000'])
    """
    named = [name if ":" in name else f"{name}:{port}"] if name else []
    return [f"http://{one}" for one in named or [f"{one}:{port}" for one in there]] if there else []


def addresses() -> list[str]:
    """Return this computer's network addresses, starting with the route to the internet."""
    found = [*_leading(), *_of_adapters(), *_of_name()]
    own = [one for one in dict.fromkeys(found) if _may_be_asked(one)]
    return [one for one in own if not IPv4Address(one).is_link_local] or own


def _may_be_asked(address: str) -> bool:
    given = IPv4Address(address)
    return not (given.is_loopback or given.is_unspecified or given.is_multicast)


def _leading() -> Iterator[str]:
    """Yield the address this computer would use to reach the internet; nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe, suppress(OSError):
        probe.connect(("192.0.2.1", 9))
        yield str(probe.getsockname()[0])


def _of_adapters() -> Iterator[str]:
    """Yield each adapter's address, if the system can be asked for it."""
    if sys.platform == "win32" or sys.platform not in _IOCTLS:
        return
    from fcntl import ioctl

    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        for _, name in socket.if_nameindex():
            with suppress(OSError):  # it has none
                if not name.startswith(_NO_ROOM):
                    asked = name.encode().ljust(40, b"\0")
                    yield socket.inet_ntoa(ioctl(probe, _IOCTLS[sys.platform], asked)[20:24])


def _of_name() -> Iterator[str]:
    """Yield the addresses for this computer's name: on Windows, one per adapter."""
    if sys.platform not in _IOCTLS:
        with suppress(OSError):
            yield from socket.gethostbyname_ex(socket.gethostname())[2]
