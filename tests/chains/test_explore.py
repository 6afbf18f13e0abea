"""What makes a chain, what is refused, and that games, graphs and arcs give the same one."""

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_from_arrays, chain_of
from evenbreak.errors import ChainError, EvenbreakError, GameError
from evenbreak.game import graph_of
from evenbreak.games import OneBall, Race, Rack, Series, winner_breaks
from rows import each_of

UNIT = st.floats(0.0, 1.0)


def test_triples_keep_the_order_in_which_states_appear() -> None:
    chain = chain_of([("C", "A", 0.25), ("C", "B", 0.75), ("A", "C", 1)])
    assert chain.states == ["C", "A", "B"]
    assert chain.matrix.toarray().tolist() == [[0, 1, 0], [0.25, 0, 0], [0.75, 0, 1]]
    assert chain.start is None


def test_the_matrix_is_canonical() -> None:
    chain = chain_of([("A", "C", 0.5), ("A", "B", 0.5), ("C", "A", 1.0)])
    matrix = chain.matrix.copy()
    matrix.has_canonical_format = False
    matrix.sum_duplicates()
    assert matrix.indices.tolist() == chain.matrix.indices.tolist()
    assert matrix.indptr.tolist() == chain.matrix.indptr.tolist()
    assert chain.matrix.has_canonical_format


@pytest.mark.parametrize("source", [None, 5, 0.5])
def test_what_is_no_source_is_refused(source: object) -> None:
    with pytest.raises(ChainError, match=r"the source must be a game, a networkx.DiGraph, a "):
        chain_of(source)  # type: ignore[arg-type]


def test_a_game_with_arrays_of_chances_is_refused() -> None:
    rack = Rack(np.array([0.25, 0.5]))
    with pytest.raises(EvenbreakError, match=r"p1 must be one number\. For an array"):
        chain_of(Race(2, 2, rack))
    with pytest.raises(EvenbreakError, match=r"p1 must be one number\. For an array"):
        chain_of(Series(rack, breaks=winner_breaks))

    class Mine:
        start = "rack"

        def moves(self, state: str) -> dict[str, object]:
            return {"won": np.array([0.25, 0.5])} if state == "rack" else {}

        def winner(self, _: str) -> None:
            return None

    with pytest.raises(GameError, match=r"'rack' -> 'won' has probability array"):
        chain_of(Mine())  # type: ignore[arg-type]


# The rules -----------------------------------------------------------------------------


@each_of(
    "triples, words",
    [
        ([("A", "B", 0.5)], r"the arcs out of state 'A' sum to 0\.5\. Give probabilities"),
        ([("A", "B", 1.1)], "'A' -> 'B' has probability 1.1"),
        ([("A", "B", -0.5), ("A", "C", 1.5)], "probability -0.5"),
        ([("A", "B", float("nan"))], "probability nan"),
        ([("A", "B", float("inf"))], "probability inf"),
        ([("A", "B", 0.5), ("A", "B", 0.5)], "'A' -> 'B' is listed more than once"),
        ([("A", "A", 0.5), ("A", "B", 0.5), ("A", "A", 0)], "'A' -> 'A' is listed more than once"),
        ([("A", "B", 0)], "sum to 0"),
        ([("A", "B", 1 + 2e-9)], "probability 1.000000002"),
        ([("A", "B", 1 - 2e-9)], "sum to 0.999999998"),
        (
            [("A", "B", 0.7), ("C", "B", 0.7)],
            r"'A' sum to 0.7 \(1 other state is off too\)",
        ),
        ([("A", "B", 0.6), ("A", "A", 0.6)], "sum to 1.2"),
        ([], "state"),
        (
            [("A", "B")],
            (
                r"arc 1 must be \(source, target, probability\), two hashable states "
                r"and a number; you gave \('A', 'B'\)"
            ),
        ),
        ([("A", "B", 1), ("B", "A", "much")], "arc 2 must"),
        (
            [("A", [1], 1)],
            (
                r"arc 1 must be \(source, target, probability\), two hashable states "
                r"and a number; you gave \('A', \[1\], 1\)"
            ),
        ),
    ],
)
def test_refused(triples: list[tuple[object, ...]], words: str) -> None:
    with pytest.raises(ChainError, match=words):
        chain_of(triples)  # type: ignore[arg-type]


