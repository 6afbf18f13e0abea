"""Game diagrams: circles for states and arrows for moves, as in Figs. 5.2 to 5.10."""

from __future__ import annotations

import re
from functools import partial
from typing import TYPE_CHECKING, Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from evenbreak.checks import floats
from evenbreak.errors import InputError
from evenbreak.game import Game, graph_of
from evenbreak.plots.picture import Plot, figure_of, in_our_look
from evenbreak.plots.strokes import (
    FONT,
    INCHES,
    Pen,
    Positions,
    is_words,
    longest_line,
    positions_of,
)

if TYPE_CHECKING:
    import networkx as nx


_MOST_STATES = 150
_MARGIN = 0.12
_KNOWN_FILLS = 3
"""Fills of a terminal node: no winner, player 1, player 2; a legend names any others."""


@in_our_look
def draw(
    game: Game | nx.DiGraph[Any],
    *,
    layout: Positions | None = None,
    title: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw a game's diagram: states as circles, each arc with its probability.

    An arrow from outside marks the start. A terminal node is a double circle, light if player 1
    has won and dark if player 2 has; further players have colors, which a legend names. An arc's
    text is its `label` if it has one (`"$p_1$"` is set as mathematics), else its `probability` to
    three significant digits. A state's text is what the game's method `label(state)` returns if it
    has one, or the node's `label`, else the state itself. In a custom graph, the start is the node
    whose `kind` is "start", or the first node if no node has a `kind`; a node with the kind "words"
    is text without a circle, such as dots or a heading.

    Parameters
    ----------
    game
        a game, or a directed graph whose arcs have a `probability` or a `label`. A node whose
        only arc leads to itself is drawn as terminal.
    layout
        a position (x, y) for every state, with neighbors about 1 apart; None: find one.
    ax
        the axes to draw on; None: those of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        the axes; a notebook shows their figure, about 1.25 inches for each unit of the layout, and
        `image_bytes` turns it into a file.

    Raises
    ------
    InputError
        if there are no states or more than 150, `layout` leaves out a state or has a position that
        is not two numbers, or `ax` is not an axes object.

    Notes
    -----
    Source: the diagrams of Figs. 5.2, 5.4, 5.5, 5.7, 5.10 and of problem P5.24.

    >>> from evenbreak.games import OneBall
    >>> axes = draw(OneBall(0.4, 0.8), title="One-ball")
    >>> axes.get_title()
    'One-ball'
    """
    import networkx as nx

    graph = game if isinstance(game, nx.DiGraph) else graph_of(game)
    if not 0 < len(graph) <= _MOST_STATES:
        raise InputError(
            f"the game has {len(graph)} states, but a diagram is readable only with 1 to "
            f"{_MOST_STATES}. Draw a shorter match."
        )
    start = _start_of(graph)
    places = (
        dict(layout)
        if layout is not None
        else positions_of(graph, next(iter(graph)) if start is None else start)
    )
    missing = [state for state in graph if state not in places]
    if missing:
        raise InputError(f"layout has no place for state {missing[0]!r}. Give the state's (x, y).")
    if layout is not None:
        for state in graph:
            if floats(places[state], f"layout for state {state!r}").shape != (2,):
                raise InputError(
                    f"layout for state {state!r} must be (x, y); you gave {places[state]!r}"
                )

    hook = getattr(game, "label", None)
    written = hook if callable(hook) else partial(_state_label, graph)
    labels = {state: str(written(state)) for state in graph}
    inside = [longest_line(text) for state, text in labels.items() if not is_words(graph, state)]
    inches = INCHES * max(1.0, max(inside, default=0) / 8)
    if ax is not None:
        inches = min(inches, _inches_in(ax, places))
    axes = Figure().add_axes((0.0, 0.0, 1.0, 1.0), axes_class=Plot) if ax is None else ax
    pen = Pen(axes, graph, places, inches)
    pen.draw(start, labels)
    (left, right), (bottom, top) = (
        (min(ends) - _MARGIN, max(ends) + _MARGIN) for ends in zip(*pen.reach, strict=True)
    )
    above = 0.4 if title else 0.0
    below = 0.3 if len(pen.fills) > _KNOWN_FILLS else 0.0
    width, height = (right - left) * inches, (top - bottom) * inches
    whole = below + height + above
    if ax is None:
        figure_of(axes).set_size_inches(width, whole)
        axes.set_position((0.0, below / whole, 1.0, height / whole))
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    axes.set_axis_off()
    if below:
        pen.legend(width)
    if title:
        axes.set_title(title, fontsize=FONT + 2, pad=4)
    return axes


def _inches_in(ax: Axes, places: Positions) -> float:
    """Return about how large a unit can be for all positions to fit into the given axes."""
    box = ax.get_window_extent()
    spans = (max(ends) - min(ends) + 1.5 for ends in zip(*places.values(), strict=True))
    sides = zip((box.width, box.height), spans, strict=True)
    return float(min(side / ax.figure.dpi / span for side, span in sides))


def _start_of(graph: nx.DiGraph[Any]) -> Any:
    """Return the start, or None if the nodes' kinds do not tell."""
    kinds = [graph.nodes[state].get("kind") for state in graph]
    if not any(kinds):
        return next(iter(graph))
    return next((state for state, kind in zip(graph, kinds, strict=True) if kind == "start"), None)


def _state_label(graph: nx.DiGraph[Any], state: Any) -> str:
    label = graph.nodes[state].get("label")
    if label is not None:
        return str(label)
    subscripted = re.fullmatch(r"([A-Za-z])(\d+)", str(state))
    return f"${subscripted[1]}_{{{subscripted[2]}}}$" if subscripted else str(state)
