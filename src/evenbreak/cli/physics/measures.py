"""The numbers that players type for a shot, and the option --metric."""

from typing import Any

import click

from evenbreak.answers.physics.units import Units
from evenbreak.cli.kit.values import Number


class Measure(Number):
    """A number from `low` to `high`; what refuses another shows one that would do, `example`."""

    def __init__(self, name: str, low: float, high: float, example: str) -> None:
        self.needed = f"give a number from {low:,.12g} to {high:,.12g}, such as {example}"
        super().__init__(low, high, f"; {self.needed}")
        self.name = name

    def get_missing_message(
        self,
        param: click.Parameter,  # noqa: ARG002
        ctx: click.Context | None,  # noqa: ARG002
    ) -> str:
        """Return what to write where the option is missing."""
        return f"{self.needed.capitalize()}."


class Friction(Measure):
    """A coefficient of friction from 0 to 1, or `by-speed`: the fit to measurements."""

    def __init__(self) -> None:
        super().__init__("mu", 0.0, 1.0, "0.06, or by-speed")

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the number, or the friction that falls with the speed of the slip."""
        if str(value).strip().lower() == "by-speed":
            from evenbreak.physics import SlipFriction

            return SlipFriction()
        return super().convert(value, param, ctx)


CUT = Measure("degrees", -90.0, 90.0, "30")
LENGTH = Measure("length", 0.01, 1e5, "36")
SPEED = Measure("speed", 0.01, 1e5, "60")
WEIGHT = Measure("weight", 0.01, 1e5, "6")
SPIN = Measure("J", -100.0, 100.0, "0.3")
OFFSET = Measure("B", -1.0, 1.0, "0.4")
FRICTION = Friction()


def _units(ctx: click.Context, param: click.Parameter, value: bool) -> Units:  # noqa: ARG001
    from evenbreak.answers.physics.units import IMPERIAL, METRIC

    return METRIC if value else IMPERIAL


metric_option = click.option(
    "--metric",
    "units",
    is_flag=True,
    callback=_units,
    help="Read and print centimetres, grams and metres per second.",
)
"""The option --metric; the command gets it as `units`."""
