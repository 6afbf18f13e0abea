"""What a night is worth at each moment: the same to both teams together, and as advised."""

import itertools

import numpy as np
import pytest

from evenbreak.teams.advice import advice
from evenbreak.teams.evening.events import HandedIn, PutUp, Result
from evenbreak.teams.evening.outlook import chance, point_of, side_of
from evenbreak.teams.sealed import sealed
from evenbreak.teams.solve import solved
from team_nights import after

PAIRS = [("Ann", "Wim"), ("Bo", "Vic"), ("Cleo", "Uli")]


def moments(order):
    """Yield what has happened at each moment of a night."""
    done = []
    for number, pair in enumerate(PAIRS, 1):
        for _ in pair:
            yield tuple(done)
            team = after(*done, order=order).due[0]
            done.append(PutUp(team, number, (pair[team],)))
        yield tuple(done)
        done.append(Result(number, (4, 2) if number != 2 else (1, 4)))
    yield tuple(done)


@pytest.mark.parametrize("order", ["alternate", "AWL", "blind"])
def test_the_other_side_is_the_night_solved_the_other_way_round(order):
    side = side_of(after(order=order, count="games")).mirrored()
    own = solved(side.meeting.night())
    for mirrored, direct in zip(side.solution.values, own.values, strict=True):
        assert np.allclose(mirrored, direct)


def test_the_other_side_of_sealed_line_ups():
    side = side_of(after(order="sealed", cap=15)).mirrored()
    own = sealed(side.meeting.night())
    assert side.solution.worth == pytest.approx(own.worth)
    assert [one.names for one in side.solution.ours] == [one.names for one in own.ours]
    shares = [one.mix for one in own.ours]
    assert [one.mix for one in side.solution.ours] == pytest.approx(shares, abs=1e-6)


@pytest.mark.slow_after(4)
@pytest.mark.parametrize("order", ["home", "blind", "AWW", "ALL"])
@pytest.mark.parametrize("count", ["sets", "games"])
def test_the_chances_of_both_teams_add_up_to_one(order, count):
    for done in moments(order):
        state = after(*done, order=order, count=count)
        sides = [side_of(state), side_of(state).mirrored()]
        assert sum(chance(side, state) for side in sides) == pytest.approx(1.0)
    assert chance(sides[0], state) == pytest.approx(1.0)


def test_the_chance_is_that_of_the_best_pick():
    state = after(PutUp(0, 1, ("Ann",)))
    for team in (0, 1):
        side = side_of(state) if team == 0 else side_of(state).mirrored()
        found = advice(side.solution, point_of(state, team))
        assert found.ours == (team == 1)
        assert chance(side, state) == found.best.worth


def test_the_last_sets_are_worth_what_their_races_are():
    done = [*moments("home")][-2]  # the last set is being played at 1:1
    state = after(*done, order="home")
    law = state.meeting.law_in_play(("Cleo",), ("Uli",))
    assert chance(side_of(state), state) == pytest.approx(law[0].sum())


def test_who_names_next_is_averaged_over_the_set_in_play():
    done = (PutUp(0, 1, ("Ann",)), PutUp(1, 1, ("Wim",)))
    state = after(*done, order="loser")
    won, lost = (after(*done, Result(1, score), order="loser") for score in ((4, 0), (0, 4)))
    law = state.meeting.law_in_play(("Ann",), ("Wim",)).sum(axis=1)
    side = side_of(state)
    expected = law @ [chance(side, won), chance(side, lost)]
    assert chance(side, state) == pytest.approx(expected)


def test_a_correction_leaves_standing_whoever_has_named_first():
    done = PutUp(0, 1, ("Ann",)), PutUp(1, 1, ("Wim",)), Result(1, (4, 0)), PutUp(1, 2, ("Vic",))
    states = [after(*done, *more, order="loser") for more in ((), (Result(1, (0, 4)),))]
    assert [state.due for state in states] == [(0,), (0,)]
    chances = [chance(side_of(state), state) for state in states]
    assert chances[0] > chances[1]


def test_an_unseen_pick_changes_no_chance():
    for order, done in [
        ("blind", PutUp(0, 1, ("Dan",))),
        ("sealed", HandedIn(0, (("Dan",), ("Cleo",), ("Bo",)))),
    ]:
        before, since = after(order=order), after(done, order=order)
        for team in (0, 1):
            side = side_of(before) if team == 0 else side_of(before).mirrored()
            assert chance(side, before) == chance(side, since)


def test_sealed_line_ups_that_are_in_are_worth_their_pairings():
    line_ups = [HandedIn(team, tuple((pair[team],) for pair in PAIRS)) for team in (0, 1)]
    state = after(*line_ups, order="sealed")
    p = [state.meeting.law_in_play((a,), (b,))[0].sum() for a, b in PAIRS]
    two_or_more = sum(
        np.prod([q if won else 1 - q for q, won in zip(p, outcome, strict=True)])
        for outcome in itertools.product((0, 1), repeat=3)
        if sum(outcome) >= 2
    )
    assert chance(side_of(state), state) == pytest.approx(two_or_more)
