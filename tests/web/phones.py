"""A page, and phones that open it: cookies, forms, no JavaScript.

`answering` has the application answer in this process, at once; `running` is a real server, for
tests of connections, browsers, other processes, and a page that is started again.
"""

from __future__ import annotations

import asyncio
import http.client
import io
import itertools
import random
import re
import secrets
import socket
import threading
import urllib.error
import urllib.parse
import urllib.request
import urllib.response
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import cache, partial
from html import unescape
from http.cookiejar import CookieJar
from pathlib import Path
from typing import Any, NamedTuple

from starlette.applications import Starlette

from evenbreak.web.app import make_app
from evenbreak.web.evening_view import match_view
from evenbreak.web.server import server_of
from evenbreak.web.site import Site


class Shown(NamedTuple):
    """What a phone got."""

    status: int
    text: str
    url: str
    headers: Mapping[str, str]

    @property
    def words(self) -> str:
        """The text without tags."""
        inner = re.sub(r"<(script|style).*?</\1>", " ", self.text, flags=re.DOTALL)
        return " ".join(unescape(re.sub(r"<[^>]+>", " ", inner)).split())


_ANSWERING: dict[str, Starlette] = {}
_PORTS = itertools.count(1)


@cache
def _loop() -> asyncio.AbstractEventLoop:
    """The loop that applications answer in, in a thread of its own."""
    loop = asyncio.new_event_loop()
    threading.Thread(target=loop.run_forever, daemon=True).start()
    return loop


async def answer_of(
    app: Starlette,
    method: str,
    path: str,
    head: Mapping[str, str],
    body: bytes,
    *,
    address: str,
    expected: tuple[type[Exception], ...] = (),
) -> tuple[int, list[tuple[str, str]], bytes]:
    """Return the status, headers and body that an application answers to an address.

    `expected` is what it may fail with, once it has answered.
    """
    got: list[Any] = []

    async def receive() -> dict[str, Any]:
        await asyncio.sleep(0)
        return {"type": "http.request", "body": body, "more_body": False}

    async def send(message: Any) -> None:
        got.append(message)

    plain, _, query = path.partition("?")
    scope = {
        "type": "http",
        "method": method,
        "path": urllib.parse.unquote(plain),
        "raw_path": plain.encode(),
        "query_string": query.encode(),
        "headers": [(k.lower().encode(), v.encode("latin-1")) for k, v in head.items() if v],
        "client": (address, 1),
        "server": ("localhost", 80),
        "scheme": "http",
        "http_version": "1.1",
        "root_path": "",
    }
    with suppress(*expected):
        await app(scope, receive, send)
    raw = got[0]["headers"]
    headers = [(name.decode("latin-1"), value.decode("latin-1")) for name, value in raw]
    return got[0]["status"], headers, b"".join(one.get("body", b"") for one in got[1:])


class _From(urllib.request.HTTPHandler):
    """Opens its connections from one of this computer's addresses, or asks an application here."""

    def __init__(self, address: str) -> None:
        super().__init__()
        self.address = address

    def http_open(self, req: urllib.request.Request) -> Any:
        app = _ANSWERING.get(req.host)
        if app is not None:
            sent = req.data if isinstance(req.data, bytes) else b""
            asked = (req.get_method(), req.selector, dict(req.header_items()), sent)
            answer = answer_of(app, *asked, address=self.address)
            waiting = asyncio.run_coroutine_threadsafe(answer, _loop())
            status, headers, body = waiting.result(20)
            message = http.client.HTTPMessage()
            for name, value in headers:
                message[name] = value
            got = urllib.response.addinfourl(io.BytesIO(body), message, req.full_url, status)
            got.msg = http.client.responses[status]  # type: ignore[attr-defined]
            return got
        line = partial(http.client.HTTPConnection, source_address=(self.address, 0))
        return self.do_open(line, req)


