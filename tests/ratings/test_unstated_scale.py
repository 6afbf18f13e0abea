"""Ratings that do not say their scale: what they can only be, or a question with both readings."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.ratings.scale import DEFAULT_SCALE, SCALES, USUAL, unstated_scale

NOBODY = float("nan")


@pytest.mark.parametrize("name", USUAL)
def test_ratings_that_can_only_be_on_one_scale_are_on_that(name: str) -> None:
    rng, (low, high) = np.random.default_rng(12), USUAL[name]
    for _ in range(100):
        ratings = [*rng.uniform(low + 1, high - 1, rng.integers(1, 30)), NOBODY]
        assert unstated_scale(ratings, ["Ann"] * 31, "").name == name


@pytest.mark.parametrize(
    "ratings", [[190, 140], [612, 92], [580, 5800], [980, 960], [3100, 3050], [-80, 20]]
)
def test_ratings_outside_every_scale_are_refused_with_each_reading(ratings: list[float]) -> None:
    with pytest.raises(InputError, match=r"say which$") as refused:
        unstated_scale([NOBODY, *ratings], ["Cy", "Ann", "Bo"], "say which", "tonight.txt")
    said = str(refused.value)
    gap = abs(ratings[0] - ratings[1])
    for name, title in (("npl", "NPL"), ("fargo", "Fargo"), ("elo", "Elo")):
        assert f"by {title} ratings" in said
        assert f"{SCALES[name].win_probability(gap):.0%}" in said
    better, worse = ("Ann", "Bo") if ratings[0] > ratings[1] else ("Bo", "Ann")
    assert f"tonight.txt: the ratings from {min(ratings)} to {max(ratings)}" in said
    assert f"{better} wins a game against {worse}" in said


def test_a_list_without_a_rating_is_on_the_default_scale() -> None:
    assert unstated_scale([NOBODY], ["Ann"], "").name == DEFAULT_SCALE
