"""The units for typing and showing lengths, speeds and weights: inches or centimeters."""

from typing import NamedTuple

from evenbreak.answers.kit.columns import quantity_of
from evenbreak.answers.kit.parts import Quantity
from evenbreak.answers.kit.wording import decimals
from evenbreak.physics.units import CENTIMETER, GRAM, INCH, OUNCE
from evenbreak.words import Parameter, say


class Unit(NamedTuple):
    """A unit: its size in SI units, the suffix for names in it, its plural."""

    size: float
    key: str
    words: str

    def text(self, value: float, places: int = 1) -> str:
        """Return a value, given in SI units, in this unit.

        >>> IMPERIAL.length.text(1.0)
        '39.4 inches'
        """
        return f"{decimals(places)(value / self.size)} {self.words}"

    def is_nothing(self, value: float, places: int) -> bool:
        """Return whether a value, given in SI units, rounds to 0 in this unit.

        >>> IMPERIAL.length.is_nothing(0.0001, 2), IMPERIAL.length.is_nothing(-0.001, 2)
        (True, False)
        """
        return round(value / self.size, places) == 0.0

    def typed(self, value: float) -> str:
        """Return a value, given in SI units, as it was typed in this unit.

        >>> IMPERIAL.length.typed(0.9144)
        '36 inches'
        """
        return f"{value / self.size:.6g} {self.words}"

    def quantity(self, key: str, value: float | None) -> Quantity:
        """Return a value, given in SI units, as a quantity in this unit.

        >>> quantity = METRIC.speed.quantity("ball_speed", 1.5)
        >>> quantity.name, quantity.value, quantity.words
        ('ball_speed_m_s', 1.5, 'speed of the ball, meters per second')
        """
        number = None if value is None else float(value) / self.size
        return quantity_of(key, number, unit=self.key, units=self.words)


class Units(NamedTuple):
    """A command's units for lengths, speeds and masses."""

    length: Unit
    speed: Unit
    mass: Unit


IMPERIAL = Units(
    Unit(INCH, "in", "inches"), Unit(INCH, "in_s", "inches per second"), Unit(OUNCE, "oz", "ounces")
)
"""Inches, inches per second and ounces."""

METRIC = Units(
    Unit(CENTIMETER, "cm", "centimeters"),
    Unit(1.0, "m_s", "meters per second"),
    Unit(GRAM, "g", "grams"),
)
"""Centimeters, meters per second and grams."""

_TYPICAL = {
    "stick": ((10.0, 30.0), (280.0, 850.0)),
    "ball": ((3.0, 10.0), (85.0, 285.0)),
    "forearm": ((10.0, 320.0), (280.0, 9000.0)),
    "speed": ((0.0, 600.0), (0.0, 15.0)),
    "stick_speed": ((0.0, 600.0), (0.0, 15.0)),
}
"""An option's typical range, in imperial and metric units."""


def unit_doubts(units: Units, **typed: float | None) -> list[str]:
    """Return a warning for each option whose value looks like it is in other units.

    >>> unit_doubts(IMPERIAL, stick=19.0, ball=None, stick_speed=60.0)
    []
    >>> unit_doubts(IMPERIAL, ball=170.0)
    ['ball 170 ounces is unusual (3 to 10 is typical). For grams, add metric.']
    """
    doubts: list[str] = []
    metric = units is METRIC
    for name, value in typed.items():
        low, high = _TYPICAL[name][metric]
        if value is None or low <= value <= high:
            continue
        kind = "speed" if name.endswith("speed") else "mass"
        other = getattr(IMPERIAL if metric else METRIC, kind).words
        option = Parameter("metric")
        remedy = say("For {other}, add {option}.", other=other, option=option)
        if metric:
            remedy = say("For {other}, leave out {option}.", other=other, option=option)
        doubts.append(
            say(
                "{name} {value:g} {unit} is unusual ({low:g} to {high:g} is typical). {remedy}",
                name=Parameter(name),
                value=value,
                unit=getattr(units, kind).words,
                low=low,
                high=high,
                remedy=remedy,
            )
        )
    return doubts
