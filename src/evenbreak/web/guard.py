"""Checks for every request: its Host, the size and time of its body; headers for every page.

Rejections, here or by a page, are a `RefusalError`: one line in the reader's language.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Collection, Sequence
from http import HTTPStatus
from typing import Any

from h11 import LocalProtocolError
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from evenbreak.errors import EvenbreakError

ROOT = "/api"
"""The prefix of the API's addresses: everything below it is answered in JSON."""

MOST_BYTES = 2 << 20
"""The largest body: a season of results, pasted or uploaded."""

MOST_HEAD = 32 << 10
"""The most bytes in the header lines, including the address."""

PATIENCE = 15.0
"""How many seconds a body may take to arrive."""


def headers(script_hash: str) -> list[tuple[bytes, bytes]]:
    """Return the headers for every answer: nothing from elsewhere, no other script, no frame."""
    policy = "; ".join(
        [
            "default-src 'none'",
            "style-src 'self'",
            f"script-src 'sha256-{script_hash}'",
            "img-src 'self' data:",
            "connect-src 'self'",
            "form-action 'self'",
            "frame-ancestors 'none'",
            "base-uri 'none'",
        ]
    )
    found = {
        "content-security-policy": policy,
        "x-content-type-options": "nosniff",
        "referrer-policy": "same-origin",
        "cross-origin-opener-policy": "same-origin",
        "cross-origin-resource-policy": "same-origin",
        "permissions-policy": "camera=(), geolocation=(), microphone=()",
    }
    return [(name.encode(), value.encode()) for name, value in found.items()]


class Guard:
    """Rejects wrong hosts, and bodies too large or too slow, before anything is read.

    Any other host may be a page elsewhere whose own name leads here (DNS rebinding). `script_hash`
    is the hash of the only script that pages may run.
    """

    def __init__(self, app: ASGIApp, *, hosts: Collection[str], script_hash: str) -> None:
        self.app = app
        self.hosts = hosts
        self.headers = headers(script_hash)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer or reject a request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        given = dict(scope["headers"])
        host = given.get(b"host", b"").decode("latin-1").rsplit(":", 1)[0].strip("[]").lower()
        if host not in self.hosts:
            await turn_away(
                scope, send, 421, "This is not the address of the tournament's computer."
            )
            return
        if len(scope["raw_path"]) + len(scope["query_string"]) + _size(scope) > MOST_HEAD:
            await turn_away(
                scope,
                send,
                431,
                f"The request's address and headers are larger than {MOST_HEAD >> 10} KB.",
            )
            return
        length = given.get(b"content-length", b"0")
        if not length.isdigit() or int(length) > MOST_BYTES:
            await turn_away(
                scope, send, 413, f"More than {MOST_BYTES >> 20} MB was sent. Send less."
            )
            return
        started = False

        async def answer(message: Message) -> None:
            nonlocal started
            if message["type"] == "http.response.start":
                started = True
                own = list(message.get("headers", []))
                known = {name for name, _ in own}
                message["headers"] = own + [one for one in self.headers if one[0] not in known]
                if all(name != b"cache-control" for name, _ in message["headers"]):
                    message["headers"].append((b"cache-control", b"no-store"))
            await send(message)

        try:
            await self.app(scope, _Body(receive), answer)
        except (ClientDisconnect, LocalProtocolError):
            return  # whoever asked has gone, or has sent what nobody can answer
        except (_TooLargeError, TimeoutError) as error:
            if started:
                raise
            large = isinstance(error, _TooLargeError)
            words = "More was sent than is allowed." if large else "The form came too slowly."
            await turn_away(scope, send, 413 if large else 408, words)


def _size(scope: Scope) -> int:
    return sum(len(name) + len(value) + len(": \r\n") for name, value in scope["headers"])


class _TooLargeError(Exception):
    pass


class _Body:
    """A request's body, counted and timed as it arrives."""

    def __init__(self, receive: Receive) -> None:
        self.receive = receive
        self.size = 0
        self.whole = False
        self.until: float | None = None

    async def __call__(self) -> Message:
        """Return the next message."""
        if self.whole:  # now only the end of the connection can come
            return await self.receive()
        now = asyncio.get_running_loop().time()
        self.until = self.until or now + PATIENCE
        message = await asyncio.wait_for(self.receive(), self.until - now)
        self.size += len(message.get("body", b""))
        self.whole = not message.get("more_body", False)
        if self.size > MOST_BYTES:
            raise _TooLargeError
        return message


async def turn_away(
    scope: Scope, send: Send, status: int, words: str, more: Sequence[tuple[bytes, bytes]] = ()
) -> None:
    """Reject a request before anything in it is read, so its language isn't known either."""
    kind, body = "text/plain; charset=utf-8", f"{words}\n"
    if f"{scope['path']}/".startswith(f"{ROOT}/"):
        told = {"title": HTTPStatus(status).phrase, "status": status, "detail": words}
        kind, body = "application/problem+json", json.dumps(told)
    plain: Any = [(b"content-type", kind.encode()), (b"connection", b"close"), *more]
    await send({"type": "http.response.start", "status": status, "headers": plain})
    await send({"type": "http.response.body", "body": body.encode()})


class RefusalError(EvenbreakError):
    """A rejected request; template and values are as for `evenbreak.words.say`."""

    def __init__(self, template: str, /, *, status: int = 400, **values: Any) -> None:
        super().__init__(template, **values)
        self.status = status


class MovedOnError(RefusalError):
    """A tap on a page that shows an outdated score."""
