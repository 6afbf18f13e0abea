"""The laws of a collision, from the velocities and spins before and after it alone."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.physics import FRICTION_LAWS, Ball, Collision, axis_tilt, collide, throw_angle
from evenbreak.physics.units import INCH

cuts = st.floats(-math.pi / 2.0, math.pi / 2.0)
spins = st.floats(-3.0, 3.0)
speeds = st.floats(0.01, 20.0)
frictions = st.floats(0.0, 1.0)
laws = st.sampled_from(FRICTION_LAWS)
balls = st.builds(Ball, mass=st.floats(0.05, 0.5), radius=st.floats(0.01, 0.1))
shots = st.builds(
    collide, cuts, spins, spins, speed=speeds, mu=frictions, friction=laws, ball=balls
)
limited = st.builds(collide, cuts, spins, spins, speed=speeds, mu=frictions, ball=balls)
level = st.builds(collide, cuts, st.just(0.0), spins, speed=speeds, mu=frictions, friction=laws)


def before(hit: Collision) -> tuple[Any, Any]:
    """The cue ball's velocity and spin before the hit, in the frame of the shot."""
    turning = hit.speed / hit.ball.radius
    return np.array([hit.speed, 0.0, 0.0]), turning * np.array([0.0, hit.topspin, hit.side])


def axes(hit: Collision) -> tuple[Any, Any]:
    """The line of centers, which leads to the side of the cut, and what is at its left."""
    sin, cos = math.sin(hit.cut), math.cos(hit.cut)
    return np.array([cos, -sin, 0.0]), np.array([sin, cos, 0.0])


def hand(hit: Collision) -> float:
    """The sign of the cut: throw forward is to the left of a cut to the right."""
    return -1.0 if hit.cut < 0.0 else 1.0


def energy(ball: Ball, velocity: Any, spin: Any) -> float:
    return 0.5 * ball.mass * float(velocity @ velocity) + 0.5 * ball.inertia * float(spin @ spin)


def lost(hit: Collision) -> float:
    after = energy(hit.ball, hit.cue_velocity, hit.cue_spin)
    after += energy(hit.ball, hit.object_velocity, hit.object_spin)
    return energy(hit.ball, *before(hit)) - after


def scale(hit: Collision) -> float:
    """The size of the energies that `lost` is a difference of."""
    return sum(
        energy(hit.ball, *pair)
        for pair in (
            before(hit),
            (hit.cue_velocity, hit.cue_spin),
            (hit.object_velocity, hit.object_spin),
        )
    )


@given(shots)
def test_level_momentum_is_kept(hit: Collision) -> None:
    after = hit.cue_velocity + hit.object_velocity
    assert after[:2] == pytest.approx([hit.speed, 0.0], abs=1e-12 * (1.0 + hit.speed) * 10.0)
    assert after[2] == pytest.approx(abs(hit.upward), rel=1e-15)


@given(limited)
def test_no_energy_is_made(hit: Collision) -> None:
    assert lost(hit) >= -1e-13 * scale(hit)
    assert hit.energy_lost >= -1e-13 * scale(hit)


def test_the_law_of_the_text_makes_energy_in_stun_shots_below_11_degrees() -> None:
    cut = np.radians([5.0, 10.0, 11.0, 11.1, 21.0])
    assert (collide(cut, 0.0, friction="shepard").energy_lost > 0.0).tolist() == [False] * 3 + [
        True
    ] * 2
    assert (collide(cut, 0.0).energy_lost > 0.0).all()


@given(shots)
def test_the_books_of_energy(hit: Collision) -> None:
    assert hit.energy_lost == pytest.approx(lost(hit), abs=1e-12 * scale(hit))


@given(level)
def test_delta_inelastic_is_the_books_of_level_friction(hit: Collision) -> None:
    tolerance = 1e-12 * scale(hit) / hit.ball.mass
    found = 2.0 * lost(hit) / hit.ball.mass
    assert hit.delta_inelastic == pytest.approx(found, abs=tolerance)


@given(shots)
def test_delta_elastic_is_the_books_of_upright_spin(hit: Collision) -> None:
    spin = [before(hit)[1][2], hit.cue_spin[2], hit.object_spin[2]]
    gained = 0.4 * hit.ball.radius**2 * (spin[1] ** 2 + spin[2] ** 2 - spin[0] ** 2)
    assert hit.delta_elastic == pytest.approx(gained, abs=1e-11 * (1.0 + hit.speed**2) * 10.0)
    parts = hit.delta_elastic + hit.delta_inelastic
    assert hit.delta_total == pytest.approx(parts, abs=1e-11 * (1.0 + hit.speed**2) * 10.0)


