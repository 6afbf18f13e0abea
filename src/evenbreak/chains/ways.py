"""The ways to a stochastic limit, by name; hardly anything is loaded for them."""

from __future__ import annotations

from typing import Literal, TypeAlias

from evenbreak.checks import one_of
from evenbreak.errors import InputError

Way: TypeAlias = Literal["kernel", "elimination", "eigen"]
"""A way to the limit: a closed form, elimination of states, or eigenvectors."""
WAYS: tuple[Way, ...] = ("kernel", "elimination", "eigen")


def way_of_limit(via: Way | None, *, exact: bool = False) -> Way | None:
    """Return a way that leads over the limit of a chain; None where a function's kernel answers.

    An InputError if it is not a way, or is given together with `exact`.

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
