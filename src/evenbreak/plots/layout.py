"""Where the nodes of a game diagram go: on a line, on a grid of scores, or in layers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    import networkx as nx

Positions: TypeAlias = Mapping[Any, tuple[float, float]]
"""The place (x, y) of each state, in units of the distance between neighbours."""

_SWEEPS = 8


def positions_of(graph: nx.DiGraph[Any], start: Any) -> dict[Any, tuple[float, float]]:
    """Return a place for every node, in units of the distance between neighbours.

    A graph that is a path, ignoring self-loops and directions (one-ball, n-ahead, drills), lies
    on a line, with player 1's wins to the right. A graph whose states are scores (a, b), each of
    which an arc changes by 1 at most, lies on a grid: racks played to the right, player 1's
    lead upwards. Any other graph is layered by the distance from `start`, with terminal nodes
    on the outer rows: player 1's wins above, the others below.

    Parameters
    ----------
    graph
        the diagram; nodes may have a `winner`, and terminal nodes have no arc to another node.
    start
        the node from which the layers are counted.

    >>> from evenbreak.game import graph_of
    >>> from evenbreak.games import OneBall
    >>> positions_of(graph_of(OneBall(0.5, 0.5)), "S1")
    {'L': (0.0, 0.0), 'S2': (1.0, 0.0), 'S1': (2.0, 0.0), 'W': (3.0, 0.0)}
    """
    return _on_a_line(graph, start) or _on_the_lattice(graph) or _in_layers(graph, start)


def _neighbours(graph: nx.DiGraph[Any], node: Any) -> list[Any]:
    around = [*graph.predecessors(node), *graph.successors(node)]
    return [other for other in dict.fromkeys(around) if other != node]


def _on_a_line(graph: nx.DiGraph[Any], start: Any) -> dict[Any, tuple[float, float]]:
    around = {node: _neighbours(graph, node) for node in graph}
    ends = [node for node in graph if len(around[node]) <= 1]
    if not ends or any(len(others) > 2 for others in around.values()):
        return {}
    line = [min(ends, key=lambda node: (_from_left(graph, node), node != start))]
    while step := [node for node in around[line[-1]] if node not in line[-2:]]:
        line.append(step[0])
    if len(line) < len(graph):
        return {}
    return {node: (float(x), 0.0) for x, node in enumerate(line)}


def _from_left(graph: nx.DiGraph[Any], end: Any) -> int:
    return {2: 0, None: 1, 1: 2}.get(graph.nodes[end].get("winner"), 1)


def _on_the_lattice(graph: nx.DiGraph[Any]) -> dict[Any, tuple[float, float]]:
    def is_score(state: Any) -> bool:
        return (
            isinstance(state, tuple)
            and len(state) == 2
            and all(isinstance(games, int) for games in state)
        )

    def is_step(source: Any, target: Any) -> bool:
        return all(abs(i - j) <= 1 for i, j in zip(source, target, strict=True))

    if not all(map(is_score, graph)) or not all(is_step(*arc) for arc in graph.edges):
        return {}
    # 0.75 instead of 0.5: arcs of slope 3/4 leave room for their labels.
    return {(a, b): (float(a + b), 0.75 * (a - b)) for a, b in graph}


def _in_layers(graph: nx.DiGraph[Any], start: Any) -> dict[Any, tuple[float, float]]:
    import networkx as nx

    distance = nx.single_source_shortest_path_length(graph, start)
    beyond = 1 + max(distance.values())
    ends = {node for node in graph if not any(other != node for other in graph.successors(node))}
    layers: dict[int, list[Any]] = {}
    for node in graph:
        if node not in ends:
            layers.setdefault(distance.get(node, beyond), []).append(node)
    rows = _ordered(graph, list(layers.values()))
    places = {
        node: (1.5 * layer, height)
        for layer, nodes in layers.items()
        for node, height in ((node, rows[node]) for node in nodes)
    }
    highest, lowest = max(rows.values(), default=0.0) + 1.0, min(rows.values(), default=0.0) - 1.0
    taken: set[tuple[float, float]] = set()
    for node in sorted((n for n in graph if n in ends), key=lambda n: distance.get(n, beyond)):
        before = [places[other][0] for other in graph.predecessors(node) if other in places]
        x = 0.75 + (sum(before) / len(before) if before else 1.5 * beyond)
        y = highest if graph.nodes[node].get("winner") == 1 else lowest
        while any(abs(x - other) < 1.0 and y == row for other, row in taken):
            x += 0.25
        taken.add((x, y))
        places[node] = (x, y)
    return {node: places[node] for node in graph}


def _ordered(graph: nx.DiGraph[Any], layers: list[list[Any]]) -> dict[Any, float]:
    """Return each node's height; sorting layers by the mean of their neighbours untangles arcs."""
    rows: dict[Any, float] = {}
    for _ in range(_SWEEPS):
        for nodes in layers:

            def mean(node: Any) -> float:
                heights = [rows[other] for other in _neighbours(graph, node) if other in rows]
                return sum(heights) / len(heights) if heights else 0.0

            nodes.sort(key=mean, reverse=True)
            middle = (len(nodes) - 1) / 2
            rows.update({node: middle - place for place, node in enumerate(nodes)})
    return rows
