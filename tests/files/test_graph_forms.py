"""What networkx and scipy find in the files of a graph."""

import io
import json

import networkx as nx
from scipy.io import mmread

from evenbreak.answers.match.chain import road_of
from evenbreak.files import graphml_bytes, matrix_market_bytes, node_link_bytes
from evenbreak.games import Drill, OneBall


def test_networkx_and_scipy_open_them() -> None:
    road = road_of(OneBall(0.4, 0.8))
    graph = nx.read_graphml(io.BytesIO(graphml_bytes(road.graph)))
    assert graph.nodes["W"] == {"kind": "terminal", "winner": 1}
    assert graph.nodes["S1"] == {"kind": "start"}
    linked = nx.node_link_graph(json.loads(node_link_bytes(road.graph)), edges="edges")
    assert dict(linked.nodes(data=True)) == dict(road.graph.nodes(data=True))
    for read in (graph, linked):
        assert list(read.edges(data="probability")) == list(road.graph.edges(data="probability"))
    content = matrix_market_bytes(road.chain)
    assert (
        mmread(io.BytesIO(content), spmatrix=False).toarray() == road.chain.matrix.toarray()
    ).all()
    assert b"% Transition matrix" in content or b"%Transition matrix" in content
    assert b"column-stochastic" in content


def test_they_are_the_same_bytes_each_time() -> None:
    one, other = (road_of(Drill.progressive(0.8)) for _ in range(2))
    assert graphml_bytes(one.graph) == graphml_bytes(other.graph)
    assert matrix_market_bytes(one.chain) == matrix_market_bytes(other.chain)
