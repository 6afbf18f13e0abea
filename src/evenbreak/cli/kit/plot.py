"""The option --plot FILE, and writing the picture."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.cli.kit.options import Command
from evenbreak.cli.kit.terminal import write_file

if TYPE_CHECKING:
    from matplotlib.figure import Figure


KINDS = (".png", ".svg")


def _picture(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    if value is None:
        return None
    folder = Path(value).parent
    wrong = ""
    if PurePath(value).suffix.lower() not in KINDS:
        wrong = "name a file that ends in .png or .svg"
    elif not folder.exists():
        wrong = f"there is no folder {str(folder)!r}; make it first, or name another"
    elif not folder.is_dir():
        wrong = f"{str(folder)!r} is a file, so no picture can be in it; name a folder"
    elif Path(value).is_dir():
        wrong = "that is a folder; name a file in it"
    if wrong:
        raise click.BadParameter(f"{value!r}; {wrong}", ctx=ctx, param=param)
    return value


def plot_option_for(only: str = "") -> Callable[[Command], Command]:
    """Return the option --plot; `only` says which answers have a picture, if not all have."""
    text = f"Write a picture to FILE, .png or .svg{only and '; ' + only}."
    return click.option("--plot", metavar="FILE", callback=_picture, help=text)


plot_option = plot_option_for()
"""The option --plot of commands whose every answer has a picture."""


def write_plot(figure: Figure, path: str) -> None:
    """Write a figure to the file named by --plot, and say so on stderr."""
    from evenbreak.plots.picture import image_bytes

    svg = PurePath(path).suffix.lower() == ".svg"
    write_file(path, image_bytes(figure, "svg" if svg else "png"))
