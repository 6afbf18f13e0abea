"""The game diagrams of section 5: Figs. 5.2, 5.4, 5.5, 5.7, 5.10 and that of problem P5.24.

Each is a graph with symbols on its arcs: p for a success, q = 1 - p for a failure.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

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
    return {
        "figure_5_2": _endless_one_ball(),
        "figure_5_4": _two_shots(),
        "figure_5_5": _one_ball(),
        "figure_5_7": _drill(),
        "figure_5_10": _ahead(),
        "figure_p5_24": _break_formats(),
    }


def drawn(graph: nx.DiGraph[Any]) -> Figure:
    """Return the drawing of a graph whose nodes have places."""
    from evenbreak.plots.diagram import draw

    return draw(graph, layout={state: graph.nodes[state]["place"] for state in graph})


class _Sketch:
    """A graph that grows: nodes with their places, then arcs with their symbols."""

    def __init__(self) -> None:
        import networkx as nx

        self.graph: nx.DiGraph[Any] = nx.DiGraph()

    def state(self, name: str, x: float, y: float = 0.0, label: str | None = None) -> None:
        """Add a state; W and L in front of a name mean that player 1 has won or lost there."""
        winner = {"W": 1, "L": 2}.get(name[0])
        kind = "terminal" if winner else "transient"
        self.graph.add_node(name, place=(x, y), kind=kind, winner=winner)
        if label is not None:
            self.graph.nodes[name]["label"] = label

    def words(self, name: str, x: float, y: float = 0.0, label: str = r"$\cdots$") -> None:
        """Add words that are no state: dots for the states left out."""
        self.graph.add_node(name, place=(x, y), kind="words", label=label)

    def start(self, name: str) -> None:
        """Let the game begin there."""
        self.graph.nodes[name]["kind"] = "start"

    def arcs(self, arcs: Iterable[tuple[str, str, str]]) -> nx.DiGraph[Any]:
        """Add arcs (source, target, symbol) and return the graph."""
        for source, target, symbol in arcs:
            self.graph.add_edge(source, target, label=f"${symbol}$")
        return self.graph


def _endless_one_ball() -> nx.DiGraph[Any]:
    """Fig. 5.2: shot after shot, each with a chance of its own, without end."""
    sketch = _Sketch()
    arcs = []
    for shot in range(1, 5):
        end, height = (f"W{shot}", 1.0) if shot % 2 else (f"L{shot}", -1.0)
        missed = f"S{shot + 1}" if shot < 4 else "later"
        sketch.state(f"S{shot}", shot)
        sketch.state(end, shot, height)
        arcs += [(f"S{shot}", end, f"p_{shot}"), (f"S{shot}", missed, f"q_{shot}")]
    sketch.words("later", 5)
    sketch.start("S1")
    return sketch.arcs(arcs)


def _two_shots() -> nx.DiGraph[Any]:
    """Fig. 5.4: two shots with chances of their own, then an even chance."""
    sketch = _Sketch()
    for name, x, y in (("S1", 0, 0), ("W1", 0, 1), ("S2", 1, 0), ("L2", 1, -1)):
        sketch.state(name, x, y)
    sketch.state("W", 2.3, 0.7)
    sketch.state("L", 2.3, -0.7)
    sketch.start("S1")
    half = r"\frac{1}{2}q_2"
    shots = [("S1", "W1", "p_1"), ("S1", "S2", "q_1"), ("S2", "L2", "p_2")]
    return sketch.arcs([*shots, ("S2", "W", half), ("S2", "L", half)])


def _one_ball() -> nx.DiGraph[Any]:
    """Fig. 5.5: the endless game folded up into four nodes."""
    sketch = _Sketch()
    for x, name in enumerate(("W", "S1", "S2", "L")):
        sketch.state(name, x)
    sketch.start("S1")
    return sketch.arcs(
        [("S1", "W", "p_1"), ("S1", "S2", "q_1"), ("S2", "L", "p_2"), ("S2", "S1", "q_2")]
    )


def _drill() -> nx.DiGraph[Any]:
    """Fig. 5.7: a progressive drill of n levels."""
    sketch = _Sketch()
    for x, name in enumerate(("1", "2", "3")):
        sketch.state(name, x)
    sketch.words("between", 3)
    sketch.state("n-1", 4, label="$n-1$")
    sketch.state("n", 5, label="$n$")
    sketch.start("1")
    up = [("1", "2", "p_1"), ("2", "3", "p_2"), ("3", "between", "p_3")]
    up += [("between", "n-1", "p_{n-2}"), ("n-1", "n", "p_{n-1}"), ("n", "n", "p_n")]
    down = [("1", "1", "q_1"), ("2", "1", "q_2"), ("3", "2", "q_3"), ("between", "3", "q_4")]
    down += [("n-1", "between", "q_{n-1}"), ("n", "n-1", "q_n")]
    return sketch.arcs(up + down)


def _ahead() -> nx.DiGraph[Any]:
    """Fig. 5.10: the n-ahead match m:n; in the state Si player 1 leads by i games."""
    sketch = _Sketch()
    names = ["L", "S-n+1", "behind", "S-1", "S0", "S1", "ahead", "Sm-1", "W"]
    for place, name in enumerate(names):
        x = 0.85 * place  # short symbols leave room
        if name in ("behind", "ahead"):
            sketch.words(name, x)
        else:
            sketch.state(name, x, label=f"$S_{{{name[1:]}}}$" if name[1:] else None)
    sketch.start("S0")
    pairs = list(itertools.pairwise(names))
    up = [(low, high, "p") for low, high in pairs if low != "L"]
    down = [(high, low, "q") for low, high in pairs if high != "W"]
    return sketch.arcs(up + down)


def _break_formats() -> nx.DiGraph[Any]:
    """P5.24: who breaks next, winner breaks on the left and loser breaks on the right.

    Neither has a start: whoever breaks first, the long run is the same.
    """
    sketch = _Sketch()
    arcs = []
    # The symbols of staying and of leaving: the winner stays at the break, or leaves it.
    for left, name, title, stay, leave in (
        (0.0, "WB", "Winner breaks", "p", "q"),
        (3.4, "LB", "Loser breaks", "q", "p"),
    ):
        sketch.words(f"title {name}", left + 0.5, 0.6, title)
        one, two = f"S1 {name}", f"S2 {name}"
        sketch.state(one, left, label="$S_1$")
        sketch.state(two, left + 1, label="$S_2$")
        arcs += [(one, one, f"{stay}_1"), (one, two, f"{leave}_1")]
        arcs += [(two, two, f"{stay}_2"), (two, one, f"{leave}_2")]
    return sketch.arcs(arcs)
