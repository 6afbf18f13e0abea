import pytest

from evenbreak.answers.match.shot_games import straight_answer
from evenbreak.matches import StraightPool, even_spot


def test_the_spot_is_named_with_its_chance():
    match = StraightPool(100, 100, 0.85, 0.9)
    spot = even_spot(match)
    answer = straight_answer(match)
    told = answer.to_dict()
    assert (told["even_points_a"], told["even_points_b"]) == (spot.points, 100)
    assert told["p_win_a_even"] == spot.p_win_1
    assert f"A should play to {spot.points} points" in answer.sentences[0]


@pytest.mark.parametrize(
    ("match", "words"),
    [
        (StraightPool(100, 60, 0.9, 0.85), "No other spot"),
        (StraightPool(100, 100, 0.0, 0.9), "No spot"),
        (StraightPool(100, 100, 0.0, 0.0), "never ends"),
    ],
)
def test_a_match_without_a_better_spot(match, words):
    assert words in straight_answer(match).sentences[0]


def test_the_heading_has_averages_or_chances_and_safety():
    match = StraightPool(50, 40, 0.9, 0.8, safety_1=0.7, safety_2=0.7, first=2)
    assert straight_answer(match).heading.split("\n")[1].count("0.7") == 1
    assert "averages 9 balls" in straight_answer(match, (9.0, 4.0)).heading
