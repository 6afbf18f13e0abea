"""The curves pass through the exact values, and show what the text says of its figures."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from math import comb
from typing import Any

import networkx as nx
import numpy as np
import pytest
from matplotlib.patches import Circle

from drawings import at, contours, curves, figure, line_at, marked
from evenbreak.game import Game, graph_of
from evenbreak.games import (
    Ahead,
    Drill,
    OneBall,
    OneBallLookAhead,
    Rack,
    Series,
    loser_breaks,
    winner_breaks,
)
from evenbreak.matches import win_probability
from evenbreak.source_text.section5.plots import diagram_graphs, drawn, figure_tables


def race(p: Fraction, m: int, n: int) -> Fraction:
    """Return W(p; m, n), the loser's score summed out."""
    return sum((comb(m - 1 + k, k) * p**m * (1 - p) ** k for k in range(n)), start=Fraction(0))


# Fig. 5.1


def test_races_are_ten_even_and_ten_with_twice_the_games_for_player_1() -> None:
    drawn = curves(figure("figure_5_1").axes[0])
    assert len(drawn) == 20
    for n, (even, uneven) in enumerate(zip(drawn[0::2], drawn[1::2], strict=True), start=1):
        for p in (Fraction(1, 4), Fraction(1, 2), Fraction(7, 10)):
            assert at(even, float(p)) == pytest.approx(float(race(p, n, n)), abs=1e-12)
            assert at(uneven, float(p)) == pytest.approx(float(race(p, 2 * n, n)), abs=1e-12)
        assert at(even, 0.5) == pytest.approx(0.5, abs=1e-12)


def test_the_two_families_of_races_differ_without_color() -> None:
    lines = figure("figure_5_1").axes[0].lines[:20]
    styles = (
        {line.get_linestyle() for line in lines[0::2]},
        {line.get_linestyle() for line in lines[1::2]},
    )
    assert styles == ({"-"}, {"--"})


def test_the_inset_marks_where_2_to_1_and_4_to_2_cross() -> None:
    (inset,) = figure("figure_5_1").axes[0].child_axes
    dot = next(line for line in inset.lines if line.get_marker() == "o")
    ((p, chance),) = dot.get_xydata()
    assert p == pytest.approx(0.640388, abs=1e-6)
    assert chance == pytest.approx(0.410097, abs=1e-6)
    assert inset.get_xlim()[0] < p < inset.get_xlim()[1]
    assert "$p$ = 0.640" in [text.get_text() for text in inset.texts]
    assert marked(figure("figure_5_1").axes[0], p, chance)


# Fig. 5.3


def test_the_even_chance_is_the_same_line_for_both_look_aheads() -> None:
    for axes in figure("figure_5_3").axes:
        p1, p2 = line_at(axes, 0.5).T
        inner = p1 > 0.02
        assert p2[inner] == pytest.approx((p1 / (1 - p1))[inner], abs=0.006)
        assert p1.max() == pytest.approx(0.5, abs=1e-4)


def test_look_aheads_differ_elsewhere() -> None:
    infinite, two = figure("figure_5_3").axes
    line = line_at(infinite, 0.9)
    p1, p2 = line[line[:, 0] > 0.1].T  # all lines meet at the origin
    assert p1 / (p1 + p2 - p1 * p2) == pytest.approx(0.9, abs=1e-3)
    p1, p2 = line_at(two, 0.9).T
    assert p1 + (1 - p1) * (1 - p2) / 2 == pytest.approx(0.9, abs=1e-3)
    assert "Infinite" in infinite.get_title()
    assert "Two-shot" in two.get_title()


# Fig. 5.6


def test_every_break_format_is_even_for_equal_players() -> None:
    for axes in figure("figure_5_6").axes[:3]:
        p1, p2 = line_at(axes, 0.5).T
        assert p1 == pytest.approx(p2, abs=1e-9)


def test_lines_cluster_where_the_winner_breaks_and_both_are_strong() -> None:
    def near(axes: Any, corner: float) -> int:
        """Return how many lines pass by a corner."""
        return sum(
            bool((np.hypot(*(line_at(axes, level) - corner).T) < 0.1).any())
            for level in contours(axes).levels
        )

    winner, loser, alternate, _ = figure("figure_5_6").axes
    assert [near(axes, 1.0) for axes in (winner, loser, alternate)] == [9, 1, 1]
    assert [near(axes, 0.0) for axes in (winner, loser, alternate)] == [1, 9, 1]


def test_the_difference_is_dashed_where_the_loser_should_break() -> None:
    axes = figure("figure_5_6").axes[3]
    lines = contours(axes)
    for level, (_, dashes) in zip(lines.levels, lines.get_linestyles(), strict=True):
        assert (dashes is not None) == (level < 0)
        p1, p2 = line_at(axes, level).T
        difference = (1 - p2) / (2 - p1 - p2) - p1 / (p1 + p2)
        inner = (np.minimum(p1, p2) > 0.05) & (np.maximum(p1, p2) < 0.95)
        assert difference[inner] == pytest.approx(level, abs=2e-3)
    p1, p2 = line_at(axes, 0.0).T
    assert np.minimum(abs(p1 - p2), abs(p1 + p2 - 1)) == pytest.approx(0, abs=1e-9)


