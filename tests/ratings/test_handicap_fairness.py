"""How often the player with the longer race wins, by spot."""

import pytest

from evenbreak.ratings import Results, walk_forward
from evenbreak.ratings.validation.validate import handicap_fairness


def test_spots_are_counted_from_the_side_that_gives():
    results = Results.from_names(
        ["Ann"] * 5, ["Bo"] * 5, [7, 6, 4, 4, 7], [4, 5, 7, 7, 6],
        race_a=[7, 7, 5, 6, 7], race_b=[5, 5, 7, 7, 7],
        date=[f"2024-09-0{day}" for day in range(1, 6)],
    )  # fmt: skip
    told = walk_forward(results)
    one, two, every = handicap_fairness(told)
    assert (one.spot, one.matches, one.won) == (1, 1, 1)
    assert (two.spot, two.matches, two.won) == (2, 3, 2)
    assert (every.spot, every.matches, every.won, every.share) == (None, 4, 3, 0.75)
    chances = told.p_match_integrated
    expected = (chances[0] + chances[1] + 1 - chances[2]) / 3
    assert two.expected == pytest.approx(expected)


def test_even_races_have_no_spot():
    results = Results.from_names(
        ["Ann"] * 2, ["Bo"] * 2, [7, 6], [4, 7], date=["2024-09-03", "2024-09-04"]
    )
    assert handicap_fairness(walk_forward(results)) == []
