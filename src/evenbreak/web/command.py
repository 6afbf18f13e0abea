"""`evenbreak serve`: the page on the director's phone and the venue's screen."""

from __future__ import annotations

import ctypes
import gc
import glob
import socket
import sys
from contextlib import suppress
from datetime import date, datetime
from pathlib import Path
from tempfile import mkdtemp

import click
import segno

from evenbreak.errors import DataError, EvenbreakError
from evenbreak.files.demo import write_demo_evening
from evenbreak.files.league import find_league
from evenbreak.files.league.league_file import LeagueFile, read_league
from evenbreak.files.store.desk import back_up
from evenbreak.files.store.evening_file import holds
from evenbreak.files.store.formats import TOURNAMENT
from evenbreak.files.store.team_night import read_team_events
from evenbreak.files.store.tournament import read_tournament, renew_views
from evenbreak.questions.start import Serve
from evenbreak.web.documents import Alone, documents, goes_on, show, tonights_file
from evenbreak.web.room import addresses, places_of
from evenbreak.web.server import server_of
from evenbreak.web.site import Site
from evenbreak.words import say

_TURN = 0.0005  # seconds
_PORTS = 50
_ARENAS, _TRIM, _APART = -8, -1, -3  # of malloc.h: M_ARENA_MAX, M_TRIM_THRESHOLD, M_MMAP_THRESHOLD


def serve(asked: Serve, league: LeagueFile | None) -> None:
    """Serve the page until Ctrl+C; its forms start with a league's rules."""
    if not asked.open or asked.demo:
        _serve(asked, _demo() if asked.demo else Path(asked.file or "tonight.db"), league)
        return
    with Alone() as alone:
        if alone.running and (asked.file is None or Path(asked.file).resolve() == Path(alone.of)):
            click.echo(f"{alone.of} is open already: {alone.running}", err=True)
            click.echo("To open another night, stop that program first.", err=True)
            show(alone.running)
            return
        path = Path(asked.file) if asked.file else tonights_file(documents(), date.today())
        if (
            asked.file is None
            and league is None
            and (there := find_league(path.parent)) is not None
        ):
            league = read_league(there, quickly=True)
        _serve(asked, path, league, alone)


def _serve(asked: Serve, path: Path, league: LeagueFile | None, alone: Alone | None = None) -> None:
    if path.exists():
        try:
            _read(path)
        except DataError as error:
            raise click.ClickException(f"{error}\n{_instead(path)}") from error
        try:
            back_up(path, datetime.now())
        except (EvenbreakError, OSError) as error:  # it can be shown all the same
            click.echo(f"Warning: {path} couldn't be backed up: {error}", err=True)
        renew_views(path)
    elif not path.parent.is_dir():
        asked.refuse(
            "folder {folder} doesn't exist. Create it or choose another.",
            folder=path.parent,
        )
    elif not path.suffix:
        asked.refuse("there's no file {file}. Name a .db file, such as {file}.db.", file=path)
    click.echo(f"Tonight's file is {path.resolve()}", err=True)
    site = Site(path, rules=league, color=asked.color, origins=frozenset(asked.allow_origin))
    last = site.last_port
    port = _port(asked, last)
    here = f"http://127.0.0.1:{port}"
    site.found_at_port(port)
    if last not in (0, port):
        moved = say(
            "The page has moved from port {last} to port {port}: phones, QR codes and overlays "
            "that use the old port won't find it. Have everyone scan the code again.",
            last=last,
            port=port,
        )
        _say(site, moved)
    there = _room(asked, port) or _room_again(site, port)
    places = places_of(there, port, asked.host or "")
    for place in places or [here]:
        click.echo(f"The page: {place}", err=True)
    click.echo(f"The director's PIN: {site.pin}", err=True)
    if places:
        segno.make(places[0], error="l").terminal(sys.stderr, compact=True)
    click.echo("Press Ctrl+C to stop; nothing is lost.", err=True)
    if alone is not None:
        alone.keep(here, path)
    # A page does not wait until the odds, worked out beside it, have had their usual 5 ms.
    sys.setswitchinterval(_TURN)
    _give_memory_back()
    gc.freeze()  # what all pages share need not be looked through again

    def then() -> None:
        show(f"{here}/pin?ticket={site.ticket.draw()}")

    shown = then if asked.open else None
    server_of(site, port=port, lan=bool(there), name=asked.host or "", then=shown).run()


