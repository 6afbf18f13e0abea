"""A diagram shows every state, every arc and its probability, the start and the ends."""

import itertools
import subprocess
import sys
from math import hypot

import networkx as nx
import pytest
from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyArrowPatch
from matplotlib.text import Annotation

from evenbreak import InputError
from evenbreak.game import Game, graph_of
from evenbreak.games import (
    CATALOG,
    Ahead,
    Drill,
    OneBall,
    OneBallLookAhead,
    Race,
    Rack,
    Series,
    winner_breaks,
)
from evenbreak.plots.diagram import draw
from evenbreak.plots.picture import image_bytes

READABLE = {name: game for name, game in CATALOG.items() if len(graph_of(game)) <= 60}


def texts(axes: Axes) -> list[str]:
    return [text.get_text() for text in axes.texts if not isinstance(text, Annotation)]


def circles(axes: Axes) -> list[Circle]:
    return [patch for patch in axes.patches if isinstance(patch, Circle)]


def arrows(axes: Axes) -> list[FancyArrowPatch]:
    return [patch for patch in axes.patches if isinstance(patch, FancyArrowPatch)]


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("game", READABLE.values(), ids=READABLE)
def test_every_state_and_arc_is_drawn(game: Game) -> None:
    graph = graph_of(game)
    ends = sum(kind == "terminal" for kind in nx.get_node_attributes(graph, "kind").values())
    axes = draw(game)
    assert len(circles(axes)) == len(graph) + ends
    assert len(arrows(axes)) == graph.number_of_edges()
    assert len(texts(axes)) == len(graph) + graph.number_of_edges()
    assert sum(isinstance(text, Annotation) for text in axes.texts) == 1


@pytest.mark.parametrize(
    ("game", "shown"),
    [
        (OneBall(0.4, 0.8), {"$S_{1}$", "$S_{2}$", "W", "L", "0.4", "0.6", "0.8", "0.2"}),
        (Drill([1, 1 / 3]), {"1", "2", "0.333", "0.667"}),
        (Ahead(1, 1, Rack(0.5)), {"0:0", "1:0", "0:1", "0.5"}),
        (Race(1, 1, Rack(0.6, 0.5), breaks=winner_breaks), {"0:0\n1 breaks", "1:0", "0:1"}),
        (Race(1, 1, Race(2, 1, Rack(0.5))), {"0:0\n0:0", "0:0\n1:0", "1:0", "0:1"}),
    ],
)
def test_labels_read_as_in_the_field(game: Game, shown: set[str]) -> None:
    assert shown <= set(texts(draw(game)))


def test_labels_of_arcs_and_nodes_take_the_place_of_numbers_and_names() -> None:
    graph = nx.DiGraph()
    graph.add_edge("S1", "W", label="$p_1$", probability=0.25)
    graph.nodes["W"]["label"] = "won"
    assert set(texts(draw(graph))) == {"$S_{1}$", "won", "$p_1$"}


def test_opposite_arcs_part() -> None:
    axes = draw(Series(Rack(0.9, 0.6), breaks=winner_breaks))
    there, back = (patch.get_connectionstyle() for patch in arrows(axes)[:2])
    assert there.rad > 0
    assert back.rad > 0
    labels = {
        text.get_text(): text.get_position()
        for text in axes.texts
        if not isinstance(text, Annotation)
    }
    assert labels["0.1"][1] * -1 == pytest.approx(labels["0.4"][1])


def test_an_arc_bends_around_a_node_in_its_way() -> None:
    graph = nx.DiGraph()
    for source, target in (("a", "b"), ("b", "c"), ("a", "c")):
        graph.add_edge(source, target, probability=0.5)
    axes = draw(graph, layout={"a": (0, 0), "b": (1, 0), "c": (2, 0)})
    rads = [patch.get_connectionstyle().rad for patch in arrows(axes)]
    assert sorted(map(abs, rads))[:2] == [0, 0]
    assert abs(rads[1]) > 0.2  # the arcs of a come first: a -> b, a -> c


def test_ends_differ_without_color() -> None:
    fills = [circle.get_facecolor() for circle in circles(draw(OneBall(0.5, 0.5)))]
    grays = {red for red, green, blue, _ in fills if red == green == blue}
    assert len(fills) == 6
    assert len(grays) == 3


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("game", READABLE.values(), ids=READABLE)
def test_numbers_do_not_cover_each_other_or_leave_the_picture(game: Game) -> None:
    axes = draw(game)
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    spots = [text.get_position() for text in axes.texts if not isinstance(text, Annotation)]
    assert all(left < x < right and bottom < y < top for x, y in spots)
    assert all(hypot(a[0] - b[0], a[1] - b[1]) > 0.1 for a, b in itertools.combinations(spots, 2))


