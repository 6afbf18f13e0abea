"""A game written into a folder, and each file of it opened again."""

import csv
import json

import networkx as nx
import numpy as np
import pytest
from scipy.io import mmread

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.cli.match.graph import FILES
from evenbreak.games import CATALOG, Ahead, Drill, OneBall, Race, Rack, Series, loser_breaks
from evenbreak.handicaps import Ladder, chart


@pytest.fixture
def write(run, tmp_path):
    """Write the game of some words, and return its JSON and its folder."""

    def write_game(words: str):
        result = run("graph", *words.split(), "--json", "--out", str(tmp_path))
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout), tmp_path

    return write_game


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


GAMES = {
    "one-ball --p1 0.3 --p2 0.6": OneBall(0.3, 0.6),
    "series loser breaks --p1 0.9 --p2 0.5": Series(Rack(0.9, 0.5), breaks=loser_breaks),
    "series, alternate breaks": CATALOG["series, alternate breaks"],
    "drill 9-ball --p 0.7": Drill.progressive(0.7),
    "drill 8-ball --p 0.7": Drill.eight_ball(0.7),
    "ahead 3:2 --p 0.6": Ahead(3, 2, Rack(0.6)),
    "race 9:5": Race(9, 5, Rack(2 / 3)),
    "7:5 loser breaks --p1 0.6 --p2 0.5": Race(7, 5, Rack(0.6, 0.5), breaks=loser_breaks),
    "race to 4 --p 0.6": Race(4, 4, Rack(0.6)),
    "n-ahead 3 --p 0.6": Ahead(3, 3, Rack(0.6)),
    "one_ball --p1 0.3 --p2 0.6": OneBall(0.3, 0.6),
    "npl_20": Ladder(chart("npl_20")),
}


@pytest.mark.slow
@pytest.mark.parametrize(("words", "game"), GAMES.items(), ids=GAMES.keys())
def test_the_limit_is_read_back_from_every_form(write, run, words, game) -> None:
    answer, folder = write(words)
    chain = chain_of(game)
    limit = {str(s): p for s, p in stochastic_limit(chain).to_dict().items()}
    assert (answer["states"], answer["start"]) == (len(chain), str(chain.start))
    states = ("--states", str(folder / "states.csv"))
    for name, more in (
        ("graph.graphml", ()),
        ("graph.json", ()),
        ("arcs.csv", ()),
        ("matrix.mtx", states),
    ):
        result = run("chain", str(folder / name), *more, "--json")
        assert (result.exit_code, result.stderr) == (0, ""), name
        read = json.loads(result.stdout)
        assert read["start"] == str(chain.start)
        assert read["limit"] == pytest.approx(limit, rel=0, abs=1e-15), name
    written = {row["state"]: float(row["elimination"]) for row in rows_of(folder / "limit.csv")}
    assert written == pytest.approx(limit, rel=0, abs=1e-15)


@pytest.mark.slow
@pytest.mark.parametrize("words", ["one-ball", "series, alternate breaks"])
def test_what_is_written_can_be_written_again(write, run, tmp_path, words) -> None:
    answer, folder = write(words)
    for name, more in (
        ("graph.graphml", ()),
        ("graph.json", ()),
        ("matrix.mtx", ("--states", str(folder / "states.csv"))),
        ("arcs.csv", ()),
    ):
        again = tmp_path / "again"
        result = run("graph", str(folder / name), *more, "--json", "--out", str(again))
        assert result.exit_code == 0, result.stderr
        read = json.loads(result.stdout)
        assert read["heading"] == f"From graph to limit: the chain in {name}"
        for key in ("states", "arcs", "start", "all_eigenvalues", "period"):
            assert read[key] == answer[key], (name, key)
        for file in FILES:
            if name == "arcs.csv" and file != "arcs.csv":
                assert (again / file).exists()  # states come in another order, and nobody wins
            elif not file.endswith((".svg", ".png")):  # whose title is the game's
                one, other = ((place / file).read_text() for place in (folder, again))
                assert sorted(one.split("\n")) == sorted(other.split("\n")), (name, file)


