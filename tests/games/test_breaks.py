import pytest

from evenbreak.games import (
    BREAK_FORMATS,
    BreakFormat,
    alternate_breaks,
    loser_breaks,
    player_1_breaks,
    player_2_breaks,
    winner_breaks,
)


@pytest.mark.parametrize(
    ("breaks", "after"),
    [  # the next breaker after (breaker, winner) = (1, 1), (1, 2), (2, 1), (2, 2)
        (winner_breaks, [1, 2, 1, 2]),
        (loser_breaks, [2, 1, 2, 1]),
        (alternate_breaks, [2, 2, 1, 1]),
        (player_1_breaks, [1, 1, 1, 1]),
        (player_2_breaks, [2, 2, 2, 2]),
    ],
)
def test_who_breaks_next(breaks: BreakFormat, after: list[int]) -> None:
    assert [breaks(*past) for past in ((1, 1), (1, 2), (2, 1), (2, 2))] == after


def test_each_format_has_a_name() -> None:
    assert list(BREAK_FORMATS) == ["winner", "loser", "alternate", "player 1", "player 2"]
    assert len(set(BREAK_FORMATS.values())) == 5
