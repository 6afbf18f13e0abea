"""The rows of an answer that follow the printed numbers: numbers and formulas."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, TypeAlias

from evenbreak.source_text.cells import packaged_rows


class Row(NamedTuple):
    """One part of an answer.

    Parameters
    ----------
    quantity, inputs
        the quantity, and the inputs for which it is computed.
    computed
        a number, or a formula or an enumeration as text.
    note
        a comment, or ''.
    """

    quantity: str
    inputs: str
    computed: Any
    note: str = ""


Derived: TypeAlias = Mapping[str, Callable[[], Iterable[Row]]]
"""The rows of each problem, as functions that make them."""


def formulas(problem: str) -> list[Row]:
    """Return the formulas that answer a problem, and its matrices entry by entry.

    An entry is the chance of the arrow from one state to another, q = 1 - p.

    >>> formulas("P5.9")[1]
    Row(quantity='formula: mean', inputs='', computed='N p', note='')
    """
    return [Row(*row) for home, *row in packaged_rows("section5/formulas.csv") if home == problem]
