"""A game written in every form and read back; and what is refused at the door."""

import json
import random
from collections.abc import Iterator

import networkx as nx
import numpy as np
import pytest

from evenbreak.answers.match.chain import road_of
from evenbreak.chains import Chain, chain_from_arrays, chain_of, stochastic_limit
from evenbreak.errors import DataError
from evenbreak.files import (
    graphml_bytes,
    matrix_market_bytes,
    node_link_bytes,
    read_chain,
)
from evenbreak.files.arcs import ArcsFile
from evenbreak.files.chain_files import OTHER_FORMS
from evenbreak.game import Game
from evenbreak.games import CATALOG
from evenbreak.handicaps import Ladder, chart
from tries import tries

GAMES = {**CATALOG, "npl_10": Ladder(chart("npl_10")), "npl_20": Ladder(chart("npl_20"))}


def chain_in(file: ArcsFile, start: str | None) -> Chain:
    return chain_from_arrays(
        file.states, file.sources, file.targets, file.probabilities, start=start
    )


@pytest.mark.slow_after(15)
@pytest.mark.parametrize("game", GAMES.values(), ids=GAMES.keys())
@pytest.mark.parametrize("form", ["graphml", "json", "mtx"])
def test_the_limit_is_the_same_when_read_back(tmp_path, game: Game, form: str) -> None:
    road = road_of(game)
    contents = {
        "graphml": graphml_bytes(road.graph),
        "json": node_link_bytes(road.graph),
        "mtx": matrix_market_bytes(road.chain),
    }
    path = tmp_path / f"graph.{form}"
    path.write_bytes(contents[form])
    names = None
    if form == "mtx":
        names = tmp_path / "states.csv"
        nodes = road.graph.nodes.items()
        names.write_text(
            "state,kind,winner\n"
            + "".join(f'"{s}",{n["kind"]},{n["winner"] or ""}\n' for s, n in nodes)
        )
    file = read_chain(path, states=names)
    assert (file.states, file.start, file.warnings) == (
        list(road.chain.states),
        road.chain.start,
        (),
    )
    chain = file.chain()
    assert (chain.matrix != road.chain.matrix).nnz == 0
    limit = stochastic_limit(chain).probability
    np.testing.assert_allclose(limit, road.limit.probability, rtol=0, atol=1e-15)
    np.testing.assert_allclose(
        limit, stochastic_limit(chain_of(game)).probability, rtol=0, atol=1e-15
    )
    # Nothing that a form holds gets lost.
    assert nx.utils.graphs_equal(file.graph(), road.graph)


def matrix_file(folder, rows):
    n = len(rows)
    entries = [(i + 1, j + 1, p) for i, row in enumerate(rows) for j, p in enumerate(row) if p]
    path = folder / "matrix.mtx"
    path.write_text(
        f"%%MatrixMarket matrix coordinate real general\n{n} {n} {len(entries)}\n"
        + "".join(f"{i} {j} {p}\n" for i, j, p in entries)
    )
    return path


def problem(path, **options) -> str:
    with pytest.raises(DataError) as caught:
        read_chain(path, **options)
    return caught.value.problems[0]


BY_COLUMNS = [[0.75, 1.0], [0.25, 0.0]]
BY_ROWS = [[0.75, 0.25], [1.0, 0.0]]
BOTH = [[0.25, 0.5, 0.25], [0.25, 0.25, 0.5], [0.5, 0.25, 0.25]]


def test_a_row_stochastic_matrix_is_recognized(tmp_path) -> None:
    path = matrix_file(tmp_path, BY_ROWS)
    assert "row-stochastic" in problem(path)
    read = chain_in(read_chain(path, rows="from"), None)
    assert read.matrix.toarray().tolist() == BY_COLUMNS
    assert "column 1 sums to 1.75" in problem(path, rows="to")
    assert "row 1 sums to 1.75" in problem(matrix_file(tmp_path, BY_COLUMNS), rows="from")


