"""The server that the application runs in: its limits, and how connections are closed.

A phone that opens connection after connection must not keep others out: each address may have half
of all connections, the last few are reserved for this computer, and when none are left the
connection that has been idle longest is closed.
"""

from __future__ import annotations

import asyncio
import logging
import socket
import sys
import time
from collections.abc import Callable, Collection, Iterable
from concurrent.futures import ThreadPoolExecutor
from threading import Thread
from typing import Any

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

from evenbreak.web.app import make_app
from evenbreak.web.guard import MOST_HEAD
from evenbreak.web.room import Room
from evenbreak.web.site import Site

_LOG = logging.getLogger(__name__)

KEPT = 16
"""How many connections are reserved for this computer."""

_MOST = 1000
_WANTED = 4096  # descriptors
_FILES = 48  # descriptors that the database, uploads and the program itself may need at once
_TURNS = 5  # of the event loop, until a refused connection is closed
_SECONDS = 60.0
_READERS = 2  # threads for what is read and written: more hold one another up, and memory
_QUEUE = 1024  # connections that wait to be let in
_IDLE = 200  # tenths of a second


def server_of(
    site: Site,
    *,
    port: int,
    lan: bool = False,
    name: str = "",
    then: Callable[[], object] | None = None,
) -> uvicorn.Server:
    """Return a site's server, which listens on this computer and, with `lan`, for phones.

    `name` is as for `Room`; `then` is called in a thread once it listens.
    """
    # It warns of each form that is cut or wrong, which any guest can send.
    logging.getLogger("python_multipart").setLevel(logging.ERROR)
    most, at_a_turn = room(descriptors())
    config = uvicorn.Config(
        make_app(site, streams=most // 2),
        host="127.0.0.1",
        port=port,
        http=behind(Door(most, site.asked_as)),
        ws="none",
        lifespan="off",
        proxy_headers=False,
        log_level="error",
        access_log=False,
        server_header=False,
        timeout_keep_alive=20,
        timeout_graceful_shutdown=3,
        backlog=at_a_turn,
        h11_max_incomplete_event_size=MOST_HEAD,
    )
    server = _Server(config)
    site.room = Room(site.asked_as, site.found_at, port, server, name)
    server.room, server.then = site.room if lan else None, then
    return server


class _Server(uvicorn.Server):
    """A server that closes its pages' streams before it stops, and closes idle connections.

    Otherwise, a phone that requests nothing, or never finishes a request, would keep its connection
    as long as it likes, and so would a phone that has left the venue.
    """

    def __init__(self, config: uvicorn.Config) -> None:
        super().__init__(config)
        self._idle: dict[Any, Any] = {}
        self.room: Room | None = None
        self.then: Callable[[], object] | None = None

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start to listen."""
        loop = asyncio.get_running_loop()
        loop.set_exception_handler(in_few_lines())
        loop.set_default_executor(ThreadPoolExecutor(_READERS))
        await super().startup(sockets)
        _let_many_wait(self.servers)
        if self.room is not None:
            await self.room.open()
        if self.then is not None:
            Thread(target=self.then, daemon=True).start()

    async def listen_at(self, address: str) -> asyncio.Server:
        """Listen on another of this computer's addresses."""
        config = self.config

        def line() -> asyncio.Protocol:
            kind: Any = config.http_protocol_class
            made: asyncio.Protocol = kind(
                config=config, server_state=self.server_state, app_state=self.lifespan.state
            )
            return made

        found = await asyncio.get_running_loop().create_server(
            line, host=address, port=config.port, backlog=config.backlog
        )
        _let_many_wait([found])
        self.servers.append(found)
        return found

    def leave(self, at: str, server: asyncio.Server) -> None:
        """Stop listening on an address, and close the connections that came in there."""
        server.close()
        self.servers.remove(server)
        lines: set[Any] = self.server_state.connections
        for line in list(lines):
            if line.transport.get_extra_info("sockname", ("",))[0] == at:
                line.transport.abort()

    async def on_tick(self, counter: int) -> bool:
        """Check the connections; called ten times a second."""
        if counter % _IDLE == 0:
            self._end_idle()
        return await super().on_tick(counter)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Close the streams, then everything else."""
        app: Any = self.config.app
        app.state.watch.close()
        await super().shutdown(sockets)

    def _end_idle(self) -> None:
        """Close connections that have requested or read nothing since the last check."""
        still: dict[Any, Any] = {}
        connections: set[Any] = self.server_state.connections
        for one in connections:
            if one.cycle is None or one.cycle.response_complete:
                still[one] = one.cycle
            elif one.flow.write_paused:  # it has yet to read so many bytes of its answer
                still[one] = one.cycle, one.transport.get_write_buffer_size()
            if one in still and self._idle.get(one, self) == still[one]:
                one.transport.abort()
        self._idle = still


def _let_many_wait(servers: Iterable[asyncio.Server]) -> None:
    """Let many connections wait on servers that accept few at a time."""
    for listening in (one for server in servers for one in server.sockets):
        with listening.dup() as same:
            same.listen(_QUEUE)


def descriptors() -> int:
    """Return how many files and connections this process may have, after requesting more."""
    if sys.platform == "win32":
        return _WANTED
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = _WANTED if hard == resource.RLIM_INFINITY else min(hard, _WANTED)
    if soft == resource.RLIM_INFINITY or soft >= wanted:
        return _WANTED if soft == resource.RLIM_INFINITY else soft
    resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
    return wanted


def room(limit: int) -> tuple[int, int]:
    """Return how many connections fit within a limit of descriptors, and are accepted at a time.

    >>> room(4096), room(1024), room(256)
    ((1000, 128), (656, 64), (128, 16))
    """
    at_a_turn = max(8, min(limit // 16, 128))
    return max(2 * KEPT, min(_MOST, limit - _TURNS * at_a_turn - _FILES)), at_a_turn


class Door:
    """The open connections by address, with limits except for this computer's `own` addresses."""

    def __init__(self, most: int, own: Collection[str]) -> None:
        self.most = most
        self.own = own
        self.lines: dict[str, dict[Any, None]] = {}  # of each address, the longest idle first

    def lets_in(self, line: Any) -> bool:
        """Accept a new connection, replacing an idle one if needed; False if there is no room."""
        address = _address(line)
        its = self.lines.get(address, {})
        count, own = sum(map(len, self.lines.values())), address in self.own
        if not own and len(its) >= self.most // 2:
            taken = its
        elif count >= self.most - (0 if own else KEPT):
            guests = [one for at, one in self.lines.items() if at not in self.own]
            taken = max(guests, key=len, default=its)
        else:
            taken = {}
        if taken:
            idle = next((one for one in taken if _is_idle(one)), None)
            if idle is None:
                return False
            self.forgets(idle)
            idle.transport.abort()
        self.lines.setdefault(address, {})[line] = None
        return True

    def answered(self, line: Any) -> None:
        """Start counting how long a connection has been idle."""
        its = self.lines.get(_address(line), {})
        if line in its:
            its[line] = its.pop(line)

    def forgets(self, line: Any) -> None:
        """Forget a closed connection."""
        its = self.lines.get(_address(line), {})
        its.pop(line, None)
        if not its:
            self.lines.pop(_address(line), None)


def behind(door: Door) -> type[H11Protocol]:
    """Return the protocol for connections that pass through a door."""

    class Line(H11Protocol):
        def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
            super().connection_made(transport)
            if not door.lets_in(self):
                transport.abort()

        def connection_lost(self, exc: Exception | None) -> None:
            door.forgets(self)
            super().connection_lost(exc)

        def on_response_complete(self) -> None:
            door.answered(self)
            super().on_response_complete()

    return Line


def in_few_lines(clock: Callable[[], float] = time.monotonic) -> Callable[..., None]:
    """Return an event loop's error handler that reports once a minute that no more can connect.

    When descriptors run out, each waiting connection causes such an error at each try.
    """
    said = -_SECONDS

    def handle(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        nonlocal said
        if not str(context.get("message", "")).startswith("socket.accept()"):
            loop.default_exception_handler(context)
        elif clock() - said >= _SECONDS:
            said = clock()
            _LOG.error("no more connections can be opened now: %s", context.get("exception"))

    return handle


def _address(line: Any) -> str:
    return str(line.client[0]) if line.client else ""


def _is_idle(line: Any) -> bool:
    """Return whether a connection has no unanswered request."""
    return line.cycle is None or bool(line.cycle.response_complete)
