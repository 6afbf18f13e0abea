"""A league's roster: skills, days, drift and weeks, and all that is wrong at once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from evenbreak.errors import DataError
from evenbreak.files.lists.season import read_season_players
from evenbreak.league.players import ESTABLISHED

WHOLE = """\
Name;Rating;SE;Games;Matches;Skill;Day SD;Drift;Joins;Leaves;Absence
Ann;92,4;9;140;25;95,5;4;0,1;;;
Bo;71,5;12;20;;;;;3;20;0,25
Cy;60;;;0;;0;;;;
"""


def club(folder: Path, text: str) -> Path:
    path = folder / "club.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_every_column_is_read(tmp_path: Path) -> None:
    file = read_season_players(club(tmp_path, WHOLE), day_sd=6.0)
    players = file.players
    assert players.names == ("Ann", "Bo", "Cy")
    assert players.rating.tolist() == [92, 72, 60]
    assert players.skill.tolist() == [95.5, 71.5, 60.0]
    assert players.skill_sd.tolist() == [0.0, 12.0, 0.0]
    assert players.day_sd.tolist() == [4.0, 6.0, 0.0]
    assert players.drift.tolist() == [0.1, 0.0, 0.0]
    assert (players.joins.tolist(), players.leaves.tolist()) == ([1, 3, 1], [0, 20, 0])
    assert players.absence.tolist() == [0.0, 0.25, 0.0]
    assert players.played.tolist() == [25, ESTABLISHED, 0]
    assert (file.drawn, file.exact) == (1, 1)
    assert file.warnings == (
        f"{tmp_path}/club.csv: 2 ratings were rounded to whole points, because charts need them",
    )


def test_a_plain_roster_is_enough(tmp_path: Path) -> None:
    file = read_season_players(club(tmp_path, "player,rating,standard_error\nAnn,92,9\nBo,71,12\n"))
    assert file.players.skill.tolist() == [92.0, 71.0]
    assert file.players.skill_sd.tolist() == [9.0, 12.0]
    assert file.players.day_sd.tolist() == [0.0, 0.0]
    assert (file.drawn, file.exact, file.warnings) == (2, 0, ())
    assert not np.isnan(file.players.absence).any()


def test_all_problems_are_told_at_once(tmp_path: Path) -> None:
    text = """\
player,rating,skill,day_sd,drift,joins,leaves,absence,standard_error
Ann,six,80,,,,,,
Ann,80,strong,,,,,,
Cy,,80,,,,,,
Di,80,20000,-1,2000,,,1.5,-3
Ed,20000,80,,,9,3,,
Flo,80,,,,-2,x,,
"""
    with pytest.raises(DataError) as caught:
        read_season_players(club(tmp_path, text))
    told = "\n".join(caught.value.problems)
    for line, words in (
        (2, "rating 'six' isn't a number"),
        (3, "player 'Ann' is already in line 2"),
        (3, "skill 'strong' isn't a number"),
        (5, "skill '20000' isn't a number from -10,000 to 10,000"),
        (5, "day_sd '-1' isn't a number from 0 to 1,000"),
        (5, "drift '2000' isn't a number from -1,000 to 1,000"),
        (
            5,
            "absence '1.5' isn't a number from 0 to 1. Write the chance of being absent, "
            "such as 0.1",
        ),
        (5, "standard_error '-3' isn't a number from"),
        (6, "rating '20000' isn't a number from -10,000 to 10,000"),
        (6, "leaves in week 3, before week 9. Correct one of them"),
        (7, "joins '-2' isn't a whole number"),
        (7, "leaves 'x' isn't a whole number"),
    ):
        assert f"club.csv:{line}: {words}" in told
    assert len(caught.value.problems) == 12


def test_a_player_without_a_rating_is_a_newcomer_at_the_median(tmp_path: Path) -> None:
    file = read_season_players(
        club(tmp_path, "player,rating,level\nAnn,90,6\nBo,70,4\nCy,84,\nDi,,5\n")
    )
    assert file.players.rating.tolist() == [90, 70, 84, 84]
    assert file.players.skill_sd[3] == pytest.approx(np.std([90, 70, 84]))
    assert file.players.played[3] == 0
    assert file.roster.level[:2].tolist() == [6.0, 4.0]
    assert file.warnings == (
        f"{tmp_path / 'club.csv'}: 'Di' has no rating and starts as a newcomer at the median, 84",
    )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("player,skill\nAnn,80\nBo,70\n", "there's no column 'rating'"),
        ("player,rating\n", "has no players below its header"),
        ("player,rating\nAnn,80\n", "club.csv: has 1 player"),
    ],
)
def test_a_file_that_is_no_league_is_refused(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(DataError, match=words):
        read_season_players(club(tmp_path, text))
