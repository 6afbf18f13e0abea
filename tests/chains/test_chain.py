"""The chain: its states, and what a start may be."""

import networkx as nx
import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains import Chain, chain_of, propagate
from evenbreak.errors import ChainError, InputError
from evenbreak.game import Game, graph_of
from evenbreak.games import CATALOG, Race, Rack
from rows import each_of


@pytest.fixture
def chain() -> Chain:
    return Chain(("a", "b", "c"), csc_array([[0.5, 0, 0], [0.25, 1, 0], [0.25, 0, 1.0]]), "a")


def test_a_start_is_a_state_a_mapping_an_array_or_the_chains_own(chain):
    assert chain.density().tolist() == [1, 0, 0]
    assert chain.density("c").tolist() == [0, 0, 1]
    assert chain.density({"a": 0.25, "b": 0.75}).tolist() == [0.25, 0.75, 0]
    given = np.array([0.5, 0.0, 0.5])
    found = chain.density(given)
    found[0] = 9.0
    assert given[0] == 0.5, "the caller's array is not shared"


@pytest.mark.parametrize(
    ("start", "words"),
    [
        ("d", "state 'd' isn't in the chain, whose first states are 'a', 'b', 'c'"),
        (["a"], "isn't in the chain"),
        ({"a": 0.5}, "sums to 0.5"),
        (
            {"a": 1.5, "b": -0.5},
            "start vector must have probabilities; the one for state 'b' is negative",
        ),
        ({"x": 1.0}, "'x' isn't in the chain"),
        (np.array([1.0, 0.0]), "shape (3,)"),
        (np.array([np.nan, 0.0, 1.0]), "start must have finite numbers; one is nan for state 'a'"),
    ],
)
def test_what_is_no_start_is_refused(chain, start, words):
    with pytest.raises(ChainError) as caught:
        chain.density(start)
    assert words in str(caught.value)


def test_a_number_for_each_state(chain):
    for given in (np.array([0, -2, 0]), {"b": -2}):
        assert chain.vector(given, "rewards").tolist() == [0.0, -2.0, 0.0]
    assert chain.vector("c", "weights").tolist() == [0.0, 0.0, 1.0]
    with pytest.raises(
        ChainError, match="rewards must have finite numbers; one is inf for state 'b'"
    ):
        chain.vector({"b": np.inf}, "rewards")


def test_a_chain_without_a_start_asks_for_one():
    with pytest.raises(
        ChainError, match=r"such as start=0, or set one for all questions with chain_of"
    ):
        Chain(range(1), csc_array([[1.0]])).density()


def test_states_in_a_string_are_letters_not_substrings():
    chain = Chain("ab", csc_array(np.eye(2)))
    with pytest.raises(ChainError):
        chain.density("ab")
    assert chain.start_index("b") == 1


def test_a_state_is_found_before_and_after_the_dictionary_is_made(chain):
    assert chain.start_index("c") == 2
    assert chain.index("c") == 2
    assert chain.start_index("c") == 2
    assert chain.start_index({"c": 1.0}) is None


def test_arcs_leave_out_loops_and_stored_zeros_and_sum_duplicates():
    entries, rows, indptr = [0.5, 0.5, 1.0, 0.0, 1.0], [0, 1, 1, 0, 2], [0, 2, 3, 5]
    matrix = csc_array((np.array(entries), np.array(rows), np.array(indptr)), (3, 3))
    arcs = Chain(range(3), matrix).arcs
    assert (arcs.sources.tolist(), arcs.targets.tolist()) == ([0], [1])
    assert arcs.chances.tolist() == [0.5]
    assert arcs.outflow.tolist() == [0.5, 0, 0]
    raw = csc_array(
        (np.array([0.25, 0.25, 0.5, 1.0]), np.array([1, 1, 0, 1]), np.array([0, 3, 4])), (2, 2)
    )
    assert Chain(range(2), raw).arcs.chances.tolist() == [0.5]


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        ([[0.5, 0.0], [0.1, 1.0]], r"arcs out of state 'a' sum to 0\.6"),
        ([[0.0, 0.0], [0.0, 1.0]], "arcs out of state 'a' sum to 0"),
        ([[1.5, 0.0], [-0.5, 1.0]], "must be from 0 to 1"),
        ([[np.nan, 0.0], [1.0, 1.0]], "must be from 0 to 1"),
        ([[1.0]], "shape"),
    ],
)
def test_a_matrix_that_is_no_chain_is_refused(matrix, message):
    with pytest.raises(ChainError, match=message):
        Chain(["a", "b"], csc_array(np.array(matrix)))


def test_a_seed_that_is_none_is_refused_by_its_name():
    chain = chain_of([("a", "b", 1.0), ("b", "a", 1.0)], start="a")
    for rng in ("x", 1.5, -1):
        with pytest.raises(InputError, match="rng"):
            chain.simulate(3, rng)
    assert (chain.simulate(3, 1) == chain.simulate(3, np.random.default_rng(1))).all()


# Toward other libraries ---------------------------------------------------------------


