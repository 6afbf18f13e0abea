import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.answers.physics.hit import Hit, aim_answer, aim_words, throw_answer
from evenbreak.answers.physics.shot import shot_answer
from evenbreak.answers.physics.units import IMPERIAL, METRIC
from evenbreak.errors import InputError
from evenbreak.physics import SlipFriction, shot, strike_for_speed
from evenbreak.physics.units import INCH
from evenbreak.questions.english import english_in
from evenbreak.questions.physics import Aim

INCHES = IMPERIAL.length
MU = 4 / 72


def hit(cut, topspin=1.0, side=0.0, mu=MU):
    return Hit(cut, topspin, side, mu, "limited")


def aim(cut, topspin=1.0, side=0.0, mu=MU, units=IMPERIAL, inches=36.0):
    return aim_answer(hit(cut, topspin, side, mu), inches * INCH, units).to_dict()


def test_the_example_of_the_text():
    cut = math.degrees(math.asin(0.25))
    found = aim(cut)
    assert found["rule_offset_in"] == pytest.approx(0.5)
    assert found["offset_in"] == pytest.approx(0.528, abs=5e-4)
    assert found["aim_cut_deg"] - found["throw_deg"] == pytest.approx(cut)
    left = aim(-cut)
    for key in ("offset_in", "rule_offset_in", "aim_cut_deg"):
        assert left[key] == pytest.approx(-found[key])


@pytest.mark.parametrize(("topspin", "side"), [(0.0, 0.0), (1.0, 0.5), (-0.4, -0.8)])
def test_a_ball_aimed_so_goes_where_it_should(topspin, side):
    found = aim(20.0, topspin, side)
    thrown = throw_answer(hit(found["aim_cut_deg"], topspin, side), IMPERIAL).to_dict()
    assert thrown["object_cut_deg"] == pytest.approx(20.0)
    assert found["offset_in"] == pytest.approx(
        36 * math.tan(math.radians(found["aim_cut_deg"] - 20)), rel=1e-9
    )


def test_in_centimeters():
    inches, metric = aim(20.0), aim(20.0, units=METRIC)
    assert metric["offset_cm"] == pytest.approx(2.54 * inches["offset_in"])
    assert metric["distance_cm"] == pytest.approx(36 * 2.54)
    assert metric["aim_cut_deg"] == inches["aim_cut_deg"]
    assert "offset_in" not in metric


def test_a_cut_too_thin_for_throw_is_refused():
    with pytest.raises(InputError, match="cut"):
        aim(89.5)


@pytest.mark.parametrize(
    ("inches", "cut", "how", "words"),
    [
        (0.5, 0.2, hit(14.0), ("0.50 inches to the right", "thinner")),
        (-0.5, 0.2, hit(-14.0), ("to the left", "thinner")),
        (-0.5, 0.2, hit(14.0), ("to the left", "fuller")),
        (-0.5, 0.2, hit(0.0), ("to the left of the middle of the pocket;",)),
        (-2.0, -0.04, hit(1.0), ("a cut to the left",)),
        (0.001, 0.2, hit(14.0), ("less than 0.01 inches",)),
    ],
)
def test_the_advice_names_the_side(inches, cut, how, words):
    advice = aim_words(inches * INCH, cut, how, INCHES)
    assert all(word in advice for word in words)


spins = st.floats(-100, 100)


@pytest.mark.slow
@given(st.floats(0, 85), spins, spins, st.floats(0, 0.05), st.floats(0.1, 1e5))
def test_aims_of_all_kinds_go_where_they_should(cut, topspin, side, mu, inches):
    found = aim(cut, topspin, side, mu, inches=inches)
    assert found["aim_cut_deg"] - found["throw_deg"] == pytest.approx(cut, abs=1e-6)


