"""What captains and the director may do, and what a second tap does: nothing."""

import pytest

from evenbreak.errors import InputError
from evenbreak.teams.evening import moves
from evenbreak.teams.evening.events import HandedIn, Proposed, PutUp, Result, check_plan
from evenbreak.teams.evening.moves import choices
from rows import each_of
from team_nights import after, plan

ANN, WIM = PutUp(0, 1, ("Ann",)), PutUp(1, 1, ("Wim",))
LINE_UP = HandedIn(0, (("Bo",), ("Ann",), ("Cleo",)))


def test_what_is_there_already_gives_no_event():
    state = after(ANN, WIM, Proposed(0, 1, (4, 2)))
    assert moves.put_up(state, 0, 1, ("Ann",)) == []
    assert moves.propose(state, 0, 1, (4, 2)) == []
    assert moves.result(after(ANN, WIM, Result(1, (4, 2))), 1, (4, 2)) == []
    assert moves.hand_in(after(LINE_UP, order="sealed"), 0, LINE_UP.picks) == []
    assert moves.begin(after(), plan()) == []
    assert len(moves.begin(after(ANN), plan())) == 1


@each_of(
    "state, move, why",
    [
        (after(), lambda s: moves.put_up(s, 1, 1, ("Wim",)), "Racks puts up first"),
        (after(ANN), lambda s: moves.put_up(s, 0, 1, ("Bo",)), "already"),
        (after(ANN), lambda s: moves.put_up(s, 1, 2, ("Wim",)), "set 1 is next"),
        (after(ANN), lambda s: moves.put_up(s, 1, 1, ("Uli", "Vic")), "1 player in"),
        (after(ANN, WIM), lambda s: moves.put_up(s, 1, 2, ("Wim",)), "can't be put up"),
        (after(ANN, WIM, order="winner"), lambda s: moves.put_up(s, 0, 2, ("Bo",)), "result"),
        (after(), lambda s: moves.propose(s, 0, 1, (4, 0)), "has no players"),
        (after(), lambda s: moves.result(s, 9, (4, 0)), "no set 9"),
        (after(ANN, WIM), lambda s: moves.propose(s, 0, 1, (4, 4)), "can't be the final score"),
        (
            after(ANN, WIM, Result(1, (4, 0))),
            lambda s: moves.propose(s, 0, 1, (0, 4)),
            "director can correct",
        ),
        (after(), lambda s: moves.hand_in(s, 0, LINE_UP.picks), "aren't sealed"),
        (after(order="sealed"), lambda s: moves.put_up(s, 0, 1, ("Ann",)), "sealed"),
        (
            after(order="sealed"),
            lambda s: moves.hand_in(s, 0, (("Bo",), ("Bo",), ("Ann",))),
            "more often",
        ),
        (
            after(order="sealed", cap=15),
            lambda s: moves.hand_in(s, 0, (("Ann",), ("Bo",), ("Cleo",))),
            "the limit is 15",
        ),
        (after(order="sealed"), lambda s: moves.hand_in(s, 0, (("Bo",),)), "3 players"),
        (
            after(order="sealed"),
            lambda s: moves.hand_in(s, 0, (("Bo",), ("Uli",), ("Ann",))),
            "isn't in the squad",
        ),
    ],
)
def test_what_cannot_be_is_refused(state, move, why):
    with pytest.raises(InputError, match=why):
        move(state)


def test_an_unseen_pick_may_be_changed_until_the_other_is_in():
    assert moves.put_up(after(ANN, order="blind"), 0, 1, ("Bo",)) == [PutUp(0, 1, ("Bo",))]
    with pytest.raises(InputError, match="already"):
        moves.put_up(after(ANN, WIM, order="blind"), 0, 1, ("Bo",))


def test_a_pair_is_taken_in_any_order():
    state = after(doubles=(1,), sets=2)
    assert moves.put_up(state, 0, 1, ("Bo", "Ann")) == [PutUp(0, 1, ("Ann", "Bo"))]


def test_who_can_still_be_put_up_under_a_cap():
    # Ann counts 6, Bo 5, Cleo 5, Dan 4: with Ann in, 15 leaves room for Dan and a five.
    state = after(ANN, WIM, cap=15)
    found = choices(state, 0)
    assert found.picks == (("Bo",), ("Cleo",), ("Dan",))
    assert (found.used_up, found.barred) == (("Ann",), ())
    assert (found.caps[0].total, found.caps[0].most) == (6, 15)
    more = after(ANN, WIM, PutUp(1, 2, ("Vic",)), PutUp(0, 2, ("Bo",)), cap=15)
    assert choices(more, 0).barred == ("Cleo",)


@pytest.mark.parametrize(
    ("how", "why"),
    [
        ({"cap": 5}, "no lineup"),
        ({"sets": 4}, "can't fill"),
        ({"race": 0}, "race must"),
        ({"doubles": (9,)}, "set 9"),
        ({"order": "sideways"}, "order 'sideways'"),
        ({"order": "sealed", "doubles": (1,), "sets": 2}, "sealed"),
        ({"count": "beers"}, "count must"),
    ],
)
def test_a_night_that_cannot_be_played_is_refused(how, why):
    with pytest.raises(InputError, match=why):
        check_plan(plan(**how))


def test_a_night_that_can_be_played_is_taken():
    check_plan(plan(handicapped=True, order="loser", count="points", at_most=(1, 6.0)))
    check_plan(plan(race=0, chart="fargo_r6_hot", times=2, sets=5))
