import pytest

from evenbreak.answers.match.live import live_answer
from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.games import Race, Rack
from evenbreak.matches import live_odds

RACK = Rack(0.6)


def answer_of(match, winners=(), **options):
    return live_answer(TwoPlayers(RACK), match, live_odds(match, winners), **options)


def test_the_course_is_one_row_a_moment_and_ends_now():
    answer = answer_of(Race(7, 5, RACK), [1, 2, 2])
    told = answer.to_dict()
    assert [row["won_by"] for row in told["course"]] == [None, "a", "b", "b"]
    assert told["now"] == told["course"][-1]
    assert answer.to_frame().shape[0] == 4
    assert len(told["comebacks"]) == 6 * 3


def test_files_hold_the_comebacks_where_they_are_asked_for():
    frame = answer_of(Race(2, 1, RACK), comebacks=True).to_frame()
    assert frame[["score_a", "score_b"]].to_numpy().tolist() == [[0, 0], [1, 0]]


def test_the_turning_point_is_the_game_that_moved_most():
    answer = answer_of(Race(3, 3, RACK), [1, 2, 2])
    odds = live_odds(Race(3, 3, RACK), [1, 2, 2])
    most = max(range(3), key=lambda i: abs(odds.swings[i]))
    assert f"Game {most + 1} " in answer.sentences[-1]
    before, after = (100 * standing.p_win_2 for standing in odds.course[most : most + 2])
    assert f"{before:.0f}% to {after:.0f}%" in answer.sentences[-1]


@pytest.mark.parametrize(("winners", "name"), [([1, 1], "A"), ([2, 2], "B")])
def test_a_match_that_is_over_names_the_winner(winners, name):
    answer = answer_of(Race(2, 2, RACK), winners)
    assert answer.sentences[0] == f"{name} has won the match."


def test_nobody_is_certain_who_can_still_lose():
    match = Race(9, 9, Rack(0.999))
    text = live_answer(TwoPlayers(match.innermost_rack), match, live_odds(match, "")).sentences[0]
    assert "100%" not in text
