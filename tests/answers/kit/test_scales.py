import pytest

from evenbreak.answers.kit.scales import decimals_of, game_chance, like_scale_words, scale_words
from evenbreak.ratings.scale import scale_of


@pytest.mark.parametrize("name", ["npl", "fargo", "elo", 50])
def test_a_leagues_own_ratings_are_on_no_named_scale(name):
    scale = scale_of(name)
    assert scale_words(scale).lower().startswith(f"on the {scale.name} scale (")
    words = like_scale_words(scale)
    assert "-like" in words or "of its own" in words
    assert f"{scale.points_per_doubling:.6g} points" in words


@pytest.mark.parametrize(("scale", "decimals"), [("npl", 1), ("fargo", 0), (0.5, 3), (1e6, 0)])
def test_decimals_are_a_hundredth_of_a_doubling(scale, decimals):
    assert decimals_of(scale_of(scale)) == decimals


def test_the_formula_has_the_points_that_double_the_odds():
    assert "d/100" in game_chance(scale_of("fargo"))
