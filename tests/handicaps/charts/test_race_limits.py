import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import RaceLimits


def test_the_races_are_all_within_the_limits():
    limits = RaceLimits((4, 9), stronger_least=4, weaker_least=2)
    every = {(m, n) for m in range(4, 10) for n in range(2, m + 1) if 4 <= m + n - 1 <= 9}
    assert set(limits.races) == every
    assert len(limits.races) == len(every)


@pytest.mark.parametrize(
    ("wrong", "remedy"),
    [
        ({"games": (7, 5)}, "games is .7, 5"),
        ({"games": 7}, "games must be a pair .*you gave 7"),
        ({"games": (0, 5)}, "games must"),
        ({"games": (6, 6)}, "7 or more"),
        ({"games": (5, 7), "weaker_least": 5}, "9 or more"),
        ({"games": (5, 7), "stronger_least": 5}, "9 or more"),
        ({"games": (5, 7), "weaker_least": 0}, "weaker_least must"),
        ({"games": (5, 7), "games_p90": 0}, "games_p90 must"),
    ],
)
def test_limits_that_leave_nothing_are_refused(wrong, remedy):
    with pytest.raises(InputError, match=remedy):
        RaceLimits(**wrong)
