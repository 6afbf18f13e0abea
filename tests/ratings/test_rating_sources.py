"""What a rating is made of."""

import numpy as np
import pytest

from evenbreak.ratings import Beginning, Levels, Results, fit
from evenbreak.ratings.fitted import rating_sources

SEASON = Results.from_names(
    ["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [17, 12, 9], [10, 14, 8], date=["2026-01-05"] * 3
)
OLD = Beginning(["Ann", "Bo"], [95, 65], [10, 20])


@pytest.mark.parametrize("levels", [Levels(), Levels(beginning=OLD)])
def test_a_rating_is_the_mean_of_what_its_sources_say(levels):
    ratings = fit(SEASON, levels=levels)
    for player, name in enumerate(ratings.players):
        sources = rating_sources(ratings, player)
        assert sum(one.weight for one in sources) == pytest.approx(1.0)
        mean = sum(one.weight * one.rating for one in sources if one.rating is not None)
        assert mean == pytest.approx(float(ratings.rating[player]))
        brought = [one for one in sources if one.source == "brought"]
        assert bool(brought) == (levels.beginning is not None and name != "Cy")


def test_a_brought_rating_says_what_stands_in_the_list():
    ratings = fit(SEASON, levels=Levels(beginning=OLD))
    prior, brought, results = rating_sources(ratings, 0)
    assert (brought.rating, brought.standard_error) == pytest.approx((95.0, 10.0))
    assert prior.standard_error == pytest.approx(ratings.scale.points(ratings.prior_sd))
    assert 0.0 < results.weight < 1.0


def test_a_player_without_results_has_the_rating_that_was_assumed():
    season = Results.from_names(
        ["Ann", "Di"], ["Bo", "Ann"], [7, 0], [5, 0], date=np.array(["2026-01-05"] * 2, "M8[D]")
    )
    ratings = fit(season)
    prior, results = rating_sources(ratings, ratings.players.index("Di"))
    assert prior.weight == pytest.approx(1.0)
    assert results.rating is None
