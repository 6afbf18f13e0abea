import pytest


def test_the_distance_is_in_the_units_of_the_command(ask_physics):
    inches = ask_physics("aim", "--cut 20 --distance 36")
    metric = ask_physics("aim", f"--cut 20 --distance {36 * 2.54!r} --metric")
    assert metric["offset_cm"] == pytest.approx(2.54 * inches["offset_in"])
