"""Which numbers lie within limits, and how the limits are said."""

import math

import pytest

from evenbreak.checks.limits import Limits

NONE = Limits(-math.inf, math.inf, -math.inf, math.inf)


@pytest.mark.parametrize(
    ("limits", "inside", "outside"),
    [
        (NONE, (-1e300, 0.0, 1e300), (math.inf, -math.inf, math.nan)),
        (NONE._replace(low=0.0, high=1.0), (0.0, 0.5, 1.0), (-5e-324, 1.0000001, math.nan)),
        (NONE._replace(above=0.0, below=1.0), (5e-324, 0.5), (0.0, 1.0, -1.0)),
        (NONE._replace(above=0.0, high=2.0), (1.0, 2.0), (0.0, 2.1)),
    ],
)
def test_what_lies_within(
    limits: Limits, inside: tuple[float, ...], outside: tuple[float, ...]
) -> None:
    assert all(limits.hold(x, x) for x in inside)
    assert not any(limits.hold(x, x) for x in outside)
    assert limits.hold(min(inside), max(inside))
    assert not any(limits.hold(min(*inside, x), max(*inside, x)) for x in outside[:2])


@pytest.mark.parametrize(
    ("limits", "one", "many"),
    [
        (NONE, "a finite number", "finite numbers"),
        (NONE._replace(low=0), "a finite number, 0 or more", "finite numbers, 0 or more"),
        (NONE._replace(above=0), "a finite number above 0", "finite numbers above 0"),
        (NONE._replace(high=5), "a number, at most 5", "numbers, at most 5"),
        (NONE._replace(low=-1, high=1), "a number from -1 to 1", "numbers from -1 to 1"),
        (NONE._replace(above=0, below=1), "a number between 0 and 1", "numbers between 0 and 1"),
        (NONE._replace(above=0, high=2.5), "a number above 0, at most 2.5", None),
    ],
)
def test_the_limits_in_words(limits: Limits, one: str, many: str | None) -> None:
    assert limits.numbers() == one
    assert many is None or limits.numbers(many=True) == many
