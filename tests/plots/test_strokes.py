import itertools
from math import hypot

import networkx as nx
import pytest
from matplotlib.patches import Circle, FancyArrowPatch

from evenbreak.game import Game, graph_of
from evenbreak.games import CATALOG, Ahead, Drill, OneBall, Race, Rack
from evenbreak.plots.picture import new_axes
from evenbreak.plots.strokes import Pen, is_terminal, is_words, longest_line, positions_of
from rows import each_of

PLACES = {"a": (0.0, 0.0), "b": (1.0, 0.0), "c": (2.0, 0.0)}


def graph_with(*arcs):
    graph = nx.DiGraph()
    graph.add_nodes_from(PLACES)
    for source, target, probability in arcs:
        graph.add_edge(source, target, probability=probability)
    return graph


def pen_of(graph):
    return Pen(new_axes("", ""), graph, PLACES, 1.25)


def test_a_node_that_only_leads_to_itself_is_terminal():
    graph = graph_with(("a", "b", 1.0), ("b", "b", 1.0))
    assert [is_terminal(graph, state) for state in PLACES] == [False, True, True]


def test_words_are_no_states():
    graph = graph_with()
    graph.nodes["a"]["kind"] = "words"
    assert [is_words(graph, state) for state in "ab"] == [True, False]


@pytest.mark.parametrize(("text", "length"), [("S1", 2), ("$p_{1}$", 2), ("0:0\nA breaks", 8)])
def test_the_longest_line_without_markup(text, length):
    assert longest_line(text) == length


def test_an_arc_bends_around_a_circle_in_its_way_and_away_from_its_opposite():
    assert pen_of(graph_with(("a", "b", 1.0))).bend("a", "b") == 0.0
    assert pen_of(graph_with(("a", "c", 1.0))).bend("a", "c") != 0.0  # b is in between
    there_and_back = pen_of(graph_with(("a", "b", 0.5), ("b", "a", 0.5)))
    assert there_and_back.bend("a", "b") > 0.0 < there_and_back.bend("b", "a")


@pytest.mark.slow
def test_a_diagram_has_an_arrow_an_arc_and_a_circle_a_state_and_two_at_the_end():
    graph = graph_with(("a", "b", 0.25), ("b", "c", 1.0), ("a", "a", 0.75))
    pen = pen_of(graph)
    pen.draw("a", {state: state for state in PLACES})
    patches = pen.axes.patches
    assert sum(isinstance(patch, FancyArrowPatch) for patch in patches) == 3
    assert sum(isinstance(patch, Circle) for patch in patches) == 4  # c is a double circle
    texts = {text.get_text() for text in pen.axes.texts}
    assert {"a", "b", "c", "0.25", "1", "0.75"} <= texts


def test_a_label_moves_away_from_what_it_would_cover():
    pen = pen_of(graph_with())
    assert pen.is_crossed((0.5, 0.5), 0.1, 0.1, ("a", "b")) == 0
    pen.boxes.append((0.5, 0.5, 0.1, 0.1))
    assert pen.is_crossed((0.5, 0.5), 0.1, 0.1, ("a", "b")) == 2


# Every node has a place of its own, and the three arrangements are chosen as documented.


READABLE = {name: game for name, game in CATALOG.items() if len(graph_of(game)) <= 150}


@each_of("game", READABLE.values())
def test_no_two_nodes_overlap(game: Game) -> None:
    graph = graph_of(game)
    places = positions_of(graph, game.start)
    assert set(places) == set(graph)
    nearest = min(
        hypot(a[0] - b[0], a[1] - b[1]) for a, b in itertools.combinations(places.values(), 2)
    )
    assert nearest >= 0.9


@pytest.mark.parametrize(
    ("game", "line"),
    [
        (OneBall(0.4, 0.8), ["L", "S2", "S1", "W"]),
        (Ahead(2, 1, Rack(0.5)), [(0, 1), (0, 0), (1, 0), (2, 0)]),
        (Drill([1, 0.5, 0.5]), [1, 2, 3]),
    ],
)
def test_paths_lie_on_a_line_with_wins_of_player_1_to_the_right(
    game: Game, line: list[object]
) -> None:
    places = positions_of(graph_of(game), game.start)
    assert sorted(places, key=lambda state: places[state]) == line
    assert {y for _, y in places.values()} == {0.0}


def test_races_lie_on_the_lattice_of_scores() -> None:
    places = positions_of(graph_of(Race(3, 2, Rack(0.5))), (0, 0))
    assert all(places[a, b] == (a + b, 0.75 * (a - b)) for a, b in places)


def test_pairs_that_are_no_scores_do_not_lie_on_the_lattice() -> None:
    balls_and_shooter = nx.DiGraph([((9, 1), (9, 2)), ((9, 2), (0, 1)), ((9, 1), (4, 1))])
    places = positions_of(balls_and_shooter, (9, 1))
    assert max(x for x, _ in places.values()) <= 4


def test_layers_run_from_the_start_with_terminal_nodes_on_outer_rows() -> None:
    graph = nx.DiGraph([("s", "a"), ("s", "b"), ("a", "won"), ("b", "lost"), ("a", "b")])
    graph.nodes["won"]["winner"] = 1
    places = positions_of(graph, "s")
    assert places["s"][0] < places["a"][0] < places["won"][0]
    assert places["lost"][1] < min(places[state][1] for state in "sab")
    assert places["won"][1] > max(places[state][1] for state in "sab")


def test_a_state_that_the_start_never_reaches_has_a_place_too() -> None:
    graph = nx.DiGraph([("s", "a"), ("s", "b"), ("s", "c"), ("far", "s"), ("b", "b"), ("c", "a")])
    assert set(positions_of(graph, "s")) == set(graph)


def test_a_circle_without_an_end_is_laid_out() -> None:
    assert len(positions_of(nx.DiGraph([(0, 1), (1, 2), (2, 0)]), 0)) == 3


def test_one_state_alone() -> None:
    assert positions_of(nx.DiGraph([("s", "s")]), "s") == {"s": (0.0, 0.0)}
