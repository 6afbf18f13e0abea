"""Lists of fixtures: weeks and names, and all that is wrong at once."""

from __future__ import annotations

from pathlib import Path

import pytest

from evenbreak.errors import DataError
from evenbreak.files.lists.season import read_schedule
from evenbreak.ratings.roster import Roster

CLUB = Roster(["Ann Lee", "Bo", "Zoë"], [92, 71, 80])


def fixtures(folder: Path, text: str) -> Path:
    path = folder / "fixtures.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_weeks_and_names_are_read_in_the_order_of_the_file(tmp_path: Path) -> None:
    path = fixtures(tmp_path, "Night;Home;Away;Referee\n3;zoë;Bo;1\n1; Ann  Lee;Bo;2\n")
    file = read_schedule(path, CLUB)
    assert file.schedule.week.tolist() == [3, 1]
    assert (file.schedule.a.tolist(), file.schedule.b.tolist()) == ([2, 0], [1, 1])
    assert file.schedule.weeks == 3
    assert "columns not used: 'Referee'" in file.warnings[0]


def test_all_problems_are_told_at_once(tmp_path: Path) -> None:
    path = fixtures(
        tmp_path,
        "week,player_a,player_b\n0,Ann Lee,Bo\nsoon,Ann Lee,Bo\n1,Anne Lee,Bo\n1,Bo,bo\n,Bo,\n",
    )
    with pytest.raises(DataError) as caught:
        read_schedule(path, CLUB)
    told = "\n".join(caught.value.problems)
    for line, words in (
        (2, "week '0' isn't a whole number from 1 to 10,000. Write 1 for the first week"),
        (3, "week 'soon' isn't a whole number"),
        (4, "player_a 'Anne Lee' isn't in the roster (did you mean 'Ann Lee'?)"),
        (5, "'Bo' is on both sides"),
        (6, "week is empty. Write 1 for the first week"),
        (6, "player_b is empty"),
    ):
        assert f"fixtures.csv:{line}: {words}" in told
    assert len(caught.value.problems) == 6


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("player_a,player_b\nBo,Zoë\n", "there's no column 'week'"),
        ("week,player_a,player_b\n", "has no matches below its header"),
    ],
)
def test_a_file_that_is_no_schedule_is_refused(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(DataError, match=words):
        read_schedule(fixtures(tmp_path, text), CLUB)


def test_two_players_who_meet_twice_in_a_week_are_a_warning_whoever_is_named_first(
    tmp_path: Path,
) -> None:
    path = fixtures(tmp_path, "week,player_a,player_b\n1,Bo,Zoë\n2,Zoë,Bo\n1,Zoë,Bo\n")
    file = read_schedule(path, CLUB)
    (warning,) = file.warnings
    assert "fixtures.csv:4: " in warning
    assert "line 2" in warning
    assert len(file.schedule.week) == 3
