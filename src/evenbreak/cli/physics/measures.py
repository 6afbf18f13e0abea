"""The numbers that players type for a shot, and the option --metric."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.values import Number

if TYPE_CHECKING:
    from evenbreak.answers.shot_units import Units
    from evenbreak.cli.kit.options import Command


def _units(ctx: click.Context, param: click.Parameter, value: bool) -> Units:  # noqa: ARG001
    from evenbreak.answers.shot_units import IMPERIAL, METRIC

    return METRIC if value else IMPERIAL


metric_option = click.option(
    "--metric",
    "units",
    is_flag=True,
    callback=_units,
    help="Read and print centimetres, grams and metres per second.",
)
"""The option --metric; the command gets it as `units`."""


class Measure(Number):
    """A number from `low` to `high`; what refuses another shows one that would do, `example`."""

    def __init__(self, low: float, high: float, example: str) -> None:
        self.needed = f"give a number from {low:,.12g} to {high:,.12g}, such as {example}"
        super().__init__(low, high, f"; {self.needed}")

    def get_missing_message(
        self,
        param: click.Parameter,  # noqa: ARG002
        ctx: click.Context | None,  # noqa: ARG002
    ) -> str:
        """Return what to write where the option is missing."""
        return f"{self.needed.capitalize()}."


def measure_option(
    name: str, metavar: str, low: float, high: float, example: str, text: str, **more: Any
) -> Callable[[Command], Command]:
    """Return an option for a number from `low` to `high`, with `text` as its help."""
    return click.option(name, metavar=metavar, type=Measure(low, high, example), help=text, **more)
