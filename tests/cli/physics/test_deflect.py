import pytest


def test_a_deflection_of_the_text(ask_physics):
    assert ask_physics("deflect", "--cut 30")["deflection_deg"] == pytest.approx(33.67, abs=0.005)
