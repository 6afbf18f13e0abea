import pytest


def test_weights_are_in_the_units_of_the_command(ask_physics):
    ounces = ask_physics("breakcue", "--forearm 36 --stick 19 --ball 6")
    grams = ask_physics(
        "breakcue", "--forearm 1020.5828 --stick 538.6409 --ball 170.09714 --metric"
    )
    assert grams["optimal_cue_oz"] == pytest.approx(ounces["optimal_cue_oz"], rel=1e-6)
    assert grams["stick_speed_share"] == pytest.approx(ounces["stick_speed_share"], rel=1e-6)
