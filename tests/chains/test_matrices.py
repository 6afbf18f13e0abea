"""A matrix is read the one way that makes sense, or as it is said to be, in whatever form."""

from fractions import Fraction

import networkx as nx
import numpy as np
import pandas as pd
import pytest
from scipy.sparse import coo_array, csc_array, csr_array, csr_matrix, lil_array

from evenbreak.chains import Chain, chain_of, stochastic_limit
from evenbreak.errors import ChainError, InputError

FROM = np.array([[0.5, 0.25, 0.25], [0.5, 0.0, 0.5], [0.25, 0.25, 0.5]])
"""Land of Oz (Kemeny and Snell 1960): rain, nice, snow; the law is 2/5, 1/5, 2/5."""
LAW = [0.4, 0.2, 0.4]
ROUND = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
"""Rows and columns sum to 1: it goes round one way or the other."""
FORMS = [np.array, csr_array, csc_array, coo_array, csr_matrix, lil_array, pd.DataFrame]
named = pytest.mark.parametrize("form", FORMS, ids=lambda f: f.__name__)


@named
def test_the_one_reading_that_is_stochastic(form) -> None:
    for source in (form(FROM), form(FROM.T)):
        chain = chain_of(source, start=0)
        assert chain.matrix.toarray().tolist() == FROM.T.tolist()
        assert stochastic_limit(chain).probability == pytest.approx(LAW, rel=1e-15)


@named
def test_both_readings_are_stochastic(form) -> None:
    with pytest.raises(ChainError, match="rows='from'"):
        chain_of(form(ROUND))
    assert chain_of(form(ROUND), rows="from").matrix[1, 0] == 1.0
    assert chain_of(form(ROUND), rows="to").matrix[2, 0] == 1.0


def test_a_symmetric_matrix_reads_the_same_both_ways() -> None:
    even = np.full((2, 2), 0.5)
    assert chain_of(even).matrix.toarray().tolist() == even.tolist()


def test_a_reading_that_is_not_stochastic_is_refused() -> None:
    with pytest.raises(ChainError, match=r"out of state 0 sum to 1\.25"):
        chain_of(FROM, rows="to")
    with pytest.raises(ChainError, match="rows or its columns must all sum to 1"):
        chain_of(FROM / 2)
    with pytest.raises(InputError, match="rows must be 'from' or 'to'; you gave 'down'"):
        chain_of(FROM, rows="down")  # type: ignore[arg-type]


def test_the_columns_of_a_frame_in_another_order() -> None:
    states = ["rain", "nice", "snow"]
    frame = pd.DataFrame(FROM, states, states)[["snow", "rain", "nice"]]
    chain = chain_of(frame, start="nice")
    assert (chain.states, chain.start) == (states, "nice")
    assert stochastic_limit(chain).to_dict() == pytest.approx(dict(zip(states, LAW, strict=True)))


@pytest.mark.parametrize(
    ("index", "columns", "named"),
    [("aab", "aab", "twice"), ("abc", "aab", "twice"), ("abc", "abd", "'[cd]' labels")],
)
def test_the_labels_of_a_frame(index: str, columns: str, named: str) -> None:
    with pytest.raises(ChainError, match=named):
        chain_of(pd.DataFrame(FROM, list(index), list(columns)))


@pytest.mark.parametrize(
    ("source", "named"),
    [
        (np.ones((2, 3)) / 3, r"shape is \(2, 3\)"),
        (np.array([0.5, 0.5]), "two-dimensional"),
        (np.array([["a", "b"], ["c", "d"]]), "two-dimensional"),
        (np.array([[np.nan, 1.0], [1.0, 0.0]]), "neither"),
        (np.array([[1.5, -0.5], [0.5, 0.5]]), "must be from 0 to 1"),
        (np.zeros((0, 0)), "at least one state"),
    ],
)
def test_what_is_no_stochastic_matrix_is_refused(source, named: str) -> None:
    with pytest.raises(ChainError, match=named):
        chain_of(source)


def test_an_unknown_start() -> None:
    with pytest.raises(ChainError, match="start is 7"):
        chain_of(FROM, start=7)


