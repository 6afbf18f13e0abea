"""Titles in six languages: each means one column, and files with them are read as they are."""

import numpy as np
import pytest
import xlsxwriter

from evenbreak.errors import DataError
from evenbreak.files.lists import roster, season, teams
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.results.columns import RESULTS_FILE
from evenbreak.files.results.results_file import read_results
from evenbreak.files.tables.titles import (
    BYE,
    FORFEIT,
    LANGUAGES,
    SIDES,
    UNPLAYED,
    WAS_PLAYED,
    key_of,
    keys_of,
    titles_of,
)
from rows import each_of

SCHEMAS = [
    *(RESULTS_FILE, roster.ROSTER, season.SEASON, season.SCHEDULE, season.PAIRS),
    *(teams.TEAM_RESULTS, teams.FIXTURES, teams.SQUADS, teams.TEAMS),
]


def test_a_title_means_one_column_but_for_sides_that_are_players_or_their_teams():
    sides = {key_of(word) for both in SIDES.values() for text in both for word in text.split(", ")}
    for schema in SCHEMAS:
        means: dict[str, set[str]] = {}
        for name in schema.columns:
            for key in keys_of(name):
                means.setdefault(key, set()).add(name)
        twice = {key: names for key, names in means.items() if len(names) > 1}
        assert all(key in sides and "player_a" in schema.columns for key in twice), twice


def test_no_title_is_a_single_letter_and_no_word_both_was_and_was_not_played():
    for schema in SCHEMAS:
        for name in schema.columns:
            assert min(map(len, keys_of(name)), default=2) > 1, name
    words = (FORFEIT, BYE, UNPLAYED, WAS_PLAYED)
    assert sum(map(len, words)) == len(frozenset().union(*words))


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_file_in_each_language_is_read_as_it_is(tmp_path, language):
    def title(column, k=0):
        english = RESULTS_FILE[column].aliases[0]
        return (titles_of(column).get(language) or (english,))[k]

    path = tmp_path / "r.csv"
    columns = ("date", "player_a", "player_b", "score")
    path.write_text(";".join(map(title, columns)) + "\n2024-09-03;Ann;Bo;5 – 3\n")
    one_cell = read_results(path).results
    columns = ("score_b", "player_b", "team_b", "team_a", "score_a", "player_a")
    last = [title(column, -1) for column in columns]
    path.write_text(";".join(last).upper() + "\n3;Bo;Cues;Racks;5;Ann\n")
    several = read_results(path).results
    for results in (one_cell, several):
        assert results.players == ("Ann", "Bo")
        assert (results.score_a, results.score_b) == (np.array([5]), np.array([3]))
    assert several.team_a is not None


def test_a_side_is_the_team_where_players_have_titles_of_their_own(tmp_path):
    path = tmp_path / "r.csv"
    path.write_text("Gast;Heim;Spieler Heim;Spieler Gast;Ergebnis\nCues;Racks;Ann;Bo;5:3\n")
    results = read_results(path).results
    assert results.players == ("Ann", "Bo")
    path.write_text("Gast;Heim;Heim Team;Ergebnis\nBo;Ann;Racks;5:3\n")
    assert read_results(path).results.players == ("Ann", "Bo")


@each_of(
    "upper, lower, row",
    [
        ("Datum;Heim;;Gast;", ";Spieler;Spiele;Spieler;Spiele", "3.9.2024;Ann;5;Bo;3"),
        ("Datum;Spieler;;Ergebnis;", ";Heim;Gast;Heim;Gast", "3.9.2024;Ann;Bo;5;3"),
        ("Home;;Away;;Date", "Player;Score;Player;Score;", "Ann;5;Bo;3;2024-09-03"),
    ],
)
def test_a_header_may_have_two_rows(tmp_path, upper, lower, row):
    path = tmp_path / "r.csv"
    path.write_text(f"Our league;;;;\n{upper}\n{lower}\n{row}\n")
    results = read_results(path).results
    assert results.players == ("Ann", "Bo")
    assert (results.score_a.tolist(), results.score_b.tolist()) == ([5], [3])
    assert str(results.date[0]) == "2024-09-03"


@each_of("word", sorted(FORFEIT))
def test_every_word_for_a_forfeit_is_read_in_a_score_a_status_or_a_remark(tmp_path, word):
    path = tmp_path / "r.csv"
    for row in (f"{word.upper()};;", f";{word};", f"7:0;;{word.title()}"):
        path.write_text(f"Heim;Gast;Ergebnis;Status;Bemerkung\nAnn;Bo;{row}\nAnn;Cy;7:5;;\n")
        results = read_results(path).results
        assert results.forfeit is not None
        assert results.forfeit.tolist() == [True, False]


def test_byes_and_matches_not_played_are_left_out_and_counted(tmp_path):
    path = tmp_path / "r.csv"
    path.write_text(
        "home,away,score,status\nAnn,BYE,,\nspielfrei,Bo,7-0,\nAnn,Bo,7-5,final\n"
        "Ann,Bo,,postponed\nBo,,,bye\nAnn,Bo,7-3,abandoned\nBo,Ann,verlegt,\n"
    )
    file = read_results(path)
    assert file.results.players == ("Ann", "Bo")
    assert file.results.score_b.tolist() == [5, 3]
    told = "\n".join(file.warnings)
    assert "3 byes are left out (lines 2, 3, 6)" in told
    assert "2 matches that weren't played are left out (lines 5, 8)" in told
    assert "'abandoned'" in told


def test_a_list_of_players_in_another_language(tmp_path):
    path = tmp_path / "p.csv"
    path.write_text("Zawodnik;Ranking;Elo\nAnn;1;1500,5\n")
    file = read_roster(path)
    assert file.roster.players == ("Ann",)
    assert file.roster.rating.tolist() == [1500.5]


def test_several_missing_columns_are_one_problem(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("wer,wen,wann\n" + "x,y,z\n" * 40)
    with pytest.raises(DataError) as caught:
        teams.read_team_results(path, teams.TeamNames([]))
    assert len(caught.value.problems) == 1


def test_a_workbook_with_merged_cells_above_the_titles(tmp_path):
    path = tmp_path / "season.xlsx"
    with xlsxwriter.Workbook(path) as book:
        sheet = book.add_worksheet("Ergebnisse")
        sheet.merge_range("A1:E1", "Liga 2024/25")
        sheet.merge_range("A2:A3", "Spieltag")
        sheet.merge_range("B2:C2", "Heim")
        sheet.merge_range("D2:E2", "Gast")
        sheet.write_row("B3", ["Spieler", "Spiele", "Spieler", "Spiele"])
        sheet.write_row("A4", [1, "Ann", 5, "Bo", 3])
        sheet.write_row("A5", [1, "Cy", 2, "Di", 5])
    file = read_results(path)
    assert file.results.players == ("Ann", "Bo", "Cy", "Di")
    assert file.results.score_a.tolist() == [5, 2]
    assert file.lines.tolist() == [4, 5]
