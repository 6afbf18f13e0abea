import numpy as np
import pytest

from evenbreak.errors import DataError
from evenbreak.files.arcs import read_arcs


@pytest.fixture
def arcs_file(tmp_path):
    def write(rows):
        path = tmp_path / "arcs.csv"
        path.write_text("source,target,probability\n" + rows, encoding="utf-8")
        return path

    return write


def problems(path):
    with pytest.raises(DataError) as caught:
        read_arcs(path)
    return [line.removeprefix(str(path)) for line in caught.value.problems]


def test_states_come_in_the_order_in_which_they_are_named(arcs_file):
    arcs = read_arcs(arcs_file("b,c,1\nc,a,0.5\nc,b,0.5\nz,z,1\n"))
    assert arcs.states == ["b", "c", "a", "z"]
    assert arcs.sources.tolist() == [0, 1, 1, 3]
    assert arcs.targets.tolist() == [1, 2, 0, 3]
    assert arcs.probabilities.tolist() == [1, 0.5, 0.5, 1]


def test_probabilities_are_read_to_the_last_bit(arcs_file):
    p = 1 / 3
    arcs = read_arcs(arcs_file(f"a,b,{p!r}\na,a,{1 - p!r}\n"))
    assert arcs.probabilities.tolist() == [p, 1 - p]


def test_a_spreadsheet_may_write_a_decimal_comma(tmp_path):
    path = tmp_path / "arcs.csv"
    path.write_text("sep=;\nsource;target;probability\nS;W;0,6\nS;L;,4\nT;S;1,000\n")
    assert read_arcs(path).probabilities.tolist() == [0.6, 0.4, 1.0]
    path.write_text("source,target,probability\nS,W,0,6\n")
    assert problems(path)[0].startswith(":2: has 4 cells")


def test_sums_may_miss_1_by_1e_9(arcs_file):
    assert len(read_arcs(arcs_file("a,b,0.5\na,a,0.5000000009\n")).states) == 2
    assert "sum to 1.000000002, not 1" in problems(arcs_file("a,b,0.5\na,a,0.500000002\n"))[0]


def test_all_problems_are_told_at_once_in_the_order_of_lines(arcs_file):
    told = problems(arcs_file("a,b,2\na,b,1\n,c,x\nd,,1\n"))
    assert [line.split(":")[1] for line in told] == ["2", "3", "4", "4", "5"]


def test_sums_are_told_only_where_all_numbers_are_known(arcs_file):
    assert len(problems(arcs_file("a,b,0.5\na,c,oops\nd,e,0.25\n"))) == 1
    assert len(problems(arcs_file("a,b,0.5\na,c\nd,e,0.25\n"))) == 1


def test_many_rows(arcs_file):
    n = 20_000
    arcs = read_arcs(arcs_file("".join(f"{k},{k + 1},1\n" for k in range(n))))
    assert np.array_equal(arcs.targets - arcs.sources, np.ones(n))
    assert arcs.states == [str(k) for k in range(n + 1)]
