"""`evenbreak serve`: the page on the director's phone and the venue's screen."""

from __future__ import annotations

import ctypes
import gc
import socket
import sys
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from tempfile import mkdtemp

import click
import segno

from evenbreak.errors import EvenbreakError
from evenbreak.files.demo import write_demo_evening
from evenbreak.files.league.league_file import LeagueFile
from evenbreak.files.store.desk import back_up
from evenbreak.files.store.evening_file import holds
from evenbreak.files.store.formats import TOURNAMENT
from evenbreak.files.store.team_night import read_team_events
from evenbreak.files.store.tournament import read_tournament, renew_views
from evenbreak.questions.start import Serve
from evenbreak.web.server import server_of
from evenbreak.web.site import Site

_TURN = 0.0005  # seconds
_ARENAS, _TRIM, _APART = -8, -1, -3  # of malloc.h: M_ARENA_MAX, M_TRIM_THRESHOLD, M_MMAP_THRESHOLD


def serve(asked: Serve, league: LeagueFile | None) -> None:
    """Serve the page until Ctrl+C; its forms begin with the rules of a league."""
    path = _demo() if asked.demo else Path(asked.file or "tonight.db")
    if path.exists():
        if holds(path, TOURNAMENT) or not read_team_events(path):
            read_tournament(path)
        try:
            back_up(path, datetime.now())
        except (EvenbreakError, OSError) as error:  # it can be shown all the same
            click.echo(f"Warning: no copy of {path} could be made: {error}", err=True)
        renew_views(path)
    elif not path.parent.is_dir():
        asked.refuse(
            "{path}: there is no folder {folder}; make it, or name another",
            path=path,
            folder=path.parent,
        )
    own = asked.host or (_own_address() if asked.lan else "127.0.0.1")
    host = "0.0.0.0" if asked.lan else "127.0.0.1"  # noqa: S104
    hosts = {"127.0.0.1", "localhost", "::1", own.partition(":")[0]}
    if asked.lan:
        hosts |= {socket.gethostname().lower(), f"{socket.gethostname().lower()}.local"}
    address = f"http://{own}" if ":" in own else f"http://{own}:{asked.port}"
    site = Site(path, frozenset(hosts), address, league, color=asked.color)
    if why := _taken(host, asked.port):
        asked.refuse(
            "{port} {n}: {why}; give another one, such as {free}",
            n=asked.port,
            why=why,
            free=asked.port + 1,
        )
    click.echo(f"The page: {address}", err=True)
    click.echo(f"The director's PIN: {site.pin}", err=True)
    if asked.lan:
        segno.make(address, error="l").terminal(sys.stderr, compact=True)
    click.echo("Ctrl+C ends it; nothing is lost.", err=True)
    # A page does not wait until the odds, worked out beside it, have had their usual 5 ms.
    sys.setswitchinterval(_TURN)
    _give_memory_back()
    gc.freeze()  # what all pages share need not be looked through again
    server_of(site, host=host, port=asked.port).run()


def _give_memory_back() -> None:
    """Have what was used for odds and pictures returned to the system, where glibc is its library.

    It would keep a heap for each thread, and all that was once large.
    """
    with suppress(OSError, AttributeError):
        mallopt = ctypes.CDLL("libc.so.6").mallopt
        for option, value in ((_ARENAS, 1), (_TRIM, 1 << 17), (_APART, 1 << 17)):
            mallopt(option, value)


def _demo() -> Path:
    """Write the demo's evening to a folder of its own, and return its file."""
    path = Path(mkdtemp(prefix="evenbreak-demo-"), "evening.db")
    write_demo_evening(path, datetime.now())
    click.echo(f"The demo: {path}, which you may delete", err=True)
    return path


def _own_address() -> str:
    """Return the address of this computer in its network."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # nothing is sent
        except OSError:
            raise click.ClickException(
                "this computer is in no network; join one, or leave --lan out"
            ) from None
        return str(probe.getsockname()[0])


def _taken(host: str, port: int) -> str:
    """Return why a port cannot be used; '' if it can."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            return (error.strerror or str(error)).lower()
    return ""
