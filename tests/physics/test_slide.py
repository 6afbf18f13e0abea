"""Slide and roll: against the equations of motion, and against their own laws."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from evenbreak.errors import InputError
from evenbreak.physics import (
    Ball,
    Cloth,
    Slide,
    drag_distance,
    parabola,
    roll_speed,
    roll_velocity,
    sliding_ball_speed,
    stun_distance,
)

BALL, CLOTH = Ball(), Cloth()
speeds = st.floats(-5.0, 5.0)
turns = st.floats(-200.0, 200.0)
slides = st.builds(
    lambda *x: Slide(BALL, CLOTH, [x[0], x[1]], [x[2], x[3]], [x[4], x[5], x[6]]),
    *(speeds, speeds, speeds, speeds, turns, turns, turns),
)


def motion(_: float, state: Any) -> list[float]:
    """Newton's and Euler's equations: the cloth pulls against the slip, at the lowest point."""
    velocity, spin = state[2:4], state[4:7]
    point = np.array([*velocity, 0.0]) + np.cross(spin, [0.0, 0.0, -BALL.radius])
    force = -CLOTH.mu_slide * BALL.mass * CLOTH.gravity * point / np.linalg.norm(point)
    torque = np.cross([0.0, 0.0, -BALL.radius], force)
    return [*velocity, *(force[:2] / BALL.mass), *(torque / BALL.inertia)]


@pytest.mark.parametrize("seed", range(8))
def test_sliding_solves_the_equations_of_motion(seed: int) -> None:
    rng = np.random.default_rng(seed)
    shot = Slide(BALL, CLOTH, *(rng.normal(size=n) * s for n, s in ((2, 1), (2, 2), (3, 80))))
    times = np.linspace(0.0, 0.99 * shot.slide_time, 7)
    start = [*shot.position, *shot.velocity, *shot.spin]
    solved = solve_ivp(motion, (0.0, times[-1]), start, t_eval=times, rtol=1e-10, atol=1e-12)
    assert shot.at(times) == pytest.approx(solved.y[:2].T, abs=1e-8)
    assert shot.velocity_at(times) == pytest.approx(solved.y[2:4].T, abs=1e-8)
    assert shot.spin_at(times) == pytest.approx(solved.y[4:].T, abs=1e-6)


@given(slides, st.floats(0.0, 1.0))
def test_the_sliding_path_is_the_parabola(shot: Slide, part: float) -> None:
    slip = float(np.hypot(*shot.slip))
    assume(slip > 0.01)
    along = -shot.slip / slip
    across = np.array([along[1], -along[0]])
    start = (float(shot.velocity @ across), float(shot.velocity @ along))
    assume(abs(start[0]) > 0.01)
    moved = shot.at(part * shot.slide_time) - shot.position
    found = parabola(float(moved @ across), start, CLOTH)
    assert found == pytest.approx(float(moved @ along), rel=1e-9, abs=1e-9)


@given(slides)
def test_it_comes_to_natural_roll(shot: Slide) -> None:
    end = shot.slide_time
    x, y, _ = shot.spin_at(end)
    rolling = shot.velocity_at(end)
    assert rolling == pytest.approx(BALL.radius * np.array([y, -x]), abs=1e-10)
    assert rolling == pytest.approx(shot.roll_velocity, abs=1e-10)
    assert shot.roll_velocity == pytest.approx(
        roll_velocity(shot.velocity, BALL.radius * shot.spin), abs=1e-12
    )


@given(slides)
def test_angular_momentum_about_the_cloth_is_kept_while_it_slides(shot: Slide) -> None:
    height = np.array([0.0, 0.0, BALL.radius])

    def about_the_cloth(time: float) -> Any:
        moving = BALL.mass * np.array([*shot.velocity_at(time), 0.0])
        return BALL.inertia * shot.spin_at(time) + np.cross(height, moving)

    start, end = about_the_cloth(0.0), about_the_cloth(shot.slide_time)
    assert end == pytest.approx(start, abs=1e-12)


@given(slides, st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_energy_never_grows(shot: Slide, one: float, two: float) -> None:
    def energy(part: float) -> float:
        velocity = shot.velocity_at(part * shot.stop_time)
        spin = shot.spin_at(part * shot.stop_time)
        return float(velocity @ velocity + 0.4 * BALL.radius**2 * (spin @ spin))

    early, late = sorted((one, two))
    assert energy(late) <= energy(early) + 1e-9


@given(slides)
def test_it_rests_where_and_when_it_should(shot: Slide) -> None:
    assert shot.velocity_at(shot.stop_time) == pytest.approx([0.0, 0.0], abs=1e-12)
    assert shot.at(shot.stop_time + 10.0) == pytest.approx(shot.stop_position, abs=1e-12)
    speed = float(np.hypot(*shot.roll_velocity))
    assert shot.stop_time - shot.slide_time == pytest.approx(
        speed / (CLOTH.mu_roll * CLOTH.gravity), abs=1e-9
    )


@given(slides, st.floats(0.0, 1.2))
def test_mirror_images(shot: Slide, part: float) -> None:
    """In a mirror along x, y turns round, and so do the spins about x and z."""
    time = part * shot.stop_time
    other = Slide(
        BALL,
        CLOTH,
        shot.position * [1, -1],
        shot.velocity * [1, -1],
        shot.spin * [-1, 1, -1],
    )
    assert other.at(time).tolist() == (shot.at(time) * [1, -1]).tolist()
    assert (other.spin_at(time) == shot.spin_at(time) * [-1, 1, -1]).all()


def test_signs() -> None:
    rolling = Slide(BALL, CLOTH, [0.0, 0.0], [1.0, 0.0], [0.0, 1.0 / BALL.radius, 9.0])
    assert rolling.slide_time == pytest.approx(0.0, abs=1e-15)  # J_y = 1 is natural roll
    draw = Slide(BALL, CLOTH, [0.0, 0.0], [1.0, 0.0], [0.0, -5.0 / BALL.radius, 0.0])
    assert draw.roll_velocity[0] < 0.0  # it comes back
    to_the_left = Slide(BALL, CLOTH, [0.0, 0.0], [1.0, 0.0], [-50.0, 35.0, 0.0])
    assert to_the_left.stop_position[1] > 0.0  # spin about -x rolls to +y
    assert draw.spin_at(0.1)[2] == 0.0


@given(st.floats(0.1, 5.0), st.floats(-2.5, 0.0))
def test_stun_and_drag(speed: float, spin: float) -> None:
    shot = Slide(BALL, CLOTH, [0.0, 0.0], [speed, 0.0], [0.0, spin * speed / BALL.radius, 0.0])
    to_stun = stun_distance(speed, spin, CLOTH)
    time = -0.4 * spin * speed / (CLOTH.mu_slide * CLOTH.gravity)
    assert shot.spin_at(time)[1] * BALL.radius == pytest.approx(0.0, abs=1e-12)
    assert shot.at(time)[0] == pytest.approx(to_stun, abs=1e-12)
    to_roll = shot.at(shot.slide_time)[0]
    assert drag_distance(speed, spin, CLOTH) == pytest.approx(to_roll, abs=1e-12)
    assert to_stun <= to_roll + 1e-12
    assert roll_speed(speed, spin * speed) == pytest.approx(shot.roll_velocity[0], abs=1e-12)


@given(st.floats(0.1, 5.0), st.floats(-2.5, 3.0), st.floats(0.0, 1.0))
def test_speed_from_the_speed_of_the_rim(speed: float, spin: float, part: float) -> None:
    shot = Slide(BALL, CLOTH, [0.0, 0.0], [speed, 0.0], [0.0, spin * speed / BALL.radius, 0.0])
    time = part * shot.slide_time
    rim = BALL.radius * shot.spin_at(time)[1]
    found = sliding_ball_speed(speed, spin * speed, rim)
    assert found == pytest.approx(shot.velocity_at(time)[0], abs=1e-12)


def test_arrays_of_balls_are_balls() -> None:
    rng = np.random.default_rng(3)
    many = [rng.normal(size=(4, n)) * s for n, s in ((2, 1.0), (2, 1.0), (3, 50.0))]
    shots = Slide(BALL, CLOTH, *many)
    times = np.linspace(0.0, 5.0, 6)[:, None]
    assert shots.at(times).shape == shots.velocity_at(times).shape == (6, 4, 2)
    assert shots.spin_at(times).shape == (6, 4, 3)
    for i in range(4):
        one = Slide(BALL, CLOTH, *(array[i] for array in many))
        assert type(one.slide_time) is float
        assert one.slide_time == shots.slide_time[i]
        assert one.at(5.0).tolist() == shots.at(times)[5, i].tolist()


@pytest.mark.parametrize("tiny", [0.0, 5e-324, 1e-200])
def test_a_ball_that_hardly_moves_is_no_trouble(tiny: float) -> None:
    shot = Slide(BALL, CLOTH, [0.0, 0.0], [tiny, tiny], [0.0, tiny, -tiny])
    found = [*shot.at(1.0), *shot.velocity_at(1.0), *shot.spin_at(1.0), shot.stop_time]
    assert np.abs(found).max() <= 1e-150
    assert math.isfinite(shot.slide_time)


def test_a_slide_keeps_its_own_numbers() -> None:
    velocity = np.array([1.0, 0.0])
    shot = Slide(BALL, CLOTH, [0.0, 0.0], velocity, [0.0, 0.0, 0.0])
    velocity[0] = 9.0
    assert shot.velocity.tolist() == [1.0, 0.0]


def test_refusals() -> None:
    with pytest.raises(
        InputError, match=r"velocity must have shape \(\.\.\., 2\); its shape is \(3,\)"
    ):
        Slide(BALL, CLOTH, [0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    with pytest.raises(
        InputError, match=r"spin must be numbers from -1e\+50 to 1e\+50; it holds nan"
    ):
        Slide(BALL, CLOTH, [0.0, 0.0], [1.0, 0.0], [0.0, math.nan, 0.0])
    with pytest.raises(InputError, match=r"time must be a number from 0 to 1e\+50; it is -1\.0"):
        Slide(BALL, CLOTH, [0.0, 0.0], [1.0, 0.0], [0.0, 0.0, 0.0]).at(-1.0)
    with pytest.raises(InputError, match="velocity is 0 across the force"):
        parabola(1.0, (0.0, 1.0), CLOTH)
    with pytest.raises(InputError, match=r"spin must be a number from -2\.5 to 0; it is 0\.5"):
        stun_distance(1.0, 0.5, CLOTH)
