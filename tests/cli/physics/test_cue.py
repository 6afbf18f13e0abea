"""The commands without an object ball: speed, strike and breakcue."""

import math

import pytest

from evenbreak.cli.physics.speed import _doubt, cloth_class
from evenbreak.cli.physics.units import PLAYERS
from evenbreak.physics import Ball, Cloth, Slide
from evenbreak.physics.units import INCH


def test_the_lag_of_the_text(ask_physics):
    told = ask_physics("speed", "--lag-time 7.0")
    assert told["table_speed"] == pytest.approx(96.7468031)
    assert told["first_speed_in_s"] == pytest.approx(27.9285714)
    assert told["roll_in"] == pytest.approx(97.75)
    assert told["mu_roll"] == pytest.approx(1 / 96.7468031)
    assert told["cloth"] == "normal"


def test_a_smaller_table_and_another_ball(ask_physics):
    told = ask_physics("speed", "--lag-time 5 --table-length 88 --ball-diameter 2.125")
    assert told["roll_in"] == pytest.approx(85.875)
    assert told["table_speed"] == pytest.approx(386 * 25 / 2 / 85.875)


def test_speed_is_the_same_in_metric(ask_physics):
    told = ask_physics("speed", "--lag-time 7 --table-length 254 --ball-diameter 5.715 --metric")
    assert told["table_speed"] == pytest.approx(96.7468031)
    assert told["first_speed_m_s"] == pytest.approx(27.9285714 * 0.0254)
    assert told["roll_cm"] == pytest.approx(97.75 * 2.54)


@pytest.mark.parametrize(
    ("speed", "name"),
    [(50, "very slow"), (80, "normal"), (120, "very fast"), (150, "very fast")],
)
def test_classes_hold_their_ends(speed, name):
    assert cloth_class(float(speed)) == name


@pytest.mark.parametrize(
    ("speed", "words"),
    [(97.0, ""), (40.0, ""), (255.0, "lengths are inches."), (37.0, "lengths are inches.")],
)
def test_a_speed_that_hardly_any_table_has_is_doubted(speed, words):
    assert _doubt(speed, PLAYERS).endswith(words)
    assert bool(_doubt(speed, PLAYERS)) == bool(words)


def test_struck_into_natural_roll(ask_physics):
    told = ask_physics("strike", "--offset 0.4")
    assert told["spin_speed_ratio"] == pytest.approx(1.0)
    assert told["roll_speed_ratio"] == told["ball_speed_ratio"]
    assert told["ball_speed_ratio"] == pytest.approx(2 / (1 + 1 / 3 + 2.5 * 0.16))
    assert told["ball_speed_in_s"] is told["slide_in"] is told["stun_in"] is None


def test_a_hit_in_the_centre_at_a_speed(ask_physics):
    told = ask_physics("strike", "--offset 0 --stick-speed 40")
    assert told["ball_speed_in_s"] == pytest.approx(60.0)
    assert told["stick_speed_after_in_s"] == pytest.approx(20.0)
    assert told["roll_speed_in_s"] == pytest.approx(60 * 5 / 7)
    assert told["stun_in"] is None
    assert ask_physics("strike", "--offset 0 --stick 19")["ball_speed_ratio"] == pytest.approx(1.52)
    metric = ask_physics("strike", "--offset 0 --stick-speed 1 --ball 170 --stick 510 --metric")
    assert metric["ball_speed_m_s"] == pytest.approx(1.5)


def test_right_of_the_centre_is_right_english(ask_physics):
    told = ask_physics("strike", "--offset -0.2 --side-offset 0.3")
    assert told["side_spin_speed_ratio"] == pytest.approx(0.75)
    assert told["roll_side_spin_speed_ratio"] == pytest.approx(3.5 * 0.3 / 0.8)
    assert told["off_centre"] == pytest.approx(math.hypot(0.2, 0.3))


def test_a_miscue_tells_no_spin(ask_physics):
    told = ask_physics("strike", "--offset 0.45 --side-offset 0.3 --stick-speed 60")
    assert told["miscue"] is True
    assert told["miscue_offset"] == pytest.approx(0.5)
    assert told["spin_speed_ratio"] is told["ball_speed_ratio"] is told["ball_speed_in_s"] is None
    held = ask_physics("strike", "--offset 0.45 --side-offset 0.3 --tip-mu 0.8")
    assert held["miscue"] is False
    assert held["spin_speed_ratio"] == pytest.approx(1.125)


@pytest.mark.parametrize("offset", [-0.3, -0.1, 0.1, 0.45])
@pytest.mark.parametrize("inches", [0.0, 5.0, 15.0, 200.0])
def test_the_spin_after_a_distance_is_that_of_the_slide(ask_physics, offset, inches):
    told = ask_physics("strike", f"--offset {offset} --stick-speed 50 --distance {inches}")
    speed = told["ball_speed_in_s"] * INCH
    ball = Ball()
    slide = Slide(
        ball,
        Cloth(),
        [0.0, 0.0],
        [speed, 0.0],
        [0.0, told["spin_speed_ratio"] * speed / ball.radius, 0.0],
    )
    assert slide.at(slide.slide_time)[0] / INCH == pytest.approx(told["slide_in"])
    low, high = 0.0, float(slide.slide_time)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if slide.at(middle)[0] < inches * INCH else (low, middle)
    rim = ball.radius * slide.spin_at(high)[1]
    assert told["later_spin_speed_ratio"] == pytest.approx(
        rim / slide.velocity_at(high)[0], abs=1e-9
    )
    assert told["later_offset"] == pytest.approx(told["later_spin_speed_ratio"] / 2.5)


def test_draw_is_gone_at_the_stun_distance(ask_physics):
    line = "--offset -0.3 --stick-speed 60"
    told = ask_physics("strike", line)
    there = ask_physics("strike", f"{line} --distance {told['stun_in']!r}")
    assert there["later_spin_speed_ratio"] == pytest.approx(0.0, abs=1e-12)
    assert there["stun_offset"] == pytest.approx(-0.3)
    assert ask_physics("strike", f"{line} --distance 900")["stun_offset"] is None


def test_the_best_cue_of_the_text(ask_physics):
    for arm, ounces in ((0, 6.0), (24, 13.2), (36, 15.4), (64, 19.3), (150, 27.7)):
        assert ask_physics("breakcue", f"--forearm {arm}")["optimal_cue_oz"] == pytest.approx(
            ounces, abs=0.05
        )


def test_another_cue_breaks_slower(ask_physics):
    best = ask_physics("breakcue", "--forearm 36")
    assert best["stick_energy_share"] is best["stick_speed_share"] is None
    told = ask_physics("breakcue", "--forearm 36 --stick 18")
    assert told["stick_energy_share"] == pytest.approx(0.45)
    assert told["stick_speed_share"] == pytest.approx(math.sqrt(0.45 / told["energy_share"]))
    same = ask_physics("breakcue", f"--forearm 36 --stick {best['optimal_cue_oz']!r}")
    assert same["stick_speed_share"] == pytest.approx(1.0)
    for ounces in (best["optimal_cue_oz"] - 0.5, best["optimal_cue_oz"] + 0.5):
        assert ask_physics("breakcue", f"--forearm 36 --stick {ounces}")["stick_speed_share"] < 1.0


def test_the_best_cue_in_grams_and_still_in_ounces(ask_physics):
    told = ask_physics("breakcue", "--forearm 1020.58 --ball 170.097 --metric")
    assert told["optimal_cue_g"] == pytest.approx(28.349523125 * told["optimal_cue_oz"])
    assert told["optimal_cue_oz"] == pytest.approx(15.369, abs=1e-3)