class Phone:
    """A phone with its own cookies and address; `director` has entered the PIN."""

    def __init__(
        self,
        site: Site,
        *,
        director: bool = False,
        language: str = "en",
        address: str = "127.0.0.1",
    ) -> None:
        self.site = site
        self.kept = ""
        self.jar = CookieJar()
        cookies = urllib.request.HTTPCookieProcessor(self.jar)
        self.opener = urllib.request.build_opener(cookies, _From(address))
        self.opener.addheaders = [("Accept-Language", language)]
        if director:
            assert self.send("/pin", pin=site.pin).status == 200

    def open(self, path: str, **asked: str) -> Shown:
        """Open a page."""
        if asked:
            path = f"{path}?{urllib.parse.urlencode(asked)}"
        return self._get(urllib.request.Request(self.site.address + path))  # noqa: S310

    def travels(self, path: str) -> int:
        """Return how many bytes travel when a browser opens a page, and its style with it."""
        found = 0
        for at in (path, style_of(self.open(path).text)):
            asked = urllib.request.Request(self.site.address + at)  # noqa: S310
            asked.add_header("Accept-Encoding", "gzip")
            try:
                with self.opener.open(asked, timeout=20) as got:
                    found += len(got.read())
            except urllib.error.HTTPError as refused:
                with refused:
                    found += len(refused.read())
        return found

    def token(self) -> str:
        """Return the token of this phone's forms, which its session keeps."""
        if not self.kept:
            found = re.search(r'name="csrf" value="([^"]+)"', self.open("/pin").text)
            assert found
            self.kept = found[1]
        return self.kept

    def hidden(self) -> dict[str, str]:
        """Return what every form of a page that is opened now carries unseen."""
        return carried(self.site, self.token())

    def send(self, path: str, **fields: object) -> Shown:
        """Send a form of this phone."""
        seen = seen_at(self.site, path, fields)
        return self.send_raw(path, {**self.hidden(), **seen, **fields})

    def claims(self, name: str) -> Shown:
        """Say that this is a player's phone."""
        return self.send("/me/claim", name=name)

    def claims_by_code(self, name: str) -> Shown:
        """Scan a player's code, and say that it is theirs."""
        code = self.site.player_code(name)
        assert name in self.open(f"/c/{code.lower()}").words
        return self.send("/me/code", code=code)

    def taps(self, match: str, a: int, b: int, **more: object) -> Shown:
        """Tap the score of a match on the player's own page."""
        return self.send("/me/score", match=match, a=a, b=b, **more)

    def send_raw(self, path: str, fields: Mapping[str, object], **headers: str) -> Shown:
        """Send just these fields."""
        body = urllib.parse.urlencode(fields, doseq=True).encode()
        asked = urllib.request.Request(self.site.address + path, body, headers)  # noqa: S310
        return self._get(asked)

    def send_files(self, path: str, files: Mapping[str, bytes], **fields: object) -> Shown:
        """Send a form of this phone with files."""
        parts = {**self.hidden(), **fields}
        edge, body = "edge-of-a-part", b""
        for name, content in parts.items():
            body += _part(edge, f'name="{name}"', str(content).encode())
        for name, file in files.items():
            body += _part(edge, f'name="{name}"; filename="../{name}.csv"', file)
        kind = {"Content-Type": f"multipart/form-data; boundary={edge}"}
        end = f"--{edge}--\r\n".encode()
        return self._get(urllib.request.Request(self.site.address + path, body + end, kind))  # noqa: S310

    def _get(self, asked: urllib.request.Request) -> Shown:
        try:
            with self.opener.open(asked, timeout=20) as got:
                return Shown(
                    got.status, got.read().decode("utf-8", "replace"), got.url, got.headers
                )
        except urllib.error.HTTPError as error:
            with error:
                text = error.read().decode("utf-8", "replace")
            return Shown(error.code, text, error.url or "", error.headers)


def is_working(text: str) -> bool:
    """Return whether a page says that figures are still being worked out."""
    return re.search("<[^>]* data-older", text) is not None  # its script names that, too


def style_of(text: str) -> str:
    """Return the address of the style that a page names, which is one."""
    (found,) = re.findall(r'rel="stylesheet" href="([^"]+)"', text)
    return unescape(found)


def carried(site: Site, token: str) -> dict[str, str]:
    """Return the hidden fields of a form, as a page shows them now."""
    return {"csrf": token, "once": secrets.token_urlsafe(9), "begun": site.night.begun_at}


def seen_at(site: Site, path: str, fields: Mapping[str, object]) -> dict[str, object]:
    """Return what the form of a tap carries: the players of the match, and the score it shows."""
    if not re.fullmatch("/(me|table/[^/]+)/score", path) or not site.night.exists:
        return {}
    state, match = site.night.state(), str(fields.get("match", ""))
    if not state.drawn or match not in state.standing.to_play:
        return {}
    (one, other), (a, b) = state.pair(match), match_view(state, match).score or (0, 0)
    return {"player_a": one, "player_b": other, "seen": f"{a}:{b}"}


def _part(edge: str, named: str, content: bytes) -> bytes:
    head = f"--{edge}\r\nContent-Disposition: form-data; {named}\r\n\r\n"
    return head.encode() + content + b"\r\n"


def two_phones(site: Site) -> list[Phone]:
    """Return the phones of two players, each with an address of its own."""
    return [Phone(site, address=f"127.0.0.{k}") for k in (2, 3)]


@contextmanager
def answering(path: Path, **asked: Any) -> Iterator[Site]:
    """Answer what phones ask about a file while the block runs, without a server between."""
    host = f"127.0.0.1:{next(_PORTS)}"  # lower than those of servers
    site = Site(path, address=f"http://{host}", **asked)
    app = _ANSWERING[host] = make_app(site)
    app.state.watch.close()  # a stream says one thing and ends
    try:
        yield site
    finally:
        del _ANSWERING[host]


def free_port() -> int:
    """Return a port that nobody uses, below those that connections are given for themselves.

    A connection tried to one of those may be made from the same one, and keep a server out of it.
    """
    for _ in range(100):
        with socket.socket() as probe, suppress(OSError):
            port = random.randrange(12000, 30000)
            probe.bind(("127.0.0.1", port))
            return port
    raise AssertionError("no port is free")


@contextmanager
def running(path: Path, *, port: int = 0, **asked: Any) -> Iterator[Site]:
    """Serve a file while the block runs."""
    port = port or free_port()
    site = Site(path, address=f"http://127.0.0.1:{port}", **asked)
    server = server_of(site, port=port)
    thread = threading.Thread(target=server.run, daemon=True)
    thread.start()
    while not server.started:
        assert thread.is_alive()
        threading.Event().wait(0.01)
    try:
        yield site
    finally:
        server.should_exit = True
        thread.join(10)
