"""The chances inside a match: numbers or arrays, whichever the innermost rack holds.

Numpy is loaded only where arrays are looked at: the scalar kernels stand on this too.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, TypeVar

from evenbreak.games.match import Match, Score
from evenbreak.games.rack import Rack

__all__ = ["at_score", "broadcast", "first_breaker", "innermost", "plain", "shape_of", "with_rack"]

AnyMatch = TypeVar("AnyMatch", bound=Match)


def innermost(match: Match) -> Rack:
    """Return the rack that is played in the end, however many sets are around it."""
    rack = match.rack
    return rack if isinstance(rack, Rack) else innermost(rack)


def first_breaker(match: Match) -> int:
    """Return the breaker in a match's states: 1 for both where the break does not matter."""
    return match.first_breaker if match.break_matters else 1


def with_rack(match: AnyMatch, rack: Rack) -> AnyMatch:
    """Return the same match played with another innermost rack."""
    inside = match.rack
    return replace(match, rack=rack if isinstance(inside, Rack) else with_rack(inside, rack))


def broadcast(match: AnyMatch) -> tuple[AnyMatch, tuple[int, ...]]:
    """Return the match with p1 and p2 of one shape, and the shape; () for numbers."""
    rack = innermost(match)
    shape = shape_of(rack)
    if not shape or rack.p2 is None:
        return match, shape
    import numpy as np

    p1, p2 = np.broadcast_arrays(rack.p1, rack.p2)
    return with_rack(match, Rack(p1, p2)), shape


def shape_of(rack: Rack) -> tuple[int, ...]:
    """Return the shape that p1 and p2 have together; () for numbers."""
    import numpy as np

    return np.broadcast_shapes(np.shape(rack.p1), () if rack.p2 is None else np.shape(rack.p2))


def at_score(match: AnyMatch, score: Score | None) -> AnyMatch:
    """Return the match from `score` on; its first breaker breaks the next rack."""
    return match if score is None else replace(match, score=score)


def plain(value: Any, shape: tuple[int, ...]) -> Any:
    """Return a float where the parameters were numbers, else an array of their shape."""
    if not shape:
        return float(value)
    import numpy as np

    return np.array(np.broadcast_to(value, shape), dtype=float)
