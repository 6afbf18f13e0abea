import math

import numpy as np
import pytest

from evenbreak.source_text.reproduce import physics_tables

SIN, COS = 0.5, math.sqrt(0.75)


@pytest.fixture(scope="module")
def tables():
    return physics_tables()


def test_lags(tables):
    (row,) = [row for row in tables["figure_3_4"] if row["offset"] == 0]
    speeds = [float(cell) for name, cell in row.items() if name != "offset"]
    assert speeds == pytest.approx([5 / 7, 20 / 21, 15 / 14, 8 / 7], abs=1e-6)


def test_lines_of_equal_sidespin_end_on_the_outline_of_the_ball(tables):
    for row in tables["figure_3_1"]:
        y, z = float(row["y_to"]), float(row["z_to"])
        assert math.hypot(y, z - 1.0) == pytest.approx(1.0, abs=2e-6)


def test_a_stun_shot_has_no_throw_factor_where_it_steps(tables):
    rows = {float(row["sidespin"]): row for row in tables["figure_4_4"]}
    assert [side for side, row in rows.items() if row["topspin_0"] is None] == [-0.5]
    assert float(rows[0.0]["topspin_1"]) == 0.5


def test_sensitivities_are_the_length_of_the_gradient(tables):
    for row in tables["figure_4_5"]:
        u, w = SIN + float(row["sidespin"]), COS * float(row["topspin"])
        by_topspin, by_side = (part / (u**2 + w**2) ** 1.5 for part in (-u * w * COS, w**2))
        assert float(row["sensitivity"]) == pytest.approx(np.hypot(by_topspin, by_side), abs=1e-6)


def test_the_points_of_the_tip_line_lie_on_a_line(tables):
    *line, touched = tables["figure_4_8"]
    assert [float(point["y"]) for point in line] == pytest.approx(
        [float(point["z"]) / 7 for point in line], abs=1e-6
    )
    assert (float(touched["y"]), float(touched["z"])) == (-0.5, 1.0)


def test_deflections_and_marked_points_agree(tables):
    by_cut = {int(row["cut_degrees"]): row for row in tables["figure_4_7"]}
    (half_ball,) = [row for row in tables["figure_4_7_points"] if row["point"] == "D"]
    assert half_ball["deflection_degrees"] == by_cut[30]["natural_roll_degrees"]
    assert half_ball["slope"] == by_cut[30]["natural_roll_slope"]
