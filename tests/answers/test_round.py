import numpy as np
import pandas as pd
import pytest

from evenbreak.answers import round as module
from evenbreak.answers.offered_races import OfferedRaces
from evenbreak.matches.evening import evening
from evenbreak.ratings.roster import Roster
from leagues import CLUB, round_of

OFFERED = OfferedRaces((7, 13))


def test_the_races_to_play_come_first():
    assert list(round_of().kinds) == ["chart_"]
    assert list(round_of(offered=OFFERED).kinds) == ["chart_", ""]
    assert list(round_of(offered=OFFERED, chart=None).kinds) == [""]


def test_parts_are_the_whole(monkeypatch):
    tonight = round_of(offered=OFFERED)
    monkeypatch.setattr(module, "AT_A_TIME", 4)
    parts = [part.frame for part in tonight.in_parts()]
    assert list(map(len, parts)) == [4, 2]
    whole = tonight.matchups.frame
    pd.testing.assert_frame_equal(pd.concat(parts, ignore_index=True), whole, rtol=1e-12)


def test_only_players_who_meet_somebody_are_named():
    assert round_of(pairs=[[0, 1]]).names == {"Ann", "Bo"}
    assert round_of().names == set(CLUB.players)


def test_the_evening_is_that_of_the_races_lengths():
    tonight = round_of(pairs=[[0, 1], [2, 3]], offered=OFFERED, minutes_per_game=8.0, tables=2)
    chart, best = tonight.evening
    assert (chart.races, best.races, chart.exact) == ("chart", "best", True)
    exact = evening(tonight.matchups.chart_lengths, tables=2)
    assert chart.mean_minutes == pytest.approx(8.0 * exact.mean)
    assert chart.minutes_p90 == 8.0 * exact.p90
    assert round_of(minutes_per_game=8.0).evening == []


def test_a_simulated_evening_depends_on_its_seed_alone():
    def ends(seed):
        return round_of(minutes_per_game=8.0, tables=2, seed=seed).evening

    assert ends(0) == ends(0) != ends(1)
    assert not ends(0)[0].exact
    assert 0.0 < ends(0)[0].mean_minutes_error < 1.0


def test_pairs_without_a_race_take_no_table():
    apart = Roster(["A", "B", "C"], [90, 80, 70], np.full(3, np.nan), [9] * 3, component=[1, 1, 2])
    (end,) = round_of(apart, minutes_per_game=8.0, tables=1).evening
    assert end.matches == 1
