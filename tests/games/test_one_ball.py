import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import InputError
from evenbreak.games import OneBall, OneBallLookAhead

UNIT = st.floats(0.0, 1.0)


def chance(game: OneBall | OneBallLookAhead) -> float:
    limit = stochastic_limit(chain_of(game)).to_dict()
    return sum(p for state, p in limit.items() if game.winner(state) == 1)


@given(st.floats(0.001, 1.0), UNIT)
def test_the_infinite_look_ahead(p1: float, p2: float) -> None:
    assert chance(OneBall(p1, p2)) == pytest.approx(p1 / (p1 + p2 - p1 * p2), rel=1e-12)


def test_the_four_nodes() -> None:
    game = OneBall(0.25, 0.75)
    assert game.start == "S1"
    assert game.moves("S1") == {"W": 0.25, "S2": 0.75}
    assert game.moves("S2") == {"L": 0.75, "S1": 0.25}
    assert [game.winner(s) for s in ("W", "L", "S1", "S2")] == [1, 2, None, None]


@given(UNIT, UNIT)
def test_two_shots_then_even(p1: float, p2: float) -> None:
    game = OneBallLookAhead([p1, p2])
    assert chance(game) == pytest.approx(p1 + (1 - p1) * (1 - p2) / 2, rel=1e-12)


@given(st.lists(UNIT, min_size=1, max_size=6), UNIT)
def test_any_number_of_shots(shots: list[float], after: float) -> None:
    missed, won = 1.0, 0.0
    for i, made in enumerate(shots):
        won += missed * made * (i % 2 == 0)
        missed *= 1.0 - made
    won += missed * after
    assert chance(OneBallLookAhead(shots, after=after)) == pytest.approx(won, rel=1e-12, abs=1e-300)


def test_equal_shots_for_ever_are_the_infinite_game() -> None:
    assert chance(OneBallLookAhead([0.4, 0.8] * 30)) == pytest.approx(chance(OneBall(0.4, 0.8)))


def test_the_winners_of_the_shots() -> None:
    game = OneBallLookAhead([0.5, 0.5, 0.5])
    assert [game.winner(s) for s in ("W1", "L2", "W3", "W", "L", "S2")] == [1, 2, 1, 1, 2, None]


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: OneBall(1.2, 0.5), r"p1 must be a number from 0 to 1; you gave 1\.2"),
        (lambda: OneBall(0.5, float("nan")), "p2 must be a number from 0 to 1; you gave nan"),
        (
            lambda: OneBallLookAhead([]),
            r"shots must be a list of numbers from 0 to 1; you gave \[\]",
        ),
        (lambda: OneBallLookAhead([0.5, -1]), "shot 2 must be a number from 0 to 1; you gave -1"),
        (lambda: OneBallLookAhead([0.5], after=2), "after must"),
    ],
)
def test_what_a_one_ball_game_cannot_be(make: object, words: str) -> None:
    with pytest.raises(InputError, match=words):
        make()  # type: ignore[operator]