# Fig. 5.8


def test_the_drill_has_nine_shares_that_make_up_the_whole() -> None:
    drawn = curves(figure("figure_5_8").axes[0])
    assert len(drawn) == 9
    assert sum(curve[:, 1] for curve in drawn) == pytest.approx(1.0)
    # Table 5.5, p = .8; at p = 1 nothing fails and the last level repeats.
    table = [0.018, 0.088, 0.195, 0.256, 0.222, 0.135, 0.060, 0.020, 0.005]
    assert [at(curve, 0.8) for curve in drawn] == pytest.approx(table, abs=6e-4)
    assert [at(curve, 1.0) for curve in drawn] == [0] * 8 + [1]
    assert [at(curve, 0.0) for curve in drawn] == [0.5, 0.5] + [0] * 7


def test_no_two_levels_share_a_line() -> None:
    lines = figure("figure_5_8").axes[0].lines
    assert len({line.get_color() for line in lines}) == 9
    legend = figure("figure_5_8").axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == [f"$v_{n}$" for n in range(1, 10)]
    dashes = {line._unscaled_dash_pattern for line in lines}
    assert len({str(pattern) for pattern in dashes}) == 9


def test_the_level_most_visited_goes_up_with_skill() -> None:
    drawn = curves(figure("figure_5_8").axes[0])
    peaks = [curve[np.argmax(curve[:, 1]), 0] for curve in drawn]
    assert peaks == sorted(peaks)


# Fig. 5.9


def test_ladders_are_flat_on_top_and_sharper_for_longer_matches() -> None:
    axes = figure("figure_5_9").axes[0]
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    assert names == ["Chart-8", "Chart-10", "Chart-12", "Chart-20"]
    laws = curves(axes)
    spreads, flats, peaks = [], [], []
    for law in laws:
        errors, chances = law.T
        assert chances.sum() == pytest.approx(1.0)
        assert chances == pytest.approx(chances[::-1])
        spreads.append(np.sqrt(chances @ errors**2))
        flats.append(int((chances > chances.max() * (1 - 1e-9)).sum()))
        peaks.append(chances.max())
    assert spreads == pytest.approx([4.963, 4.634, 4.269, 3.668], abs=6e-4)
    assert flats == [13, 11, 9, 5]
    assert peaks == sorted(peaks)
    assert len({line.get_marker() for line in axes.lines}) == 4


# Fig. 5.11


def test_ahead_matches_are_the_gamblers_ruin() -> None:
    drawn = curves(figure("figure_5_11").axes[0])
    assert len(drawn) == 5
    p = Fraction(3, 5)
    odds = (1 - p) / p
    for m, curve in enumerate(drawn, start=1):
        exact = (1 - odds ** (6 - m)) / (1 - odds**6)
        assert at(curve, 0.6) == pytest.approx(float(exact), abs=1e-12)
        assert at(curve, 0.5) == pytest.approx((6 - m) / 6)
    texts = [text.get_text() for text in figure("figure_5_11").axes[0].texts]
    assert texts == ["1:5", "2:4", "3:3", "4:2", "5:1"]


@pytest.fixture(scope="module")
def tables():
    return figure_tables()


def numbers_at(rows, **inputs):
    """Return the one row with these inputs, without them."""
    (row,) = [row for row in rows if all(float(row[k]) == v for k, v in inputs.items())]
    return {name: cell for name, cell in row.items() if name not in inputs}


def test_curves_of_races(tables):
    rows = tables["figure_5_1"]
    assert (len(rows), len(rows[0])) == (101, 21)
    even = numbers_at(rows, p=0.5)
    assert {even[f"w_{n}_{n}"] for n in range(1, 11)} == {Decimal("0.500000")}
    assert even["w_2_1"] == Decimal("0.250000")
    assert even["w_4_2"] == Decimal("0.187500")


def test_surfaces(tables):
    shots = numbers_at(tables["figure_5_3"], p1=0.4, p2=0.8)
    assert list(map(str, shots.values())) == ["0.454545", "0.460000"]
    breaks = numbers_at(tables["figure_5_6"], p1=0.9, p2=0.5)
    assert list(map(str, breaks.values())) == ["0.833333", "0.642857", "0.700000", "0.190476"]
    assert len(tables["figure_5_3"]) == len(tables["figure_5_6"]) == 19 * 19


def test_distributions_sum_to_one(tables):
    levels = np.array([list(row.values())[1:] for row in tables["figure_5_8"]], float)
    assert levels.sum(axis=1) == pytest.approx(1.0, abs=1e-5)
    errors = np.array([list(row.values())[1:] for row in tables["figure_5_9"]], float)
    assert errors.sum(axis=0) == pytest.approx(1.0, abs=1e-4)
    assert (errors == errors[::-1]).all()


