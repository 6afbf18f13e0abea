import pytest


def test_the_table_and_the_ball_are_those_that_were_typed(ask_physics):
    nine_feet = ask_physics("speed", "--lag-time 7.0")
    assert nine_feet["roll_in"] == pytest.approx(97.75)
    answer = ask_physics("speed", "--lag-time 5 --table-length 88 --ball-diameter 2.125")
    assert answer["roll_in"] == pytest.approx(85.875)
    assert answer["table_speed"] == pytest.approx(386 * 25 / 2 / 85.875)


def test_in_metric(ask_physics):
    line = "--lag-time 7 --table-length 254 --ball-diameter 5.715 --metric"
    assert ask_physics("speed", line)["roll_cm"] == pytest.approx(97.75 * 2.54)
