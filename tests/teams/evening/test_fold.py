"""The state of a team night follows from its events; what is unseen stays so."""

import json
from dataclasses import replace

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.level_chart import LEVEL_CHARTS, level_chart
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.teams.evening.events import (
    KINDS,
    Begun,
    Event,
    HandedIn,
    LevelsTonight,
    NightPlan,
    Proposed,
    PutUp,
    Result,
    Undone,
    meeting_of,
)
from evenbreak.teams.evening.fold import EVERYBODY, team_evening
from team_nights import AT, CUES, RACKS, after, plan

FIRST = (PutUp(0, 1, ("Ann",)), PutUp(1, 1, ("Wim",)))


def test_teams_name_in_turn():
    assert after().due == (0,)
    assert after(FIRST[0]).due == (1,)
    assert after(*FIRST).due == (1,)
    assert after(*FIRST).to_name.number == 2


def test_the_winner_names_first_once_the_result_is_in():
    assert after(*FIRST, order="winner").due == ()
    assert after(*FIRST, Result(1, (4, 1)), order="winner").due == (0,)
    assert after(*FIRST, Result(1, (1, 4)), order="winner").due == (1,)
    assert after(*FIRST, Result(1, (1, 4)), order="loser").due == (0,)


@pytest.mark.parametrize(
    ("count", "score"), [("sets", (1, 1)), ("games", (7, 4)), ("points", (4, 2))]
)
def test_the_score_is_counted_as_the_night_is(count, score):
    more = PutUp(1, 2, ("Vic",)), PutUp(0, 2, ("Bo",)), Result(2, (3, 4))
    assert after(*FIRST, Result(1, (4, 0)), *more, count=count).score == score


def test_two_teams_that_agree_enter_a_result_and_two_that_differ_do_not():
    one, other = Proposed(0, 1, (4, 2)), Proposed(1, 1, (4, 2))
    assert after(*FIRST, one).sets[0].score is None
    assert after(*FIRST, one, other).sets[0].score == (4, 2)
    differs = after(*FIRST, one, Proposed(1, 1, (2, 4)))
    assert (differs.sets[0].score, differs.sets[0].said) == (None, ((4, 2), (2, 4)))
    assert after(*FIRST, one, Proposed(1, 1, (2, 4)), other).sets[0].score == (4, 2)
    corrected = after(*FIRST, one, other, Result(1, (1, 4)))
    assert corrected.sets[0].score == (1, 4)


def test_undo_takes_back_one_event_after_another_up_to_the_night_before():
    assert after(*FIRST, Undone()).sets[0].picks == (("Ann",), ())
    assert after(*FIRST, Undone(), Undone()).due == (0,)
    first, second = plan(), plan(race=7)
    events = [Begun(first), FIRST[0], Begun(second), Undone()]
    state = team_evening(Event(AT, one) for one in events)
    assert (state.plan, state.began, state.due) == (first, 1, (1,))
    assert team_evening([Event(AT, Begun(first)), Event(AT, Undone())]) is None


def test_an_unseen_pick_is_left_out_until_both_are_in():
    state = after(FIRST[0], order="blind")
    assert state.due == (1,)
    assert state.seen_by(0).sets[0].picks == (("Ann",), ())
    for viewer in (EVERYBODY, 1):
        seen = state.seen_by(viewer)
        assert seen.sets[0].picks == ((), ())
        assert seen.sets[0].hidden == (True, False)
        assert seen.due == (1,)
    assert after(*FIRST, order="blind").seen_by(EVERYBODY).sets[0].picks == (("Ann",), ("Wim",))


def test_a_sealed_line_up_is_left_out_until_both_are_in():
    line_ups = [
        HandedIn(0, (("Bo",), ("Ann",), ("Cleo",))),
        HandedIn(1, (("Uli",), ("Vic",), ("Wim",))),
    ]
    one = after(line_ups[0], order="sealed")
    assert one.due == (1,)
    assert {line.picks for line in one.seen_by(1).sets} == {((), ())}
    both = after(*line_ups, order="sealed").seen_by(EVERYBODY)
    assert both.sets[2].picks == (("Cleo",), ("Wim",))


@pytest.mark.parametrize(
    "what",
    [
        Begun(plan(doubles=(3,), cap=16.0, at_most=(1, 6.0), order="blind")),
        FIRST[0],
        HandedIn(0, (("Ann",), ("Bo",))),
        Proposed(1, 2, (4, 1)),
        Result(1, (4, 3)),
        Undone(),
    ],
)
def test_events_survive_as_plain_data(what):
    assert KINDS.read(KINDS.name(what), KINDS.text(what)) == what


def test_what_is_no_event_is_refused():
    with pytest.raises(InputError, match="number is missing"):
        KINDS.read("put up", '{"team": 1}')
    with pytest.raises(InputError, match="isn't a type of entry"):
        KINDS.read("put down", '{"team": 1}')


def by_levels(chart: str) -> NightPlan:
    """Return a night by the levels of a chart, as one whose file was written keeps them."""
    kept = LevelsTonight.of(level_skills(chart))
    weights = (float(level_chart(chart).levels[0]),) * 4
    teams = tuple(replace(team, weights=weights[: len(team.players)]) for team in (RACKS, CUES))
    held = KINDS.text(Begun(plan(chart=chart, by_level=True, levels=kept)))
    json.loads(held, parse_constant=pytest.fail)  # NaN is no JSON
    read = KINDS.read("begun", held)
    assert isinstance(read, Begun)
    return replace(read.plan, teams=teams)


@pytest.mark.parametrize("chart", LEVEL_CHARTS)
def test_a_night_keeps_how_strong_levels_are(chart):
    night, usual = by_levels(chart), level_skills(chart)
    held = meeting_of(night).levels
    earlier = meeting_of(replace(night, levels=None)).levels  # of an earlier version
    for found in (held, earlier):
        for name, value in vars(usual).items():
            np.testing.assert_array_equal(getattr(found, name), value)


def test_levels_that_are_not_those_of_the_chart_are_refused():
    night = by_levels("apa_8ball")
    for wrong in (
        {"gaps": night.levels.gaps[1:]},
        {"errors": ((0.0,), *night.levels.errors[1:])},
        {"points": (0.0,)},
        {"source": "guess"},
    ):
        with pytest.raises(InputError, match=next(iter(wrong))):
            meeting_of(replace(night, levels=replace(night.levels, **wrong)))
