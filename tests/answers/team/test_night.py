"""How a team night stands, in words; what is unseen is not said."""

from dataclasses import replace

import pytest

from evenbreak.answers.team.night import (
    cap_words,
    history_words,
    last_words,
    needed_words,
    night_words,
    waiting_words,
)
from evenbreak.teams.evening.events import Begun, Event, HandedIn, PutUp, Result, Undone
from evenbreak.teams.evening.fold import team_evening
from team_nights import AT, after, plan

NAMED = [
    PutUp(team, number, (name,))
    for number, pair in enumerate((("Ann", "Wim"), ("Bo", "Vic"), ("Dan", "Uli")), 1)
    for team, name in enumerate(pair)
]


def results(*scores):
    return [Result(number, score) for number, score in enumerate(scores, 1)]


@pytest.mark.parametrize(
    ("scores", "how", "chances", "words"),
    [
        ([], {}, (0.5, 0.5), "Racks needs 2 of the 3 sets left, and Cues needs 2"),
        ([(4, 1)], {}, None, "Racks needs 1 of the 2 sets left, and Cues needs 2"),
        ([(4, 1), (4, 1)], {}, (1.0, 0.0), "Racks has won"),
        ([(4, 1), (1, 4), (0, 4)], {}, None, "Cues has won"),
        ([(4, 1)], {"count": "games"}, (0.8, 0.2), "Racks leads by 3 games with 2 sets"),
        ([(2, 4)], {"count": "points"}, (0.3, 0.7), "Cues leads by 2 points with 2 sets"),
        ([(4, 1), (1, 4)], {"count": "games"}, None, "tied with 1 set"),
        ([(4, 1), (1, 4), (4, 0)], {"sets": 3, "count": "games"}, None, "Racks has won"),
    ],
)
def test_what_is_needed(scores, how, chances, words):
    assert words in needed_words(after(*NAMED, *results(*scores), **how), chances)


def test_a_tie_is_no_win():
    state = after(*NAMED[:4], *results((4, 0), (0, 4)), sets=2)
    assert "tie" in needed_words(state, (0.5, 0.5))


def test_what_is_played():
    assert night_words(after(handicapped=True)) == "3 sets, the fairest races to 4"
    assert night_words(after(count="games")) == "3 sets, races to 4, all games count"


def test_a_cap_says_who_cannot_be_put_up():
    assert cap_words(after(), 0) == []
    assert cap_words(after(cap=15), 0)[1].startswith("Every player")
    state = after(NAMED[0], NAMED[1], NAMED[3], NAMED[2], cap=15)
    assert cap_words(state, 0)[0] == "So far, the sum of the levels is 11; the limit is 15."
    assert cap_words(state, 0)[1].startswith("Cleo can't be put up in set 3")
    assert cap_words(after(order="sealed", cap=15), 0) == []


@pytest.mark.parametrize("order", ["ABA", "BAB", "blind", "winner"])
def test_the_sum_under_a_cap_counts_who_has_just_been_put_up(order):
    """Nomination by nomination, for both teams, as each captain sees it."""
    orders = {"ABA": (0, 1, 0), "BAB": (1, 0, 1), "blind": (0, 0, 1), "winner": (0, 0, 0)}
    counts = {"Ann": 6, "Bo": 5, "Dan": 4, "Wim": 4, "Vic": 5, "Uli": 6}
    happened, sums = [], [0, 0]
    for number, first in enumerate(orders[order], 1):
        pair = NAMED[2 * number - 2 : 2 * number]
        for put in (pair[first], pair[1 - first]):
            happened.append(put)
            sums[put.team] += counts[put.pick[0]]
            state = after(*happened, order=order, cap=15)
            for team in (0, 1):
                words = cap_words(state.seen_by(team), team)
                spent = f"the sum of the levels is {sums[team]}; the limit is 15."
                assert words[0] == f"So far, {spent}"
        happened.append(Result(number, (4, 1)))


def test_who_waits_for_an_answer_is_not_told_who_can_still_be_put_up():
    assert len(cap_words(after(NAMED[0], order="ABA", cap=15), 0)) == 1
    assert len(cap_words(after(NAMED[0], order="ABA", cap=15), 1)) == 2
    assert len(cap_words(after(NAMED[0], order="blind", cap=15), 0)) == 2  # it can be changed


def test_what_the_next_pick_waits_for():
    assert waiting_words(after()) == ""
    assert "loser of set 1" in waiting_words(after(*NAMED[:2], order="loser"))
    assert waiting_words(after(*NAMED[:2], *results((4, 0)), order="loser")) == ""


def test_an_unseen_pick_is_not_said_even_once_it_is_undone():
    for order, what in (
        ("blind", PutUp(0, 1, ("Ann",))),
        ("sealed", HandedIn(0, (("Ann",), ("Bo",), ("Dan",)))),
    ):
        for more in ([], [Undone()]):
            events = [Event(AT, one) for one in (Begun(plan(order=order)), what, *more)]
            state = team_evening(events)
            assert "Ann" not in " ".join([*history_words(events, state), last_words(state)])
    shown = after(NAMED[0], NAMED[1], order="blind")
    assert last_words(shown) == "Cues put up Wim in set 1"


def test_a_night_that_an_undo_brings_back_has_its_own_names_again():
    first, second = plan(), replace(plan(), teams=plan().teams[::-1])
    what = [Begun(first), Begun(second), Undone(), PutUp(0, 1, ("Ann",))]
    events = [Event(AT, one) for one in what]
    lines = history_words(events, team_evening(events))
    assert lines[1] == "night started: Cues against Racks"
    assert lines[3] == "Racks put up Ann in set 1"
