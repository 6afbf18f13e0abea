"""The interface of a game, and its diagram.

A game is a directed graph that is described rather than stored: where it starts, what can happen
next and with what probability, and who has won once it is over. Any object that answers these three
questions is a game, and so is any `networkx.DiGraph` whose arcs have a `probability`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, runtime_checkable

from evenbreak.errors import GameError

if TYPE_CHECKING:
    import networkx as nx
    from numpy.typing import NDArray

_ONE = 1.0 + 1e-9  # a sum of probabilities may miss 1 by rounding


@runtime_checkable
class Game(Protocol):
    """Any object that knows where it starts, what can happen next, and who has won.

    A game may also have a method `label(state)`, which returns a state's text in a diagram, and a
    method `arcs()` (see `ArcArrays`).
    """

    @property
    def start(self) -> Any:
        """The state in which the game starts."""
        ...

    def moves(self, state: Any, /) -> Mapping[Any, float]:
        """Return the probability of each next state, given `state`; empty if the game is over."""
        ...

    def winner(self, state: Any, /) -> int | None:
        """Return the number of the player who has won in `state`: 1, 2, ...; None if no one has."""
        ...


class ArcArrays(NamedTuple):
    """The arcs of a game as arrays, for games with many states.

    `sources[k]` and `targets[k]` are positions in `states`; `probabilities[k]` > 0 is the
    probability of the target, given the source. States without arcs are terminal. A game
    may have a method `arcs()` that returns these, for the start and every state that can
    be reached from it, or None if they have to be found from its moves.
    """

    states: Sequence[Any]
    sources: NDArray[Any]
    targets: NDArray[Any]
    probabilities: NDArray[Any]


def arcs_of(game: Game, *, start: Any = None, max_states: int = 5_000_000) -> ArcArrays:
    """Return every state that can be reached from the start, and the arcs between them.

    Parameters
    ----------
    game
        the game. If it has its own arrays, they are used; otherwise, its states are found move by
        move, breadth-first. Moves of probability zero are left out.
    start
        the state to start from; None: the game's own start.
    max_states
        the largest number of states; beyond it an error is raised, as the game may be endless.

    Returns
    -------
    ArcArrays
        the arcs sorted by source; each probability is conditional on the source.

    Raises
    ------
    GameError
        if `game` is not a game, more than `max_states` states can be reached, a probability
        is not a number from 0 to 1, or all moves from a state have probability zero.

    >>> from evenbreak.games import Rack, Race
    >>> arcs = arcs_of(Race(2, 1, Rack(0.75)))
    >>> list(arcs.states)
    [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0)]
    >>> for arc in zip(arcs.sources, arcs.targets, arcs.probabilities):
    ...     print(*arc)
    0 1 0.25
    0 2 0.75
    2 3 0.25
    2 4 0.75
    """
    if isinstance(game, type):
        raise GameError(
            f"the game is the class {game.__name__} itself. Give an instance, such as "
            f"{game.__name__}(...)."
        )
    if not hasattr(game, "moves"):
        raise GameError(
            "{game} isn't a game. Give an object with start, moves and winner; for a graph, "
            "dict or matrix, make a chain instead: chain_of(graph, start=state).",
            game=repr(game),
        )
    offer = getattr(game, "arcs", None)
    if offer is not None and (start is None or start == game.start):
        arcs: ArcArrays | None = offer()
        if arcs is not None:
            if len(arcs.states) > max_states:
                raise _too_many(max_states)
            return arcs
    return _walk(game, game.start if start is None else start, max_states)


def _walk(game: Game, start: Any, max_states: int) -> ArcArrays:
    import numpy as np

    states, sources, targets, chances = moves_of(game, start, max_states)
    return ArcArrays(
        states,
        np.array(sources, dtype=np.intp),
        np.array(targets, dtype=np.intp),
        np.array(chances, dtype=object if Fraction in map(type, chances) else float),
    )


def moves_of(
    game: Game, start: Any, max_states: int = 5_000_000
) -> tuple[list[Any], list[int], list[int], list[Any]]:
    """Return the states from `start` on, and the moves' sources, targets and chances.

    The states are found breadth-first. A chance is kept as the game gives it: any kind of number
    that can be compared with 0 and 1.

    Raises
    ------
    GameError
        as `arcs_of` does.

    >>> from evenbreak.games import OneBall
    >>> moves_of(OneBall(0.5, 0.25), "S1")
    (['S1', 'W', 'S2', 'L'], [0, 0, 2, 2], [1, 2, 3, 0], [0.5, 0.5, 0.25, 0.75])
    """
    try:
        position = {start: 0}
    except TypeError:
        raise GameError(
            f"the start must be a hashable state, such as a tuple; you gave {start!r}"
        ) from None
    states = [start]
    sources: list[int] = []
    targets: list[int] = []
    chances: list[Any] = []
    for j, state in enumerate(states):
        before = len(targets)
        moves = game.moves(state)
        if not hasattr(moves, "items"):
            raise GameError(
                f"the moves from {state!r} must be a dict from states to probabilities (empty if "
                f"the game is over); you gave {moves!r}"
            )
        for target, chance in moves.items():
            try:
                possible = bool(0.0 < chance <= _ONE)
            except (TypeError, ValueError):  # a text, or an array of chances
                raise _no_chance(state, target, chance) from None
            if possible:
                i = position.setdefault(target, len(states))
                if i == len(states):
                    states.append(target)
                sources.append(j)
                targets.append(i)
                chances.append(chance)
            elif chance != 0.0:
                raise _no_chance(state, target, chance)
        if moves and len(targets) == before:
            raise GameError(
                f"every move from {state!r} has probability 0. Give probabilities that "
                "sum to 1, or no moves if the game is over."
            )
        if len(states) > max_states:
            raise _too_many(max_states)
    return states, sources, targets, chances


def _no_chance(state: Any, target: Any, chance: Any) -> GameError:
    return GameError(
        f"the move {state!r} -> {target!r} has probability {chance!r}. Give a number from 0 to 1."
    )


def _too_many(max_states: int) -> GameError:
    return GameError(
        f"the game has more than {max_states:,} states. If its graph is finite, use "
        "graph_of(game, max_states=...) and make a chain from that graph."
    )


def graph_of(game: Game, *, start: Any = None, max_states: int = 5_000_000) -> nx.DiGraph[Any]:
    """Return the game's diagram: every state that can be reached from its start.

    Arcs have a `probability` (of the target, given the source); nodes have a `kind` ('start',
    'transient' or 'terminal') and a `winner` (1, 2, ... or None). Moves of probability zero are
    left out. If the game is over at its start, the start is 'terminal'.

    Parameters
    ----------
    start
        the state to start from; None: the game's own start.
    max_states
        the largest number of states; beyond it an error is raised, as the game may be endless.

    Raises
    ------
    GameError
        as `arcs_of` does.

    >>> from evenbreak.games import OneBall
    >>> diagram = graph_of(OneBall(0.5, 0.25))
    >>> diagram.nodes(data="kind")
    NodeDataView({'S1': 'start', 'W': 'terminal', 'S2': 'transient', 'L': 'terminal'}, data='kind')
    >>> diagram.edges["S2", "L"]["probability"]
    0.25
    """
    arcs = arcs_of(game, start=start, max_states=max_states)
    graph = graph_of_arcs(arcs, game.start if start is None else start)
    for state, node in graph.nodes.items():
        node["winner"] = game.winner(state) if node["kind"] == "terminal" else None
    return graph


def graph_of_arcs(arcs: ArcArrays, start: Any) -> nx.DiGraph[Any]:
    """Return the diagram of the given arcs, like `graph_of` but without winners.

    >>> import numpy as np
    >>> graph_of_arcs(ArcArrays("SW", *map(np.array, ([0], [1], [1.0]))), "S").nodes(data="kind")
    NodeDataView({'S': 'start', 'W': 'terminal'}, data='kind')
    """
    import networkx as nx
    import numpy as np

    states = list(arcs.states)
    graph: nx.DiGraph[Any] = nx.DiGraph()
    graph.add_nodes_from(states, kind="transient")
    if start is not None:
        graph.nodes[start]["kind"] = "start"
    arc_counts = np.bincount(arcs.sources, minlength=len(states))
    for i in np.flatnonzero(arc_counts == 0).tolist():
        graph.nodes[states[i]]["kind"] = "terminal"
    # One call for all arcs, without a list of triples, is three times as fast.
    graph.add_weighted_edges_from(
        zip(
            map(states.__getitem__, arcs.sources.tolist()),
            map(states.__getitem__, arcs.targets.tolist()),
            arcs.probabilities.astype(float).tolist(),
            strict=True,
        ),
        weight="probability",
    )
    return graph
