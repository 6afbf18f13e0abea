"""The probabilities inside a match: plain numbers or arrays.

Numpy is loaded only for arrays, because the scalar kernels use this module too.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, TypeVar, cast

from evenbreak.errors import InputError
from evenbreak.games.match import Match, Score
from evenbreak.games.rack import Rack

AnyMatch = TypeVar("AnyMatch", bound=Match)


def checked_match(match: AnyMatch) -> AnyMatch:
    """Return `match` if it is a race or an n-ahead match, with a `Rack` for a game of your own.

    >>> checked_match(Rack(0.5))  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: match is Rack(p1=0.5, p2=None); give a Race or an Ahead...
    """
    if not isinstance(match, Match):
        raise InputError(f"match is {match!r}; give a Race or an Ahead, or ask game_odds(game)")
    innermost = match.innermost_rack
    if isinstance(innermost, Rack):
        return match
    from evenbreak.matches.own_games import rack_of_game

    return with_rack(match, rack_of_game(innermost))


def unit_of(match: Match) -> Rack | Match:
    """Return the rack or set of a match that `checked_match` has returned."""
    return cast("Rack | Match", match.rack)


def rack_in(match: Match) -> Rack:
    """Return the innermost rack of a match that `checked_match` has returned."""
    return cast("Rack", match.innermost_rack)


def first_breaker(match: Match) -> int:
    """Return the first breaker for the states of a match: 1 if the break does not matter."""
    return match.first_breaker if match.break_matters else 1


def with_rack(match: AnyMatch, rack: Rack) -> AnyMatch:
    """Return the same match played with another innermost rack."""
    inside = match.rack
    return replace(match, rack=with_rack(inside, rack) if isinstance(inside, Match) else rack)


def at_score(match: AnyMatch, score: Score | None) -> tuple[AnyMatch, tuple[int, ...]]:
    """Return the match from `score` on, and the shape of its parameters; () for numbers.

    The first breaker breaks the next rack; p1 and p2 are broadcast to that shape.
    """
    match = checked_match(match)
    if score is not None:
        match = replace(match, score=score)
    rack = rack_in(match)
    shape = rack.shape
    if not shape or rack.p2 is None:
        return match, shape
    import numpy as np

    p1, p2, q1, q2 = np.broadcast_arrays(rack.p1, rack.p2, rack.q1, rack.q2)
    return with_rack(match, Rack(p1, p2, q1=q1, q2=q2)), shape


def in_shape(value: Any, shape: tuple[int, ...]) -> Any:
    """Return a float if the parameters are numbers, else an array of their shape."""
    if not shape:
        return float(value)
    import numpy as np

    return np.array(np.broadcast_to(value, shape), dtype=float)
