from evenbreak.answers.chart.show import team_handicap_answer
from evenbreak.handicaps import team_handicap
from evenbreak.ratings.scale import SCALES


def answer(first, second):
    found = team_handicap(first, second)
    return team_handicap_answer((first, second), found, match_ups=3, scale=SCALES["fargo"])


def test_json_has_what_was_found():
    found, quantities = team_handicap(447, 417), answer(447, 417).to_dict()
    assert (quantities["points"], quantities["to_team"]) == (4, 2)
    assert quantities["even_points"] == found.even_points


def test_nobody_gets_points_in_words():
    assert "Neither" in answer(430, 430).sentences[0]
    assert answer(430, 430).to_dict()["to_team"] is None