def test_leads(tables):
    row = numbers_at(tables["figure_5_11"], p=0.6)
    for m in range(1, 6):
        exact = win_probability(Ahead(m, 6 - m, Rack(0.6)))
        assert float(row[f"w_{m}_{6 - m}"]) == pytest.approx(exact, abs=5e-7)


# Each diagram is its game: the same arcs, and symbols that mean the game's probabilities.


GRAPHS = diagram_graphs()
SHOTS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)
"""Of a drill of six levels, n = 6, and of as many shots."""
CHANCE = {"p": SHOTS[0]} | {f"p_{shot}": chance for shot, chance in enumerate(SHOTS, 1)}
CHANCE |= {"p_{n-2}": SHOTS[3], "p_{n-1}": SHOTS[4], "p_n": SHOTS[5]}
VALUE = CHANCE | {name.replace("p", "q"): 1 - chance for name, chance in CHANCE.items()}
VALUE |= {r"\frac{1}{2}q_2": VALUE["q_2"] / 2}


def values(graph: nx.DiGraph[Any], names: dict[str, Any] | None = None) -> dict[Any, float]:
    """Return the value of each arc's symbol, states renamed."""
    names = {state: state for state in graph} | (names or {})
    return {
        (names[source], names[target]): VALUE[arc["label"].strip("$")]
        for source, target, arc in graph.edges(data=True)
    }


def probabilities(game: Game) -> dict[Any, float]:
    return {
        (source, target): arc["probability"]
        for source, target, arc in graph_of(game).edges(data=True)
    }


def test_the_endless_game_is_the_look_ahead_as_far_as_it_goes() -> None:
    game = probabilities(OneBallLookAhead(SHOTS[:4]))
    drawn = values(GRAPHS["figure_5_2"])
    assert drawn.pop(("S4", "later")) == pytest.approx(game.pop(("S4", "W")) + game["S4", "L"])
    del game["S4", "L"]
    assert drawn == pytest.approx(game)


def test_two_shots_and_the_folded_game_are_those_of_the_library() -> None:
    assert values(GRAPHS["figure_5_4"]) == pytest.approx(probabilities(OneBallLookAhead(SHOTS[:2])))
    assert values(GRAPHS["figure_5_5"]) == pytest.approx(probabilities(OneBall(*SHOTS[:2])))


@pytest.mark.parametrize(("name", "breaks"), [("WB", winner_breaks), ("LB", loser_breaks)])
def test_break_formats_are_those_of_the_library(name: str, breaks: Any) -> None:
    graph = GRAPHS["figure_p5_24"]
    half = graph.subgraph([state for state in graph if state.endswith(name)])
    players = {f"S{player} {name}": player for player in (1, 2)}
    game = probabilities(Series(Rack(*SHOTS[:2]), breaks=breaks))
    assert values(half, players) == pytest.approx(game)


def test_the_drill_is_that_of_six_levels_where_the_dots_are_one() -> None:
    levels = {"1": 1, "2": 2, "3": 3, "between": 4, "n-1": 5, "n": 6}
    assert values(GRAPHS["figure_5_7"], levels) == pytest.approx(probabilities(Drill(SHOTS)))


def test_the_ahead_match_is_4_to_4_where_the_dots_are_one_state_on_either_side() -> None:
    names = ["L", "S-n+1", "behind", "S-1", "S0", "S1", "ahead", "Sm-1", "W"]
    leads = {
        name: (max(lead, 0), max(-lead, 0)) for name, lead in zip(names, range(-4, 5), strict=True)
    }
    game = probabilities(Ahead(4, 4, Rack(SHOTS[0])))
    assert values(GRAPHS["figure_5_10"], leads) == pytest.approx(game)


@pytest.mark.parametrize("name", GRAPHS)
def test_ends_are_won_or_lost_and_only_states_have_circles(name: str) -> None:
    graph = GRAPHS[name]
    kinds = nx.get_node_attributes(graph, "kind")
    states = [state for state, kind in kinds.items() if kind != "words"]
    ends = [state for state, kind in kinds.items() if kind == "terminal"]
    winners = nx.get_node_attributes(graph, "winner")
    assert all(winners[state] == {"W": 1, "L": 2}[state[0]] for state in ends)
    assert all(graph.out_degree(state) == 0 for state in ends)
    axes = drawn(graph)
    circles = [patch for patch in axes.patches if isinstance(patch, Circle)]
    assert len(circles) == len(states) + len(ends)


def test_every_diagram_but_the_break_formats_has_one_start() -> None:
    starts = {
        name: [state for state, kind in graph.nodes(data="kind") if kind == "start"]
        for name, graph in GRAPHS.items()
    }
    assert starts == {
        "figure_5_2": ["S1"],
        "figure_5_4": ["S1"],
        "figure_5_5": ["S1"],
        "figure_5_7": ["1"],
        "figure_5_10": ["S0"],
        "figure_p5_24": [],
    }