def test_a_matrix_that_reads_both_ways_comes_with_a_warning(tmp_path) -> None:
    path = matrix_file(tmp_path, BOTH)
    file = read_chain(path)
    assert chain_in(file, None).matrix.toarray().tolist() == BOTH
    assert "If the rows hold those probabilities, use rows from" in file.warnings[0]
    assert read_chain(path, rows="to").warnings == ()
    assert chain_in(read_chain(path, rows="from"), None).matrix.toarray().T.tolist() == BOTH
    assert read_chain(matrix_file(tmp_path, [[0.0, 1.0], [1.0, 0.0]])).warnings == ()


@pytest.mark.parametrize(
    ("rows", "part"),
    [
        ([[0.5, 1.0], [0.25, 0.0]], "column 1 sums to 0.75"),
        ([[-0.5, 1.0], [1.5, 0.0]], "-0.5"),
        ([[float("nan"), 1.0], [1.0, 0.0]], "nan"),
    ],
)
def test_a_bad_matrix(tmp_path, rows, part) -> None:
    assert part in problem(matrix_file(tmp_path, rows))


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("hello", "Matrix Market"),
        ("", "Matrix Market"),
        ("%%MatrixMarket matrix coordinate real general\n1 2 1\n1 1 1.0\n", "1 x 2"),
        ("%%MatrixMarket matrix coordinate complex general\n1 1 1\n1 1 1.0 0.5\n", "complex"),
        ("%%MatrixMarket matrix coordinate real general\n1 1 2\n1 1 0.5\n1 1 0.5\n", "twice"),
        (
            "%%MatrixMarket matrix coordinate real general\n9999999999 9999999999 1\n",
            "doesn't hold",
        ),
        ("%%MatrixMarket matrix array real general\n99999 99999\n1\n", "doesn't hold"),
    ],
)
def test_what_is_no_square_matrix(tmp_path, text, part) -> None:
    path = tmp_path / "matrix.mtx"
    path.write_text(text)
    assert part in problem(path)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("end", [b"", b" ", b" 7", b"x", b"e", b"\xff", b"\r"])
def test_a_matrix_whose_last_line_has_no_end(tmp_path, end) -> None:
    """scipy alone reads past the end of such files, and the program ends by a signal."""
    path = tmp_path / "matrix.mtx"
    path.write_bytes(b"%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1" + end)
    for _ in range(20):
        assert read_chain(path).probabilities.tolist() == [1.0]
    path.write_bytes(path.read_bytes() + b"\0\n")
    assert "holds a NUL byte" in problem(path)


def mutants(content: bytes, seed: int, count: int) -> Iterator[bytes]:
    """Yield the content with one to four wrong, missing, repeated or strange pieces each."""
    draw = random.Random(seed)
    strange = (
        b"null 1e999 -1 [] {} x NaN true 99999999999999999999 < \0 \xff &x; undirected".split()
    )
    for _ in range(count):
        mutant = bytearray(content)
        for _ in range(draw.randint(1, 4)):
            at, end = sorted(draw.choices(range(len(mutant) + 1), k=2))
            piece = draw.choice([mutant[at : at + 30], b"", bytes([draw.randrange(256)]), *strange])
            mutant[at : draw.choice([at, at + 1, min(end, at + 30)])] = piece
        yield bytes(mutant)


@pytest.mark.parametrize("form", ["graphml", "json", "mtx"])
def test_damaged_graphs_and_matrices_are_read_or_refused_on_a_line(tmp_path, form) -> None:
    road = road_of(CATALOG["one-ball"])
    content = {
        "graphml": graphml_bytes(road.graph),
        "json": node_link_bytes(road.graph),
        "mtx": matrix_market_bytes(road.chain),
    }[form]
    path = tmp_path / f"graph.{form}"
    for mutant in mutants(content, 1, tries("damaged graphs and matrices", 60)):
        path.write_bytes(mutant)
        try:
            read_chain(path).graph()
        except DataError as error:
            for text in error.problems:
                assert text.isprintable(), mutant


