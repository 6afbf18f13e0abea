"""A hundred phones watch while twenty tap: how soon each page comes, and how much memory it takes.

The server runs in a process of its own. A page is what a phone waits for: of a watching phone the
one that it asks for when told that something has changed, of a tapping one what its tap shows. The
machine may be busy with other tests: what counts then is the page beside a file that is asked for
at the same moments, and only sent.
"""

from __future__ import annotations

import asyncio
import gzip
import os
import re
import secrets
import time
import urllib.parse
from pathlib import Path
from typing import NamedTuple

import pytest

from evenbreak.files.store.tournament import new_tournament, read_tournament
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
from evenbreak.web.site import Site
from web.phones import free_port
from web.test_kills import started

WATCHING, TAPPING, TABLES, SECONDS = 100, 20, 20, 8.0
BOUND, BUSY = 0.100, 12.0
"""Seconds in which 95 % of pages come; on a busy machine, that many times as long as the file."""


class Got(NamedTuple):
    status: int
    text: str
    cookie: str
    to: str
    took: float


class Client:
    """A phone: its cookie, and how long it waited for each page."""

    def __init__(self, port: int, cookie: str = "") -> None:
        self.port, self.cookie = port, cookie
        self.waited: list[float] = []

    async def ask(self, path: str, fields: dict[str, str] | None = None) -> Got:
        begun = time.perf_counter()
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        body = urllib.parse.urlencode(fields).encode() if fields is not None else b""
        head = [f"{'POST' if fields is not None else 'GET'} {path} HTTP/1.1"]
        head += [
            f"Host: 127.0.0.1:{self.port}",
            "Connection: close",
            f"Content-Length: {len(body)}",
            "Accept-Encoding: gzip",
        ]
        head += ["Content-Type: application/x-www-form-urlencoded"] if body else []
        head += [f"Cookie: {self.cookie}"] if self.cookie else []
        writer.write("\r\n".join([*head, "", ""]).encode() + body)
        answer = await reader.read()
        writer.close()
        raw, _, packed = answer.partition(b"\r\n\r\n")
        took = time.perf_counter() - begun
        top, is_packed = raw.decode(), b"content-encoding: gzip" in raw.lower()
        text = (gzip.decompress(packed) if is_packed else packed).decode()
        set_to = re.search(r"(?i)^set-cookie: ([^;]+)", top, re.M)
        to = re.search(r"(?i)^location: (\S+)", top, re.M)
        self.cookie = set_to[1] if set_to else self.cookie
        return Got(int(top.split()[1]), text, self.cookie, to[1] if to else "", took)

    async def hidden(self, path: str) -> dict[str, str]:
        """Return what the forms of a page carry unseen."""
        text = (await self.ask(path)).text
        found = {
            name: re.search(rf'name="{name}" value="([^"]*)"', text) for name in ("csrf", "begun")
        }
        return {name: one[1] if one else "" for name, one in found.items()}


async def watches(one: Client, until: float) -> None:
    """Follow the stream, and ask for the page whenever it says that something has changed."""
    reader, writer = await asyncio.open_connection("127.0.0.1", one.port)
    writer.write(f"GET /events HTTP/1.1\r\nHost: 127.0.0.1:{one.port}\r\n".encode())
    writer.write(b"Accept-Encoding: gzip\r\n\r\n")
    seen = ""
    while (left := until - time.perf_counter()) > 0.0:
        try:
            line = (await asyncio.wait_for(reader.readline(), left)).decode().strip()
        except TimeoutError:
            break
        if line.startswith("data: "):
            if seen and line != seen:
                one.waited.append((await one.ask("/")).took)
            seen = line
    writer.close()


async def taps(one: Client, match: str, until: float, luck: float) -> None:
    """Tap a game every two seconds, as a quick pair would."""
    hidden, score = await one.hidden("/desk"), 0
    await asyncio.sleep(2.0 * luck)
    while time.perf_counter() < until:
        score += 1
        fields = {
            **hidden,
            "once": secrets.token_urlsafe(9),
            "match": match,
            "a": str(score),
            "b": "0",
        }
        posted = await one.ask("/desk/score", fields)
        assert posted.status == 303, posted.text[:2000]
        shown = await one.ask(posted.to)
        one.waited.append(posted.took + shown.took)
        await asyncio.sleep(2.0)


async def asks_for_a_file(one: Client, until: float) -> None:
    while time.perf_counter() < until:
        one.waited.append((await one.ask("/evenbreak.css")).took)
        await asyncio.sleep(0.1)


def late(waited: list[float]) -> float:
    """Return what 95 of 100 did not wait longer than."""
    return sorted(waited)[int(0.95 * len(waited))]


async def evening(port: int, pin: str, matches: list[str]) -> dict[str, list[float]]:
    watching = [Client(port) for _ in range(WATCHING)]
    tapping = [Client(port) for _ in range(TAPPING)]
    for one in tapping:
        await one.ask(
            "/pin", {**await one.hidden("/pin"), "once": secrets.token_urlsafe(9), "pin": pin}
        )
    of_file = Client(port)
    await of_file.ask("/")
    await asyncio.sleep(6.0)  # the odds are worked out
    until = time.perf_counter() + SECONDS
    await asyncio.gather(
        *(watches(one, until) for one in watching),
        *(
            taps(one, match, until, k / TAPPING)
            for k, (one, match) in enumerate(zip(tapping, matches, strict=True))
        ),
        asks_for_a_file(of_file, until),
    )
    return {
        "watching": [one for each in watching for one in each.waited],
        "tapping": [one for each in tapping for one in each.waited],
        "file": of_file.waited,
    }


def used(process: int) -> int:
    """Return the most memory that a process has used so far, in MB; 0: not known here."""
    status = Path(f"/proc/{process}/status")
    found = re.search(r"VmHWM:\s+(\d+)", status.read_text()) if status.exists() else None
    return int(found[1]) // 1000 if found else 0


@pytest.mark.thorough
def test_a_hundred_watch_and_twenty_tap(tmp_path: Path) -> None:
    path, port = tmp_path / "tonight.db", free_port()
    entrants = tuple(Entrant(f"Player Number {k}", 700.0 - 3 * k) for k in range(64))
    names = tuple(one.name for one in entrants)
    plan = Plan("double", 9, losers_race=9, scale="fargo", tables=TABLES)
    both = [Opened(plan, entrants), Drawn(names, tuple(range(64)))]
    new_tournament(path, [Event("2025-03-01T19:30:00", what) for what in both])
    matches = list(read_tournament(path).standing.to_play)[:TAPPING]
    server = started(path, port)
    try:
        site = Site(path, address=f"http://127.0.0.1:{port}")
        found = asyncio.run(evening(port, site.pin, matches))
        memory = used(server.pid)
    finally:
        server.kill()
        server.wait()
    assert len(found["watching"]) > 3 * WATCHING
    assert len(found["tapping"]) > 2 * TAPPING
    waits = {who: late(waited) for who, waited in found.items()}
    told = f"{waits}, {memory} MB, load {os.getloadavg()}"
    bound = max(BOUND, BUSY * waits["file"])
    assert max(waits.values()) <= bound, told
    assert memory <= 150, told
