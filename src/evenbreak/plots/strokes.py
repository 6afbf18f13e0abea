"""Drawing of a game diagram: circles, arcs, loops, labels, and node positions."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from math import atan2, cos, hypot, inf, pi, sin
from typing import TYPE_CHECKING, Any, TypeAlias

from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyArrowPatch
from matplotlib.path import Path as Curve

if TYPE_CHECKING:
    import networkx as nx


Point: TypeAlias = tuple[float, float]

_RADIUS = 0.27
"""Radius of a circle, in units of the distance between neighbors."""
_RING = 0.82
"""The inner circle of a terminal node, as a fraction of the outer one."""
INCHES = 1.25
"""The length of a unit, for labels of up to eight characters."""
FONT = 11.0
_HEAD = "-|>,head_length=5,head_width=2.5"
_BENDS = (0.0, 0.25, -0.25, 0.4, -0.4, 0.6, -0.6)
_ALONG = (0.5, 0.4, 0.6, 0.3, 0.7)
"""Positions along an arc for its label, best first."""
_FILL = {None: ("white", "black"), 1: ("0.85", "black"), 2: ("0.35", "white")}
"""Fill and text color of a terminal node by winner; they differ in black and white too."""
_GOLDEN = 0.381966
"""Steps around the color circle that never return to a color already used."""


def is_terminal(graph: nx.DiGraph[Any], state: Any) -> bool:
    """Return whether no arc leads from `state` to another state."""
    return all(target == state for target in graph.successors(state))


def is_words(graph: nx.DiGraph[Any], state: Any) -> bool:
    """Return whether a node is not a state but text, such as dots or a heading."""
    return bool(graph.nodes[state].get("kind") == "words")


def fills(graph: nx.DiGraph[Any]) -> dict[Any, tuple[Any, str]]:
    """Return the fill and text color of a terminal node for each winner, and for none.

    Players 1 and 2 are gray; every other winner has its own color.

    >>> import networkx as nx
    >>> graph = nx.DiGraph()
    >>> graph.add_nodes_from([("a", {"winner": 3}), ("b", {"winner": 4}), ("c", {"winner": 2})])
    >>> list(fills(graph)), len(set(fills(graph).values()))
    ([None, 1, 2, 3, 4], 5)
    """
    from colorsys import hls_to_rgb

    winners: dict[Any, None] = dict.fromkeys(node.get("winner") for node in graph.nodes.values())
    others = [winner for winner in winners if winner not in _FILL]
    others.sort(key=lambda winner: winner if isinstance(winner, int) else inf)
    return _FILL | {
        winner: (hls_to_rgb((0.55 + _GOLDEN * k) % 1.0, 0.72, 0.8), "black")
        for k, winner in enumerate(others)
    }


def _arc_label(arc: Mapping[str, Any]) -> str:
    if "label" in arc:
        return str(arc["label"])
    return f"{arc['probability']:.3g}" if "probability" in arc else ""


def longest_line(text: str) -> int:
    """Return how many characters the longest line shows; math markup takes no room."""
    return max(len(re.sub(r"\\[a-z]+|[${}_^\\]", "", line)) for line in text.split("\n"))


def _bent(a: Point, b: Point, bend: float, t: float) -> Point:
    """Return the point at t of the arc from a to b, a quadratic Bezier curve."""
    control = (
        (a[0] + b[0]) / 2 + bend * (b[1] - a[1]),
        (a[1] + b[1]) / 2 - bend * (b[0] - a[0]),
    )
    weights = ((1 - t) ** 2, 2 * t * (1 - t), t * t)
    x, y = (
        sum(w * p for w, p in zip(weights, coordinates, strict=True))
        for coordinates in zip(a, control, b, strict=True)
    )
    return x, y


class Pen:
    """Draws one diagram: arcs first, so that the circles cover their ends."""

    def __init__(
        self, axes: Axes, graph: nx.DiGraph[Any], places: Positions, inches: float
    ) -> None:
        self.axes = axes
        self.graph = graph
        self.places = places
        self.points_per_unit = 72 * inches
        self.font = FONT * min(1.0, inches / INCHES)
        self.fills = fills(graph)
        self.used: dict[Any, list[float]] = {state: [] for state in graph}
        self.boxes = [(x, y, 0.8 * _RADIUS, 0.8 * _RADIUS) for x, y in places.values()]
        self.tracks: dict[tuple[Any, Any], list[Point]] = {}
        self.reach = [
            (x + turn * _RADIUS, y + turn * _RADIUS) for x, y in places.values() for turn in (-1, 1)
        ]

    def draw(self, start: Any, labels: Mapping[Any, str]) -> None:
        """Draw everything; `labels` are the texts of the states, `start` may be None."""
        arcs = [(source, target) for source, target in self.graph.edges if source != target]
        bends = {arc: self.bend(*arc) for arc in arcs}
        for arc, bend in bends.items():
            self.arc(*arc, bend)
        for arc, bend in bends.items():
            self.label_arc(*arc, bend)
        for state in self.graph:
            if self.graph.has_edge(state, state) and not is_terminal(self.graph, state):
                self.loop(state, _arc_label(self.graph.edges[state, state]))
        if start is not None:
            self.arrow_into(start)
        for state, label in labels.items():
            if is_words(self.graph, state):
                self.words(state, label)
            else:
                self.circle(state, label)

    def bend(self, source: Any, target: Any) -> float:
        """Return a curvature that stays clear of other circles and of the opposite arc."""
        a, b = self.places[source], self.places[target]
        opposite = self.graph.has_edge(target, source)
        others = [self.places[s] for s in self.graph if s not in (source, target)]

        def clearance(bend: float) -> float:
            path = [_bent(a, b, bend, k / 20) for k in range(1, 20)]
            return min(
                (hypot(x - u, y - v) for x, y in path for u, v in others), default=2 * _RADIUS
            )

        # Positive: two opposite arcs each bend to their own left, so they separate.
        choices = [bend for bend in _BENDS if not opposite or bend > 0]
        return next((bend for bend in choices if clearance(bend) > 1.3 * _RADIUS), choices[0])

    def arc(self, source: Any, target: Any, bend: float) -> None:
        """Draw the arrow from one circle to another."""
        a, b = self.places[source], self.places[target]
        shrink = _RADIUS * self.points_per_unit
        self.axes.add_patch(
            FancyArrowPatch(
                a,
                b,
                arrowstyle=_HEAD,
                connectionstyle=f"arc3,rad={bend}",
                shrinkA=shrink,
                shrinkB=shrink,
                linewidth=1.0,
                color="black",
            )
        )
        self.tracks[source, target] = path = [_bent(a, b, bend, k / 20) for k in range(21)]
        for here, (x, y) in ((source, path[4]), (target, path[-5])):
            self.used[here].append(atan2(y - self.places[here][1], x - self.places[here][0]))

    def label_arc(self, source: Any, target: Any, bend: float) -> None:
        """Write the label on the outer side of a bend, above a straight arc."""
        a, b = self.places[source], self.places[target]
        length = hypot(b[0] - a[0], b[1] - a[1]) or 1.0
        side = (b[1] - a[1]) / length, -(b[0] - a[0]) / length
        if bend < 0 or (bend == 0 and side[1] < 0):
            side = -side[0], -side[1]
        points = [_bent(a, b, bend, t) for t in _ALONG]
        self.beside(points, side, _arc_label(self.graph.edges[source, target]), (source, target))

    def loop(self, state: Any, label: str) -> None:
        """Draw the arrow from a circle to itself, where there is most room."""
        x, y = self.places[state]
        angle = self.free_angle(state, (pi / 2, -pi / 2, pi, 0.0), spare=pi)

        def at(turn: float, distance: float) -> Point:
            return x + distance * cos(angle + turn), y + distance * sin(angle + turn)

        curve = Curve(
            [at(0.5, _RADIUS), at(0.6, 0.85), at(-0.6, 0.85), at(-0.5, _RADIUS)],
            [Curve.MOVETO, Curve.CURVE4, Curve.CURVE4, Curve.CURVE4],
        )
        self.axes.add_patch(
            FancyArrowPatch(
                path=curve,
                arrowstyle=_HEAD,
                linewidth=1.0,
                color="black",
            )
        )
        self.used[state].append(angle)
        self.beside([at(0.0, 0.66)], (cos(angle), sin(angle)), label, (state, state))

    def beside(
        self, points: Sequence[Point], side: Point, label: str, own: tuple[Any, Any]
    ) -> None:
        """Write a label at the first position along its own arc where it covers nothing else."""
        font = self.font - 1
        wide = 0.3 * font * longest_line(label) / self.points_per_unit
        high = 0.6 * font / self.points_per_unit
        out = 0.02 + abs(side[0]) * wide + abs(side[1]) * high
        spots = [
            (x + out * way * side[0], y + out * way * side[1]) for way in (1, -1) for x, y in points
        ]
        crossed = [self.is_crossed(spot, wide, high, own) for spot in spots]
        x, y = min(zip(crossed, range(len(spots)), spots, strict=True))[2]
        self.boxes.append((x, y, wide, high))
        self.reach += [(x - wide, y - high), (x + wide, y + high)]
        self.axes.text(
            x,
            y,
            label,
            fontsize=font,
            ha="center",
            va="center",
            zorder=4,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.4, "alpha": 0.85},
        )

    def is_crossed(self, spot: Point, wide: float, high: float, own: tuple[Any, Any]) -> int:
        """Return what a label at `spot` would cover: 0 nothing, 1 an arc, 2 a label or a node."""

        def under(x: float, y: float, extra_wide: float, extra_high: float) -> bool:
            return abs(spot[0] - x) < wide + extra_wide and abs(spot[1] - y) < high + extra_high

        if any(under(*box) for box in self.boxes):
            return 2
        tracks = [track for arc, track in self.tracks.items() if arc != own]
        return int(any(under(x, y, 0.02, 0.02) for track in tracks for x, y in track))

    def free_angle(self, state: Any, choices: tuple[float, ...], spare: float) -> float:
        """Return the first direction with enough room, else the one farthest from every arc."""

        def gap(angle: float) -> float:
            turns = [abs((angle - used + pi) % (2 * pi) - pi) for used in self.used[state]]
            return round(min(turns, default=pi), 6)

        return next((angle for angle in choices if gap(angle) > spare), max(choices, key=gap))

    def arrow_into(self, start: Any) -> None:
        """Mark the start with an arrow from outside."""
        x, y = self.places[start]
        angle = self.free_angle(
            start, (pi, pi / 2, -pi / 2, 3 * pi / 4, -3 * pi / 4, 0.0), spare=0.7
        )
        tail = x + 0.65 * cos(angle), y + 0.65 * sin(angle)
        self.reach.append(tail)
        self.axes.annotate(
            "",
            (x + _RADIUS * cos(angle), y + _RADIUS * sin(angle)),
            tail,
            arrowprops={"arrowstyle": "-|>", "linewidth": 2.2, "color": "black", "shrinkA": 0}
            | {"shrinkB": 0},
        )

    def circle(self, state: Any, label: str) -> None:
        """Draw a state; a terminal state is a double circle, filled by winner."""
        center = self.places[state]
        fill, ink = "white", "black"
        if is_terminal(self.graph, state):
            fill, ink = self.fills[self.graph.nodes[state].get("winner")]
            self.axes.add_patch(Circle(center, _RADIUS, facecolor="white", edgecolor="black"))
            radius = _RING * _RADIUS
        else:
            radius = _RADIUS
        self.axes.add_patch(
            Circle(center, radius, facecolor=fill, edgecolor="black", linewidth=1.2, zorder=3)
        )
        room = 2 * 0.85 * radius * self.points_per_unit
        font = min(self.font, room / (0.6 * longest_line(label)))
        self.axes.text(*center, label, fontsize=font, color=ink, ha="center", va="center", zorder=4)

    def words(self, state: Any, label: str) -> None:
        """Write a node that is not a state."""
        x, y = self.places[state]
        font = self.font + 2
        wide = 0.3 * font * longest_line(label) / self.points_per_unit
        self.reach += [(x - wide, y), (x + wide, y)]
        self.axes.text(x, y, label, fontsize=font, ha="center", va="center", zorder=4)

    def legend(self, width: float) -> None:
        """List the winners' colors below the diagram, which is `width` inches wide."""
        from matplotlib.lines import Line2D

        won = {node.get("winner") for node in self.graph.nodes.values()} - {None}
        self.axes.legend(
            handles=[
                Line2D(
                    [],
                    [],
                    marker="o",
                    ls="",
                    ms=10,
                    mec="black",
                    mfc=fill,
                    label=f"player {winner} wins" if isinstance(winner, int) else f"{winner} wins",
                )
                for winner, (fill, _) in self.fills.items()
                if winner in won
            ],
            loc="upper center",
            bbox_to_anchor=(0.5, 0.0),
            borderaxespad=0.0,
            ncols=max(1, int(width / 1.6)),
            frameon=False,
        )


