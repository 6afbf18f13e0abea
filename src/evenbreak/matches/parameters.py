"""The chances inside a match: numbers or arrays, whichever the innermost rack holds.

Numpy is loaded only where arrays are looked at: the scalar kernels stand on this too.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, TypeVar

from evenbreak.checks import together
from evenbreak.errors import InputError
from evenbreak.games.match import Match, Score
from evenbreak.games.rack import Rack

AnyMatch = TypeVar("AnyMatch", bound=Match)


def checked_match(match: AnyMatch) -> AnyMatch:
    """Return `match` if it is one; other games are answered by their chains.

    >>> checked_match(Rack(0.5))  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: match is Rack(p1=0.5, p2=None); give a Race or an Ahead...
    """
    if not isinstance(match, Match):
        raise InputError(f"match is {match!r}; give a Race or an Ahead, or solve chain_of(game)")
    return match


def first_breaker(match: Match) -> int:
    """Return the breaker in a match's states: 1 for both where the break does not matter."""
    return match.first_breaker if match.break_matters else 1


def with_rack(match: AnyMatch, rack: Rack) -> AnyMatch:
    """Return the same match played with another innermost rack."""
    inside = match.rack
    return replace(match, rack=rack if isinstance(inside, Rack) else with_rack(inside, rack))


def broadcast(match: AnyMatch) -> tuple[AnyMatch, tuple[int, ...]]:
    """Return the match with p1 and p2 of one shape, and the shape; () for numbers."""
    rack = match.innermost_rack
    shape = shape_of(rack)
    if not shape or rack.p2 is None:
        return match, shape
    import numpy as np

    p1, p2 = np.broadcast_arrays(rack.p1, rack.p2)
    return with_rack(match, Rack(p1, p2)), shape


def shape_of(rack: Rack) -> tuple[int, ...]:
    """Return the shape that p1 and p2 have together; () for numbers."""
    return together(p1=rack.p1, p2=rack.p2)


def at_score(match: AnyMatch, score: Score | None) -> AnyMatch:
    """Return the match from `score` on; its first breaker breaks the next rack."""
    match = checked_match(match)
    return match if score is None else replace(match, score=score)


def plain(value: Any, shape: tuple[int, ...]) -> Any:
    """Return a float where the parameters were numbers, else an array of their shape."""
    if not shape:
        return float(value)
    import numpy as np

    return np.array(np.broadcast_to(value, shape), dtype=float)
