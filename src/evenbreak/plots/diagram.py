"""Game diagrams: circles for states and arrows for moves, as in Figs. 5.2 to 5.10."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Literal

from evenbreak.errors import InputError
from evenbreak.game import Game, graph_of
from evenbreak.plots.layout import Positions, positions_of
from evenbreak.plots.strokes import FONT, Pen, is_terminal, is_words, longest_line
from evenbreak.plots.style import our_look

if TYPE_CHECKING:
    import networkx as nx
    from matplotlib.figure import Figure

_MOST_STATES = 150
_INCHES = 1.25
"""The length of a unit, with labels of up to eight characters."""
_MARGIN = 0.12


def draw(
    game: Game | nx.DiGraph[Any], *, layout: Positions | None = None, title: str | None = None
) -> Figure:
    """Draw a game's diagram: states as circles, each arc with its probability.

    An arrow from outside marks the start. A terminal node is a double circle, light if player 1
    has won and dark if player 2 has. The text of an arc is its `label` if it has one (`"$p_1$"`
    is set as mathematics), else its `probability` to three significant digits; the text of a
    node is its `label`, else its name, with scores as a:b. In your own graph the start is the
    node whose `kind` is "start", or the first node if no node has a `kind`; a node of the kind
    "words" is text without a circle, such as dots or a heading.

    Parameters
    ----------
    game
        a game, or a directed graph whose arcs have a `probability` or a `label`. A node whose
        only arc leads to itself is drawn as terminal.
    layout
        a place (x, y) for every state, neighbours about 1 apart; None: find one.
    title
        text above the diagram.

    Returns
    -------
    matplotlib.figure.Figure
        about 1.25 inches for each unit of the layout; `image_bytes` turns it into a file.

    Raises
    ------
    InputError
        if there are no states or more than 150, or `layout` leaves out a state.

    Notes
    -----
    Source: the diagrams of Figs. 5.2, 5.4, 5.5, 5.7, 5.10 and of problem P5.24.

    >>> from evenbreak.games import OneBall
    >>> figure = draw(OneBall(0.4, 0.8), title="One-ball")
    >>> figure.axes[0].get_title()
    'One-ball'
    """
    import networkx as nx
    from matplotlib.figure import Figure

    graph = game if isinstance(game, nx.DiGraph) else graph_of(game)
    if not 0 < len(graph) <= _MOST_STATES:
        raise InputError(
            f"game has {len(graph)} states; a diagram can be read with 1 to {_MOST_STATES}, so "
            "draw a shorter match"
        )
    start = _start_of(graph)
    places = (
        dict(layout)
        if layout is not None
        else positions_of(graph, next(iter(graph)) if start is None else start)
    )
    missing = [state for state in graph if state not in places]
    if missing:
        raise InputError(f"layout has no place for state {missing[0]!r}; give it (x, y)")

    labels = {state: _state_label(graph, state) for state in graph}
    inside = [longest_line(text) for state, text in labels.items() if not is_words(graph, state)]
    inches = _INCHES * max(1.0, max(inside, default=0) / 8)
    figure = Figure()
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    pen = Pen(axes, graph, places, inches)
    pen.draw(start, labels)
    (left, right), (bottom, top) = (
        (min(ends) - _MARGIN, max(ends) + _MARGIN) for ends in zip(*pen.reach, strict=True)
    )
    above = 0.4 if title else 0.0
    width, height = (right - left) * inches, (top - bottom) * inches
    figure.set_size_inches(width, height + above)
    axes.set_position((0.0, 0.0, 1.0, height / (height + above)))
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    axes.set_axis_off()
    if title:
        axes.set_title(title, fontsize=FONT + 2, pad=4)
    return figure


def image_bytes(figure: Figure, kind: Literal["png", "svg"] = "svg") -> bytes:
    """Return a figure as the bytes of a PNG or SVG file, always the same bytes.

    >>> from evenbreak.games import OneBall
    >>> image_bytes(draw(OneBall(0.4, 0.8)), "png")[1:4]
    b'PNG'
    """
    import io

    import matplotlib as mpl

    out = io.BytesIO()
    # A salt instead of random ids, and no date or program version.
    metadata: dict[str, Any] = {"Date": None, "Creator": None} if kind == "svg" else {}
    with our_look(), mpl.rc_context({"svg.hashsalt": "evenbreak"}):
        figure.savefig(out, format=kind, dpi=150, metadata=metadata or {"Software": None})
    return out.getvalue()


def _start_of(graph: nx.DiGraph[Any]) -> Any:
    """Return the start, or None if the kinds of the nodes do not say."""
    kinds = [graph.nodes[state].get("kind") for state in graph]
    if not any(kinds):
        return next(iter(graph))
    return next((state for state, kind in zip(graph, kinds, strict=True) if kind == "start"), None)


def _state_label(graph: nx.DiGraph[Any], state: Any) -> str:
    given = graph.nodes[state].get("label")
    if given is not None:
        return str(given)
    if isinstance(state, tuple):
        # Who would break after the last rack is not part of a result.
        return _score_label(state[:2] if is_terminal(graph, state) else state)
    subscripted = re.fullmatch(r"([A-Za-z])(\d+)", str(state))
    return f"${subscripted[1]}_{{{subscripted[2]}}}$" if subscripted else str(state)


def _score_label(state: tuple[Any, ...]) -> str:
    """Return `a:b`, and below it the breaker or the score of the set."""
    if len(state) < 2:
        return str(state)
    parts = [_score_label(part) if isinstance(part, tuple) else str(part) for part in state[2:]]
    if len(parts) == 1 and isinstance(state[2], int):
        parts = [f"{parts[0]} breaks"]
    return "\n".join([f"{state[0]}:{state[1]}", *parts])