@each_of("game", CATALOG.values())
def test_the_graph_of_a_chain_is_that_of_its_game_and_reads_back(game: Game):
    chain = chain_of(game)
    graph = chain.to_networkx()
    read = chain_of(graph)
    assert (list(read.states), read.start) == (list(chain.states), chain.start)
    assert (read.matrix != chain.matrix).nnz == 0
    diagram = graph_of(game)
    for node in diagram.nodes.values():
        del node["winner"]
    if not any(loop[0] == loop[1] for loop in diagram.edges):  # a loop is what is left over
        assert nx.utils.graphs_equal(graph, diagram)


def test_the_graph_of_a_chain_without_a_start_marks_none(chain):
    free = Chain(chain.states, chain.matrix)
    assert dict(free.to_networkx().nodes(data="kind")) == {
        "a": "transient",
        "b": "terminal",
        "c": "terminal",
    }
    ended = Chain(chain.states, chain.matrix, "b")
    assert ended.to_networkx().nodes["b"]["kind"] == "terminal"


def test_a_chain_is_an_array(chain):
    matrix = np.asarray(chain)
    assert matrix.tolist() == chain.matrix.toarray().tolist()
    matrix[0, 0] = 9.0
    assert np.asarray(chain)[0, 0] == 0.5, "the array is the caller's own"
    assert np.asarray(chain, dtype=np.float32).dtype == np.float32
    assert np.linalg.matrix_power(chain, 2).shape == (3, 3)
    with pytest.raises(ValueError, match="copy=False"):
        np.array(chain, copy=False)


def test_a_dense_matrix_that_fits_nowhere_is_refused():
    large = Chain(range(20_000), csc_array((np.ones(20_000), np.arange(20_000), range(20_001))))
    with pytest.raises(ChainError, match=r"20,000 states would take 3 GB\. Use .* chain\.matrix"):
        np.asarray(large)
    with pytest.raises(ChainError, match=r"chain\.matrix"):
        large.to_frame()


# Random paths: only along arcs, each arc as often as its probability says.


MATRIX = np.array([[0.5, 0.25, 0.0], [0.0, 0.75, 0.125], [0.5, 0.0, 0.875]])


def test_steps_are_as_frequent_as_the_arcs_say() -> None:
    paths = Chain("abc", MATRIX, "a").simulate(50, np.random.default_rng(3), paths=2000)
    assert paths.shape == (2000, 51)
    assert (paths[:, 0] == 0).all()
    counts = np.zeros((3, 3))
    np.add.at(counts, (paths[:, 1:].ravel(), paths[:, :-1].ravel()), 1)
    assert (counts[MATRIX == 0.0] == 0).all()
    left = counts.sum(axis=0)
    error = np.sqrt(MATRIX * (1 - MATRIX) / left)
    assert (np.abs(counts / left - MATRIX) <= 5 * error).all()


def test_the_state_after_some_steps_has_the_density_of_propagate() -> None:
    chain = chain_of(Race(3, 3, Rack(0.6)))
    ends = chain.simulate(4, np.random.default_rng(5), paths=40_000)[:, -1]
    density = propagate(chain, steps=4)
    found = np.bincount(ends, minlength=len(chain)) / 40_000
    assert np.abs(found - density).max() < 5 * 0.5 / np.sqrt(40_000)
    assert (found[density == 0.0] == 0.0).all()


def test_arcs_of_chance_0_are_never_taken() -> None:
    matrix = csc_array(([0.0, 1.0, 0.0, 0.0, 1.0, 0.0], [0, 1, 2, 0, 1, 2], [0, 3, 6, 6]))
    matrix = csc_array((np.append(matrix.data, 1.0), np.append(matrix.indices, 1), [0, 3, 6, 7]))
    paths = Chain("abc", matrix).simulate(3, np.random.default_rng(1), start="c", paths=500)
    assert (paths[:, 1:] == 1).all()


def test_a_density_as_the_start_and_the_same_paths_for_the_same_seed() -> None:
    chain = Chain("abc", MATRIX)
    start = {"a": 0.25, "c": 0.75}
    one, other = (
        chain.simulate(2, np.random.default_rng(7), start=start, paths=4000) for _ in "ab"
    )
    assert (one == other).all()
    assert (one == chain.simulate(2, 7, start=start, paths=4000)).all()
    assert set(one[:, 0]) == {0, 2}
    assert abs((one[:, 0] == 2).mean() - 0.75) < 5 * np.sqrt(0.1875 / 4000)


def test_refusals() -> None:
    chain, rng = Chain("abc", MATRIX, "a"), np.random.default_rng(1)
    assert chain.simulate(0, rng).tolist() == [[0]]
    assert chain.simulate(5, rng, paths=0).shape == (0, 6)
    with pytest.raises(InputError, match="steps must be a whole number, 0 or more; you gave -1"):
        chain.simulate(-1, rng)
    with pytest.raises(InputError, match=r"paths must be a whole number, 0 or more; you gave 1\.5"):
        chain.simulate(1, rng, paths=1.5)  # type: ignore[arg-type]
    with pytest.raises(ChainError, match="'z'"):
        chain.simulate(1, rng, start="z")
