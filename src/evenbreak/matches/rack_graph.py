"""The states of a match, and the two to which the next rack can lead from each of them."""

from __future__ import annotations

from typing import Any

from evenbreak.games.match import Match
from evenbreak.games.rack import Rack
from evenbreak.matches.parameters import rack_in, with_rack

RackMoves = dict[Any, tuple[tuple[Any, Any], tuple[Any, Any]]]


def rack_moves(match: Match, start: Any = None) -> RackMoves:
    """Return the next state and its chance for each winner of the next rack, by state.

    The entry for player 1 comes first. Both are listed, even with a chance of 0, as people win
    racks in which a model gives them no chance. States that are not listed are final.

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks or of sets; its chances may be arrays.
    start
        the state from which the others are reached; None: the match's own start.

    >>> from evenbreak.games import Race
    >>> rack_moves(Race(2, 1, Rack(0.75)))
    {(0, 0): (((1, 0), 0.75), ((0, 1), 0.25)), (1, 0): (((2, 0), 0.75), ((1, 1), 0.25))}
    """
    rack = rack_in(match)
    template = with_rack(match, Rack(0.5, 0.5) if rack.break_matters else Rack(0.5))
    chances = {breaker: (rack.chance(1, breaker), rack.chance(2, breaker)) for breaker in (1, 2)}
    moves: RackMoves = {}
    queue = [template.start if start is None else start]
    for state in queue:
        if state in moves or template.winner(state) is not None:
            continue
        # A state's moves are listed with the one that player 1 wins first.
        won, lost = template.moves(state)
        p_won, p_lost = chances[breaker_in(match, state)]
        moves[state] = (won, p_won), (lost, p_lost)
        queue += [won, lost]
    return moves


def breaker_in(match: Match, state: Any) -> int:
    """Return who breaks the next rack in a state; 1 where the break does not matter.

    >>> from evenbreak.games import Race, winner_breaks
    >>> breaker_in(Race(2, 1, Rack(0.6, 0.5), breaks=winner_breaks), (1, 0, 2))
    2
    """
    if not match.break_matters:
        return 1
    innermost = state[-1]
    return breaker_in(match, innermost) if isinstance(innermost, tuple) else int(innermost)
