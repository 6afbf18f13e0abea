"""A tournament in words: what is raced to, who is in a slot, whose first round is a bye."""

import numpy as np

from evenbreak.answers.tournament.tournament import Tournament, races_words, slot_words
from evenbreak.files.lists.roster import RosterFile
from evenbreak.handicaps import chart
from evenbreak.ratings import SCALES, Roster
from evenbreak.tournaments import Races, double_elimination, groups_then_knockout


def tournament(races, names=("Ann", "Bo", "Cy", "Di", "Ed")):
    club = Roster(names, 600.0 - 20.0 * np.arange(len(names)))
    file = RosterFile(club, np.arange(len(names)), "a/club.csv", (), "")
    bracket = double_elimination(club.players)
    return Tournament(file, club, bracket, races, SCALES["fargo"], "seeded")


def test_words():
    tonight = tournament(Races(chart("npl_10")))
    assert tonight.byes == "Byes in the first round: Ann, Bo, Cy."
    assert "club.csv" in tonight.heading
    assert "a/club.csv" not in tonight.heading
    assert "npl_10" in races_words(tonight.races)
    groups = groups_then_knockout(8, 2)
    last = groups.matches[-1]
    assert slot_words(groups, groups.by_name["K1.1"].slots[0]).startswith("number 1 in")
    assert "winner of" in slot_words(groups, last.slots[0])