def test_a_hard_shot_needs_less_allowance():
    soft, hard = (
        aim_answer(
            Hit(30.0, 0.0, 0.0, SlipFriction(), "limited", speed), 36 * INCH, METRIC
        ).to_dict()
        for speed in (1.0, 4.0)
    )
    assert soft["offset_cm"] > hard["offset_cm"] > 0.0
    # The friction is that of the cut to aim for.
    cut = math.radians(hard["aim_cut_deg"])
    assert hard["mu"] == pytest.approx(SlipFriction().at(4.0 * math.sin(cut)))
    assert (hard["mu_by_speed"], hard["hit_speed_m_s"]) == (True, 4.0)


def test_english_brings_what_is_left_out_into_every_answer_about_a_line():
    for side in (-0.3, 0.0, 0.3):
        answers = [
            aim_answer(hit(14.5, side=side), 0.9, METRIC, squirt=0.0),
            shot_answer(shot(strike_for_speed(1.1, 0.0, side), 0.5, 0.5), METRIC),
        ]
        for answer in answers:
            words = " ".join(answer.sentences)
            assert ("Squirt and swerve are left out" in words) == bool(side)


@pytest.mark.parametrize(
    ("side", "most", "words"),
    [
        (-1.25, 2.5, "2.50 degrees to the left of the line"),
        (0.625, 1.8, "0.90 degrees to the right of the line"),
        (3.0, 2.5, "2.50 degrees to the right of the line"),
    ],
)
def test_the_cue_points_to_the_side_of_the_english(side, most, words):
    answer = aim_answer(hit(30.0, side=side), 0.9, IMPERIAL, squirt=most)
    assert words in answer.sentences[0]
    assert ("right" if side < 0 else "left") in answer.sentences[0].split("squirts")[1]
    assert "Swerve is left out" in answer.sentences[1]
    per_foot = 12 * math.tan(math.radians(abs(answer.to_dict()["squirt_deg"])))
    assert f"{per_foot:.2f} inches a foot" in answer.sentences[0]


def test_gearing_english_at_a_half_ball_hit_is_two_fifths_outside():
    """Alciatore's rule: at 30 degrees 40 % outside english takes all throw away."""
    size, way = english_in("40% outside")
    found = aim(30.0, side=-size)
    assert way == "outside"
    assert found["throw_deg"] == pytest.approx(0.0, abs=1e-9)
    assert found["english"] == "outside"


@pytest.mark.parametrize(
    ("text", "cut", "side"),
    [
        ("1 tip right", 30, 1.25 / 1.4),
        ("1 tip inside", 30, 1.25 / 1.4),
        ("1 tip inside", -30, -1.25 / 1.4),
        ("one tip of outside english", 30, -1.25 / 1.4),
        ("Half a tip left", 30, -0.625 / 1.4),
        ("1/2 tip outside", -30, 0.625 / 1.4),
        ("100% left", 0, -1.25),
        ("1,4 tips right", 0, 1.25),
        ("1 tip of inside", 30, 1.25 / 1.4),
        ("1 tip of left-hand english", 30, -1.25 / 1.4),
        ("50 percent right-handed side", 0, 0.625),
        ("a half-tip of left english", 0, -0.625 / 1.4),
        ("outside, a quarter of a tip", 30, -0.3125 / 1.4),
        ("1 tip to the right", 0, 1.25 / 1.4),
    ],
)
def test_english_is_read_as_players_say_it(text, cut, side):
    asked = Aim(cut=cut, distance=36, english=english_in(text))
    assert asked.sidespin == pytest.approx(side)


@pytest.mark.parametrize(
    "text",
    ["", "1", "1 tip", "1/0 tip left", "-1 tip left", "half a % left", "1 tip left right"],
)
def test_what_is_no_english_is_refused(text):
    with pytest.raises(InputError):
        english_in(text)


@pytest.mark.parametrize(("cut", "more"), [(0, {}), (30, {"side": 0.5})])
def test_english_that_cannot_be_told_is_refused(cut, more):
    with pytest.raises(InputError):
        Aim(cut=cut, distance=36, english=english_in("1 tip inside"), **more).check()
