import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.answers.physics.strike import break_cue_answer
from evenbreak.answers.physics.units import IMPERIAL, METRIC
from evenbreak.physics.units import OUNCE


def best(arm, stick=None, *, ball=6.0, weight=IMPERIAL.mass):
    size = weight.size
    stick = None if stick is None else stick * size
    return break_cue_answer(arm * size, ball * size, weight, stick).to_dict()


@pytest.mark.parametrize(
    ("arm", "ounces"), [(0, 6.0), (24, 13.2), (36, 15.4), (64, 19.3), (150, 27.7)]
)
def test_the_best_cue_of_the_text(arm, ounces):
    assert best(arm)["optimal_cue_oz"] == pytest.approx(ounces, abs=0.05)


def test_another_cue_breaks_slower():
    found = best(36.0)
    assert found["stick_energy_share"] is found["stick_speed_share"] is None
    heavier = best(36.0, 18.0)
    assert heavier["stick_energy_share"] == pytest.approx(0.45)
    assert heavier["stick_speed_share"] == pytest.approx(math.sqrt(0.45 / found["energy_share"]))
    assert best(36.0, found["optimal_cue_oz"])["stick_speed_share"] == pytest.approx(1.0)
    for ounces in (found["optimal_cue_oz"] - 0.5, found["optimal_cue_oz"] + 0.5):
        assert best(36.0, ounces)["stick_speed_share"] < 1.0


def test_the_best_cue_in_grams_and_still_in_ounces():
    found = best(1020.58, ball=170.097, weight=METRIC.mass)
    assert found["optimal_cue_g"] == pytest.approx(1000 * OUNCE * found["optimal_cue_oz"])
    assert found["optimal_cue_oz"] == pytest.approx(15.369, abs=1e-3)
    assert "optimal_cue_g" not in best(36.0)


weights = st.floats(0.01, 1e5)


@pytest.mark.slow
@given(st.floats(0, 1e6), weights, weights)
def test_no_cue_breaks_better_than_the_best(arm, ball, stick):
    found = best(arm, stick, ball=ball)
    assert found["stick_speed_share"] <= 1.0 + 1e-12
    assert 0.0 < found["energy_share"] <= 1.0 + 1e-12