def _read(path: Path) -> None:
    """Read a file's night; reject a damaged file, or one that isn't a night's."""
    if holds(path, TOURNAMENT) or not read_team_events(path):
        read_tournament(path)


def _instead(path: Path) -> str:
    """Return what to open instead of a file that can't be read."""
    for copy in sorted(path.parent.glob(f"{glob.escape(path.stem)}-*.backup.db"), reverse=True):
        with suppress(EvenbreakError, OSError):
            _read(copy)
            return (
                f"The newest readable copy is {copy.name}, next to it: "
                f"drop that file on the program, or run evenbreak serve {copy}\n"
                f"To start over, rename {path.name}."
            )
    return (
        f"It has no backup copy. To start over, rename {path.name}."
        if path.suffix == ".db"
        else "A tournament's file ends in .db."
    )


def _say(site: Site, line: str) -> None:
    """Show a message about this start in the window and on the desk."""
    click.echo(line, err=True)
    site.since_start.append(line)


def _room_again(site: Site, port: int) -> list[str]:
    """Return the addresses where phones are let in again, as before this start."""
    if not site.phones_in or not goes_on(site.path):
        return []
    there = [one for one in addresses() if not _taken(one, port)]
    again = say("Phones are let in again, as before the restart.")
    cannot = say(
        "Phones could connect before the restart, but they can't now. Join the "
        "network, then let them in."
    )
    _say(site, again if there else cannot)
    return there


def _port(asked: Serve, last: int) -> int:
    """Return the requested port, or if a browser will be opened on it, the next free one.

    The night's last port is tried first, because phones know it.
    """
    if asked.open and last and asked.port == Serve.port and not _taken("127.0.0.1", last):
        return last
    why = _taken("127.0.0.1", asked.port)
    rest = range(asked.port + 1, asked.port + _PORTS) if asked.open else ()
    if why and (free := next((n for n in rest if not _taken("127.0.0.1", n)), None)):
        click.echo(f"Port {asked.port}: {why}; using {free}", err=True)
        return free
    if why:
        _refuse(asked, why)
    return asked.port


def _room(asked: Serve, port: int) -> list[str]:
    """Return the addresses where phones are let in from the start; none without --lan."""
    if not asked.lan:
        return []
    there = addresses()
    if not there:
        raise click.ClickException(
            "this computer isn't on a network. Join one, or leave --lan out."
        )
    if all(why := [_taken(one, port) for one in there]):
        _refuse(asked, why[0])
    return there


def _refuse(asked: Serve, why: str) -> None:
    asked.refuse(
        "{port} {n}: {why}. Use another one, such as {free}.",
        n=asked.port,
        why=why,
        free=asked.port + 1,
    )


def _give_memory_back() -> None:
    """Have memory used for odds and pictures returned to the system, if its library is glibc.

    Otherwise glibc would keep a heap for each thread, and everything that was once large.
    """
    with suppress(OSError, AttributeError):
        mallopt = ctypes.CDLL("libc.so.6").mallopt
        for option, value in ((_ARENAS, 1), (_TRIM, 1 << 17), (_APART, 1 << 17)):
            mallopt(option, value)


def _demo() -> Path:
    """Write the demo's evening to a separate folder, and return its file."""
    path = Path(mkdtemp(prefix="evenbreak-demo-"), "evening.db")
    write_demo_evening(path, datetime.now())
    click.echo(f"The demo: {path}, which you can delete afterward", err=True)
    return path


def _taken(host: str, port: int) -> str:
    """Return why a port can't be used; '' if it can."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        if sys.platform != "win32":  # there it would let two programs have one port
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            return (error.strerror or str(error)).lower()
    return ""