@given(shots)
def test_delta_total_is_the_books_of_level_speeds(hit: Collision) -> None:
    level_speeds = [float(np.hypot(*v[:2])) for v in (hit.cue_velocity, hit.object_velocity)]
    found = hit.speed**2 - level_speeds[0] ** 2 - level_speeds[1] ** 2
    assert hit.delta_total == pytest.approx(found, abs=1e-11 * (1.0 + hit.speed**2) * 10.0)


@given(shots)
def test_angular_momentum_about_the_cue_ball(hit: Collision) -> None:
    ball, (x, y) = hit.ball, axes(hit)
    spin = ball.inertia * (hit.cue_spin + hit.object_spin - before(hit)[1])
    orbit = np.cross(2.0 * ball.radius * x, ball.mass * hit.object_velocity)
    change = spin + orbit
    size = ball.mass * ball.radius * hit.speed * 20.0
    assert change == pytest.approx(hit.angular_momentum_change * y, abs=1e-13 * size)
    if hit.topspin <= 0.0:
        assert hit.angular_momentum_change == 0.0


@given(shots)
def test_the_paths_part_at_a_right_angle_less_the_throw(hit: Collision) -> None:
    one, two = hit.cue_velocity[:2], hit.object_velocity[:2]
    lengths = float(np.hypot(*one) * np.hypot(*two))
    if lengths > 1e-6 * hit.speed**2:
        found = math.atan2(abs(one[0] * two[1] - one[1] * two[0]), float(one @ two))
        assert hit.departure == pytest.approx(found, abs=1e-8)
        on = -1.0 if hand(hit) * float(one @ axes(hit)[1][:2]) < 0.0 else 1.0
        assert hit.departure == pytest.approx(math.pi / 2.0 - on * hit.throw, abs=1e-12)


def test_the_cosine_rule_of_the_departure() -> None:
    hit = collide(0.6, 0.2, 0.4, speed=2.0)
    one, two = (float(np.hypot(*v[:2])) for v in (hit.cue_velocity, hit.object_velocity))
    assert math.cos(hit.departure) == pytest.approx(hit.delta_total / (2.0 * one * two))


@given(shots)
def test_throw_is_the_angle_from_the_line_of_centers(hit: Collision) -> None:
    x, y = axes(hit)
    ahead, aside = float(hit.object_velocity @ x), float(hit.object_velocity @ y)
    if ahead > 1e-6 * hit.speed:
        assert hit.throw == pytest.approx(hand(hit) * math.atan2(aside, ahead), abs=1e-9)


@given(cuts, spins, spins, speeds, laws)
def test_throw_does_not_depend_on_speed(
    cut: float, topspin: float, side: float, speed: float, law: str
) -> None:
    hit = collide(cut, topspin, side, speed=speed, friction=law)
    assert hit.throw == pytest.approx(throw_angle(cut, topspin, side, friction=law), abs=1e-12)


@given(shots)
def test_slip_is_the_motion_of_the_point_of_contact(hit: Collision) -> None:
    (x, y), (velocity, spin) = axes(hit), before(hit)
    point = velocity + np.cross(spin, hit.ball.radius * x)
    assert hit.slip == pytest.approx((float(point @ y), float(point[2])), abs=1e-10)


@given(limited)
def test_level_slip_never_turns_round(hit: Collision) -> None:
    x, y = axes(hit)
    points = np.cross(hit.cue_spin + hit.object_spin, hit.ball.radius * x)
    left = float((hit.cue_velocity - hit.object_velocity + points) @ y)
    assert left * hit.slip[0] >= -1e-12 * (1.0 + hit.speed**2) * 10.0
    assert abs(left) <= abs(hit.slip[0]) + 1e-12 * (1.0 + hit.speed) * 10.0


@given(shots)
def test_the_table_keeps_both_balls_up(hit: Collision) -> None:
    assert hit.object_velocity[2] >= 0.0
    assert hit.cue_velocity[2] >= 0.0
    assert (hit.object_velocity[2] > 0.0) <= (hit.topspin < 0.0)
    assert (hit.cue_velocity[2] > 0.0) <= (hit.topspin > 0.0)


@given(cuts, spins, spins, laws)
def test_draw_is_the_mirror_of_topspin(cut: float, topspin: float, side: float, law: str) -> None:
    one, two = (collide(cut, spin, side, friction=law) for spin in (topspin, -topspin))
    assert (one.sideways, one.upward) == (two.sideways, -two.upward)
    assert one.object_velocity[:2].tolist() == two.object_velocity[:2].tolist()