def test_the_tolerance_of_a_sum() -> None:
    chain = chain_of([("A", "B", 0.5), ("A", "C", 0.5 - 9e-10)])
    assert chain.matrix[2, 0] == pytest.approx((0.5 - 9e-10) / (1.0 - 9e-10), rel=1e-15)
    assert chain.matrix[1, 0] + chain.matrix[2, 0] == 1.0


def test_a_listed_self_loop_is_what_the_others_leave_over() -> None:
    chain = chain_of([("A", "A", 0.7 + 5e-10), ("A", "B", 0.3)])
    assert chain.matrix[0, 0] == 1.0 - 0.3


def test_a_self_loop_that_nothing_is_left_for_vanishes() -> None:
    chain = chain_of([("A", "A", 1e-10), ("A", "B", 1.0)])
    assert chain.matrix.toarray().tolist() == [[0, 0], [1, 1]]


def test_no_self_loop_is_invented() -> None:
    thirds = [0.7, 0.2, 0.1]
    assert thirds[0] + thirds[1] + thirds[2] != 1.0
    chain = chain_of([("A", target, p) for target, p in zip("BCD", thirds, strict=True)])
    assert chain.matrix[0, 0] == 0
    assert chain.matrix.nnz == 3 + 3


def test_a_self_loop_of_zero_stays_away() -> None:
    parts = [0.7, 0.2, 0.1, 0.0]
    chain = chain_of([("A", target, p) for target, p in zip("BCDA", parts, strict=True)])
    assert chain.matrix[0, 0] == 0
    assert chain.matrix.nnz == 3 + 3


def test_a_zero_arc_counts_as_listed_and_makes_no_arc() -> None:
    chain = chain_of([("A", "B", 0.0), ("A", "C", 1.0), ("B", "B", 0), ("B", "A", 1)])
    assert chain.states == ["A", "B", "C"]
    assert chain.matrix.nnz == 3


def test_a_state_without_arcs_absorbs() -> None:
    assert chain_of([("A", "B", 1)]).matrix[1, 1] == 1.0


def test_a_state_of_only_itself() -> None:
    assert chain_of([("A", "A", 1 - 1e-10)]).matrix.toarray().tolist() == [[1.0]]


# Arrays --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arrays", "words"),
    [
        (("AA", [0], [1], [1.0]), "state is listed twice"),
        (("AB", [0], [2], [1.0]), "from 0 to 1; one doesn't"),
        (("AB", [-1], [1], [1.0]), "from 0 to 1; one doesn't"),
        (("AB", [0], [1], [0.5, 0.5]), r"shapes \(1,\), \(1,\) and \(2,\)"),
        (("AB", [0.0], [1.0], [1.0]), "type is float64"),
        (("AB", [[0]], [[1]], [[1.0]]), "shapes"),
        (([], [], [], []), "state"),
    ],
)
def test_arrays_refused(arrays: tuple[object, ...], words: str) -> None:
    with pytest.raises(ChainError, match=words):
        chain_from_arrays(*arrays)  # type: ignore[arg-type]


def test_arrays_in_any_order() -> None:
    sources, targets = np.array([2, 0, 1, 0]), np.array([2, 2, 0, 1])
    chances = np.array([1.0, 0.25, 1.0, 0.75])
    expected = chain_from_arrays("ABC", [0, 0, 1, 2], [1, 2, 0, 2], [0.75, 0.25, 1, 1])
    found = chain_from_arrays("ABC", sources, targets, chances)
    assert (found.matrix != expected.matrix).nnz == 0
    assert chances.tolist() == [1.0, 0.25, 1.0, 0.75]  # what was given is left alone


