"""A Markov chain in a file, read and written: arcs, GraphML, node-link JSON, Matrix Market.

`networkx.read_graphml`, `networkx.node_link_graph` and `scipy.io.mmread` can read the files written
here, and so can `read_chain`. Every number is written with enough digits to be read back exactly.
"""

from __future__ import annotations

import io
import json
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains.matrices import sums_to_1
from evenbreak.files.arcs import ARCS, SUM_TOLERANCE, WEIGHT, ArcsFile, read_arcs, sum_problems
from evenbreak.files.tables.problems import Problems, printable, quoted, refusal, warning
from evenbreak.files.tables.rows import content_of
from evenbreak.files.tables.schema import Schema, Text
from evenbreak.words import Parameter, say

if TYPE_CHECKING:
    from collections.abc import Mapping

    import networkx as nx
    from scipy.sparse import csc_array

    from evenbreak.chains.chain import Chain
    from evenbreak.chains.matrices import Rows


STATES = Schema(
    "states",
    state=Text("name, node", "the state's name", needed=True),
    kind=Text(about="`start` for the state that the chain starts in"),
    winner=Text(about="the number of the player who has won in that state"),
) | Schema(**dict.fromkeys(("class", "class_kind", "period", "limit"), Text()))
"""A list of states; the lists that `evenbreak chain` writes have more columns."""

OTHER_FORMS = (".dot", ".gexf", ".gml", ".gv", ".gz", ".mat", ".net", ".npy", ".npz", ".pkl")
"""File extensions that other programs use for graphs and matrices, and that tables never have."""

MOST_MEGABYTES = 64
"""The largest graph: some 200,000 states with three arcs each, or a gigabyte of memory."""


def read_chain(
    path: str | Path, *, states: str | Path | None = None, rows: Rows | None = None
) -> ArcsFile:
    r"""Read a chain; the file's extension shows its format.

    Parameters
    ----------
    path
        `.graphml`, `.json` (node-link), `.mtx` (Matrix Market), or a table of arcs (see
        `read_arcs`). '-' is a table of arcs from standard input.
    states
        a CSV file naming a matrix's states, in the matrix's order; without it, the states are
        numbered from 1.
    rows
        how to read a matrix. 'from': a row holds the chances out of its state. 'to': a row holds
        the chances into its state, so that the columns sum to 1, as in this package. None: 'to',
        but a matrix whose rows sum to 1 and whose columns don't is rejected, and a matrix whose
        rows and columns both sum to 1 is read with a warning.

    Raises
    ------
    DataError
        listing what is wrong with the file: its format, missing or invalid probabilities, arcs or
        states listed twice, sums that are not 1.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "matrix.mtx"
    ...     _ = path.write_text("%%MatrixMarket matrix coordinate real general\n2 2 3\n"
    ...                         "1 1 0.75\n2 1 0.25\n1 2 1\n")
    ...     read_chain(path).probabilities
    array([0.75, 0.25, 1.  ])
    """
    form = PurePath(path).suffix.lower()
    if form != ".mtx" and (states is not None or rows is not None):
        raise refusal(
            str(path),
            "only a Matrix Market file (.mtx) needs {option}. Leave it out.",
            option=Parameter("states" if states is not None else "rows"),
        )
    if form == ".mtx":
        return _of_matrix(path, states, rows)
    if form in OTHER_FORMS:
        raise refusal(
            str(path),
            "{form} files can't be read. Save the graph as GraphML (networkx.write_graphml), "
            "the matrix as a Matrix Market file (scipy.io.mmwrite), or the arcs as CSV.",
            form=form,
        )
    if form in (".graphml", ".xml"):
        return _of_graph(path, _graphml)
    return _of_graph(path, _node_link) if form == ".json" else read_arcs(path)


def _graphml(content: bytes) -> nx.Graph[Any]:
    from xml.parsers import expat

    import networkx as nx

    def refuse(*_: object) -> None:
        raise ValueError("it has a DOCTYPE, which could make it expand far beyond its size")

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = refuse
    parser.Parse(content, True)
    return nx.read_graphml(io.BytesIO(content))


def _node_link(content: bytes) -> nx.Graph[Any]:
    import networkx as nx

    data = json.loads(content.decode("utf-8-sig"))
    if not isinstance(data, dict) or not isinstance(data.get("nodes"), list):
        raise TypeError("it has no list of nodes")
    name = "links" if "links" in data else "edges"  # networkx before 3.6 wrote links
    if not isinstance(data.get(name), list):
        raise TypeError("it has no list of edges")
    for k, arc in enumerate(data[name], 1):
        if not isinstance(arc, dict) or not {"source", "target"} <= arc.keys():
            raise TypeError(f"arc {k} has no source or no target")
    graph = nx.node_link_graph({"multigraph": False, **data}, edges=name)
    if len(graph) > len(data["nodes"]):
        stray = list(graph)[len(data["nodes"])]
        raise ValueError(f"an arc leads from or to {stray!r}, which isn't among the nodes")
    if graph.number_of_edges() < len(data[name]) and graph.is_directed():
        raise ValueError("an arc is listed twice")
    return graph


