import pytest


def test_without_a_speed_of_the_cue_there_are_only_ratios(ask_physics):
    answer = ask_physics("strike", "--offset -0.3")
    assert answer["ball_speed_ratio"] > 1.0
    assert answer["ball_speed_in_s"] is answer["stun_in"] is answer["later_offset"] is None


def test_distance_and_speed_are_in_the_units_of_the_command(ask_physics):
    inches = ask_physics("strike", "--offset -0.3 --stick-speed 60 --distance 24")
    metric = ask_physics("strike", "--offset -0.3 --stick-speed 1.524 --distance 60.96 --metric")
    for name in ("later_spin_speed_ratio", "later_offset", "stun_offset"):
        assert metric[name] == pytest.approx(inches[name])
    assert metric["slide_cm"] == pytest.approx(2.54 * inches["slide_in"])