@pytest.mark.parametrize("names", ["a\n", "a\na\n", "a\nb\nc\n"])
def test_states_that_do_not_fit_the_matrix(tmp_path, names) -> None:
    path = matrix_file(tmp_path, BY_COLUMNS)
    states = tmp_path / "states.csv"
    states.write_text("state\n" + names)
    assert "the matrix has 2" in problem(path, states=states)


def test_states_and_rows_are_for_matrices(tmp_path) -> None:
    assert "states" in problem(tmp_path / "arcs.csv", states="states.csv")
    assert "rows" in problem(tmp_path / "graph.json", rows="from")


def json_file(folder, edges, **more):
    nodes = sorted({edge[end] for edge in edges for end in ("source", "target") if end in edge})
    data = {"directed": True, "nodes": [{"id": node} for node in nodes], "edges": edges} | more
    path = folder / "graph.json"
    path.write_text(json.dumps(data))
    return path


def edge(source, target, **attributes):
    return {"source": source, "target": target, **attributes}


@pytest.mark.parametrize(
    ("edges", "more", "part"),
    [
        ([edge("S", "W", probability=0.5)], {}, "'S' sum to 0.5"),
        ([edge("S", "W")], {}, "'S' -> 'W' has no probability"),
        ([edge("S", "W", probability=1.5)], {}, "1.5"),
        ([edge("S", "W", probability="1\x1b[2J")], {}, "'1\\x1b[2J'"),
        ([edge("S", "W", probability=10**400)], {}, "'S' -> 'W' has probability 1000"),
        ([edge("S", "W", probability=True)], {}, "'S' -> 'W' has probability True"),
        ([edge("S", "W", probability=0.5), edge("S", "W", probability=1.0)], {}, "listed twice"),
        ([edge("S", "W", weight=3.0)], {}, "'S' -> 'W' has probability 3.0"),
        ([edge("S", "W", weight=3.0)], {}, "its weight divided by the total weight"),
        ([edge("S", "W", p=1.0)], {"nodes": [{"id": "S"}]}, "'W', which isn't among the nodes"),
        ([{"source": "S"}], {"nodes": [{"id": "S"}]}, "arc 1 has no source or no target"),
        ([], {"nodes": [{"id": "S", "winner": "Ann"}]}, "state 'S' has the winner 'Ann'. Give the"),
        ([], {"nodes": [{"id": k, "kind": "start"} for k in "AB"]}, "2 nodes whose kind is start"),
        ([edge("S", "W", probability=1.0)], {"directed": False}, "directed"),
        ([edge("S", "W", probability=1.0)], {"multigraph": True}, "one arc"),
        ([edge("1", "1", p=1.0)], {"nodes": [{"id": 1}, {"id": "1"}]}, "written the same"),
        ([], {}, "no states"),
    ],
)
def test_a_bad_graph(tmp_path, edges, more, part) -> None:
    assert part in problem(json_file(tmp_path, edges, **more))


def test_probabilities_may_have_the_names_that_columns_have(tmp_path) -> None:
    path = json_file(tmp_path, [edge("S", "W", p=0.25), edge("S", "L", p=0.75)])
    assert read_chain(path).probabilities.tolist() == [0.25, 0.75]


def test_a_weight_counts_where_there_is_no_probability(tmp_path) -> None:
    path = json_file(tmp_path, [edge("S", "W", weight=0.25), edge("S", "L", weight=0.75)])
    assert read_chain(path).probabilities.tolist() == [0.25, 0.75]
    path = json_file(tmp_path, [edge("S", "W", weight=9, probability=1.0)])
    assert read_chain(path).probabilities.tolist() == [1.0]
    path = tmp_path / "arcs.csv"
    path.write_text("Source,Target,Type,Weight\nS,W,Directed,0.25\nS,L,Directed,0.75\n")
    assert read_chain(path).probabilities.tolist() == [0.25, 0.75]
    path.write_text("source,target,weight,p\nS,W,9,0.25\nS,L,9,0.75\n")
    assert read_chain(path).probabilities.tolist() == [0.25, 0.75]
    path.write_text("source,target\nS,W\n")
    assert "no column 'probability'" in problem(path)


