"""The game diagrams of section 5: Figs. 5.2, 5.4, 5.5, 5.7, 5.10 and that of problem P5.24.

Each is a graph with symbols on its arcs: p for a success, q = 1 - p for a failure.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from evenbreak.source_text.cells import packaged_rows

if TYPE_CHECKING:
    import networkx as nx
    from matplotlib.figure import Figure


def diagram_graphs() -> Mapping[str, nx.DiGraph[Any]]:
    """Return the graphs behind the diagrams, by name.

    An arc carries its symbol as `label`, a node its `place` (x, y), its `kind` and,
    where someone has won there, the `winner`.

    Notes
    -----
    Source: Figs. 5.2, 5.4, 5.5, 5.7 and 5.10, and the diagrams of problem P5.24.

    >>> graph = diagram_graphs()["figure_5_5"]
    >>> graph.edges["S1", "W"]["label"]
    '$p_1$'
    """
    import networkx as nx

    graphs: dict[str, nx.DiGraph[Any]] = {}
    for figure, state, x, y, kind, label in packaged_rows("section5/diagram_states.csv"):
        winner = {"W": 1, "L": 2}[state[0]] if kind == "terminal" else None
        node: dict[str, Any] = {"label": label} if label else {}
        graph = graphs.setdefault(figure, nx.DiGraph())
        graph.add_node(state, place=(float(x), float(y)), kind=kind, winner=winner, **node)
    for figure, source, target, symbol in packaged_rows("section5/diagram_arcs.csv"):
        graphs[figure].add_edge(source, target, label=f"${symbol}$")
    return graphs


def drawn(graph: nx.DiGraph[Any]) -> Figure:
    """Return the drawing of a graph whose nodes have places."""
    from evenbreak.plots.diagram import draw

    return draw(graph, layout={state: graph.nodes[state]["place"] for state in graph})
