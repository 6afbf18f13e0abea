"""A full room: phones that watch and phones that report; how soon pages come, and the memory.

    python benchmarks/web_load.py                 # 100 watch, 20 report, 64 players, 20 seconds
    python benchmarks/web_load.py 128 40          # 128 players, 40 seconds

Watchers follow the stream of events and open a page every two seconds or so; reporters enter the
score of a match every second. It prints the time of pages (50, 95, 100 of 100) and the memory of
the server. Nothing is compared in time across machines: the page without a tournament is the floor.
"""

import asyncio
import random
import re
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.parse
from pathlib import Path

from evenbreak.files.store.tournament import new_tournament, read_tournament
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
from evenbreak.web.site import Site

WATCH, REPORT, RACE = 100, 20, 9


class Line:
    """A phone with a cookie, one request after another."""

    def __init__(self, port: int) -> None:
        self.port = port
        self.cookie = ""

    async def ask(self, path: str, fields: dict[str, object] | None = None) -> tuple[float, str]:
        started = time.perf_counter()
        body = urllib.parse.urlencode(fields).encode() if fields is not None else b""
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        head = f"{'POST' if fields is not None else 'GET'} {path} HTTP/1.1\r\nHost: 127.0.0.1\r\n"
        head += f"Connection: close\r\nCookie: {self.cookie}\r\nContent-Length: {len(body)}\r\n"
        head += "Content-Type: application/x-www-form-urlencoded\r\n\r\n"
        writer.write(head.encode() + body)
        got = (await reader.read(-1)).decode("utf-8", "replace")
        writer.close()
        if found := re.search(r"set-cookie: (evenbreak[^=]*=[^;]+)", got):
            self.cookie = found[1]
        return time.perf_counter() - started, got

    async def follow(self, until: float) -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        writer.write(b"GET /events HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
        while (left := until - time.perf_counter()) > 0:
            try:
                if not await asyncio.wait_for(reader.read(4096), left):
                    break
            except TimeoutError:
                break
        writer.close()


async def watch(port: int, until: float, times: list[float]) -> None:
    line, luck = Line(port), random.Random()
    stream = asyncio.create_task(line.follow(until))
    while time.perf_counter() < until:
        await asyncio.sleep(luck.uniform(1.0, 3.0))
        took, got = await line.ask(luck.choice(["/", "/", "/bracket", "/screen"]))
        assert " 200 " in got[:20], got[:300]
        times.append(took)
    await stream


async def report(port: int, until: float, times: list[float], match: str, code: str) -> None:
    line, luck = Line(port), random.Random()
    await line.ask(f"/c/{code}")
    a = b = 0
    while time.perf_counter() < until:
        await asyncio.sleep(luck.uniform(0.5, 1.5))
        _, got = await line.ask("/me?play=1")
        fields = dict(re.findall(r'name="(\w+)" value="([^"]*)"', got.split('class="halves"')[1]))
        a, b = (a + 1, b) if luck.random() < 0.5 else (a, b + 1)
        if max(a, b) == RACE:
            a = b = 0
        took, got = await line.ask("/me/score", {**fields, "match": match, "a": a, "b": b})
        assert " 303 " in got[:20], got[:300]
        times.append(took)


async def room(site: Site, port: int, seconds: float) -> tuple[list[float], list[float]]:
    state = read_tournament(site.path)
    until = time.perf_counter() + seconds
    seen: list[float] = []
    sent: list[float] = []
    names = list(state.standing.to_play)[:REPORT]
    watching = [watch(port, until, seen) for _ in range(WATCH)]
    reporting = [
        report(port, until, sent, name, site.player_code(state.pair(name)[0])) for name in names
    ]
    await asyncio.gather(*watching, *reporting)
    return seen, sent


def main(players: int = 64, seconds: float = 20.0) -> None:
    with tempfile.TemporaryDirectory() as folder, socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
        probe.close()
        path = Path(folder, "tonight.db")
        entrants = tuple(Entrant(f"Player {k}", 700.0 - 3 * k, 20.0) for k in range(players))
        plan = Plan("double", RACE, scale="fargo", tables=16)
        drawn = Drawn(tuple(one.name for one in entrants), tuple(range(players)))
        new_tournament(
            path, [Event("2025-03-01T19:30:00", one) for one in (Opened(plan, entrants), drawn)]
        )
        words = [sys.executable, "-m", "evenbreak", "serve", str(path), "--port", str(port)]
        begun = time.perf_counter()
        server = subprocess.Popen(words, stderr=subprocess.DEVNULL)
        while True:
            with socket.socket() as line:
                if not line.connect_ex(("127.0.0.1", port)):
                    break
            time.sleep(0.01)
        asyncio.run(Line(port).ask("/fair"))
        print(f"start to first page: {time.perf_counter() - begun:.2f} s")
        try:
            seen, sent = asyncio.run(room(Site(path), port, seconds))
            for name, times in (("pages", seen), ("scores", sent)):
                q = statistics.quantiles(times, n=100)
                within = ", ".join(f"{1000.0 * q[k]:.0f}" for k in (49, 94, 98))
                print(f"{name}: {len(times)}; 50, 95 and 99 of 100 within {within} ms")
            status = Path(f"/proc/{server.pid}/status").read_text().splitlines()
            print("memory:", *(one for one in status if one.startswith(("VmHWM", "VmRSS"))))
        finally:
            server.send_signal(signal.SIGINT)
            server.wait(10)


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:3]))
