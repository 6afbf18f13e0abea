import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import RaceLimits
from evenbreak.handicaps.charts.candidates import Candidates, NoChartError
from evenbreak.handicaps.charts.race_grid import even_differences, win_grid
from evenbreak.ratings import SCALES

NPL = SCALES["npl"]


@pytest.fixture(scope="module")
def candidates():
    return Candidates(NPL, RaceLimits((5, 9), weaker_least=2), up_to=40)


def races_of(some):
    return list(zip(some.m.tolist(), some.n.tolist(), strict=True))


def test_even_races_come_first_and_then_harder_and_harder_ones(candidates):
    races = races_of(candidates)
    assert races[: candidates.evens] == [(3, 3), (4, 4), (5, 5)]
    even_at = even_differences(NPL, *np.array(races[candidates.evens :]).T)
    assert (np.diff(even_at) > 0).all()
    assert set(races) == set(candidates.limits.races)


def test_the_last_difference_is_the_one_asked_for_or_where_the_hardest_race_is_even(candidates):
    assert candidates.points[-1] == 40
    hardest = even_differences(NPL, [8], [2])[0]
    whole = Candidates(NPL, RaceLimits((5, 9), weaker_least=2))
    assert races_of(whole)[-1] == (8, 2)
    assert whole.points[-1] == np.floor(hardest)


def test_chances_have_a_row_a_race_and_a_column_a_difference(candidates):
    place = races_of(candidates).index((5, 3))
    assert candidates.wins.shape == (len(candidates.m), 41)
    assert candidates.wins[place, 24] == win_grid(NPL, [5], [3], [24])[0, 0]


def test_equal_players_always_play_an_even_race(candidates):
    for made in (candidates.fairest(target=0.6), candidates.nearest("near")):
        first = made.rows[0]
        assert first.stronger_needs == first.weaker_needs
    assert candidates.nearest("near").rows[0][2:] == (5, 5)


def test_a_row_limit_that_no_chart_reaches_changes_nothing(candidates):
    assert candidates.fairest(rows=41) == candidates.fairest()
    assert len(candidates.fairest(rows=2).rows) == 2


def test_a_limit_on_the_length_that_no_race_keeps_is_refused():
    limited = Candidates(NPL, RaceLimits((5, 9), weaker_least=2, games_p90=3), up_to=40)
    with pytest.raises(NoChartError, match="games_p90 is 3"):
        limited.fairest()


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(
    ("games", "up_to", "wrong"),
    [
        ((1, 999), None, "250000 races"),
        ((5, 7), 0, "up_to must be a whole number, 1 or more; you gave 0"),
    ],
)
def test_too_much_to_try_is_refused(games, up_to, wrong):
    with pytest.raises(InputError, match=wrong):
        Candidates(NPL, RaceLimits(games), up_to)
