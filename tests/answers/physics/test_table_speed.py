import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.answers.physics.strike import cloth_class, table_speed_answer
from evenbreak.answers.physics.units import IMPERIAL, METRIC
from evenbreak.physics.units import INCH

ROLL = 97.75 * INCH


def test_the_lag_of_the_text():
    found = table_speed_answer(7.0, ROLL, IMPERIAL).to_dict()
    assert found["table_speed"] == pytest.approx(96.7468031)
    assert found["first_speed_in_s"] == pytest.approx(27.9285714)
    assert found["roll_in"] == pytest.approx(97.75)
    assert found["mu_roll"] == pytest.approx(1 / 96.7468031)
    assert found["cloth"] == "normal"


def test_it_is_the_same_in_metric():
    found = table_speed_answer(7.0, ROLL, METRIC).to_dict()
    assert found["table_speed"] == pytest.approx(96.7468031)
    assert found["first_speed_m_s"] == pytest.approx(27.9285714 * INCH)
    assert found["roll_cm"] == pytest.approx(97.75 * 2.54)


@pytest.mark.parametrize(
    ("speed", "name"),
    [(50, "very slow"), (80, "normal"), (120, "very fast"), (150, "very fast")],
)
def test_classes_include_their_ends(speed, name):
    assert cloth_class(float(speed)) == name


@pytest.mark.parametrize(("seconds", "doubted"), [(7.0, False), (4.0, True), (12.0, True)])
def test_a_speed_that_hardly_any_table_has_is_doubted(seconds, doubted):
    warnings = table_speed_answer(seconds, ROLL, IMPERIAL).warnings
    assert len(warnings) == doubted
    assert all("inches" in warning for warning in warnings)


@given(st.floats(0.1, 1000), st.floats(0.01, 1e3))
def test_lags_of_all_kinds_are_answered(seconds, meters):
    found = table_speed_answer(seconds, meters, METRIC).to_dict()
    assert found["table_speed"] * found["mu_roll"] == pytest.approx(1.0)
    assert found["cloth"]