Positions: TypeAlias = Mapping[Any, tuple[float, float]]
"""The position (x, y) of each state, in units of the distance between neighbors."""

_SWEEPS = 8


def positions_of(graph: nx.DiGraph[Any], start: Any) -> dict[Any, tuple[float, float]]:
    """Return a position for every node, in units of the distance between neighbors.

    A graph that is a path, ignoring self-loops and directions (one-ball, n-ahead, drills), is on a
    line, with player 1's wins to the right. A graph whose states are scores (a, b) that every arc
    changes by at most 1 is on a grid: racks played to the right, player 1's lead upwards. Any other
    graph is layered by the distance from `start`, with terminal nodes, which have no arc to another
    node, on the outer rows: player 1's wins above, the others below.
    """
    return _on_a_line(graph, start) or _on_the_lattice(graph) or _in_layers(graph, start)


def _neighbors(graph: nx.DiGraph[Any], node: Any) -> list[Any]:
    around = [*graph.predecessors(node), *graph.successors(node)]
    return [neighbor for neighbor in dict.fromkeys(around) if neighbor != node]


def _on_a_line(graph: nx.DiGraph[Any], start: Any) -> dict[Any, tuple[float, float]]:
    around = {node: _neighbors(graph, node) for node in graph}
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
    ends = {node for node in graph if not any(near != node for near in graph.successors(node))}
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
        before = [places[near][0] for near in graph.predecessors(node) if near in places]
        x = 0.75 + (sum(before) / len(before) if before else 1.5 * beyond)
        y = highest if graph.nodes[node].get("winner") == 1 else lowest
        while any(abs(x - near) < 1.0 and y == row for near, row in taken):
            x += 0.25
        taken.add((x, y))
        places[node] = (x, y)
    return {node: places[node] for node in graph}


def _ordered(graph: nx.DiGraph[Any], layers: list[list[Any]]) -> dict[Any, float]:
    """Return each node's height; sorting layers by their neighbors' mean untangles arcs."""
    rows: dict[Any, float] = {}
    for _ in range(_SWEEPS):
        for nodes in layers:

            def mean(node: Any) -> float:
                heights = [rows[near] for near in _neighbors(graph, node) if near in rows]
                return sum(heights) / len(heights) if heights else 0.0

            nodes.sort(key=mean, reverse=True)
            middle = (len(nodes) - 1) / 2
            rows.update({node: middle - place for place, node in enumerate(nodes)})
    return rows
