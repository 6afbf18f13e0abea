"""The sheet as a terminal shows it, read back cell by cell."""

import re

import pytest

from evenbreak.answers.faces.to_text import to_text
from evenbreak.answers.league.report import report_answer
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.ratings.results import Results
from leagues import league, sheet_of, two_groups

LONG = "A Player With A Name Far Too Long To Print {}"


def races_in(text):
    """Return the race in each cell by the places of its row and column."""
    found, columns = {}, None
    for line in text.splitlines():
        if re.fullmatch(r"\s+\d+(\s+\d+)*", line):
            columns = [(match.end(), match[0]) for match in re.finditer(r"\d+", line)]
        elif columns and (row := re.match(r"\s+(\d+)  \S", line)):
            for race in re.finditer(r"\d+:\d+|-(?=\s|$)", line):
                (column,) = (place for end, place in columns if end == race.end())
                found[row[1], column] = race[0]
        elif not line.strip():
            columns = None
    return found


@pytest.mark.parametrize("players", [2, 9, 23])
def test_every_race_stands_in_the_row_and_column_of_its_players(players):
    sheet = sheet_of(league(players))
    place = {name: str(k) for k, name in enumerate(sheet.rated["player"], 1)}
    assert races_in(to_text(report_answer(sheet))) == {
        (place[a], place[b]): race for (a, b), race in sheet.races.items()
    }


@pytest.mark.slow_after(5)
@pytest.mark.parametrize("players", [2, 12, 30])
@pytest.mark.parametrize("name", ["P{}", LONG, "選手{}"])
def test_no_line_is_wider_than_a_terminal_and_no_name_is_cut(players, name):
    text = to_text(report_answer(sheet_of(league(players, name))))
    assert all(len(line) <= 80 for line in text.splitlines())
    assert "…" not in text


def test_a_long_list_is_cut_and_said_to_be(monkeypatch):
    monkeypatch.setattr("evenbreak.answers.league.report.MOST_ON_SHEET", 30)
    answer = report_answer(sheet_of(league(34), top=33))
    assert "place among all 34 players" in to_text(answer)
    left = " ".join(answer.data["left_out"])
    assert "3 of 33 paired players" in left
    assert "1 rated player" in left
    assert len(answer.data["ratings"]) == 34
    assert len(answer.to_dict()["matchups"]) == 33 * 32 / 2


def test_races_of_a_large_league_are_on_paper_and_all_its_players_are_named():
    sheet = sheet_of(league(34))
    text = to_text(report_answer(sheet))
    assert "sheet.pdf has the races" in text
    assert not races_in(text)
    assert all(name in text for name in sheet.rated["player"])


def test_json_has_the_tables_of_the_files():
    sheet = sheet_of(league(3))
    answer = report_answer(sheet).to_dict()
    assert [row["rating"] for row in answer["ratings"]] == sheet.rated["rating"].tolist()
    assert [row["p_win_a"] for row in answer["matchups"]] == sheet.paired["p_win_a"].tolist()
    assert answer["summary"]["pairs"] == 3
    assert answer["summary"]["games_lo"] is None


@pytest.mark.slow
def test_pairs_that_cannot_be_compared_have_no_race_but_a_group():
    sheet = sheet_of(two_groups())
    text = to_text(report_answer(sheet))
    assert sorted(races_in(text).values()).count("-") == 8
    assert "lost  group" in text
    assert "group" not in to_text(report_answer(sheet_of(league(2))))


def test_ratings_on_a_fine_scale_have_more_decimals():
    text = to_text(report_answer(sheet_of(Results.from_names(["A"], ["B"], [7], [5]), scale=0.5)))
    assert re.search(r" 0\.\d{3} ", text)


def test_details_have_the_model():
    sheet = sheet_of(league(3), offered=OfferedRaces((5, 9)))
    answer = report_answer(sheet)
    assert "1/(1 + 2^" not in to_text(answer)
    assert "1/(1 + 2^" in to_text(answer, verbose=True)
