"""Each diagram is its game: the same arcs, and symbols that mean the game's probabilities."""

from __future__ import annotations

from typing import Any

import networkx as nx
import pytest
from matplotlib.patches import Circle

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
from evenbreak.source_text.section5.plots import diagram_graphs, drawn

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
    axes = drawn(graph).axes[0]
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
