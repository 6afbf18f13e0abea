from decimal import Decimal

from evenbreak.source_text.physics.frames import published_physics_frame
from evenbreak.source_text.physics.numbers import physics_findings
from evenbreak.source_text.section5.problems import COLUMNS


def test_one_row_for_each_number():
    frame = published_physics_frame(physics_findings())
    assert list(frame.columns) == list(COLUMNS)
    assert len(frame) == len(physics_findings())


def test_a_row_is_what_is_said_of_a_number():
    frame = published_physics_frame(physics_findings())
    rows = frame[frame["verdict"] == "erratum"].set_index("quantity")
    row = rows.loc["alpha_max, deg"]
    assert (row.printed, row.computed) == (Decimal("28.125"), Decimal("28.1255057"))
    assert (row.difference, row.tolerance) == (Decimal("0.0005057021"), Decimal("0.0005"))
    assert row.verdict == "erratum"


def test_what_is_not_known_is_left_empty():
    rows = published_physics_frame(physics_findings()).set_index("quantity")
    assert rows.loc["lag time, s"].computed is None
    assert rows.loc["lag time, s"].difference is None
    assert rows.loc["full throw, deg"].printed is None
    assert rows.loc["full throw, deg"].difference is None
