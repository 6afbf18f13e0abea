import pytest

from evenbreak.answers.match.odds import TwoPlayers, match_words, odds_answer
from evenbreak.games import Ahead, Race, Rack, alternate_breaks
from evenbreak.matches import match_odds

RACK = Rack(0.6)


def answer_of(match):
    return odds_answer(TwoPlayers(match.innermost_rack), match)


def test_the_quantities_are_those_of_match_odds():
    match = Race(7, 5, RACK, score=(1, 2))
    told, odds = answer_of(match).to_dict(), match_odds(match)
    assert (told["p_win_a"], told["p_win_b"]) == (odds.p_win_1, odds.p_win_2)
    assert (told["mean_games"], told["games_p90"]) == (odds.mean_games, odds.games_p90)
    assert told["p_hill_hill"] == odds.p_hill_hill


@pytest.mark.parametrize(("p", "favorite"), [(0.6, "A"), (0.3, "B")])
def test_the_favorite_comes_first(p, favorite):
    assert answer_of(Race(5, 5, Rack(p))).sentences[0].startswith(favorite)


def test_a_winner_is_certain_only_if_the_other_cannot_win():
    (sentence,) = answer_of(Race(9, 9, Rack(1.0))).sentences[:1]
    assert "100%" in sentence
    (sentence,) = answer_of(Race(9, 9, Rack(0.999))).sentences[:1]
    assert "100%" not in sentence


def test_exact_chances_are_there_if_asked_for():
    match = Race(2, 1, RACK)
    exact = odds_answer(TwoPlayers(RACK), match, exact=True)
    assert exact.to_dict()["p_win_b_exact"] == "16/25"
    assert "9/25 = 0.36" in exact.sentences[1]


def test_a_match_that_is_over_has_no_odds_in_words():
    over = answer_of(Race(3, 3, RACK, score=(1, 3)))
    assert over.sentences[0].startswith("B")
    assert "%" not in over.sentences[0]


def test_a_match_without_end_has_no_length():
    match = Ahead(2, 2, Rack(1.0, 1.0), breaks=alternate_breaks)
    answer = odds_answer(TwoPlayers(match.rack, "alternate"), match)
    assert answer.to_dict()["p_never_ends"] == 1.0
    assert "games, on average" not in str(answer)


@pytest.mark.parametrize(
    ("match", "words"),
    [
        (Race(7, 5, RACK), "Race 7:5"),
        (Race(7, 7, RACK, win_by=2, score=(1, 2)), "Race 7:7, win by 2, score 1-2"),
        (Race(3, 1, Race(3, 3, RACK)), "Race 3:1 in sets of 3:3"),
        (Ahead(5, 3, RACK), "First to lead by 5 (A) or 3 (B)"),
        (Ahead(4, 4, RACK), "First to lead by 4"),
        (Race(3, 3, RACK, score=(1, 3)), "Race 3:3, score 1-3: B has won"),
    ],
)
def test_a_match_in_words(match, words):
    assert match_words(match) == words
