"""The probabilities inside a match: plain numbers or arrays.

Numpy is loaded only for arrays, because the scalar kernels use this module too.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, TypeVar

from evenbreak.errors import InputError
from evenbreak.games.match import Match, Score
from evenbreak.games.rack import Rack

AnyMatch = TypeVar("AnyMatch", bound=Match)


def checked_match(match: AnyMatch) -> AnyMatch:
    """Return `match` if it is a race or an n-ahead match; other games are solved as chains.

    >>> checked_match(Rack(0.5))  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: match is Rack(p1=0.5, p2=None); give a Race or an Ahead...
    """
    if not isinstance(match, Match):
        raise InputError(f"match is {match!r}; give a Race or an Ahead, or solve chain_of(game)")
    return match


def first_breaker(match: Match) -> int:
    """Return the first breaker as it stands in states: 1 if the break does not matter."""
    return match.first_breaker if match.break_matters else 1


def with_rack(match: AnyMatch, rack: Rack) -> AnyMatch:
    """Return the same match played with another innermost rack."""
    inside = match.rack
    return replace(match, rack=rack if isinstance(inside, Rack) else with_rack(inside, rack))


def broadcast(match: AnyMatch) -> tuple[AnyMatch, tuple[int, ...]]:
    """Return the match with p1 and p2 of the same shape, and that shape; () for numbers."""
    rack = match.innermost_rack
    shape = rack.shape
    if not shape or rack.p2 is None:
        return match, shape
    import numpy as np

    p1, p2 = np.broadcast_arrays(rack.p1, rack.p2)
    return with_rack(match, Rack(p1, p2)), shape


def at_score(match: AnyMatch, score: Score | None) -> AnyMatch:
    """Return the match from `score` on; its first breaker breaks the next rack."""
    match = checked_match(match)
    return match if score is None else replace(match, score=score)


def in_shape(value: Any, shape: tuple[int, ...]) -> Any:
    """Return a float if the parameters are numbers, else an array of their shape."""
    if not shape:
        return float(value)
    import numpy as np

    return np.array(np.broadcast_to(value, shape), dtype=float)
