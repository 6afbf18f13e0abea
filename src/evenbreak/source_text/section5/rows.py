"""What else answers a problem: rows that stand below the numbers that the text prints."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, TypeAlias


class Row(NamedTuple):
    """One part of an answer.

    Parameters
    ----------
    quantity, inputs
        what it is and for what.
    computed
        a number, or a formula or an enumeration as text.
    note
        what there is to say; '' for nothing.
    """

    quantity: str
    inputs: str
    computed: Any
    note: str = ""


Derived: TypeAlias = Mapping[str, Callable[[], Iterable[Row]]]
"""The rows of each problem, as functions that make them."""
