import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.practice import DrillLog
from rows import each_of


def test_attempts_and_successes_are_counted_by_level() -> None:
    log = DrillLog([1, 2, 3, 2, 1], [True, True, False, False, True], levels=4)
    assert log.attempts.tolist() == [2, 2, 1, 0]
    assert log.successes.tolist() == [2, 1, 0, 0]
    assert (len(log), log.sessions, log.levels) == (5, 1, 4)


def test_what_came_before_is_the_outcome_of_the_attempt_before() -> None:
    log = DrillLog([1, 2, 3, 2, 3, 1], [1, 1, 0, 1, 0, 0], ["a"] * 5 + ["b"])
    start, miss, success = np.moveaxis(log.outcomes, 1, 0)
    assert start.tolist() == [[1, 1], [0, 0], [0, 0]]
    assert miss.tolist() == [[0, 0], [0, 1], [0, 0]]
    assert success.tolist() == [[0, 0], [0, 1], [2, 0]]


def test_the_first_level_repeats_after_a_miss_and_the_last_after_a_success() -> None:
    log = DrillLog([1, 1, 2, 2, 2, 1], [0, 1, 1, 1, 0, 1])
    assert log.jumps.tolist() == []
    assert log.starts.tolist() == [0]


def test_the_highest_level_repeats_only_if_it_is_the_last() -> None:
    assert DrillLog([1, 2, 2], [1, 1, 1]).jumps.tolist() == []
    assert DrillLog([1, 2, 2], [1, 1, 1], levels=3).jumps.tolist() == [2]


def test_a_step_against_the_rule_is_a_new_start() -> None:
    log = DrillLog([1, 2, 5, 4, 4], [1, 1, 0, 1, 1])
    assert log.jumps.tolist() == [2, 4]
    assert log.starts.tolist() == [0, 2, 4]


def test_a_session_may_begin_anywhere() -> None:
    log = DrillLog([1, 2, 5, 4, 1, 2], [1, 1, 0, 1, 1, 1], ["Mo", "Mo", "Tu", "Tu", "Mo", "Mo"])
    assert log.jumps.tolist() == []
    assert (log.starts.tolist(), log.sessions) == ([0, 2, 4], 3)


@given(st.lists(st.booleans(), min_size=1, max_size=60), st.integers(1, 5))
def test_up_and_down_balance_in_one_session(success: list[bool], n: int) -> None:
    level = [1]
    for won in success[:-1]:
        level.append(min(level[-1] + 1, n) if won else max(level[-1] - 1, 1))
    log = DrillLog(level, success, levels=n)
    assert log.jumps.tolist() == []
    up, down = log.successes[:-1], (log.attempts - log.successes)[1:]
    assert (np.abs(up - down) <= 1).all()


@each_of(
    "level, success, more, words",
    [
        ([], [], {}, "level is empty"),
        (3, True, {}, "level is empty"),
        ([0, 1], [1, 1], {}, "level must be whole numbers, 1 or more; it holds 0"),
        ([1.5], [1], {}, r"level must be whole numbers, 1 or more; it holds 1\.5"),
        (["two"], [1], {}, "level must be .*two"),
        ([1, 2], [1], {}, "success doesn't match"),
        ([1, 2], [1, 2], {}, "success doesn't match"),
        ([1, 2], [1, 0], {"session": ["Mo"]}, "session doesn't match"),
        ([1, 2], [1, 0], {"levels": 1}, "levels is 1, but the log has level 2"),
        (
            [1, 2],
            [1, 0],
            {"levels": 2.5},
            r"levels must be a whole number, 1 or more; you gave 2\.5",
        ),
        ([1, 101], [1, 0], {}, "the drill must have at most 100 levels; it has 101"),
        ([1, 1e30], [1, 0], {}, "the drill must have at most 100 levels; it has 1"),
        ([1, 2], [1, 0], {"levels": 101}, "the drill must have at most 100 levels; it has 101"),
    ],
)
def test_what_a_log_cannot_be(level: object, success: object, more: object, words: str) -> None:
    with pytest.raises(InputError, match=words):
        DrillLog(level, success, **more)  # type: ignore[arg-type]