@pytest.mark.slow
def test_files_are_the_same_to_the_byte() -> None:
    code = (
        "import sys\nfrom evenbreak.games import OneBallLookAhead\n"
        "from evenbreak.plots import draw, image_bytes\n"
        "axes = draw(OneBallLookAhead([0.4, 0.8]), title='Two shots')\n"
        "for kind in ('png', 'svg', 'png', 'svg'):\n"
        "    sys.stdout.buffer.write(image_bytes(axes, kind))"
    )
    elsewhere = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)
    axes = draw(OneBallLookAhead([0.4, 0.8]), title="Two shots")
    assert 2 * (image_bytes(axes, "png") + image_bytes(axes, "svg")) == elsewhere.stdout


def test_a_diagram_that_nobody_could_read_is_refused() -> None:
    with pytest.raises(InputError, match="168 states"):
        draw(Race(12, 12, Rack(0.5)))
    with pytest.raises(InputError, match="0 states"):
        draw(nx.DiGraph())


def test_a_layout_must_place_every_state() -> None:
    with pytest.raises(InputError, match="no place for state 'S2'"):
        draw(OneBall(0.5, 0.5), layout={"S1": (0, 0), "W": (1, 0), "L": (2, 0)})


@pytest.mark.parametrize("place", [(0, float("nan")), (1,), None, "ab", 3])
def test_a_place_is_two_numbers(place: object) -> None:
    layout = {"S1": (0, 0), "S2": place, "W": (1, 0), "L": (2, 0)}
    with pytest.raises(InputError, match="layout for state 'S2'"):
        draw(OneBall(0.5, 0.5), layout=layout)  # type: ignore[arg-type]


def test_words_have_no_circle_and_kinds_say_where_the_game_begins() -> None:
    graph = nx.DiGraph()
    graph.add_node("S1", kind="transient")
    graph.add_node("later", kind="words", label=r"$\cdots$")
    graph.add_edge("S1", "later", label="$q_1$")
    axes = draw(graph, layout={"S1": (0, 0), "later": (1, 0)})
    assert len(circles(axes)) == 1
    assert texts(axes) == ["$q_1$", "$S_{1}$", r"$\cdots$"]
    starts = [text for text in axes.texts if isinstance(text, Annotation)]
    assert starts == []
    graph.nodes["S1"]["kind"] = "start"
    marked = draw(graph).texts
    assert sum(isinstance(text, Annotation) for text in marked) == 1


def test_a_heading_lies_within_the_picture() -> None:
    graph = nx.DiGraph()
    graph.add_node("one", kind="transient")
    graph.add_node("title", kind="words", label="A heading wider than the game below it")
    axes = draw(graph, layout={"one": (0, 0), "title": (0, 0.7)})
    axes.figure.canvas.draw()
    for text in axes.texts:
        box = text.get_window_extent()
        assert box.x0 >= 0
        assert box.x1 <= axes.figure.bbox.width


class Cutthroat:
    """Three players with balls left; whoever is shot out leaves, and the last one wins."""

    start = (1, 1, 1)

    def moves(self, balls: tuple[int, ...]) -> dict[tuple[int, ...], float]:
        left = [player for player in range(3) if balls[player]]
        if len(left) == 1:
            return {}
        return {
            tuple(0 if player == out else had for player, had in enumerate(balls)): 1 / len(left)
            for out in left
        }

    def winner(self, balls: tuple[int, ...]) -> int | None:
        return balls.index(1) + 1 if sum(balls) == 1 else None


class WithLabels(Cutthroat):
    def label(self, balls: tuple[int, ...]) -> str:
        return "".join("abc"[player] for player in range(3) if balls[player])


def test_tuples_of_your_own_game_are_drawn_as_they_are() -> None:
    shown = set(texts(draw(Cutthroat())))
    assert {"(1, 1, 1)", "(0, 1, 1)", "(0, 0, 1)"} <= shown
    assert not any(":" in text or "breaks" in text for text in shown)


def test_a_game_says_how_its_states_are_written() -> None:
    assert set(texts(draw(WithLabels()))) >= {"abc", "ab", "ac", "bc", "a", "b", "c"}


def test_every_winner_has_a_color_and_a_third_one_a_legend() -> None:
    axes = draw(Cutthroat())
    fills = {circle.get_facecolor() for circle in circles(axes)}
    assert len(fills) == 4  # white, and one for each player
    legend = axes.get_legend()
    assert [text.get_text() for text in legend.get_texts()] == [
        "player 1 wins",
        "player 2 wins",
        "player 3 wins",
    ]
    axes.figure.canvas.draw()
    box = legend.get_window_extent()
    assert axes.figure.bbox.y0 <= box.y0
    assert box.x1 <= axes.figure.bbox.x1
    assert draw(OneBall(0.5, 0.5)).get_legend() is None
