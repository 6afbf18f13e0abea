import pytest


def test_a_throw_of_the_text(ask_physics):
    assert ask_physics("throw", "--cut 30 --mu 0.0556")["throw_factor"] == pytest.approx(0.5)