def _of_graph(path: str | Path, parsed: Any) -> ArcsFile:
    source, content = content_of(path)
    if len(content) > MOST_MEGABYTES << 20:
        raise refusal(source, "is larger than {n} MB. Save its arcs as CSV.", n=MOST_MEGABYTES)
    try:
        graph = parsed(content)
    except Exception as error:
        form = "GraphML" if parsed is _graphml else "node-link JSON, with nodes and edges"
        reason = printable(" ".join(str(error).split()))
        raise refusal(
            source, "can't be read as {form} ({reason}). Check the file.", form=form, reason=reason
        ) from None
    if not graph.is_directed() or graph.is_multigraph():
        raise refusal(
            source,
            "{fault}. Save a directed graph, with at most one arc from one state to another.",
            fault=say("is a multigraph") if graph.is_directed() else say("isn't directed"),
        )
    if not len(graph):
        raise refusal(source, "has no states. Write a node for each one.")
    names = ("probability", *ARCS["probability"].aliases, WEIGHT)
    problems, triples = Problems(source), []
    position = {state: k for k, state in enumerate(graph)}
    for j, i, attributes in graph.edges(data=True):
        chance: Any = next((attributes[name] for name in names if name in attributes), None)
        if type(chance) not in (int, float) or not 0.0 <= chance <= 1.0:
            weighted = not attributes.keys() & {*names[:-1]} and WEIGHT in attributes
            problems.add(
                None,
                "the arc {start} -> {end} has {chance}. Give each arc an attribute named "
                "probability, with a number from 0 to 1{scaled}.",
                start=quoted(str(j)),
                end=quoted(str(i)),
                chance=say("no probability")
                if chance is None
                else say("probability {chance}", chance=f"{chance!r:.40}"),
                scaled=say(
                    ", such as its weight divided by the total weight of all arcs from "
                    "the same state"
                )
                if weighted
                else "",
            )
        triples.append((position[j], position[i], chance))
    states = [str(state) for state in graph]
    if len(set(states)) < len(states):
        raise refusal(
            source, "has two states whose names are written the same. Give each its own name."
        )
    problems.raise_any()
    ends = np.array([triple[:2] for triple in triples], dtype=np.int64).reshape(-1, 2)
    sources, targets = ends.T
    p = np.array([triple[2] for triple in triples], dtype=np.float64)
    for problem in sum_problems(states, sources, p).values():
        problems.add(None, problem)
    problems.raise_any()
    nodes = dict(zip(states, graph.nodes.values(), strict=True))
    starts = [state for state, node in nodes.items() if node.get("kind") == "start"]
    if len(starts) > 1:
        raise refusal(
            source, "has {n} nodes whose kind is start. Mark only one as the start.", n=len(starts)
        )
    start = starts[0] if starts else None
    winners = _winners({state: node.get("winner") for state, node in nodes.items()}, source)
    return ArcsFile(states, sources, targets, p, source, (), start, winners)


def _winners(winners: Mapping[str, Any], source: str) -> dict[str, int]:
    """Return the players who have won, leaving out states in which no one has won."""
    players = {}
    for state, winner in winners.items():
        if winner is None or winner == "":
            continue
        try:
            players[state] = int(str(winner))
        except ValueError:
            players[state] = 0
        if players[state] < 1:
            raise refusal(
                source,
                "state {state} has the winner {winner}. Give the winning player's number: 1, 2, "
                "...",
                state=quoted(state),
                winner=quoted(str(winner)),
            )
    return players


