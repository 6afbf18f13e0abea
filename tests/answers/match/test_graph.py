import csv
import io
import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.io import mmread

from evenbreak.answers.faces.to_csv import table_lines
from evenbreak.answers.match.chain import road_of
from evenbreak.answers.match.graph import (
    arcs_table,
    classes_table,
    eigenvector_table,
    graph_answer,
    limit_table,
    states_table,
)
from evenbreak.files.chain_files import matrix_market_bytes
from evenbreak.games import CATALOG, Ahead, Rack
from evenbreak.handicaps import CHARTS, Ladder, chart
from rows import each_of


class RoundTable:
    """Three players who pass the cue on, one way round more often than the other."""

    start = 2

    def moves(self, state):
        return {(state + 1) % 3: 0.75, (state - 1) % 3: 0.25}

    def winner(self, state):  # noqa: ARG002
        return None


class Rounded:
    """A state with many ways out, whose chances miss 1 by what rounding left, and a rare wait."""

    start = 0

    def moves(self, state):
        return {} if state else {0: 1e-19, **dict.fromkeys(range(1, 50), (1 + 2e-14) / 49)}

    def winner(self, state):
        return 1 if state else None


WRITTEN = {**CATALOG, **{name: Ladder(chart(name)) for name in CHARTS}, "rounded": Rounded()}


@pytest.mark.slow
@each_of("name", WRITTEN)
def test_written_chances_out_of_a_state_add_up_to_1(name):
    road = road_of(WRITTEN[name])
    rows = csv.DictReader(io.StringIO("".join(table_lines(arcs_table(road)))))
    chances = {}
    for row in rows:
        chances.setdefault(row["source"], []).append(row["probability"])
    for out in chances.values():
        assert math.fsum(map(float, out)) == 1.0
        assert abs(sum(map(Fraction, out)) - 1) < 2**-52
    matrix = mmread(io.BytesIO(matrix_market_bytes(road.chain)), spmatrix=False).tocsc()
    for start, end in zip(matrix.indptr, matrix.indptr[1:], strict=False):
        assert math.fsum(matrix.data[start:end]) == 1.0


def test_complex_eigenvectors_have_an_imaginary_part_beside_each():
    road = road_of(RoundTable())
    frame = eigenvector_table(road).to_frame().set_index("state")
    right, left = (
        np.array([frame[f"{side}_{k}"] + 1j * frame[f"{side}_{k}_imaginary"] for k in (1, 2, 3)])
        for side in ("right", "left")
    )
    np.testing.assert_allclose(left @ right.T, np.eye(3), atol=1e-14)
    assert "some of them are complex" in str(graph_answer("A round table", road))


def test_arcs_begin_at_the_start():
    assert arcs_table(road_of(RoundTable())).rows[0][0] == "2"


def test_tables_are_about_the_same_states_and_classes():
    road = road_of(Ahead(3, 2, Rack(0.6)))
    states = states_table(road).to_frame()
    assert states["state"].tolist() == limit_table(road).to_frame()["state"].tolist()
    classes = classes_table(road).to_frame().set_index("class")
    assert (states.groupby("class").size() == classes["states"]).all()
    np.testing.assert_allclose(states.groupby("class")["limit"].sum(), classes["limit"], atol=1e-15)
    assert states.loc[states["winner"] == 1, "class_kind"].tolist() == ["absorbing"]


@pytest.mark.parametrize(
    ("levels", "words"),
    [(1, "The only eigenvalue is 1."), (2, "Both eigenvalues were"), (3, "All 3 eigenvalues were")],
)
def test_eigenvalues_are_counted_in_plain_words(levels, words):
    class Cycle:
        start = 0

        def moves(self, state):
            return {(state + 1) % levels: 1}

        def winner(self, state):  # noqa: ARG002
            return None

    text = str(graph_answer("A cycle", road_of(Cycle())))
    assert words in " ".join(text.split())


def test_a_ladder_that_goes_back_and_forth_for_ages_says_how_fast_it_settles():
    text = str(graph_answer("A ladder", road_of(Ladder(chart("npl_10")))))
    assert "falls by 2.2% with each step (the gap is 0.02168)" in " ".join(text.split())
    assert "as if its period were 2" in " ".join(text.split())
