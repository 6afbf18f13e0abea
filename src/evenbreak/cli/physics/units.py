"""The units that players speak in, the numbers that they type, and how answers are printed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import click
from click.types import FloatParamType

from evenbreak.cli.kit.callbacks import number
from evenbreak.cli.kit.output import paragraphs, print_quantities
from evenbreak.physics.units import CENTIMETRE, GRAM, INCH, OUNCE


class Units(NamedTuple):
    """What a length, a speed and a mass are typed and printed in.

    Parameters
    ----------
    length, speed, mass
        one of each, in metres, metres per second and kilograms.
    length_word, speed_word, mass_word
        what a terminal calls them.
    length_key, speed_key, mass_key
        how the names of quantities end that are in them.
    """

    length: float
    speed: float
    mass: float
    length_word: str
    speed_word: str
    mass_word: str
    length_key: str
    speed_key: str
    mass_key: str


PLAYERS = Units(INCH, INCH, OUNCE, "inches", "inches a second", "ounces", "in", "in_s", "oz")
"""Inches, inches per second and ounces."""

METRIC = Units(CENTIMETRE, 1.0, GRAM, "centimetres", "metres a second", "grams", "cm", "m_s", "g")
"""Centimetres, metres per second and grams."""


def _units(ctx: click.Context, param: click.Parameter, value: bool) -> Units:  # noqa: ARG001
    return METRIC if value else PLAYERS


wants_metric = click.option(
    "--metric",
    "units",
    is_flag=True,
    callback=_units,
    help="Read and print centimetres, grams and metres a second.",
)
"""The option --metric; the command gets it as `units`."""


class Measure(FloatParamType):
    """A number from `low` to `high`; refusals show one that would do, `example`."""

    def __init__(self, low: float, high: float, example: str) -> None:
        self.low, self.high = low, high
        self.wanted = f"give a number from {low:,.12g} to {high:,.12g}, such as {example}"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Return the number that was typed."""
        if isinstance(value, float):  # the default
            return value
        return number(value, self.low, self.high, f"; {self.wanted}", ctx=ctx, param=param)

    def get_missing_message(
        self,
        param: click.Parameter,  # noqa: ARG002
        ctx: click.Context | None,  # noqa: ARG002
    ) -> str:
        """Return what to write where the option is missing."""
        return f"{self.wanted[0].upper()}{self.wanted[1:]}."


def decimals(value: float, digits: int = 2) -> str:
    """Return a number with so many decimals, and never a negative nought.

    >>> decimals(0.52836), decimals(-0.001), decimals(96.7468, 1)
    ('0.53', '0.00', '96.7')
    """
    return f"{round(value, digits) + 0.0:.{digits}f}"


def print_answer(
    answer: Mapping[str, Any], *, shown: Mapping[str, tuple[str, int]], heading: str, as_json: bool
) -> None:
    """Print one answer of several quantities, as JSON, CSV or text.

    Parameters
    ----------
    answer
        each quantity by its name: a number, a truth, a plain word, or None where there is none.
    shown
        what a terminal shows, in its order: the words for a quantity and its decimals.
    heading
        the sentences above them, on a terminal.
    as_json
        whether JSON was asked for.
    """

    def text(key: str, value: Any) -> str:
        return decimals(value, shown[key][1]) if isinstance(value, float) else str(value)

    # Nothing is a negative nought.
    answer = {
        key: value + 0.0 if isinstance(value, float) else value for key, value in answer.items()
    }
    if not as_json:
        truths = {True: "yes", False: "no"}
        answer = {
            key: truths[value] if isinstance(value, bool) else value
            for key, value in answer.items()
        }
    print_quantities(
        answer,
        words={key: words for key, (words, _) in shown.items()},
        heading=paragraphs(heading),
        text=text,
        as_json=as_json,
    )
