"""How soon the watch flags a sandbagger, in words and numbers."""

import numpy as np

from evenbreak.answers.sandbag_power import sandbag_power_answer
from evenbreak.league import WatchPower


def kind(share, points, flagged):
    many = np.array(flagged)
    return WatchPower(share, points, 100, many, 0.1 * many, -10.0 * many, 0.5)


HONEST = kind(0.0, None, [0.0, 0.0, 0.0, 0.01])
PLAIN = kind(0.5, 120, [0.1, 0.5, 0.8, 0.9])
HIDDEN = kind(0.25, None, [0.0, 0.0, 0.0, 0.02])


def asked(*kinds):
    return sandbag_power_answer(kinds, "npl_10", alpha=0.01, honest="any", replicas=100)


def test_the_easiest_and_the_hardest_kind_are_named_and_the_honest():
    text = asked(HONEST, HIDDEN, PLAIN).sentences[0]
    assert "Within 4 matches" in text
    assert "90% of players who dump 50%" in text
    assert "2% of players who dump 25%" in text
    assert "1% of honest players" in text


def test_honest_players_alone():
    assert asked(HONEST).sentences[0].endswith("1% of honest players.")


def test_files_have_a_row_for_each_kind_and_quarter():
    answer = asked(HONEST, PLAIN)
    assert answer.to_frame()["matches"].tolist() == [1, 2, 3, 4] * 2
    kinds = answer.to_dict()["kinds"]
    assert kinds[1]["flagged"] == [0.1, 0.5, 0.8, 0.9]
    assert (answer.to_dict()["alpha"], answer.to_dict()["replicas"]) == (0.01, 100)