GRAPHML = """<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
<key id="p" for="edge" attr.name="probability" attr.type="double"/>
<graph edgedefault="directed"><node id="S"/><node id="W"/>
<edge source="S" target="W"><data key="p">{}</data></edge></graph></graphml>"""


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
@pytest.mark.parametrize(
    "definition",
    [
        '<!ENTITY a "1"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">',
        '<!ENTITY b SYSTEM "file:///etc/hostname">',
        '<!ENTITY % b SYSTEM "http://localhost/b"> %b;',
    ],
)
def test_a_graph_that_defines_entities_is_refused_unread(tmp_path, definition, encoding) -> None:
    path = tmp_path / "graph.graphml"
    path.write_text(f"<!DOCTYPE graphml [{definition}]>" + GRAPHML.format("&b;"), encoding)
    assert "has a DOCTYPE" in problem(path)
    path.write_text(GRAPHML.format("1"), encoding)
    assert read_chain(path).probabilities.tolist() == [1.0]


def test_a_graph_that_would_fill_the_memory_is_refused(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("evenbreak.files.chain_files.MOST_MEGABYTES", 0)
    path = json_file(tmp_path, [edge("S", "W", probability=1.0)])
    assert "larger than 0 MB. Save its arcs as CSV" in problem(path)


def test_json_that_is_nested_without_end_is_refused(tmp_path) -> None:
    path = tmp_path / "graph.json"
    path.write_text("[" * 100_000)
    assert "can't be read as node-link JSON" in problem(path)


def test_who_has_won_is_read_from_every_form(tmp_path) -> None:
    nodes = [{"id": "S", "winner": None}, {"id": "W", "winner": 2}]
    path = json_file(tmp_path, [edge("S", "W", p=1.0)], nodes=nodes)
    file = read_chain(path)
    assert file.winners == {"W": 2}
    assert dict(file.graph("S").nodes(data="winner")) == {"S": None, "W": 2}
    with pytest.raises(DataError, match="start 'X' isn't a state; the first states are 'S', 'W'"):
        file.chain("X")


def test_links_as_older_programs_write_them(tmp_path) -> None:
    path = tmp_path / "graph.json"
    graph = nx.DiGraph([("S", "W", {"probability": 1.0})])
    path.write_text(json.dumps(nx.node_link_data(graph, edges="links")))
    assert read_chain(path).states == ["S", "W"]


@pytest.mark.parametrize("name", ["graph.json", "graph.graphml"])
@pytest.mark.parametrize("content", ["", "hello", "{}", "[1]", "<graphml", "<a/>"])
def test_what_is_no_graph(tmp_path, name, content) -> None:
    path = tmp_path / name
    path.write_text(content)
    problem(path)


def test_a_graph_in_another_form_of_json(tmp_path) -> None:
    path = tmp_path / "graph.json"
    path.write_text(json.dumps(nx.adjacency_data(nx.DiGraph([("S", "W", {"probability": 1.0})]))))
    assert "it has no list of edges" in problem(path)


@pytest.mark.parametrize("form", OTHER_FORMS)
def test_other_forms_of_graphs_and_matrices_are_named_and_not_read_as_tables(tmp_path, form):
    path = tmp_path / f"mine{form}"
    path.write_bytes(b"graph [ directed 1 ]")
    assert f"{form} files can't be read. Save the graph as GraphML" in problem(path)


def test_a_missing_file(tmp_path) -> None:
    for form in ("mtx", "json", "graphml", "csv"):
        assert "no such file" in problem(tmp_path / f"nowhere.{form}")
