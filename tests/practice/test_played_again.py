import numpy as np
import pytest

from evenbreak.practice import DrillLog
from evenbreak.practice.drill_log import AFTER_START
from evenbreak.practice.log_tests import play_again


def test_sure_chances_leave_nothing_to_chance() -> None:
    """With chances of 0 and 1 each stretch has one course, which a log can tell."""
    course = DrillLog([1, 2, 3, 2, 3, 1, 2, 3], [1, 1, 0, 1, 0, 1, 1, 0], [1] * 5 + [2] * 3)
    rng = np.random.default_rng(1)
    played = play_again(course, np.array([1.0, 1.0, 0.0]), replicas=3, rng=rng)
    assert played.tolist() == [course.outcomes.tolist()] * 3


def test_starts_and_lengths_are_those_of_the_log() -> None:
    log = DrillLog([3, 2, 3, 1, 2, 3], [0, 1, 1, 1, 1, 0], [1, 1, 1, 2, 2, 3])
    played = play_again(log, np.full(3, 0.5), replicas=50, rng=np.random.default_rng(2))
    assert (played.sum((1, 2, 3)) == 6).all()
    assert (played[:, :, AFTER_START].sum(-1) == [1, 0, 2]).all()


def test_fractions_of_successes_are_the_chances() -> None:
    log = DrillLog([1] * 40, [0] * 40, levels=3)
    success = np.array([0.7, 0.4, 0.2])
    played = play_again(log, success, replicas=2000, rng=np.random.default_rng(3)).sum((0, 2))
    attempts = played.sum(-1)
    assert np.abs(played[:, 1] / attempts - success).max() < 4 / np.sqrt(attempts.min())


def test_expected_attempts_are_those_of_the_chain() -> None:
    n, steps = 3, 7
    success = np.array([0.7, 0.4, 0.2])
    M = np.zeros((n, n))
    for i, p in enumerate(success):
        M[min(i + 1, n - 1), i] += p
        M[max(i - 1, 0), i] += 1 - p
    density, visits = np.eye(n)[0], np.zeros(n)
    for _ in range(steps):
        visits += density
        density = M @ density
    level = [1, 2, 3, 2, 1, 2, 1]
    log = DrillLog(level, [1, 1, 0, 0, 1, 0, 1], levels=n)
    played = play_again(log, success, replicas=20_000, rng=np.random.default_rng(4))
    assert played.sum((2, 3)).mean(0) == pytest.approx(visits, abs=0.05)


def test_many_sessions_are_played_a_part_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    log = DrillLog([1, 2] * 10, [1, 0] * 10, np.repeat(range(10), 2))
    monkeypatch.setattr("evenbreak.practice.log_tests._AT_ONCE", 25)
    played = play_again(log, np.array([0.5, 0.5]), replicas=7, rng=np.random.default_rng(5))
    assert played.shape == (7, 2, 3, 2)
    assert (played.sum((1, 2, 3)) == 20).all()
