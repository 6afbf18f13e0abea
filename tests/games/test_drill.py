from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import InputError
from evenbreak.games import Drill


def test_success_goes_up_and_failure_down() -> None:
    drill = Drill([0.9, 0.5, 0.25])
    assert drill.moves(1) == {2: 0.9, 1: 0.1}
    assert drill.moves(2) == {3: 0.5, 1: 0.5}
    assert drill.moves(3) == {3: 0.25, 2: 0.75}
    assert drill.start == 1
    assert drill.winner(3) is None


def test_one_level() -> None:
    assert Drill([0.3]).moves(1) == {1: 1.0}


@given(st.lists(st.floats(0.01, 0.99), min_size=1, max_size=9))
def test_as_many_go_up_as_come_down(success: list[float]) -> None:
    limit = stochastic_limit(chain_of(Drill(success))).to_dict()
    for level, (here, above) in enumerate(pairwise(success), 1):
        assert limit[level] * here == pytest.approx(limit[level + 1] * (1 - above), rel=1e-12)


def test_the_8_ball_drill_is_the_9_ball_drill_without_its_certain_level() -> None:
    assert Drill.eight_ball(0.8).success == Drill.progressive(0.8, 8).success[1:]
    for levels in (0, 8):
        with pytest.raises(InputError, match="levels"):
            Drill.eight_ball(0.8, levels)


def test_the_progressive_drill() -> None:
    # Table 5.5, p = .8
    limit = stochastic_limit(chain_of(Drill.progressive(0.8)))
    table = [0.018, 0.088, 0.195, 0.256, 0.222, 0.135, 0.060, 0.020, 0.005]
    assert [round(limit[level], 3) for level in range(1, 10)] == table
    assert sum(level * limit[level] for level in range(1, 10)) == pytest.approx(4.354, abs=5e-4)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Drill([]), r"success must be a list of numbers from 0 to 1; you gave \[\]"),
        (lambda: Drill(0.5), r"success must be a list of numbers from 0 to 1; you gave 0\.5"),  # type: ignore[arg-type]
        (
            lambda: Drill([0.5, 1.5]),
            r"success at level 2 must be a number from 0 to 1; you gave 1\.5",
        ),
        (lambda: Drill.progressive(-1), "gave -1"),
        (lambda: Drill.progressive(0.5, levels=0), "levels must"),
    ],
)
def test_what_a_drill_cannot_be(make: object, words: str) -> None:
    with pytest.raises(InputError, match=words):
        make()  # type: ignore[operator]
