"""The server that the application runs in: its limits, and the ends of its connections."""

from __future__ import annotations

import asyncio
import logging
import socket
from typing import Any

import uvicorn

from evenbreak.web.app import make_app
from evenbreak.web.door import Door, behind, descriptors, in_few_lines, room
from evenbreak.web.guard import MOST_HEAD
from evenbreak.web.site import Site

_QUEUE = 1024  # connections that wait to be let in
_IDLE = 200  # tenths of a second


def server_of(site: Site, *, host: str = "127.0.0.1", port: int) -> uvicorn.Server:
    """Return the server of a site.

    Parameters
    ----------
    site
        what is served.
    host, port
        where it listens.
    """
    # It warns of each form that is cut or wrong, which any guest can send.
    logging.getLogger("python_multipart").setLevel(logging.ERROR)
    most, at_a_turn = room(descriptors())
    config = uvicorn.Config(
        make_app(site, streams=most // 2),
        host=host,
        port=port,
        http=behind(Door(most, site.hosts)),
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
    return _Server(config)


class _Server(uvicorn.Server):
    """A server that ends the streams of its pages before it ends itself, and idle connections.

    A phone that asks for nothing, or never finishes asking, would otherwise keep its connection
    for as long as it likes, and so would one that has left the room.
    """

    def __init__(self, config: uvicorn.Config) -> None:
        super().__init__(config)
        self._idle: dict[Any, Any] = {}

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start to listen."""
        asyncio.get_running_loop().set_exception_handler(in_few_lines())
        await super().startup(sockets)
        for listening in (one for server in self.servers for one in server.sockets):
            with listening.dup() as same:  # many may wait, though few are let in at a turn
                same.listen(_QUEUE)

    async def on_tick(self, counter: int) -> bool:
        """Look after the connections; called ten times a second."""
        if counter % _IDLE == 0:
            self._end_idle()
        return await super().on_tick(counter)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """End the streams, then all else."""
        app: Any = self.config.app
        app.state.closing = True
        await super().shutdown(sockets)

    def _end_idle(self) -> None:
        """End the connections that had no whole request at the last look, and have none since."""
        connections: set[Any] = self.server_state.connections
        answered = {one: one.cycle for one in connections}
        idle = {one: at for one, at in answered.items() if at is None or at.response_complete}
        for one, cycle in idle.items():
            if one in self._idle and self._idle[one] is cycle:
                one.transport.close()
        self._idle = idle
