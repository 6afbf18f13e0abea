import networkx as nx
import pytest
from matplotlib.patches import Circle, FancyArrowPatch

from evenbreak.plots.picture import new_axes
from evenbreak.plots.strokes import Pen, is_terminal, is_words, longest_line

PLACES = {"a": (0.0, 0.0), "b": (1.0, 0.0), "c": (2.0, 0.0)}


def graph_of(*arcs):
    graph = nx.DiGraph()
    graph.add_nodes_from(PLACES)
    for source, target, probability in arcs:
        graph.add_edge(source, target, probability=probability)
    return graph


def pen_of(graph):
    return Pen(new_axes("", ""), graph, PLACES, 1.25)


def test_a_node_that_only_leads_to_itself_is_terminal():
    graph = graph_of(("a", "b", 1.0), ("b", "b", 1.0))
    assert [is_terminal(graph, state) for state in PLACES] == [False, True, True]


def test_words_are_no_states():
    graph = graph_of()
    graph.nodes["a"]["kind"] = "words"
    assert [is_words(graph, state) for state in "ab"] == [True, False]


@pytest.mark.parametrize(("text", "length"), [("S1", 2), ("$p_{1}$", 2), ("0:0\nA breaks", 8)])
def test_the_longest_line_without_markup(text, length):
    assert longest_line(text) == length


def test_an_arc_bends_around_a_circle_in_its_way_and_away_from_its_opposite():
    assert pen_of(graph_of(("a", "b", 1.0))).bend("a", "b") == 0.0
    assert pen_of(graph_of(("a", "c", 1.0))).bend("a", "c") != 0.0  # b is in between
    there_and_back = pen_of(graph_of(("a", "b", 0.5), ("b", "a", 0.5)))
    assert there_and_back.bend("a", "b") > 0.0 < there_and_back.bend("b", "a")


def test_a_diagram_has_an_arrow_an_arc_and_a_circle_a_state_and_two_at_the_end():
    graph = graph_of(("a", "b", 0.25), ("b", "c", 1.0), ("a", "a", 0.75))
    pen = pen_of(graph)
    pen.draw("a", {state: state for state in PLACES})
    patches = pen.axes.patches
    assert sum(isinstance(patch, FancyArrowPatch) for patch in patches) == 3
    assert sum(isinstance(patch, Circle) for patch in patches) == 4  # c is a double circle
    texts = {text.get_text() for text in pen.axes.texts}
    assert {"a", "b", "c", "0.25", "1", "0.75"} <= texts


def test_a_label_moves_away_from_what_it_would_cover():
    pen = pen_of(graph_of())
    assert pen.is_crossed((0.5, 0.5), 0.1, 0.1, ("a", "b")) == 0
    pen.boxes.append((0.5, 0.5, 0.1, 0.1))
    assert pen.is_crossed((0.5, 0.5), 0.1, 0.1, ("a", "b")) == 2