# Dicts and graphs ----------------------------------------------------------------------


def test_a_dict_of_dicts() -> None:
    chain = chain_of({"won": {}, "rack": {"won": Fraction(3, 4), "lost": 0.25}}, start="rack")
    assert chain.states == ["won", "rack", "lost"]
    assert stochastic_limit(chain).to_dict() == {"won": 0.75, "rack": 0.0, "lost": 0.25}
    with pytest.raises(
        ChainError, match="moves from 'a' must be a dict from states to probabilities; you gave 'b'"
    ):
        chain_of({"a": "b"})
    with pytest.raises(ChainError, match=r"'a' sum to 0\.5"):
        chain_of({"a": {"b": 0.5}})


def test_the_weight_of_a_graph() -> None:
    graph = nx.DiGraph([("a", "b", {"chance": 0.25}), ("a", "c", {"chance": 0.75})])
    assert chain_of(graph, weight="chance").matrix[1, 0] == 0.25
    with pytest.raises(ChainError, match=r"but no probability\. Name the attribute"):
        chain_of(graph)
    with pytest.raises(ChainError, match="'a' -> 'b' has 'chance' but no p"):
        chain_of(graph, weight="p")


def test_options_for_another_kind_of_source_are_refused() -> None:
    with pytest.raises(ChainError, match="rows is 'from'"):
        chain_of([("a", "b", 1.0)], rows="from")
    with pytest.raises(ChainError, match="weight is 'p'"):
        chain_of(FROM, weight="p")


# And back ------------------------------------------------------------------------------


def test_a_chain_as_a_frame_and_back() -> None:
    chain = Chain([(0, 0), (1, 0), "end"], FROM.T)
    frame = chain.to_frame()
    assert (frame.index.name, frame.columns.name) == ("to", "from")
    assert frame[(0, 0)].tolist() == FROM[0].tolist()
    again = chain_of(frame, rows="to")
    assert again.states == chain.states
    assert again.matrix.toarray().tolist() == FROM.T.tolist()


def test_a_limit_as_numbers_and_as_a_series() -> None:
    limit = stochastic_limit(Chain([(0, 0), (1, 0), "end"], FROM.T), "end")
    assert np.asarray(limit) == pytest.approx(LAW)
    assert np.asarray(limit, np.float32).dtype == np.float32
    assert np.asarray(limit).shape == (3,)
    series = limit.to_series()
    assert list(series.index) == limit.states
    series["end"] = 9.0
    np.array(limit)[0] = 9.0
    assert limit["end"] == pytest.approx(0.4)
    assert limit[0, 0] == pytest.approx(0.4)


THREE = [[0, 1, 0], [0, 0, 1], [0.5, 0.5, 0]]


@pytest.mark.parametrize("kind", [list, tuple])
@pytest.mark.parametrize("P", [[[1.0]], [[0, 1], [0.5, 0.5]], THREE])
def test_square_lists_are_a_matrix(P, kind):
    found = chain_of(kind(kind(row) for row in P))
    np.testing.assert_array_equal(found.matrix.toarray(), np.array(P).T)


def test_three_arcs_between_numbers_are_not_a_matrix():
    around = chain_of([(0, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)])
    assert around.matrix.toarray()[1, 0] == 1.0
    assert chain_of([[0, 1, 1.0], [1, 0, 0.5], [1, 1, 0.5]]).states == [0, 1]


def test_square_lists_that_are_not_stochastic_are_refused():
    with pytest.raises(ChainError, match="rows or its columns must all sum to 1"):
        chain_of([[0.5, 0.4], [0.5, 0.4]])
    with pytest.raises(ChainError):
        chain_of([[0.5, 0.4, 0.3], [0.5, 0.4, 0.3], [0.5, 0.4, 0.3]])


def test_a_masked_chance_is_refused():
    P = np.ma.masked_array([[0.5, 0.5], [0.25, 0.75]], mask=[[False, True], [False, False]])
    with pytest.raises(ChainError, match="MaskedArray"):
        chain_of(P)
    assert chain_of(np.ma.masked_array(P.data)).matrix[1, 0] == 0.5
