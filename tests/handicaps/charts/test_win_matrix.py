"""Every player against every other, averaged over what is uncertain about their difference."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import Gap, win_matrix
from evenbreak.ratings import Results, fit


@pytest.fixture(scope="module")
def ratings():
    a, b = ["Ann", "Bo", "Ann", "Xi"], ["Bo", "Cy", "Cy", "Yo"]
    return fit(Results.from_names(a, b, [14, 10, 9, 5], [10, 12, 3, 4]))


@pytest.mark.parametrize("race", [(1, 1), (7, 5)])
def test_each_chance_is_that_of_the_pair(ratings, race):
    matrix = win_matrix(ratings, race=race)
    for one, two in (("Ann", "Bo"), ("Cy", "Ann"), ("Xi", "Yo")):
        at = ratings.players.index(one), ratings.players.index(two)
        difference = float(ratings.rating[at[0]] - ratings.rating[at[1]])
        error = ratings.difference_error(one, two)
        expected = Gap(difference, error, scale=ratings.scale).win(*race)
        assert matrix.loc[one, two] == pytest.approx(expected, rel=1e-9)


def test_a_single_game_has_one_winner(ratings):
    matrix = win_matrix(ratings).to_numpy()
    known = ~np.isnan(matrix)
    np.testing.assert_allclose((matrix + matrix.T)[known], 1.0, rtol=1e-12)


def test_players_who_are_not_connected_have_no_chance_given(ratings):
    matrix = win_matrix(ratings)
    assert np.isnan(matrix.loc["Ann", "Xi"])
    assert np.isnan(np.diag(matrix)).all()


def test_named_players_come_in_their_order(ratings):
    assert list(win_matrix(ratings, ["Cy", "Ann"])) == ["Cy", "Ann"]


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"race": (7, 0)}, "race"),
        ({"race": 7}, "race must"),
        ({"players": ["Ann", "Ann"]}, "twice"),
        ({"players": ["Zoe"]}, "'Zoe' isn't rated"),
    ],
)
def test_wrong_values_are_named(ratings, given, named):
    with pytest.raises(InputError, match=named):
        win_matrix(ratings, **given)
    with pytest.raises(InputError, match="ratings must"):
        win_matrix([1, 2])
