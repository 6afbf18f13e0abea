import itertools
import re

import pytest

from evenbreak.answers.faces.to_csv import to_csv
from evenbreak.answers.faces.to_text import to_text
from evenbreak.answers.league import matchups
from evenbreak.answers.league import round as round_module
from evenbreak.answers.league.matchups import matchups_answer
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.matches.pace import own_pace
from evenbreak.ratings.roster import Roster
from leagues import CLUB, round_of

OFFERED = OfferedRaces((7, 13))


def test_files_have_the_columns_of_the_frame():
    tonight = round_of(offered=OFFERED, pace=own_pace(8.0))
    table = matchups_answer(tonight).csv
    assert table.names == list(tonight.matchups.frame.columns)
    for record, row in zip(
        table.records(), tonight.matchups.frame.itertuples(index=False), strict=True
    ):
        assert record == [None if value != value else value for value in row]


@pytest.mark.parametrize("sure", [True, False])
def test_the_plug_in_chance_is_a_detail_where_it_differs(sure):
    tonight = round_of(Roster(["Ann", "Bo"], [92, 71], None if sure else [9, 9]))
    answer = matchups_answer(tonight)
    assert ("uncertain the" in to_text(answer)) == (not sure)
    assert ("if ratings" in to_text(answer, verbose=True)) == (not sure)
    assert "if ratings" not in to_text(answer)


def test_with_both_kinds_the_chart_comes_first():
    text = to_text(matchups_answer(round_of(offered=OFFERED, pace=own_pace(8.0))))
    (heads,) = (line for line in text.splitlines() if re.fullmatch(r"\s+chart\s+fair", line))
    assert heads
    assert max(map(len, text.splitlines())) <= 80


def test_a_pair_without_a_race_has_empty_cells():
    apart = Roster(["Ann", "Bo", "Cy"], [92, 80, 71], None, [9] * 3, component=[1, 1, 2])
    answer = matchups_answer(round_of(apart, offered=OFFERED))
    rows = answer.to_dict()["pairs"]
    assert [row["race_a"] is None for row in rows] == [False, True, True]
    assert to_text(answer).count("Ann  Cy\n") == 1
    assert "2 pairs without a race" in answer.sentences[-1]


def test_of_many_pairs_rows_are_worked_out_only_as_they_are_read(monkeypatch):
    whole = list(to_csv(matchups_answer(round_of(offered=OFFERED))))
    for module in (matchups, round_module):
        monkeypatch.setattr(module, "AT_A_TIME", 2)
    tonight = round_of(offered=OFFERED)
    answer = matchups_answer(tonight)
    assert list(to_csv(answer)) == whole == list(to_csv(answer))
    assert "matchups" not in vars(tonight)
    assert list(itertools.islice(answer.csv.rows, 1))
    assert len(answer.sentences[0].split(". ")) == 1


def test_warnings_are_those_of_the_list_and_of_the_command():
    answer = matchups_answer(
        round_of(CLUB, warnings=("club.csv: is odd",)), warnings=["so is this"]
    )
    assert answer.warnings == ["club.csv: is odd", "so is this"]