def test_a_graph_of_ones_own(run, tmp_path) -> None:
    graph = nx.DiGraph()
    graph.add_weighted_edges_from([("A", "B", 1), ("B", "A", 0.5), ("B", "C", 0.5), ("D", "C", 1)])
    path = tmp_path / "mine.graphml"
    nx.write_graphml(graph, path)
    result = run("graph", str(path), "--start-state", "B", "--json", "--out", str(tmp_path / "out"))
    answer = json.loads(result.stdout)
    assert (answer["states"], answer["arcs"], answer["start"]) == (4, 4, "B")
    assert [row["kind"] for row in answer["classes"]].count("absorbing") == 1
    assert answer["mean_steps"] == pytest.approx(3.0)
    assert (tmp_path / "out" / "graph.svg").read_bytes().startswith(b"<?xml")
    result = run("graph", str(path), "--start-state", "C", "--json", "--out", str(tmp_path / "out"))
    assert json.loads(result.stdout)["limit"][2]["elimination"] == 1.0


def test_a_graph_too_large_to_write_is_refused_with_the_remedy(run, tmp_path) -> None:
    path = tmp_path / "arcs.csv"
    path.write_text("source,target,p\n" + "".join(f"{k},{k + 1},1\n" for k in range(5000)))
    result = run("graph", str(path), "--out", str(tmp_path / "out"))
    assert result.exit_code == 3
    assert "arcs.csv: has 5,001 states, but evenbreak graph writes at most 5,000" in result.stderr


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("nowhere.csv", "no such file"),
        ("nowhere.graphml", "no such file"),
        ("nowhere.mtx", "no such file"),
        ("nowhere.gml", ".gml files can't be read"),
    ],
)
def test_a_missing_file_is_not_taken_for_a_game(run, tmp_path, name, said) -> None:
    result = run("graph", str(tmp_path / name), "--out", str(tmp_path / "out"))
    assert (result.exit_code, said in result.stderr) == (3, True)


def test_other_programs_open_the_files(write) -> None:
    _, folder = write("ahead 3:2 --p 0.6")
    graph = nx.read_graphml(folder / "graph.graphml")
    linked = nx.node_link_graph(json.loads((folder / "graph.json").read_text()), edges="edges")
    assert nx.utils.graphs_equal(nx.DiGraph(graph.edges), nx.DiGraph(linked.edges))
    states = [row["state"] for row in rows_of(folder / "states.csv")]
    matrix = mmread(folder / "matrix.mtx", spmatrix=False).toarray()
    np.testing.assert_allclose(matrix.sum(axis=0), 1.0, rtol=1e-15)
    for j, i, p in graph.edges(data="probability"):
        assert matrix[states.index(i), states.index(j)] == p


def test_eigenpairs_are_those_of_the_matrix(write) -> None:
    _, folder = write("drill 9-ball --p 0.7")
    matrix = mmread(folder / "matrix.mtx", spmatrix=False).toarray()
    values = np.array([float(row["real"]) for row in rows_of(folder / "eigenvalues.csv")])
    vectors = rows_of(folder / "eigenvectors.csv")
    n = len(values)
    right, left = (
        np.array([[float(row[f"{side}_{k + 1}"]) for k in range(n)] for row in vectors])
        for side in ("right", "left")
    )
    np.testing.assert_allclose(matrix @ right, right * values, atol=1e-14)
    np.testing.assert_allclose(left.T @ matrix, values[:, None] * left.T, atol=1e-10)


@pytest.mark.slow
def test_a_defective_race_is_written_nevertheless(write) -> None:
    answer, folder = write("race 9:5")
    assert "defective" in answer["refused"]["spectrum"]
    assert not answer["all_eigenvalues"]
    assert sorted(path.name for path in folder.iterdir()) == sorted(FILES)
    assert {row["real"] for row in rows_of(folder / "eigenvalues.csv")} == {"1.0"}
    assert answer["difference_eigen"] < 1e-15