def _of_matrix(path: str | Path, states: str | Path | None, rows: Rows | None) -> ArcsFile:
    source, content = content_of(path)
    matrix = _square(content, source)
    wrong = np.flatnonzero(~((matrix.data >= 0.0) & (matrix.data <= 1.0)))
    if wrong.size:
        entry = matrix.data[wrong[0]]
        raise refusal(source, "has the entry {entry:.12g}. Give numbers from 0 to 1.", entry=entry)
    by_columns, by_rows = (sums_to_1(matrix, axis=axis) for axis in (0, 1))
    warnings: tuple[str, ...] = ()
    if rows is None and by_rows and not by_columns:
        raise refusal(
            source,
            "is row-stochastic: its rows sum to 1 and its columns don't, so each row holds the "
            "chances of leaving one state. Use {rows}='from', or transpose the matrix.",
            rows=Parameter("rows"),
        )
    if rows is None and by_rows and (matrix - matrix.T).count_nonzero():
        either = warning(
            source,
            None,
            "its rows and its columns both sum to 1; each column was read as the probabilities "
            "of leaving one state. If the rows hold those probabilities, use {rows} from; if "
            "the columns do, use {rows} to",
            rows=Parameter("rows"),
        )
        warnings = (either,)
    if rows == "from":
        matrix = matrix.T.tocsc()
    n = matrix.shape[0]
    names, start = [str(k + 1) for k in range(n)], None
    winners: dict[str, int] = {}
    if states is not None:
        names, start, winners, more = _states(states, n)
        warnings += more
    sources = np.repeat(np.arange(n), np.diff(matrix.indptr))
    targets = matrix.indices.astype(np.int64)
    sums = np.bincount(sources, weights=matrix.data, minlength=n)
    problems = Problems(source)
    for k in np.flatnonzero(np.abs(sums - 1.0) > SUM_TOLERANCE).tolist():
        problems.add(
            None,
            "{line} {k} sums to {sum:.12g}, not 1. Give the probabilities of leaving each "
            "state, with a 1 on the diagonal for a state that is never left.",
            line=say("row") if rows == "from" else say("column"),
            k=k + 1,
            sum=sums[k],
        )
    problems.raise_any()
    return ArcsFile(names, sources, targets, matrix.data, source, warnings, start, winners)


def _square(content: bytes, source: str) -> csc_array[np.float64]:
    """Return the square matrix of real numbers in a Matrix Market file."""
    from scipy.io import mminfo, mmread
    from scipy.sparse import coo_array, csc_array, issparse

    try:
        # The reader goes past the end of a line with a NUL byte, and of a last one without an end.
        if b"\0" in content:
            raise ValueError("it holds a NUL byte")
        content += b"\n"
        *shape, entries, _, _, _ = mminfo(io.BytesIO(content))
        if max(shape) > 2 * entries or entries > len(content):  # room would be made for them all
            raise ValueError(f"it doesn't hold the {entries:,} entries of {max(shape):,} states")
        read: Any = mmread(io.BytesIO(content), spmatrix=False)
    except Exception as error:
        reason = printable(" ".join(str(error).split()))
        raise refusal(
            source,
            "can't be read as a Matrix Market file ({reason}). Check the file.",
            reason=reason,
        ) from None
    entries_read = coo_array(read)
    if (
        entries_read.dtype.kind not in "iuf"
        or entries_read.shape[0] != entries_read.shape[1]
        or not entries_read.shape[0]
    ):
        kind = "complex " if entries_read.dtype.kind == "c" else ""
        size = " x ".join(map(str, entries_read.shape))
        raise refusal(
            source,
            "holds a {size} {kind}matrix. Give a square matrix of real numbers.",
            kind=kind,
            size=size,
        )
    matrix: csc_array[np.float64] = csc_array(entries_read.astype(np.float64))
    if issparse(read) and matrix.nnz < entries_read.nnz:
        raise refusal(source, "lists an entry twice. Keep one of the two.")
    return matrix


def _states(
    path: str | Path, n: int
) -> tuple[list[str], str | None, dict[str, int], tuple[str, ...]]:
    """Return n state names, the start, the winners, and warnings."""
    table = STATES.text(path)
    table.problems.raise_any()
    names = table.cells("state")
    if len(names) != n or len(set(names)) < n or not all(names):
        raise refusal(
            table.source,
            "has {names} different names in {rows} rows, but the matrix has {n} states. Give "
            "each state its own name, in the matrix's order.",
            names=len(set(filter(None, names))),
            rows=len(names),
            n=n,
        )
    kinds = table.cells("kind") if "kind" in table else []
    start = next((name for name, kind in zip(names, kinds, strict=False) if kind == "start"), None)
    winners = dict(zip(names, table.cells("winner"), strict=True))
    return names, start, _winners(winners, table.source), table.warnings


HEADER = """Transition matrix of an evenbreak chain, column-stochastic: the entry in row i and
column j is the probability of going from state j to state i, and each column sums to 1.
States are numbered from 1, in the order of states.csv."""


def graphml_bytes(graph: nx.DiGraph[Any]) -> bytes:
    """Return a graph as GraphML, without attributes that are None, which GraphML can't store.

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
    >>> mmread(io.BytesIO(matrix_market_bytes(chain)), spmatrix=False).toarray()
    array([[0.7, 1. ],
           [0.3, 0. ]])
    """
    from scipy.io import mmwrite

    out = io.BytesIO()
    mmwrite(out, chain.matrix.tocoo(), comment=HEADER, field="real", symmetry="general")
    return out.getvalue()
