"""Writing the picture of --plot FILE."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING

from evenbreak.cli.kit.terminal import write_file

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def write_plot(plot: Axes | Figure, path: str) -> None:
    """Write a plot to the file named by --plot, and say so on stderr."""
    from evenbreak.plots.picture import image_bytes

    svg = PurePath(path).suffix.lower() == ".svg"
    write_file(path, image_bytes(plot, "svg" if svg else "png"))
