"""The names of the methods for a stochastic limit; this module loads hardly anything else."""

from __future__ import annotations

from typing import Literal, TypeAlias

from evenbreak.checks import one_of
from evenbreak.errors import InputError

Way: TypeAlias = Literal["kernel", "elimination", "eigen"]
"""A method for the limit: a closed form, elimination of states, or eigenvectors."""
WAYS: tuple[Way, ...] = ("kernel", "elimination", "eigen")


def way_of_limit(via: Way | None, *, exact: bool = False) -> Way | None:
    """Return a method that uses a chain's limit, or None for a function's own kernel.

    Raises InputError if it is not a known method, or if it is given together with `exact`.

    >>> way_of_limit("eigen"), way_of_limit("kernel"), way_of_limit(None)
    ('eigen', None, None)
    """
    if via is None:
        return None
    if exact:
        raise InputError(
            f"via is {via!r}, but exact answers are calculated in only one way. Leave out via."
        )
    return None if one_of(via, "via", WAYS) == "kernel" else via
