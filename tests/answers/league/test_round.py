import numpy as np
import pandas as pd
import pytest

from evenbreak.answers.league import round as module
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.matches.evening import evening
from evenbreak.matches.pace import own_pace
from evenbreak.ratings.roster import Roster
from leagues import round_of

OFFERED = OfferedRaces((7, 13))


def test_it_prints_in_a_line():
    assert repr(round_of()) == "<Round of 6 pairs of 4 players>"
    assert repr(round_of().matchups) == "<RosterMatchups of 6 pairs>"


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


def test_the_evening_is_that_of_the_races_lengths():
    tonight = round_of(pairs=[[0, 1], [2, 3]], offered=OFFERED, pace=own_pace(8.0), tables=2)
    chart, best = tonight.evening
    assert (chart.races, best.races, chart.exact) == ("chart", "best", True)
    end = evening(tonight.matchups.chart_lengths, own_pace(8.0), tables=2)
    assert (chart.mean_minutes, chart.minutes_p90) == (end.mean, end.p90)
    assert round_of(pace=own_pace(8.0)).evening == []


@pytest.mark.slow
def test_a_simulated_evening_depends_on_its_seed_alone():
    def ends(seed):
        return round_of(pace=own_pace(8.0), tables=2, seed=seed).evening

    assert ends(0) == ends(0) != ends(1)
    assert not ends(0)[0].exact
    assert 0.0 < ends(0)[0].mean_minutes_error < 1.0


def test_pairs_without_a_race_take_no_table():
    apart = Roster(["A", "B", "C"], [90, 80, 70], np.full(3, np.nan), [9] * 3, component=[1, 1, 2])
    (end,) = round_of(apart, pace=own_pace(8.0), tables=1).evening
    assert end.matches == 1
