import pytest

from evenbreak.answers.offered_races import OfferedRaces
from evenbreak.errors import InputError


@pytest.mark.parametrize("wrong", [{}, {"games": (5, 9), "race_to": 7}])
def test_races_are_limited_one_way_or_the_other(wrong):
    with pytest.raises(InputError, match="exactly one"):
        OfferedRaces(**wrong)


@pytest.mark.parametrize("p", [0.5, 0.6, 0.75])
def test_the_fairest_race_is_within_the_limits(p):
    race = OfferedRaces(race_to=7).fairest(p)
    assert race.race_1 == 7
    race = OfferedRaces((5, 9)).fairest(p)
    assert 5 <= race.race_1 + race.race_2 - 1 <= 9


def test_one_game_is_no_games():
    assert "needs 1 game." in OfferedRaces(race_to=1).in_words
    assert "has 1 game." in OfferedRaces((1, 1)).in_words
    assert "7 to 13 games;" in OfferedRaces((7, 13)).in_words
