"""The inputs of a printed number, such as `winner breaks p1=.9` or `alpha=30deg V_0=36in/s`."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, TypeAlias

from evenbreak.physics.units import DEGREE, INCH, OUNCE

_NUMBER = re.compile(r"(-?\d*\.?\d+(?:/\d+)?)(deg|in|in/s|oz|s)?")
_UNITS = {"deg": DEGREE, "in": INCH, "in/s": INCH, "oz": OUNCE}


@dataclass
class Inputs:
    """The inputs of a quantity, by name.

    Parameters
    ----------
    numbers
        exact, in the units in which they are written; `;` and `:` stand between several of one
        name, and "" is the name of those that follow none.
    units
        the factor that turns such a number into SI units or radians, where it is not 1.
    texts
        the values that are not numbers.
    words
        the words without a value.
    """

    numbers: dict[str, tuple[Fraction, ...]] = field(default_factory=dict)
    units: dict[str, float] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    words: list[str] = field(default_factory=list)

    def all(self, name: str = "") -> tuple[Fraction, ...]:
        """Return the numbers of a name, without rounding."""
        return self.numbers[name]

    def one(self, name: str = "") -> Fraction:
        """Return the one number of a name, without rounding."""
        (value,) = self.numbers[name]
        return value

    def __getitem__(self, name: str) -> Any:
        """Return the one number of a name as a float in SI units or radians, or its text."""
        if name in self.texts:
            return self.texts[name]
        return float(self.one(name)) * self.units.get(name, 1.0)

    def get(self, name: str, default: Any = None) -> Any:
        """Return the same, or a default if there is no such name."""
        return self[name] if name in self.numbers or name in self.texts else default


Answers: TypeAlias = Mapping[tuple[str, str], Callable[[Inputs], Any]]
"""How to compute each quantity that the text prints, by problem and quantity."""


def parse_inputs(text: str) -> Inputs:
    """Return the numbers, texts and words of inputs.

    >>> found = parse_inputs("half ball b/R=1/2 V_0=2in/s balls=pool 1:5")
    >>> found["b/R"], found["V_0"], found["balls"], found.words
    (0.5, 0.0508, 'pool', ['half', 'ball'])
    >>> parse_inputs("1:5 p=0.3").all(), parse_inputs("mean run 24").one("run")
    ((Fraction(1, 1), Fraction(5, 1)), Fraction(24, 1))
    """
    found = Inputs()
    name = ""
    for word in text.split():
        before, equals, after = word.partition("=")
        if equals:
            name, word = before, after
        parts = [_NUMBER.fullmatch(part) for part in re.split("[;:]", word)]
        if None not in parts:
            numbers = [part for part in parts if part]
            exact = (Fraction(number[1]) for number in numbers)
            found.numbers[name] = (*found.numbers.get(name, ()), *exact)
            if unit := _UNITS.get(numbers[0][2] or ""):
                found.units[name] = unit
        elif equals:
            found.texts[name] = word.replace("_", " ")
        else:
            name = word
            found.words.append(word)
    return found
