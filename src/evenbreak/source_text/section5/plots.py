"""The figures in section 5, all recomputed: plots, the numbers behind them, and diagrams."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.chains import limits_over
from evenbreak.games import BREAK_FORMATS, Ahead, Drill, Rack
from evenbreak.handicaps import Ladder, chart
from evenbreak.matches import race_win_probability, win_probability
from evenbreak.plots import draw
from evenbreak.plots.contours import contour_axes, share_panels
from evenbreak.plots.picture import LINES, label_beside, label_on, new_axes, note, unit_axis
from evenbreak.practice import long_run_share, one_ball_win
from evenbreak.source_text.cells import Records, Tables, packaged_rows, record
from evenbreak.source_text.section5.chains import CHARTS, FORMATS, HANDICAPS, drill, ladder

if TYPE_CHECKING:
    import networkx as nx
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_P = np.linspace(0.0, 1.0, 201)
_GAME = "$p$ = P(player 1 wins a game)"
_MATCH = "$W$ = P(player 1 wins the match)"
_BREAK_1 = "$p_1$ = P(player 1 wins | player 1 breaks)"
_BREAK_2 = "$p_2$ = P(player 2 wins | player 2 breaks)"


def races() -> Axes:
    """Fig. 5.1: W(p; n, n) and W(p; 2n, n), n = 1 ... 10, and where 2:1 and 4:2 cross."""
    axes = new_axes(_GAME, _MATCH, size=(7.2, 6.4))
    _race_curves(axes, _P, range(1, 11))
    unit_axis(axes, "x", "y")
    axes.legend(loc="upper left", frameon=False)
    for m, n, p in ((1, 1, 0.2), (10, 10, 0.6)):
        label_beside(axes, p, race_win_probability(p, m, n), f"{m}:{n}", "left")
    for m, n, p in ((2, 1, 0.94), (20, 10, 0.55)):
        label_beside(axes, p, race_win_probability(p, m, n), f"{m}:{n}", "right")
    _crossing(axes)
    return axes


def _crossing(axes: Axes) -> None:
    """Enlarge the point where the races 2:1 and 4:2 are equally good."""
    from scipy.optimize import brentq

    inset = axes.inset_axes((0.71, 0.08, 0.26, 0.33))
    _race_curves(inset, np.linspace(0.6, 0.7, 101), (1, 2))
    # No tick in the corners, from which the lines to the part enlarged begin.
    inset.set(xlim=(0.6, 0.7), ylim=(0.34, 0.52), xticks=(0.62, 0.65, 0.68), yticks=(0.4, 0.5))
    inset.tick_params(direction="in", top=True, right=True, labelsize=8)
    axes.indicate_inset_zoom(inset, edgecolor="0.4")
    label_beside(inset, 0.685, race_win_probability(0.685, 2, 1), "2:1", "below")
    label_beside(inset, 0.675, race_win_probability(0.675, 4, 2), "4:2", "left")
    p = brentq(lambda p: race_win_probability(p, 2, 1) - race_win_probability(p, 4, 2), 0.6, 0.7)
    point = p, race_win_probability(p, 2, 1)
    for panel, size in ((axes, 3.0), (inset, 4.5)):
        panel.plot(*point, "ko", markersize=size, zorder=4)
    note(inset, f"$p$ = {p:.3f}", point, (8, -11), fontsize=10, va="center")


def _race_curves(axes: Axes, p: NDArray[np.float64], lengths: Iterable[int]) -> None:
    for n in lengths:
        for times, line, width in ((1, LINES[0], 1.0), (2, LINES[1], 1.2)):
            name = f"{'2' * (times == 2)}n:n, n = 1 … 10" if n == 1 else None
            chance = race_win_probability(p, times * n, n)
            axes.plot(p, chance, **line._asdict(), lw=width, label=name)


def one_ball() -> Figure:
    """Fig. 5.3: the one-ball game, with infinite and with two-shot look-ahead."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.0, 4.7), layout="constrained")
    panels = figure.subplots(1, 2)
    names = {"infinite": "Infinite look-ahead", "two shots": "Two-shot look-ahead"}
    for axes, (look_ahead, name) in zip(panels, names.items(), strict=True):
        contour_axes(
            axes,
            partial(one_ball_win, look_ahead=look_ahead),
            x="$p_1$ = P(player 1 makes the shot)",
            y="$p_2$ = P(player 2 makes the shot)",
        )
        axes.set_title(f"{name}: $W$ = P(player 1 wins)")
    return figure


def break_formats() -> Figure:
    """Fig. 5.6: player 1's share of the games by break format, and WB minus LB."""
    figure, panels = share_panels(x=_BREAK_1, y=_BREAK_2)
    names = ("Winner breaks", "Loser breaks", "Alternate breaks")
    titles = [f"{name}: player 1's share $W$" for name in names]
    for axes, title in zip(panels, [*titles, "Winner minus loser breaks"], strict=True):
        axes.set_title(title)
    return figure


