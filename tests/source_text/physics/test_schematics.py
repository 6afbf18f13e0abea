"""The arrows of the sketches point where the forces and velocities do."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from matplotlib.patches import FancyArrowPatch

from drawings import figure


def axes_of(name: str) -> Any:
    return figure(name).axes[0]


def arrows(name: str, label: str) -> list[Any]:
    """Return tail and head of the arrows of a name."""
    patches: list[Any] = [
        patch for patch in axes_of(name).patches if isinstance(patch, FancyArrowPatch)
    ]
    return [np.array(patch._posA_posB) for patch in patches if patch.get_label() == label]


def vectors(name: str, label: str) -> list[Any]:
    return [head - tail for tail, head in arrows(name, label)]


def cross(a: Any, b: Any) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def turn(arrow: Any, center: Any) -> float:
    """Return above 0 for an arrow counterclockwise about a center."""
    return cross(arrow[0] - center, arrow[1] - center)


@pytest.mark.slow
def test_friction_turns_two_balls_the_same_way() -> None:
    total, normal, along = (vectors("figure_1_1", f"$F{end}$") for end in ("", "_N", "_T"))
    assert np.array(total) == pytest.approx(np.array(normal) + np.array(along))
    assert sum(along) == pytest.approx(np.zeros(2))
    assert sum(normal) == pytest.approx(np.zeros(2))
    touch, turns = np.array([1.0, 0.0]), arrows("figure_1_1", r"$\dot\omega$")
    for center, force, arrow in zip(((0, 0), (2, 0)), along, turns, strict=True):
        assert cross(touch - center, force) > 0
        assert turn(arrow, center) > 0


def test_the_force_of_the_tip_is_taken_apart_at_right_angles() -> None:
    (force,), (normal,), (along,) = (vectors("figure_1_2", f"$F{end}$") for end in ("", "_N", "_T"))
    assert force == pytest.approx(normal + along)
    assert normal @ along == pytest.approx(0)
    angle = math.atan2(cross(force, along), force @ along)
    # cot(a) = (b/R) / sqrt(1 - (b/R)^2), with b = R/2.
    assert 1 / math.tan(angle) == pytest.approx(0.5 / math.sqrt(0.75))
    assert np.linalg.norm(normal) == pytest.approx(np.linalg.norm(force) * math.sin(angle))


def test_draw_slides_forward_and_is_slowed_by_the_cloth() -> None:
    (speed,), (force,) = vectors("figure_2_1", "$V > 0$"), vectors("figure_2_1", "$F < 0$")
    assert speed[0] > 0 > force[0]
    (arrow,) = arrows("figure_2_1", r"$\omega < 0$")
    assert turn(arrow, (0.0, 1.0)) > 0  # counterclockwise: backspin


def test_velocities_add_up() -> None:
    (before,), (object_ball,) = vectors("figure_4_1", "$V_0$"), vectors("figure_4_1", "$V_b$")
    after, apart = vectors("figure_4_1", "$V_c$")
    assert after == pytest.approx(apart)
    assert before == pytest.approx(object_ball + after)
    assert before == pytest.approx([1, 0], abs=1e-12)


def test_what_friction_gives_the_one_ball_it_takes_from_the_other() -> None:
    (gained,), (lost,) = (vectors("figure_4_2", f"${sign}V_{{by}}$") for sign in "+-")
    assert gained == pytest.approx(-lost)
    (line,), (left,) = vectors("figure_4_2", "$x$"), vectors("figure_4_2", "$y$")
    assert line @ left == pytest.approx(0)
    assert math.atan2(-line[1], line[0]) == pytest.approx(math.pi / 6)
    assert gained @ left > 0
    (before,) = vectors("figure_4_2", "$V_0$")
    # Without friction the object ball goes along the line of centers, the cue ball across it.
    (object_ball,), (cue_ball,) = (vectors("figure_4_2", f"$V_{ball}$") for ball in "bc")
    assert cross(object_ball - gained, line) == pytest.approx(0)
    assert (cue_ball - lost) @ line == pytest.approx(0)
    assert object_ball + cue_ball == pytest.approx(before)
    assert before[1] == 0


def test_each_way_of_slipping_has_its_quadrant() -> None:
    found = vectors("figure_4_3", r"$\hat e$")
    assert [(y > 0, z > 0) for y, z in found] == [
        (True, True),
        (True, False),
        (False, True),
        (False, False),
    ]
    for way in found:
        assert np.linalg.norm(way) == pytest.approx(1)
        # Natural roll in a half-ball cut: cos(gamma) = sin(30 degrees).
        assert abs(way[0]) == pytest.approx(0.5)


def test_the_axis_of_a_thrown_ball_is_tilted_by_seven_halves_of_the_throw() -> None:
    (axis,) = vectors("figure_4_6", r"$\omega$")
    assert axis[1] / axis[0] == pytest.approx(-3.5 * math.sin(math.atan(0.1)))
    (equator,) = [line for line in axes_of("figure_4_6").lines if line.get_linestyle() == "--"]
    low, high = np.array(equator.get_xydata())
    assert (high - low) @ axis == pytest.approx(0)
    assert (low + high) / 2 == pytest.approx([0, 1])
