import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.answers.physics.shot import shot_answer
from evenbreak.answers.physics.units import IMPERIAL, METRIC
from evenbreak.physics import PoolTable, pocketed_shot, pockets, shot, strike_for_speed
from evenbreak.physics.units import INCH
from tiers import examples

POCKETS = {pocket.name: pocket for pocket in pockets(PoolTable())}


def struck(speed, up=0.0, right=0.0):
    return strike_for_speed(speed * INCH, up, right)


def by_angle(cut=30, distance=24, speed=60, up=-0.3, right=0.0, units=IMPERIAL, **kit):
    found = shot(struck(speed, up, right), math.radians(cut), distance * INCH, **kit)
    return shot_answer(found, units).to_dict()


def at_pocket(cue, standing, name, speed=60):
    places = [[x * INCH, y * INCH] for x, y in (cue, standing)]
    found = pocketed_shot(struck(speed), *places, POCKETS[name])
    return shot_answer(found, IMPERIAL, POCKETS[name]).to_dict()


def test_it_answers_what_the_library_finds():
    answer = by_angle()
    found = shot(struck(60, -0.3), math.radians(30), 24 * INCH)
    assert answer["deflection_thrown_deg"] == pytest.approx(math.degrees(found.deflection))
    assert answer["throw_deg"] == pytest.approx(math.degrees(found.throw))
    assert answer["hit_s"] == found.approach.end
    x, y = found.cue_leg.path()[-1, :2] / INCH
    assert (answer["cue_end_x_in"], answer["cue_end_y_in"]) == (pytest.approx(x), pytest.approx(y))
    assert (answer["cue_end"], answer["object_end"], answer["reached"]) == ("rest", "rest", True)
    motions = [(phase["ball"], phase["motion"]) for phase in answer["phases"]]
    assert motions[0] == ("cue ball", "slides")
    assert motions[-1] == ("object ball", "rolls")
    assert answer["phases"][0]["begin_energy_j"] == pytest.approx(found.strike.energy.total)
    assert answer["aim_offset_in"] is None


@pytest.mark.parametrize("offset", [-0.4, 0.0, 0.4])
def test_the_energy_of_the_phases_and_of_the_hit_adds_up(offset):
    answer = by_angle(cut=20, distance=20, speed=80, up=offset, right=0.2, mu=0.2)
    before = [row for row in answer["phases"] if row["end_s"] == answer["hit_s"]]
    after = [row for row in answer["phases"] if row["begin_s"] == answer["hit_s"]]
    assert (len(before), len(after)) == (1, 2)
    left = sum(row["begin_energy_j"] for row in after)
    lost = answer["energy_lost_at_hit_j"]
    assert lost > 0.0
    assert before[0]["end_energy_j"] == pytest.approx(left + lost)


def test_units_change_the_names_and_not_the_shot():
    inches, metric = by_angle(), by_angle(units=METRIC)
    assert metric["cue_end_x_cm"] == pytest.approx(2.54 * inches["cue_end_x_in"])
    assert metric["hit_speed_m_s"] == pytest.approx(0.0254 * inches["hit_speed_in_s"])
    assert metric["phases"][0]["length_cm"] == pytest.approx(
        2.54 * inches["phases"][0]["length_in"]
    )
    assert metric["deflection_deg"] == inches["deflection_deg"]


def test_a_cut_to_the_left_is_the_mirror_image():
    right, left = by_angle(right=0.1), by_angle(cut=-30, right=-0.1)
    same = ("throw_deg", "deflection_deg", "deflection_thrown_deg", "cue_roll_in", "object_end_s")
    for key in same:
        assert left[key] == pytest.approx(right[key])
    for key in ("cut_deg", "object_cut_deg", "side_spin_speed_ratio"):
        assert left[key] == pytest.approx(-right[key])
    assert left["cue_end_y_in"] - 25.0 == pytest.approx(25.0 - right["cue_end_y_in"])


def test_aimed_at_a_pocket_the_ball_drops():
    answer = at_pocket((25, 16), (50, 25), "foot-left")
    assert (answer["object_end"], answer["object_pocket"]) == ("pocket", "foot-left")
    # A cut to the left is thrown to the right, so aim to the left.
    assert answer["cut_deg"] < 0.0
    assert answer["aim_offset_in"] < 0.0 < answer["miss_in"]
    mirror = at_pocket((25, 34), (50, 25), "foot-right")
    assert mirror["aim_offset_in"] == pytest.approx(-answer["aim_offset_in"])
    assert mirror["direction_deg"] == pytest.approx(-answer["direction_deg"])


def test_a_straight_shot_has_no_angles_that_rounding_made():
    backwards = at_pocket((60, 5), (30, 25), "head-left")
    assert -180.0 <= backwards["direction_deg"] <= 180.0
    answer = at_pocket((20, 1.125), (50, 1.125), "foot-right")
    for key in ("cut_deg", "throw_deg", "object_cut_deg", "aim_turn_deg", "direction_deg"):
        assert answer[key] == 0.0
    assert (answer["target_y_in"], answer["object_pocket"]) == (pytest.approx(1.125), "foot-right")


@pytest.mark.slow
@settings(max_examples=examples(20))
@given(
    st.floats(-89.0, 89.0),
    st.floats(2.3, 20.0),
    st.floats(0.0, 1000.0),
    st.floats(-0.35, 0.35),
    st.floats(-0.35, 0.35),
    st.floats(0.0, 1.0),
    st.sampled_from(["limited", "shepard"]),
)
def test_shots_of_all_kinds_are_answered(cut, distance, speed, up, right, mu, law):
    answer = by_angle(cut, distance, speed, up, right, mu=mu, friction=law)
    numbers = [value for value in answer.values() if isinstance(value, float)]
    assert all(map(math.isfinite, numbers))
    for name in ("approach", "cue", "object"):
        x, y = answer[f"{name}_end_x_in"], answer[f"{name}_end_y_in"]
        assert (x is None) == (not answer["reached"] and name != "approach")
        assert x is None or (1.1 < x < 98.9 and 1.1 < y < 48.9)