def test_no_arcs_at_all() -> None:
    assert chain_from_arrays("AB", [], [], []).matrix.toarray().tolist() == [[1, 0], [0, 1]]


def test_an_unknown_start_is_refused() -> None:
    for start in ("Z", ["unhashable"]):
        with pytest.raises(ChainError, match="start is"):
            chain_of([("A", "B", 1)], start=start)  # type: ignore[arg-type]


@given(st.data())
def test_arrays_and_triples_agree(data: st.DataObject) -> None:
    n = data.draw(st.integers(1, 6))
    rows = data.draw(
        st.lists(st.lists(st.integers(0, 9), min_size=n, max_size=n), min_size=n, max_size=n)
    )
    triples = [
        (j, i, weight / sum(row))
        for j, row in enumerate(rows)
        if sum(row)
        for i, weight in enumerate(row)
    ]
    data.draw(st.randoms(use_true_random=False)).shuffle(triples)
    if triples:
        columns = [np.array(column) for column in zip(*triples, strict=True)]
        by_triples, by_arrays = chain_of(triples), chain_from_arrays(range(n), *columns)
        order = [by_arrays.index(state) for state in by_triples.states]
        square = by_arrays.matrix.toarray()[np.ix_(order, order)]
        assert np.allclose(by_triples.matrix.toarray(), square, rtol=0, atol=1e-15)


# Graphs --------------------------------------------------------------------------------


def test_a_graph_of_the_users_own() -> None:
    graph = nx.DiGraph()
    graph.add_node("lonely")
    graph.add_edge("A", "B", probability=0.25)
    graph.add_edge("A", "A", probability=0.75)
    chain = chain_of(graph)
    assert chain.states == ["lonely", "A", "B"]
    assert chain.start is None
    assert chain.matrix.toarray().tolist() == [[1, 0, 0], [0, 0.75, 0], [0, 0.25, 1]]


def test_the_start_of_a_graph() -> None:
    graph = graph_of(OneBall(0.4, 0.8))
    assert chain_of(graph).start == "S1"
    assert chain_of(graph, start="S2").start == "S2"
    graph.nodes["S2"]["kind"] = "start"
    with pytest.raises(ChainError, match="2 nodes with kind='start'"):
        chain_of(graph)


@pytest.mark.parametrize(
    ("attributes", "words"),
    [
        ({}, "has no probability. Give each arc a number"),
        ({"probability": "half"}, "has probability 'half'. Give each arc a number"),
        ({"probability": None}, "has probability None. Give each arc a number"),
        (
            {"p": 1.0},
            "has 'p' but no probability. Name the attribute that holds it, as in weight='p'",
        ),
        ({"weight": "much"}, "has weight 'much'. Give each arc a number"),
    ],
)
def test_an_arc_without_a_probability(attributes: dict[str, object], words: str) -> None:
    graph = nx.DiGraph()
    graph.add_edge("A", "B", **attributes)
    with pytest.raises(ChainError, match=f"'A' -> 'B' {words}"):
        chain_of(graph)


def test_weights_of_networkx_are_read_where_no_arc_has_a_probability() -> None:
    lengths = nx.DiGraph()
    lengths.add_weighted_edges_from([("A", "B", 2.0), ("A", "A", 6.0), ("B", "A", 1.0)])
    chain = chain_of(nx.stochastic_graph(lengths))
    assert chain.matrix.toarray().tolist() == [[0.75, 1.0], [0.25, 0.0]]
    with pytest.raises(
        ChainError, match=r"only a weight, and .* 'A' -> 'B' has .* 2\.0\. .* weight="
    ):
        chain_of(lengths)
    for _, _, arc in lengths.edges(data=True):
        arc["p"] = 1.0 if arc["weight"] == 1.0 else arc["weight"] / 8.0
    assert (
        chain_of(lengths, weight="p").matrix.toarray().tolist() == chain.matrix.toarray().tolist()
    )


