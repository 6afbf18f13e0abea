"""The option --plot FILE, and writing the picture."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.cli.kit.options import Command
from evenbreak.cli.kit.terminal import write_file
from evenbreak.errors import InputError
from evenbreak.questions.common import picture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def _picture(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    try:
        return None if value is None else picture(value)
    except InputError as error:
        raise click.BadParameter(str(error), ctx=ctx, param=param) from None


def plot_option_for(only: str = "") -> Callable[[Command], Command]:
    """Return the option --plot; `only` says which answers have a picture, if not all have."""
    text = f"Write a picture to FILE, .png or .svg{only and '; ' + only}."
    return click.option("--plot", metavar="FILE", callback=_picture, help=text)


plot_option = plot_option_for()
"""The option --plot of commands whose every answer has a picture."""


def write_plot(plot: Axes | Figure, path: str) -> None:
    """Write a plot to the file named by --plot, and say so on stderr."""
    from evenbreak.plots.picture import image_bytes

    svg = PurePath(path).suffix.lower() == ".svg"
    write_file(path, image_bytes(plot, "svg" if svg else "png"))
