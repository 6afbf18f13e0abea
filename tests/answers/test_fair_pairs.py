import itertools
import math

import pytest

from evenbreak.answers.fair_pairs import NOT_LINKED, matchups_frame
from evenbreak.answers.offered_races import OfferedRaces
from evenbreak.handicaps.charts.fair import fair_races
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results


@pytest.fixture(scope="module")
def ratings():
    """Ann > Bo > Cy play each other; Di and Ed play only each other."""
    season = Results.from_names(
        ["Ann", "Bo", "Cy", "Di"], ["Bo", "Cy", "Ann", "Ed"], [7, 7, 3, 5], [4, 5, 7, 5]
    )
    return fit(season, scale="fargo")


@pytest.mark.parametrize("offered", [OfferedRaces(race_to=7), OfferedRaces((7, 13))])
def test_every_pair_has_the_fairest_race_and_the_stronger_comes_first(ratings, offered):
    frame = matchups_frame(ratings, [2, 0, 1], offered)
    assert list(zip(frame["player_a"], frame["player_b"], strict=True)) == list(
        itertools.combinations(["Ann", "Bo", "Cy"], 2)
    )
    for row in frame.itertuples():
        p = ratings.win_probability(row.player_a, row.player_b)
        (race,) = fair_races(p, games=offered.games, race_to=offered.race_to, top=1)
        assert p > 0.5
        assert (row.race_a, row.race_b, row.games_p90, row.note) == (
            *(race.race_1, race.race_2, race.games_p90, ""),
        )
        assert (row.p_game_a, row.p_win_a, row.mean_games) == pytest.approx(
            (p, race.p_win_1, race.mean_games), rel=1e-12
        )


def test_players_who_are_not_linked_get_no_race(ratings):
    frame = matchups_frame(ratings, range(5), OfferedRaces(race_to=5))
    apart = frame[frame["note"] == NOT_LINKED]
    assert (len(frame), len(apart)) == (10, 6)
    assert apart[["p_game_a", "race_a", "race_b", "p_win_a", "mean_games"]].isna().all(axis=None)
    assert not frame.drop(apart.index)["race_a"].isna().any()


def test_equal_players_get_an_even_race():
    ratings = fit(Results.from_names(["Ann"], ["Bo"], [5], [5]))
    (row,) = matchups_frame(ratings, [0, 1], OfferedRaces(race_to=7)).itertuples()
    assert (row.player_a, row.race_a, row.race_b) == ("Ann", 7, 7)
    assert math.isclose(row.p_win_a, 0.5, abs_tol=1e-9)
