from evenbreak.answers.match.odds import TwoPlayers, fair_answer
from evenbreak.games import Rack
from evenbreak.handicaps import fair_races

RACK = Rack(0.6)


def test_the_fairest_race_leads_and_all_are_listed():
    races = fair_races(RACK, race_to=7, top=3)
    answer = fair_answer(TwoPlayers(RACK), races)
    assert "7:5" in answer.sentences[0]
    assert [(row["race_a"], row["race_b"]) for row in answer.to_dict()["races"]] == [
        (race.race_1, race.race_2) for race in races
    ]


def test_a_target_is_named():
    races = fair_races(RACK, race_to=7, target=0.7, top=1)
    answer = fair_answer(TwoPlayers(RACK), races, target=0.7)
    assert "70%" in answer.sentences[0]
    assert answer.to_dict()["target"] == 0.7
