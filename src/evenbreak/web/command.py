"""`evenbreak serve`: the page on the director's phone and the venue's screen."""

from __future__ import annotations

import socket
import sys
from datetime import datetime
from pathlib import Path
from tempfile import mkdtemp

import click

EXAMPLES = """\b
Examples:
  evenbreak serve
  evenbreak serve saturday.db --lan
  evenbreak serve --demo
"""


@click.command("serve", epilog=EXAMPLES)
@click.argument("file", metavar="[FILE.db]", required=False)
@click.option("--demo", is_flag=True, help="Open a made-up evening that is half played.")
@click.option(
    "--lan",
    is_flag=True,
    help="Let phones in the same network open the page; prints its address and a QR code.",
)
@click.option(
    "--port",
    type=click.IntRange(1024, 65535),
    metavar="N",
    default=8000,
    help="Where the page is found on this computer.",
)
def command(*, file: str | None, demo: bool, lan: bool, port: int) -> None:
    """Open tonight's tournament or team night as a page, for phones and the screen on the wall.

    FILE.db is the tournament's file, as evenbreak tournament new writes it, or that of a team
    night; tonight.db unless given. If it is not there, the page begins one. The commands of
    evenbreak tournament can be used on it at the same time.
    """
    import segno

    from evenbreak.errors import EvenbreakError
    from evenbreak.files.store.desk import back_up
    from evenbreak.files.store.evening_file import TOURNAMENT, holds
    from evenbreak.files.store.team_night import read_team_events
    from evenbreak.files.store.tournament import read_tournament
    from evenbreak.web.server import server_of
    from evenbreak.web.site import Site

    if demo and file is not None:
        raise click.UsageError(f"--demo makes a file of its own; leave out {file} or --demo")
    path = _demo() if demo else Path(file or "tonight.db")
    if path.exists():
        if holds(path, TOURNAMENT) or not read_team_events(path):
            read_tournament(path)
        try:
            back_up(path, datetime.now())
        except (EvenbreakError, OSError) as error:  # it can be shown all the same
            click.echo(f"Warning: no copy of {path} could be made: {error}", err=True)
    elif not path.parent.is_dir():
        raise click.UsageError(
            f"{path}: there is no folder {path.parent}; make it, or name another"
        )
    own = _own_address() if lan else "127.0.0.1"
    hosts = {"127.0.0.1", "localhost", "::1", own}
    if lan:
        hosts |= {socket.gethostname().lower(), f"{socket.gethostname().lower()}.local"}
    address = f"http://{own}:{port}"
    site = Site(path, frozenset(hosts), address)
    refused = _taken("0.0.0.0" if lan else "127.0.0.1", port)  # noqa: S104
    if refused:
        raise click.UsageError(f"--port {port}: {refused}; give another one, such as {port + 1}")
    click.echo(f"The page: {address}", err=True)
    click.echo(f"The director's PIN: {site.pin}", err=True)
    if lan:
        segno.make(address, error="l").terminal(sys.stderr, compact=True)
    click.echo("Ctrl+C ends it; nothing is lost.", err=True)
    server_of(site, host="0.0.0.0" if lan else "127.0.0.1", port=port).run()  # noqa: S104


def _demo() -> Path:
    """Write the demo's evening to a folder of its own, and return its file."""
    from evenbreak.files.demo import write_demo_evening

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
