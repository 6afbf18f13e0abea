"""`evenbreak serve`: the page on the director's phone and the venue's screen."""

from __future__ import annotations

import ctypes
import gc
import socket
import sys
from contextlib import suppress
from datetime import date, datetime
from pathlib import Path
from tempfile import mkdtemp

import click
import segno

from evenbreak.errors import EvenbreakError
from evenbreak.files.demo import write_demo_evening
from evenbreak.files.league import find_league
from evenbreak.files.league.league_file import LeagueFile, read_league
from evenbreak.files.store.desk import back_up
from evenbreak.files.store.evening_file import holds
from evenbreak.files.store.formats import TOURNAMENT
from evenbreak.files.store.team_night import read_team_events
from evenbreak.files.store.tournament import read_tournament, renew_views
from evenbreak.questions.start import Serve
from evenbreak.web.documents import Alone, documents, show, tonights_file
from evenbreak.web.room import addresses, places_of
from evenbreak.web.server import server_of
from evenbreak.web.site import Site

_TURN = 0.0005  # seconds
_PORTS = 50
_ARENAS, _TRIM, _APART = -8, -1, -3  # of malloc.h: M_ARENA_MAX, M_TRIM_THRESHOLD, M_MMAP_THRESHOLD


def serve(asked: Serve, league: LeagueFile | None) -> None:
    """Serve the page until Ctrl+C; its forms begin with the rules of a league."""
    if not (asked.open and asked.file is None and not asked.demo):
        _serve(asked, _demo() if asked.demo else Path(asked.file or "tonight.db"), league)
        return
    with Alone() as alone:
        if alone.running:
            click.echo(f"The page is open already: {alone.running}", err=True)
            show(alone.running)
            return
        path = tonights_file(documents(), date.today())
        click.echo(f"Tonight is kept in {path}", err=True)
        if league is None and (there := find_league(path.parent)) is not None:
            league = read_league(there, quickly=True)
        _serve(asked, path, league, alone)


def _serve(asked: Serve, path: Path, league: LeagueFile | None, alone: Alone | None = None) -> None:
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
    port = _port(asked)
    here = f"http://127.0.0.1:{port}"
    site = Site(
        path, address=here, rules=league, color=asked.color, origins=frozenset(asked.allow_origin)
    )
    places = places_of(_room(asked, port), port, asked.host or "")
    for place in places or [here]:
        click.echo(f"The page: {place}", err=True)
    click.echo(f"The director's PIN: {site.pin}", err=True)
    if places:
        segno.make(places[0], error="l").terminal(sys.stderr, compact=True)
    click.echo("Ctrl+C ends it; nothing is lost.", err=True)
    if alone is not None:
        alone.keep(here)
    # A page does not wait until the odds, worked out beside it, have had their usual 5 ms.
    sys.setswitchinterval(_TURN)
    _give_memory_back()
    gc.freeze()  # what all pages share need not be looked through again

    def then() -> None:
        show(f"{here}/pin?ticket={site.ticket.draw()}")

    shown = then if asked.open else None
    server_of(site, port=port, lan=asked.lan, name=asked.host or "", then=shown).run()


def _port(asked: Serve) -> int:
    """Return the port that is asked for; for a browser that is opened on it, the next free one."""
    why = _taken("127.0.0.1", asked.port)
    rest = range(asked.port + 1, asked.port + _PORTS) if asked.open else ()
    if why and (free := next((n for n in rest if not _taken("127.0.0.1", n)), None)):
        click.echo(f"Port {asked.port}: {why}; taking {free}", err=True)
        return free
    if why:
        _refuse(asked, why)
    return asked.port


def _room(asked: Serve, port: int) -> list[str]:
    """Return the addresses at which phones are let in from the start; none without --lan."""
    if not asked.lan:
        return []
    there = addresses()
    if not there:
        raise click.ClickException("this computer is in no network; join one, or leave --lan out")
    if all(why := [_taken(one, port) for one in there]):
        _refuse(asked, why[0])
    return there


def _refuse(asked: Serve, why: str) -> None:
    asked.refuse(
        "{port} {n}: {why}; give another one, such as {free}",
        n=asked.port,
        why=why,
        free=asked.port + 1,
    )


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


def _taken(host: str, port: int) -> str:
    """Return why a port cannot be used; '' if it can."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        if sys.platform != "win32":  # there it would let two programs have one port
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            return (error.strerror or str(error)).lower()
    return ""
