"""What a command writes: the answer on stdout, everything else on stderr, and files."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.answers.faces.to_text import WIDTH, paragraph
from evenbreak.cli.interrupts import raise_if_interrupted
from evenbreak.cli.kit.progress import erase
from evenbreak.cli.kit.said import refuse
from evenbreak.files.tables.problems import printable

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def to_terminal() -> bool:
    """Return whether the output goes to a terminal."""
    return sys.stdout is not None and sys.stdout.isatty()


def can_ask() -> bool:
    """Return whether someone is there to answer a question."""
    return all(one is not None and one.isatty() for one in (sys.stdin, sys.stderr))


def write(text: str) -> None:
    """Write text to stdout; letters that the terminal cannot show become question marks."""
    raise_if_interrupted()
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    click.echo(text.encode(encoding, "replace"), nl=False)


def write_file(path: str, content: bytes) -> None:
    """Write the file that an option names, and say so."""
    from evenbreak.files.store.folder import write_files

    place = Path(path)
    # The option itself is one that names it.
    if len(list(_named_by(place))) > 1:
        refuse(f"{path} is read by this command and would be overwritten. Choose another file.")
    raise_if_interrupted()
    write_files(str(place.parent), {place.name: content})
    say(f"Wrote {path}")


def write_folder(out: str, files: Mapping[str, bytes | None]) -> None:
    """Write files into the folder of --out, remove those that are None, and say so."""
    from evenbreak.files.store.folder import write_files

    for name in files:
        for given in _named_by(Path(out, name)):
            refuse(
                f"{given} is read by this command and would be overwritten by the {name} "
                "that it writes. Choose another folder with --out."
            )
    raise_if_interrupted()
    write_files(out, files)
    written = [name for name, content in files.items() if content is not None]
    named = ", ".join(written) if len(written) <= _MOST_NAMED else f"{len(written):,} files"
    say(f"Wrote {named} to {out}")


_MOST_NAMED = 12

FILES_OF_LEAGUE = "evenbreak files of league"
"""Where a command's context has the files of the league from which it takes defaults."""


def _named_by(place: Path) -> Iterator[str]:
    """Yield the files that the command has been given, or its league names, which are this one."""
    if not place.exists():
        return
    ctx = click.get_current_context()
    for value in (*ctx.params.values(), ctx.meta.get(FILES_OF_LEAGUE, ())):
        for given in value if isinstance(value, tuple) else (value,):
            if isinstance(given, str) and Path(given).is_file() and place.samefile(given):
                yield given


def say(message: str) -> None:
    """Print a message on stderr; on a terminal its lines are wrapped."""
    raise_if_interrupted()
    erase()
    terminal = sys.stderr is not None and sys.stderr.isatty()
    # File names stay whole, so that they can be copied.
    click.echo(paragraph(message, WIDTH) if terminal else printable(message), err=True)


def write_plot(plot: Axes | Figure, path: str) -> None:
    """Write a plot to the file named by --plot, and say so on stderr."""
    from evenbreak.plots.picture import image_bytes

    svg = PurePath(path).suffix.lower() == ".svg"
    write_file(path, image_bytes(plot, "svg" if svg else "png"))
