"""The rules that every game must follow, including games from other packages."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable, Iterator
from functools import cache, partial
from itertools import islice
from typing import Any, TypeAlias, cast

from evenbreak.errors import InputError
from evenbreak.game import Game, arcs_of
from evenbreak.plugins import broken_of, lawful

MOST_TRIED = 2_000
"""Number of states on which the rules are tried, counted from the start."""

_LONGEST = 40
_Tried: TypeAlias = Callable[[], list[Any]]


def broken_laws(game: Game) -> list[str]:
    """Return the rules that a game breaks, in sentences; empty if it breaks none.

    These rules are checked on the first 2,000 states from its start: the chances of moves sum to 1,
    and moves are the same each time; no one has won while there are moves, and a winner is a
    positive whole number or None; states can be told apart in print; arcs given as arrays match its
    moves; and the game can be sent to other processes.

    >>> from evenbreak.games import OneBall
    >>> broken_laws(OneBall(0.4, 0.8))
    []
    """
    laws = (_chances_sum_to_1, _winners_end_it, _states_print_well, _arcs_are_moves)
    tried = cache(lambda: list(islice(_states(game), MOST_TRIED)))
    return broken_of([partial(_it_is_a_value, game), *(partial(law, game, tried) for law in laws)])


def lawful_game(game: Any) -> Game:
    """Return a game that breaks no rule, or raise an error for the first rule that it breaks."""
    lacking = [name for name in ("start", "moves", "winner") if not hasattr(game, name)]
    if lacking:
        raise InputError("it has no {lacking}; a game needs them", lacking=" and no ".join(lacking))
    return cast("Game", lawful(game, broken_laws(game)))


def _states(game: Game) -> Iterator[Any]:
    """Yield the states that can be reached, breadth-first."""
    known = {game.start: None}
    states = [game.start]
    for state in states:
        yield state
        fresh = [target for target, p in game.moves(state).items() if p and target not in known]
        known.update(dict.fromkeys(fresh))
        states += fresh


def _it_is_a_value(game: Game) -> Iterator[str]:
    if pickle.loads(pickle.dumps(game)).moves(game.start) != game.moves(game.start):  # noqa: S301
        yield "it changes when sent to another process"


def _chances_sum_to_1(game: Game, tried: _Tried) -> Iterator[str]:
    for state in tried():
        moves = game.moves(state)
        if moves != game.moves(state):
            yield f"the moves from {state!r} differ the second time they're asked for"
        for target, p in moves.items():
            if not 0.0 <= p <= 1.0:
                yield (
                    f"the move {state!r} -> {target!r} has probability {p!r}. Give a number "
                    "from 0 to 1."
                )
        if moves and not math.isclose(total := sum(moves.values()), 1.0, abs_tol=1e-9):
            yield f"the moves from {state!r} have chances that sum to {float(total):.9g}, not 1"


def _winners_end_it(game: Game, tried: _Tried) -> Iterator[str]:
    for state in tried():
        winner = game.winner(state)
        if game.moves(state):
            if winner is not None:
                yield f"player {winner} has won in {state!r}, but there are moves from it"
        elif winner is not None and winner not in range(1, 1000):
            yield f"the winner in {state!r} must be 1, 2, ... or None; it is {winner!r}"


def _states_print_well(_: Game, tried: _Tried) -> Iterator[str]:
    seen: dict[str, Any] = {}
    for state in tried():
        text = str(state)
        if len(text) > _LONGEST or " object at " in text or "\n" in text:
            yield (
                f"the state {text[:_LONGEST]!r} doesn't print on one line of at most "
                f"{_LONGEST} characters"
            )
        if seen.setdefault(text, state) != state:
            yield f"two different states print as {text!r}"


def _arcs_are_moves(game: Game, tried: _Tried) -> Iterator[str]:
    states = tried()
    if not hasattr(game, "arcs") or len(states) == MOST_TRIED:
        return
    arcs = arcs_of(game)
    given = zip(arcs.sources, arcs.targets, arcs.probabilities, strict=True)
    listed = {(arcs.states[i], arcs.states[j]): float(p) for i, j, p in given}
    walked = {(one, to): float(p) for one in states for to, p in game.moves(one).items() if p}
    if listed.keys() != walked.keys() or any(
        abs(p - walked[arc]) > 1e-9 for arc, p in listed.items()
    ):
        yield "the arcs it gives as arrays don't match its moves"
