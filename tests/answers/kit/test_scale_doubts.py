import numpy as np
import pytest

from evenbreak.answers.kit.scales import league_doubts, starter_doubts, two_ratings_doubts
from evenbreak.ratings.scale import SCALES

NPL, FARGO = SCALES["npl"], SCALES["fargo"]


@pytest.mark.parametrize(
    ("scale", "ratings", "other"),
    [
        (NPL, (612, 521), "fargo"),
        (NPL, (92, 71), ""),
        (FARGO, (80, 71), "npl"),
        (FARGO, (1750, 1612), "elo"),
        (FARGO, (91, 0), ""),
    ],
)
def test_two_ratings_of_another_scale(scale, ratings, other):
    doubts = two_ratings_doubts(scale, *ratings)
    assert len(doubts) == bool(other)
    assert all(f"set scale to {other}" in doubt for doubt in doubts)


@pytest.mark.parametrize(
    ("ratings", "many"),
    [([92, 71, np.nan], 0), ([560, 600, 640], 1), ([92, 80, 710], 1), ([np.nan], 0)],
)
def test_a_league_on_another_scale_or_with_a_slip(ratings, many):
    doubts = league_doubts(NPL, ratings, "say which")
    assert len(doubts) == many


@pytest.mark.parametrize(
    ("scale", "ratings", "doubted"),
    [
        (NPL, [92, 71, np.nan], False),
        (FARGO, [92, 71, np.nan], True),
        (FARGO, [92, 71], False),
        (FARGO, [np.nan], False),
        (FARGO, [601, np.nan], True),
        (FARGO, [600, np.nan], False),
    ],
)
def test_new_players_far_from_all_others(scale, ratings, doubted):
    assert len(starter_doubts(scale, ratings)) == doubted
