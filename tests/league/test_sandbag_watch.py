"""The watch over a season: alarms, what they rest on, and who is left alone."""

import math

import numpy as np
import pytest

from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps import Ladder, chart, system_of
from evenbreak.league.sandbag_watch import Watched, played_nights, watch
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster

NPL, TEN = system_of("npl"), chart("npl_10")
LAW = Ladder("npl", TEN).law()


def season(matches=24):
    """Bo is beaten to nothing every other match and wins the rest easily."""
    club = Roster(["Ann", "Bo", "Cy"], [80, 80, 80])
    names, score_a, score_b = [], [], []
    for place in range(matches):
        names.append("Ann" if place % 2 else "Cy")
        bo_wins = place % 2 == 0
        score_a.append(5 if bo_wins else 0)
        score_b.append(1 if bo_wins else 5)
    return club, Results.from_names(
        ["Bo"] * matches,
        names,
        score_a,
        score_b,
        race_a=[5] * matches,
        race_b=[5] * matches,
        event=["cup" if place % 2 == 0 else "league" for place in range(matches)],
    )


def watched(**asked):
    club, results = season()
    return {one.player: one for one in watch(played_nights(NPL, club, results), NPL, LAW, **asked)}


def test_a_player_with_two_ways_of_playing_is_flagged_and_others_are_not():
    found = watched()
    assert list(found) == ["Ann", "Bo", "Cy"]
    bo = found["Bo"]
    assert bo.alarm is not None
    assert bo.log_e[bo.alarm] >= math.log(100.0) > bo.log_e[: bo.alarm].max()
    assert bo.p_value == 1.0 / bo.largest_e < 0.01
    assert found["Ann"].alarm is None is found["Cy"].alarm
    assert bo.won.tolist() == [True, False] * 12
    assert found["Cy"].rows.tolist() == list(range(0, 24, 2))


def test_known_events_flag_sooner_and_wrong_ones_never():
    _, results = season()
    league = results.event == "league"
    known, wrong = watched(marked=league)["Bo"], watched(marked=~league)["Bo"]
    assert known.alarm < watched()["Bo"].alarm
    assert wrong.alarm is None


@pytest.mark.parametrize("honest", ["any", "established"])
def test_tried_events_enter_the_evidence_by_their_average(honest):
    _, results = season()
    league = results.event == "league"
    events = {"league": league, "cup": ~league}
    found = watched(tried=events, honest=honest)
    alone = [watched(marked=rows, honest=honest) for rows in (None, *events.values())]
    for name, one in found.items():
        each = [np.exp(other[name].log_e) for other in alone]
        assert np.exp(one.log_e) == pytest.approx(np.mean(each, axis=0))
    assert found["Bo"].event == "league"
    assert all(one.alarm is not None for one in found.values() if one.event)
    assert watched(honest=honest)["Bo"].event is None


def test_against_established_players_the_evidence_is_another():
    bo = watched(honest="established")["Bo"]
    assert bo.e_value == pytest.approx(math.exp(bo.established[-1]))
    assert bo.any.tolist() == watched()["Bo"].any.tolist()
    assert bo.honest == "established"


def test_a_season_without_matches_has_no_players():
    assert watch([], NPL, LAW) == []


@pytest.mark.parametrize("alpha", [0.0, 1.0, math.nan])
def test_alpha_is_a_chance(alpha):
    with pytest.raises(InputError, match="alpha"):
        watch([], NPL, LAW, alpha=alpha)


def test_the_honest_are_of_two_kinds():
    with pytest.raises(InputError, match="honest must be 'any' or 'established'; you gave 'all'"):
        watch([], NPL, LAW, honest="all")


def test_e_is_held_where_a_float_ends():
    rows, e = np.arange(1), np.array([1e6])
    one = Watched("Ann", rows, rows > 0, e, e, "any", 0.01)
    assert math.isfinite(one.e_value)
    assert one.p_value > 0.0


def test_the_form_of_the_day_is_no_sandbagging():
    told = watched(day_sd=60.0)["Bo"]
    assert told.log_e.max() < watched()["Bo"].log_e.max()
    with pytest.raises(InputError, match="day_sd must be a number from 0 to 120; you gave 500"):
        watched(day_sd=500.0)


def test_ratings_on_another_scale_are_refused():
    club = Roster(["Ann", "Bo"], [80, 20_000])
    results = Results.from_names(["Ann"], ["Bo"], [50], [0], race_a=[50], race_b=[50])
    with pytest.raises(AccuracyError, match=r"'Ann': .* on the system's scale"):
        watch(played_nights(NPL, club, results), NPL, LAW)
