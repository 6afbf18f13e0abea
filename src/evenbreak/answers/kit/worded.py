"""Quantities by name, with their words in a table beside them."""

from collections.abc import Mapping
from typing import Any, TypeAlias

from evenbreak.answers.kit.parts import Quantity
from evenbreak.answers.kit.wording import decimals, yes_or_no

Words: TypeAlias = Mapping[str, tuple[str, int]]
"""What a person calls each quantity, and its decimals."""


def worded(values: Mapping[str, Any], words: Words, details: Words | None = None) -> list[Quantity]:
    """Return values as quantities, in their order; those without words are for files only.

    Parameters
    ----------
    values
        each by its name.
    words, details
        what a person calls it; `details` are for those who ask for details.

    >>> one, other = worded({"throw_deg": 1.591, "side": 0.0}, {"throw_deg": ("throw", 2)})
    >>> one.words, one.show(one.value), other.words
    ('throw', '1.59', None)
    """
    details = details or {}
    known = {**words, **details}
    quantities = []
    for name, value in values.items():
        heading, places = known.get(name, (None, 0))
        show = yes_or_no if isinstance(value, bool) else decimals(places)
        quantities.append(Quantity(name, value, heading, show, detail=name in details))
    return quantities
