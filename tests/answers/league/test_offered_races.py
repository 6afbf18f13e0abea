import pytest

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.errors import InputError
from evenbreak.handicaps import Gap


@pytest.mark.parametrize("wrong", [{}, {"games": (5, 9), "race_to": 7}])
def test_races_are_limited_one_way_or_the_other(wrong):
    with pytest.raises(InputError, match="exactly one"):
        OfferedRaces(**wrong)


@pytest.mark.parametrize("error", [0.0, 25.0])
def test_the_fairest_race_is_within_the_limits(error):
    gaps = Gap([0.0, 18.0, 48.0], error)
    m, n = OfferedRaces(race_to=7).fairest(gaps)
    assert (m == 7).all()
    assert (n <= 7).all()
    m, n = OfferedRaces((5, 9)).fairest(gaps)
    assert ((m + n - 1 >= 5) & (m + n - 1 <= 9)).all()


def test_one_game_is_no_games():
    assert "needs 1 game." in OfferedRaces(race_to=1).in_words
    assert "last 1 game at most." in OfferedRaces((1, 1)).in_words
    assert "7 to 13 games at most;" in OfferedRaces((7, 13)).in_words