def test_signs() -> None:
    hit = collide(math.radians(30.0), 0.0, speed=2.0)
    assert hit.object_velocity[1] < 0.0 < hit.cue_velocity[1]  # a cut to the right
    assert hit.sideways > 0.0  # thrown to the left: it misses thick
    assert hit.object_spin[2] < 0.0  # and turns clockwise, from gears' inside
    assert hit.cue_spin[2] == hit.object_spin[2]
    rolling = collide(0.0, 1.0)
    assert rolling.cue_spin[1] > 0.0 > rolling.object_spin[1]  # topspin makes draw
    assert rolling.jump() == (0.0, 0.0, 0.0)
    right = collide(0.0, 0.0, 0.5)  # counterclockwise from above pushes to the left
    assert right.object_velocity[1] > 0.0
    assert right.object_spin[2] < 0.0


@given(cuts.filter(bool), spins, spins, frictions, laws)
def test_a_cut_to_the_left_is_the_mirror_image(
    cut: float, topspin: float, side: float, mu: float, law: str
) -> None:
    right = collide(cut, topspin, side, speed=2.0, mu=mu, friction=law)
    left = collide(-cut, topspin, -side, speed=2.0, mu=mu, friction=law)
    # A mirror turns y around; of an axial vector it turns the other two.
    for name in ("object_velocity", "cue_velocity"):
        assert (getattr(left, name) * [1, -1, 1]).tolist() == getattr(right, name).tolist()
    for name in ("object_spin", "cue_spin"):
        assert (getattr(left, name) * [-1, 1, -1]).tolist() == getattr(right, name).tolist()
    for name in (
        *("throw", "departure", "energy_lost", "angular_momentum_change"),
        *("delta_elastic", "delta_inelastic", "delta_total"),
    ):
        assert getattr(left, name) == getattr(right, name)
    assert left.jump() == right.jump()


@given(
    cuts,
    st.floats(-1e50, 1e50),
    st.floats(-1e50, 1e50),
    st.floats(0.0, 1e50),
    st.floats(0.0, 1e50),
    laws,
)
def test_every_answer_is_finite(
    cut: float, topspin: float, side: float, speed: float, mu: float, law: str
) -> None:
    hit = collide(cut, topspin, side, speed=speed, mu=mu, friction=law)
    answers = [
        *(hit.throw, hit.departure, hit.delta_elastic, hit.delta_inelastic, hit.delta_total),
        *(hit.energy_lost, hit.angular_momentum_change, *hit.slip, *hit.jump()),
        *(*hit.object_velocity, *hit.cue_velocity, *hit.object_spin, *hit.cue_spin),
    ]
    assert np.isfinite(answers).all()


def test_a_jump_falls_back() -> None:
    hit = collide(0.2, -1.0, speed=36.0 * INCH)
    flight = hit.jump(gravity=9.8)
    up = hit.object_velocity[2]
    assert up * flight.time - 4.9 * flight.time**2 == pytest.approx(0.0, abs=1e-15)
    half = flight.time / 2.0
    assert up * half - 4.9 * half**2 == pytest.approx(flight.height)
    assert np.hypot(*hit.object_velocity[:2]) * flight.time == pytest.approx(flight.distance)


@given(st.floats(0.02, 1.5), frictions)
def test_axis_tilt_is_the_axis_of_the_rolling_ball(cut: float, mu: float) -> None:
    hit = collide(cut, 0.0, mu=mu)
    level_speed = float(np.hypot(*hit.object_velocity[:2]))
    rolling = 5.0 / 7.0 * level_speed / hit.ball.radius
    assert axis_tilt(hit.throw) == pytest.approx(math.atan(hit.object_spin[2] / rolling), abs=1e-9)


def test_arrays_broadcast_and_scalars_stay_scalars() -> None:
    cut, side = np.linspace(0.0, 1.5, 4)[:, None], np.linspace(-1.0, 1.0, 3)
    many = collide(cut, 1.0, side, speed=2.0)
    one = collide(float(cut[2, 0]), 1.0, float(side[1]), speed=2.0)
    for name in ("throw", "departure", "delta_elastic", "delta_inelastic", "energy_lost"):
        assert type(getattr(one, name)) is float
        assert getattr(many, name).shape == (4, 3)
        assert getattr(many, name)[2, 1] == getattr(one, name)
    for name in ("object_velocity", "cue_velocity", "object_spin", "cue_spin"):
        assert getattr(many, name).shape == (4, 3, 3)
        assert getattr(many, name)[2, 1].tolist() == getattr(one, name).tolist()
    assert many.jump().height.shape == (4, 3)


@pytest.mark.parametrize(
    ("shot", "options", "said"),
    [
        ((-1.6,), {}, "it is -1.6"),
        (([0.1, 1.6],), {}, "it holds 1.6"),
        ((0.1,), {"speed": -1.0}, "speed must be a number from 0 to 1e+50; it is -1.0"),
        ((0.1,), {"mu": math.nan}, "is nan"),
        ((0.1,), {"friction": "Shepard's"}, "friction must"),
    ],
)
def test_refusals(shot: tuple[Any, ...], options: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError) as refused:
        collide(*shot, **options)
    assert said in str(refused.value)
