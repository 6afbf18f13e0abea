"""A chain and its graph as files that other programs open: GraphML, JSON, Matrix Market.

`networkx.read_graphml`, `networkx.node_link_graph` and `scipy.io.mmread` read them back, and so
does `evenbreak.files.read_chain`. Every number is written with the digits that give it back
exactly.
"""

from __future__ import annotations

import io
import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import networkx as nx

    from evenbreak.chains.chain import Chain

HEADER = """Transition matrix of an evenbreak chain, column-stochastic: the entry in row i and
column j is the probability of going from state j to state i, and each column sums to 1.
States are numbered from 1, in the order of states.csv."""


def graphml_bytes(graph: nx.DiGraph[Any]) -> bytes:
    """Return a graph as GraphML; attributes that are None are left out, as GraphML has no such.

    >>> import networkx as nx
    >>> graph = nx.DiGraph([("S", "W", {"probability": 1.0})])
    >>> read = nx.read_graphml(io.BytesIO(graphml_bytes(graph)))
    >>> read.edges["S", "W"]["probability"]
    1.0
    """
    import networkx as nx

    written = graph.copy()
    for _, attributes in written.nodes(data=True):
        for name in [name for name, value in attributes.items() if value is None]:
            del attributes[name]
    out = io.BytesIO()
    nx.write_graphml_xml(written, out, named_key_ids=True)
    return out.getvalue() + b"\n"


def node_link_bytes(graph: nx.DiGraph[Any]) -> bytes:
    """Return a graph as node-link JSON: a list of `nodes` and a list of `edges`.

    >>> import networkx as nx
    >>> graph = nx.DiGraph([("S", "W", {"probability": 0.5})])
    >>> data = json.loads(node_link_bytes(graph))
    >>> data["edges"]
    [{'probability': 0.5, 'source': 'S', 'target': 'W'}]
    >>> nx.node_link_graph(data, edges="edges").edges["S", "W"]["probability"]
    0.5
    """
    import networkx as nx

    data = nx.node_link_data(graph, edges="edges")
    return (json.dumps(data, indent=1, ensure_ascii=False) + "\n").encode()


def matrix_market_bytes(chain: Chain) -> bytes:
    """Return the transition matrix in Matrix Market form, column-stochastic.

    >>> from evenbreak.chains import chain_of
    >>> from scipy.io import mmread
    >>> chain = chain_of([("rain", "rain", 0.7), ("rain", "sun", 0.3), ("sun", "rain", 1.0)])
    >>> mmread(io.BytesIO(matrix_market_bytes(chain))).toarray()
    array([[0.7, 1. ],
           [0.3, 0. ]])
    """
    from scipy.io import mmwrite

    out = io.BytesIO()
    mmwrite(out, chain.matrix.tocoo(), comment=HEADER, field="real", symmetry="general")
    return out.getvalue()
