"""The probabilities in a match, plain numbers or arrays, and the endings of a custom game.

Numpy is loaded only for arrays, because the scalar kernels use this module too.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, cast

from evenbreak.checks import whole
from evenbreak.errors import GameError, InputError
from evenbreak.game import Game
from evenbreak.games.match import Match, Score
from evenbreak.games.rack import Rack

if TYPE_CHECKING:
    import networkx as nx

    from evenbreak.chains.chain import Chain
    from evenbreak.chains.passage_times import PassageTime


AnyMatch = TypeVar("AnyMatch", bound=Match)


def checked_match(match: AnyMatch) -> AnyMatch:
    """Return `match` if it is a race or an n-ahead match, with a `Rack` for a custom game.

    >>> checked_match(Rack(0.5))  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: match must be a Race or an Ahead; you gave Rack(p1=0.5, p2=None).
        For a game use game_odds(game).
    """
    if not isinstance(match, Match):
        raise InputError(
            "match must be a Race or an Ahead; you gave {match!r}. For a game use game_odds(game).",
            match=match,
        )
    innermost = match.innermost_rack
    if isinstance(innermost, Rack):
        return match

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


_CERTAIN = 1e-9
"""Tolerance for the chance that player 1 or player 2 wins a rack, which should be 1."""


class Ends(NamedTuple):
    """A game's chain, and its final states by winner; None stands for no winner."""

    chain: Chain
    by_winner: dict[int | None, list[Hashable]]

    def reached(self, states: list[Hashable]) -> PassageTime | None:
        """Return how many moves it takes to reach any of these states; None if there are none."""
        from evenbreak.chains.passage_times import first_passage

        return first_passage(self.chain, None, states) if states else None

    def p_win(self, player: int) -> float:
        """Return P(`player` wins the game)."""
        time = self.reached(self.by_winner.get(player, []))
        return 0.0 if time is None else min(time.p_reached, 1.0)


def ends_of_game(game: Game | nx.DiGraph[Any], start: Hashable | None = None) -> Ends:
    """Return how a game ends: in which states, and who has won in each of them.

    A directed graph has a `probability` on its arcs and a `winner` on final nodes. Raises
    InputError if it is not a game; GameError if a winner is not the number of a player, someone has
    won in a state that has moves, or a probability is not valid; and ChainError if the
    probabilities of a state do not sum to 1, or the start is unknown.

    >>> from evenbreak.games import OneBall
    >>> ends_of_game(OneBall(0.5, 0.5)).by_winner
    {1: ['W'], 2: ['L']}
    """
    from evenbreak.chains.explore import chain_of

    if isinstance(game, Game):
        chain = chain_of(game, start=start)
        final = [state for state in _absorbing(chain) if not game.moves(state)]
        winner_in = game.winner
    elif hasattr(game, "adjacency"):
        chain = chain_of(game, start=start)
        final, winner_in = _absorbing(chain), lambda state: game.nodes[state].get("winner")
    else:
        raise InputError(
            "{game} must be an object with start, moves and winner, or a "
            "networkx.DiGraph; you gave {value!r}",
            value=game,
        )
    _check_over(chain, final, winner_in)
    by_winner: dict[int | None, list[Hashable]] = {}
    for state in final:
        by_winner.setdefault(_player(winner_in(state), state), []).append(state)
    return Ends(chain, by_winner)


def rack_of_game(game: Game) -> Rack[float]:
    """Return the rack that each player wins with the same chance as the game.

    Raises GameError if the game has other players, or may end without a winner or not at all.

    >>> from evenbreak.games import OneBall
    >>> rack_of_game(OneBall(0.5, 0.0))
    Rack(p1=1.0, p2=None)
    """
    ends = ends_of_game(game)
    others = ends.by_winner.keys() - {1, 2, None}
    if others:
        raise GameError(
            "player {str} can win the rack. Give a game for two players.", str=min(map(str, others))
        )
    p, q = ends.p_win(1), ends.p_win(2)
    if not abs(p + q - 1.0) <= _CERTAIN:
        raise GameError(
            "the rack ends without a winner with probability {p:.6g}. Give a game that player 1 "
            "or player 2 always wins in the end.",
            p=1.0 - p - q,
        )
    return Rack(p / (p + q), q1=q / (p + q))


def _absorbing(chain: Chain) -> list[Hashable]:
    states = chain.structure.recurrent & (chain.arcs.outflow == 0.0)
    return [chain.states[k] for k in states.nonzero()[0].tolist()]


def _check_over(
    chain: Chain, final: list[Hashable], winner_in: Callable[[Any], int | None]
) -> None:
    """Raise an error for a winner in a state in which the game continues: it would not count."""
    over = set(final)
    for state in chain.states:
        if state not in over and (winner := winner_in(state)) is not None:
            raise GameError(
                "player {winner} has won in {state!r}, but there are moves from it. Give "
                "no moves from a state in which the game is over, and no winner in any other.",
                winner=winner,
                state=state,
            )


def _player(winner: Any, state: Hashable) -> int | None:
    if winner is None:
        return None
    try:
        return whole(winner, "winner", at_least=1)
    except InputError:
        raise GameError(
            "the winner in {state!r} is {winner!r}. Give a player's number, 1, 2, ..., or None "
            "if no one has won.",
            state=state,
            winner=winner,
        ) from None