def progressive_drill() -> Axes:
    """Fig. 5.8: where the progressive nine-ball drill spends its attempts, level by level."""
    levels = range(1, 10)
    limit = limits_over(Drill.progressive, p=_P)
    axes = new_axes(
        "$p$ = P(one shot is made)", "$v$ = share of attempts at a level", size=(7.2, 5.4)
    )
    for level in levels:
        axes.plot(_P, limit[level], **LINES[level - 1]._asdict(), lw=1.4, label=f"$v_{level}$")
    unit_axis(axes, "x", "y")
    # Where the curves peak they lie too close to be named one by one.
    axes.legend(title="level", loc="upper center", ncols=3, frameon=False, handlelength=4.0)
    return axes


def rating_ladders() -> Axes:
    """Fig. 5.9: how far ratings stray on the NPL ladder, for four charts."""
    axes = new_axes("rating error, points", "$v$ = probability of the error", size=(7.2, 5.0))
    for games, marker, line in zip((8, 10, 12, 20), "os^D", LINES, strict=False):
        law = Ladder(chart(f"npl_{games}")).law()
        axes.plot(
            np.array(law.values, float),
            np.array(law.probability, float),
            **line._asdict(),
            lw=1.2,
            marker=marker,
            ms=4,
            label=f"Chart-{games}",
        )
    axes.set(xlim=(-20, 20), ylim=(0, None))
    axes.legend(frameon=False)
    return axes


def ahead_matches() -> Axes:
    """Fig. 5.11: n-ahead matches whose two handicaps add up to six games."""
    axes = new_axes(_GAME, _MATCH, size=(6.4, 6.2))
    for m, line in zip(range(1, 6), LINES, strict=False):
        n = 6 - m
        chance = win_probability(Ahead(m, n, Rack(_P)))
        axes.plot(_P, chance, **line._asdict(), lw=1.4)
        # On the falling diagonal the curves are farthest apart.
        here = int(np.argmin(np.abs(_P + chance - 1.0)))
        label_on(axes, _P[here], chance[here], f"{m}:{n}")
    unit_axis(axes, "x", "y")
    return axes


def diagram_graphs() -> Mapping[str, nx.DiGraph[Any]]:
    """Return the graphs behind the diagrams, by name.

    An arc carries its symbol as `label`, a node its `place` (x, y), its `kind` and, if someone has
    won there, the `winner`.

    Source: Figs. 5.2, 5.4, 5.5, 5.7 and 5.10, and the diagrams in problem P5.24.

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


def drawn(graph: nx.DiGraph[Any]) -> Axes:
    """Return the drawing of a graph whose nodes have places."""
    return draw(graph, layout={state: graph.nodes[state]["place"] for state in graph})


_HUNDREDTHS = [k / 100 for k in range(101)]


_INSIDE = [k / 20 for k in range(1, 20)]
"""The contour plots' grid; at a corner, the limit may depend on the direction of approach."""


def figure_tables() -> Tables:
    """Return the numbers behind each plot in section 5, by figure name."""
    tables = {
        "figure_5_1": _curves(
            {
                f"w_{k * n}_{n}": race_win_probability(_HUNDREDTHS, k * n, n)
                for k in (1, 2)
                for n in range(1, _LONGEST + 1)
            }
        ),
        "figure_5_3": _surfaces(
            {
                "w_infinite": one_ball_win,
                "w_two_shots": lambda p1, p2: one_ball_win(p1, p2, look_ahead="two shots"),
            }
        ),
        "figure_5_6": _surfaces(
            {
                **{f"w_{name}_breaks": _share(name) for name in FORMATS},
                "winner_less_loser": lambda p1, p2: (
                    _share("winner")(p1, p2) - _share("loser")(p1, p2)
                ),
            }
        ),
        "figure_5_8": _levels(),
        "figure_5_9": _ladders(),
        "figure_5_11": _curves(
            {f"w_{m}_{n}": win_probability(Ahead(m, n, Rack(_HUNDREDTHS))) for m, n in HANDICAPS}
        ),
    }
    return {name: list(rows) for name, rows in tables.items()}


def _curves(columns: Mapping[str, Any]) -> Records:
    for k, p in enumerate(_HUNDREDTHS):
        yield record({"p": p}, {name: values[k] for name, values in columns.items()})


def _surfaces(functions: Mapping[str, Callable[[Any, Any], Any]]) -> Records:
    for p1 in _INSIDE:
        for p2 in _INSIDE:
            values = {name: function(p1, p2) for name, function in functions.items()}
            yield record({"p1": p1, "p2": p2}, values)


def _levels() -> Records:
    for p in _HUNDREDTHS:
        shares = enumerate(drill(p).distribution.probability, 1)
        yield record({"p": p}, {f"d_{level}": share for level, share in shares})


def _ladders() -> Records:
    laws = {
        f"{kind}_{number}": ladder(number, autocorrelated=kind == "autocorrelated")
        for kind in ("natural", "autocorrelated")
        for number in CHARTS
    }
    errors = next(iter(laws.values())).values
    for k, error in enumerate(errors):
        yield record(
            {"rating_error": error}, {name: law.probability[k] for name, law in laws.items()}
        )


_LONGEST = 10


def _share(name: str) -> Callable[[Any, Any], Any]:
    return lambda p1, p2: long_run_share(p1, p2, BREAK_FORMATS[name])