@pytest.mark.slow
def test_classes_periods_and_winners(write) -> None:
    answer, folder = write("series, alternate breaks")
    assert answer["classes"] == [
        {"class": 1, "states": 2, "kind": "recurrent", "period": 2, "limit": 1.0}
    ]
    assert (answer["period"], answer["wins"]) == (2, {})
    answer, folder = write("one-ball --p1 0.5 --p2 0.25")
    assert answer["wins"] == pytest.approx({"1": 0.8, "2": 0.2})
    winners = {row["state"]: row["winner"] for row in rows_of(folder / "states.csv")}
    assert winners == {"S1": "", "S2": "", "W": "1", "L": "2"}


def test_the_same_bytes_each_time(run, tmp_path) -> None:
    for name in ("one", "other"):
        run("graph", "drill", "9-ball", "--out", str(tmp_path / name))
    for file in FILES:
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "other" / file).read_bytes()


def test_what_is_left_of_another_game_is_named(run, tmp_path) -> None:
    run("graph", "one-ball", "--out", str(tmp_path))
    result = run("graph", "15:15", "--p", "0.5", "--out", str(tmp_path))
    assert result.exit_code == 0
    assert {line for line in FILES if f"{line} is from an earlier run" in result.stderr} == {
        "eigenvectors.csv",
        "graph.svg",
        "graph.png",
    }


@pytest.mark.slow
def test_a_chart_file_makes_a_ladder(run, tmp_path) -> None:
    path = tmp_path / "house.csv"
    path.write_text("difference_from,difference_to,stronger_needs,weaker_needs\n0,9,5,5\n10,,5,3\n")
    result = run("graph", str(path), "--json", "--out", str(tmp_path / "out"))
    assert (result.exit_code, json.loads(result.stdout)["start"]) == (0, "0")


@pytest.mark.parametrize(
    ("words", "part"),
    [
        ("chess", "one-ball"),
        ("drill", "drill, progressive 8-ball"),
        ("one-ball --p 0.5", "two chances"),
        ("drill 9-ball --p1 0.5 --p2 0.5", "one chance"),
        ("7:5", "--p1 and --p2"),
        ("7:5 --p1 0.5", "give both --p1 and --p2"),
        ("7:5 --p 0.5 --p1 0.5 --p2 0.5", "--p can't be"),
        ("500:500 --p 0.5", "250,000"),
        ("npl_10 --p 0.5", "Leave --p"),
        ("apa_8ball", "'apa_8ball'"),
        ("7:5 --p1 0.6 --p2 0.5", "break"),
        ("rcae to 7 --p 0.6", "did you mean 'race to 7'?"),
        ("drlil 9-ball", "did you mean 'drill 9-ball'?"),
        ("7 --p 0.6", "did you mean 'race to 7'?"),
        ("race 0 --p 0.6", "isn't from 1 to 1000"),
        ("race 1001 --p 0.6", "isn't from 1 to 1000"),
        ("best of 8 --p 0.6", "Give an odd number"),
        ("ahead 3 win by 2 --p 0.6", "Leave one out"),
        ("race 7.5 --p 0.6", "or a match, such as 7:5"),
        ("nlp_10", "did you mean 'npl_10'?"),
        ("one-ball --start-state S2", "--start-state is for a chain in a file"),
        ("one-ball --rows from", "--rows is for a chain in a file"),
        ("mine.json --p 0.5", "Leave --p, --p1 and --p2 out"),
    ],
)
def test_wrong_options_end_with_2_and_write_nothing(run, tmp_path, words, part) -> None:
    out = tmp_path / "out"
    result = run("graph", *words.split(), "--out", str(out))
    assert result.exit_code == 2
    assert part in result.stderr
    assert not out.exists()
