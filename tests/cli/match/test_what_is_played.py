"""The options that describe the match, as `odds` takes them."""

import pytest

from evenbreak.answers.match.asked import match_of
from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.fields.question import AskedError
from evenbreak.games import Ahead, Race, Rack, alternate_breaks
from evenbreak.questions.match import Odds


def match(**options):
    return match_of(Odds(**{"p": 0.6} | options))[1]


def test_the_players_come_with_the_match():
    assert match_of(Odds(p=0.6, race=(7, 5)))[0] == TwoPlayers(Rack(0.6))


def test_a_race_perhaps_from_a_score_and_won_by_two():
    assert match(race=(7, 5)) == Race(7, 5, Rack(0.6))
    assert match(race=(7, 5), score=(1, 2), win_by=2) == Race(
        7, 5, Rack(0.6), score=(1, 2), win_by=2
    )


def test_ahead():
    assert match(ahead=(5, 3)) == Ahead(5, 3, Rack(0.6))


def test_sets_carry_the_break_on():
    breaking = {"p": None, "p1": 0.6, "p2": 0.5, "breaks": "alternate", "first_break": "b"}
    found = match(**breaking, race=(3, 1), set_=(3, 3))
    assert found.breaks is None
    assert found.rack.breaks is alternate_breaks
    assert found.start == (0, 0, (0, 0, 2))


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({}, "race"),
        ({"race": (7, 7), "ahead": (2, 2)}, "ahead"),
        ({"race": (7, 7), "set_": (2, 2), "win_by": 2}, "set_"),
        ({"ahead": (7, 7), "win_by": 2}, "ahead"),
    ],
)
def test_what_contradicts_itself_is_refused(options, named):
    with pytest.raises(AskedError, match=named):
        match(**options)