def test_weights_do_not_stand_in_for_some_probabilities() -> None:
    graph = nx.DiGraph([("A", "B", {"probability": 1.0, "weight": 3.0}), ("B", "A", {"weight": 1})])
    with pytest.raises(ChainError, match="'B' -> 'A' has 'weight' but no probability"):
        chain_of(graph)


@pytest.mark.parametrize("kind", [nx.Graph, nx.MultiDiGraph])
def test_other_graphs_are_refused(kind: type) -> None:
    graph = kind([("A", "B", {"probability": 1.0})])
    with pytest.raises(ChainError, match=r"Give a networkx\.DiGraph"):
        chain_of(graph)


# Games ---------------------------------------------------------------------------------


class Wild:
    """A game with whatever moves are asked for."""

    start = 0

    def __init__(self, moves: dict[int, dict[int, float]]) -> None:
        self._moves = moves

    def moves(self, state: int) -> dict[int, float]:
        return self._moves.get(state, {})

    def winner(self, state: int) -> None:  # noqa: ARG002
        return


class Endless(Wild):
    def moves(self, state: int) -> dict[int, float]:
        return {state + 1: 1.0}


@pytest.mark.parametrize(
    ("moves", "error", "words"),
    [
        ({0: {1: -0.5, 2: 1.5}}, GameError, "0 -> 1 has probability -0.5"),
        ({0: {1: float("nan")}}, GameError, "probability nan"),
        ({0: {1: 0.0, 2: 0.0}}, GameError, "every move from 0 has probability 0"),
        ({0: {1: 0.5, 2: 0.4}}, ChainError, "'?0'? sum to 0.9"),
        ({0: {1: 1.5}}, GameError, "probability 1.5"),
        (
            {0: None},
            GameError,
            (
                r"moves from 0 must be a dict from states to probabilities \(empty if the "
                r"game is over\); you gave None"
            ),
        ),
        ({0: [(1, 1.0)]}, GameError, "moves from 0 must"),
    ],
)
def test_games_refused(moves: dict[int, dict[int, float]], error: type, words: str) -> None:
    with pytest.raises(error, match=words):
        chain_of(Wild(moves))


def test_a_class_and_a_start_that_cannot_be_hashed_are_refused() -> None:
    with pytest.raises(GameError, match="the class Wild"):
        chain_of(Wild)  # type: ignore[arg-type]
    game = Wild({})
    game.start = [0]  # type: ignore[assignment]
    with pytest.raises(GameError, match="the start must"):
        chain_of(game)


def test_an_endless_game_is_given_up() -> None:
    with pytest.raises(GameError, match="more than 100 states"):
        graph_of(Endless({}), max_states=100)
    with pytest.raises(GameError, match="more than 100 states"):
        graph_of(Race(20, 20, Rack(0.5)), max_states=100)


def test_a_game_from_another_start() -> None:
    race = Race(3, 3, Rack(0.5))
    chain = chain_of(race, start=(2, 2))
    assert chain.start == (2, 2)
    assert set(chain.states) == {(2, 2), (3, 2), (2, 3)}


def test_a_game_that_is_over_before_it_begins() -> None:
    race = Race(3, 2, Rack(0.5), score=(3, 1))
    for chain in (chain_of(race), chain_of(graph_of(race), start=(3, 1))):
        assert list(chain.states) == [(3, 1)]
        assert chain.matrix.toarray().tolist() == [[1.0]]


def test_an_endless_series_has_no_ends() -> None:
    chain = chain_of(Series(Rack(0.75, 0.5), breaks=winner_breaks, first_breaker=2))
    assert chain.states == [2, 1]
    assert chain.matrix.toarray().tolist() == [[0.5, 0.25], [0.5, 0.75]]


@given(UNIT, UNIT)
def test_game_and_graph_give_the_same_chain(p1: float, p2: float) -> None:
    game = OneBall(p1, p2)
    one, other = chain_of(game), chain_of(graph_of(game))
    assert (one.states, one.start) == (other.states, other.start)
    assert (one.matrix != other.matrix).nnz == 0
