import numpy as np

from evenbreak.answers.graph import (
    arcs_table,
    classes_table,
    eigenvector_table,
    graph_answer,
    limit_table,
    states_table,
)
from evenbreak.answers.road import road_of
from evenbreak.games import Ahead, Rack


class RoundTable:
    """Three players who pass the cue on, one way round more often than the other."""

    start = 2

    def moves(self, state):
        return {(state + 1) % 3: 0.75, (state - 1) % 3: 0.25}

    def winner(self, state):  # noqa: ARG002
        return None


def test_complex_eigenvectors_have_an_imaginary_part_beside_each():
    road = road_of(RoundTable())
    frame = eigenvector_table(road).to_frame().set_index("state")
    right, left = (
        np.array([frame[f"{side}_{k}"] + 1j * frame[f"{side}_{k}_imaginary"] for k in (1, 2, 3)])
        for side in ("right", "left")
    )
    np.testing.assert_allclose(left @ right.T, np.eye(3), atol=1e-14)
    assert "some of them complex" in str(graph_answer("A round table", road))


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
