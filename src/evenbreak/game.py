"""What a game is, and its diagram.

A game is a directed graph that is described rather than stored: where it starts,
what can come next with what probability, and who has won where nothing more can
come. Any object that answers these three is a game; so is any `networkx.DiGraph`
whose arcs carry a `probability`.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias, runtime_checkable

from evenbreak.errors import GameError

if TYPE_CHECKING:
    import networkx as nx
    from numpy.typing import NDArray

__all__ = ["ArcArrays", "Game", "State", "graph_of"]

State: TypeAlias = Hashable
"""A situation of a game: a small tuple, string or number that prints well."""


@runtime_checkable
class Game(Protocol):
    """Anything that says where it starts, what can come next, and who has won."""

    @property
    def start(self) -> Any:
        """The state in which the game begins."""
        ...

    def moves(self, state: Any) -> Mapping[Any, float]:
        """Return the probability of each next state, given `state`; empty where it is over."""
        ...

    def winner(self, state: Any) -> int | None:
        """Return who has won in `state`: 1, 2, or None for nobody (yet)."""
        ...


class ArcArrays(NamedTuple):
    """The arcs of a game as arrays, for games of many states.

    `sources[k]`, `targets[k]` are positions in `states`; `probabilities[k]` is the
    probability of the target, given the source. States without arcs are terminal.
    """

    states: Sequence[Any]
    sources: NDArray[Any]
    targets: NDArray[Any]
    probabilities: NDArray[Any]


def graph_of(game: Game, *, max_states: int = 5_000_000) -> nx.DiGraph[Any]:
    """Return the game's diagram: every state that can be reached from its start.

    Arcs carry `probability` (of the target, given the source); nodes carry `kind`
    ('start', 'transient' or 'terminal') and `winner` (1, 2 or None). Moves of
    probability zero are left out. A start that is itself terminal is 'terminal'.

    Parameters
    ----------
    game
        the game to walk.
    max_states
        give up beyond this many states: the game may be endless.

    Raises
    ------
    GameError
        if more than `max_states` states can be reached.

    >>> from evenbreak.games import OneBall
    >>> diagram = graph_of(OneBall(0.5, 0.25))
    >>> diagram.nodes(data="kind")
    NodeDataView({'S1': 'start', 'W': 'terminal', 'S2': 'transient', 'L': 'terminal'}, data='kind')
    >>> diagram.edges["S2", "L"]["probability"]
    0.25
    """
    import networkx as nx

    graph: nx.DiGraph[Any] = nx.DiGraph()
    start = game.start
    graph.add_node(start)
    queue: list[Any] = [start]
    for state in queue:
        moves = game.moves(state)
        for target, chance in moves.items():
            if chance > 0.0:
                if target not in graph:
                    queue.append(target)
                graph.add_edge(state, target, probability=chance)
        attributes = graph.nodes[state]
        attributes["kind"] = "transient" if moves else "terminal"
        attributes["winner"] = None if moves else game.winner(state)
        if len(queue) > max_states:
            raise GameError(
                f"the game has more than {max_states} states; is its graph finite? "
                "raise max_states if it is"
            )
    if graph.nodes[start]["kind"] == "transient":
        graph.nodes[start]["kind"] = "start"
    return graph
