import itertools
import math

import numpy as np
import pytest

from evenbreak.answers.league.roster_matchups import (
    NOT_LINKED,
    OfferedRaces,
    all_pairs,
    roster_matchups,
)
from evenbreak.answers.league.sheet import matchups_frame
from evenbreak.files.csv_writer import to_csv
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.results.results_file import read_results
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results
from places import DATA, SHARED


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
    error = dict(zip(ratings.players, ratings.quasi_error, strict=True))
    for row in frame.itertuples():
        assert row.p_game_a_plug_in == pytest.approx(
            ratings.win_probability(row.player_a, row.player_b), abs=1e-8
        )
        both = math.hypot(error[row.player_a], error[row.player_b])
        assert row.difference_error == pytest.approx(both, abs=1e-5)
        chance = Gap(row.difference, both, scale="fargo").win(row.race_a, row.race_b)
        assert row.p_win_a == pytest.approx(chance, abs=1e-7)
        races = [(m, n) for m in range(1, 14) for n in range(1, 14)]
        within = [(7, n) for n in range(1, 8)]
        if offered.games is not None:
            within = [(m, n) for m, n in races if 7 <= m + n - 1 <= 13]
        chances = Gap(row.difference, both, scale="fargo").win(*np.transpose(within))
        assert abs(row.p_win_a - 0.5) == pytest.approx(np.abs(chances - 0.5).min(), abs=1e-7)


SNOOKER = SHARED / "data" / "snooker_2016_17_results.csv"


@pytest.mark.slow
@pytest.mark.parametrize(
    "results",
    [
        DATA / "demo_league.csv",
        pytest.param(
            SNOOKER,
            marks=[
                pytest.mark.thorough,
                pytest.mark.skipif(
                    not SNOOKER.exists(), reason=f"{SNOOKER.name} is not on this computer"
                ),
            ],
        ),
    ],
    ids=["demo", "snooker"],
)
def test_a_report_and_the_list_that_it_writes_give_each_pair_the_same_race(results, tmp_path):
    offered = OfferedRaces(race_to=7)
    rated = fit(read_results(results).results)
    here = matchups_frame(rated, range(len(rated.players)), offered)
    path = tmp_path / "ratings.csv"
    path.write_bytes(to_csv(rated.to_frame()))
    club = read_roster(path).roster
    there = roster_matchups(club, all_pairs(club), scale=rated.scale, offered=offered).frame
    pairs = ["player_a", "player_b"]
    # Equal ratings may come in either order.
    assert {frozenset(pair) for pair in here[pairs].to_numpy().tolist()} == {
        frozenset(pair) for pair in there[pairs].to_numpy().tolist()
    }
    same = here.merge(there, on=pairs, suffixes=("", "_list"))
    assert len(same) > 0.999 * len(here)
    for name in ("race_a", "race_b", "games_p90", "note"):
        assert (same[name] == same[f"{name}_list"]).all()
    for name in ("p_win_a", "p_game_a", "mean_games", "difference_error"):
        assert same[name].to_numpy() == pytest.approx(same[f"{name}_list"].to_numpy(), abs=1e-12)


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
