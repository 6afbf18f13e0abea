import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.fair import fair_races
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.ratings.scale import SCALES

LIMITS = [{"race_to": 7}, {"games": (5, 13)}, {"games": (9, 9)}]


@pytest.mark.slow_after(8)
@pytest.mark.parametrize("limits", LIMITS)
@pytest.mark.parametrize("difference", [-40.0, 0.0, 7.5, 33.0])
def test_the_first_is_the_race_of_a_sheet(limits, difference):
    races = Gap(difference, 20.0).nearest_races(**limits)
    m, n = Gap(difference, 20.0).fair_races(**limits)
    assert (races[0].race_1, races[0].race_2) == (int(m), int(n))
    away = [abs(race.p_win_1 - 0.5) for race in races]
    assert away == pytest.approx(sorted(away), abs=1e-9)
    for race in races:
        chance = Gap(difference, 20.0).win(race.race_1, race.race_2)
        assert race.p_win_1 == chance


@pytest.mark.parametrize("limits", LIMITS)
def test_without_errors_they_are_the_fair_races(limits):
    exact = fair_races(SCALES["npl"].rack(21.0), top=3, target=0.45, **limits)
    found = Gap(21.0).nearest_races(top=3, target=0.45, **limits)
    for one, other in zip(found, exact, strict=True):
        assert (one.race_1, one.race_2, one.games_p90) == (
            *(other.race_1, other.race_2, other.games_p90),
        )
        assert one.p_win_1 == pytest.approx(other.p_win_1)


def test_too_many_races_are_refused():
    with pytest.raises(InputError, match="games"):
        Gap(10.0, 5.0).nearest_races(games=(1, 1000))
