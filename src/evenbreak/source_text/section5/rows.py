"""What the answers of section 5 are made of: inputs as the text states them, rows, cells.

A row of an answer has a quantity, the inputs it holds for and what is computed: a number,
or a formula or an enumeration as text. Beside it may stand what the text prints.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction
from typing import Any, NamedTuple, TypeAlias

_NUMBER = re.compile(r"\d*\.?\d+(/\d+)?")
_DIGITS = Context(prec=10, rounding=ROUND_HALF_EVEN)


class Row(NamedTuple):
    """One part of an answer; `computed` is a number or a text."""

    quantity: str
    inputs: str
    computed: Any
    note: str = ""


class Inputs(NamedTuple):
    """The inputs of a quantity: numbers by the name before them, and the words between."""

    named: Mapping[str, tuple[Fraction, ...]]
    words: tuple[str, ...]

    def all(self, name: str = "") -> tuple[Fraction, ...]:
        """Return the numbers that follow a name; "" for those that follow none."""
        return self.named[name]

    def one(self, name: str = "") -> Fraction:
        """Return the one number that follows a name."""
        (value,) = self.named[name]
        return value


Answers: TypeAlias = Mapping[tuple[str, str], Callable[[Inputs], Any]]
"""How to compute each quantity that the text prints, by problem and quantity."""

Derived: TypeAlias = Mapping[str, Callable[[], Iterable[Row]]]
"""What else answers each problem."""


def parse_inputs(text: str) -> Inputs:
    """Return the numbers and words of inputs such as `winner breaks p1=.9 p2=.5 win 1.0`.

    Numbers are taken as fractions; `;` and `:` stand between several of one name.

    >>> parse_inputs("1:5 p=0.3")
    Inputs(named={'': (Fraction(1, 1), Fraction(5, 1)), 'p': (Fraction(3, 10),)}, words=())
    """
    named: dict[str, tuple[Fraction, ...]] = {}
    words = []
    name = ""
    for word in text.split():
        before, equals, after = word.partition("=")
        if equals:
            name, word = before, after
        parts = re.split("[;:]", word)
        if all(_NUMBER.fullmatch(part) for part in parts):
            named[name] = (*named.get(name, ()), *map(Fraction, parts))
        elif not equals:
            name = word
            words.append(word)
    return Inputs(named, tuple(words))


def number_cell(value: Any) -> Decimal:
    """Return a number with ten significant digits, the same on every machine.

    >>> number_cell(1 / 3), number_cell(0.1 + 0.2), number_cell(16)
    (Decimal('0.3333333333'), Decimal('0.3'), Decimal('16'))
    """
    return _plain(_DIGITS.create_decimal(_sure(value)))


def difference_cell(computed: Any, printed: Decimal) -> Decimal:
    """Return computed - printed to ten decimals; what machines disagree on is below that.

    >>> difference_cell(0.1 + 0.2, Decimal("0.3")), difference_cell(0.25, Decimal("0.2"))
    (Decimal('0'), Decimal('0.05'))
    """
    difference = _sure(computed) - printed
    return _plain(difference.quantize(Decimal("1e-10"), ROUND_HALF_EVEN))


def fixed_cell(value: Any) -> Decimal:
    """Return a probability with six decimals, ties rounded alike on every machine.

    >>> fixed_cell(2**-7), fixed_cell(2**-7 + 1e-18)
    (Decimal('0.007812'), Decimal('0.007812'))
    """
    return _sure(value).quantize(Decimal("0.000001"), ROUND_HALF_EVEN)


def _sure(value: Any) -> Decimal:
    """Return the digits that are the same on every machine: a tie is rounded from these."""
    number = float(value)
    return Decimal(f"{number:.14g}") if abs(number) >= 1e-14 else Decimal(0)


def _plain(value: Decimal) -> Decimal:
    """Return a decimal without zeros at its end, and without a sign of zero."""
    value = value.normalize()
    if value == 0:
        return Decimal(0)
    return value.quantize(Decimal(1)) if value.as_tuple().exponent > 0 else value  # type: ignore[operator]
