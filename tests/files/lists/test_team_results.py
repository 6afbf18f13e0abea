"""Results of teams as leagues write them: titles by language, a score in one cell, postponed."""

import re
from functools import partial

import pytest

from evenbreak.errors import DataError
from evenbreak.files.lists.teams import TEAM_RESULTS, TeamNames, read_team_results
from evenbreak.files.results.columns import RESULTS
from evenbreak.files.results.results_file import read_results

ROWS = [
    *("1;Racks;Cues;3:2", "1;Balls;Chalk;4 – 1", "2;Racks;Balls;3-2", "2;Cues;Chalk;1/4"),
    *("3;Racks;Chalk;verlegt", "3;spielfrei;Cues;", "4;Balls;Cues;"),
]


def written(path, header, rows=ROWS):
    path.write_text("\n".join([header, *rows, ""]), encoding="utf-8")
    return path


def test_a_score_in_one_cell_byes_and_matches_to_come(tmp_path):
    path = written(tmp_path / "t.csv", "Spieltag;Heim;Gast;Ergebnis")
    played, to_come = read_team_results(path, TeamNames([]))
    assert played.scores.tolist() == [[3, 2], [4, 1], [3, 2], [1, 4]]
    assert len(to_come.pairs) == 2
    assert to_come.rounds == ("3", "4")


def test_unknown_titles_are_one_problem_whose_remedy_reads_the_file(tmp_path):
    path = written(tmp_path / "t.csv", "Spieltag;Sp H;Sp G;Stand", ROWS[:4])
    with pytest.raises(DataError) as caught:
        read_team_results(path, TeamNames([]))
    (problem,) = caught.value.problems
    columns = dict(part.split("=") for part in re.search(r'"(.*)"', problem)[1].split(","))
    played, _ = read_team_results(path, TeamNames([]), columns=columns)
    assert played.scores.tolist() == [[3, 2], [4, 1], [3, 2], [1, 4]]


def test_another_kind_of_file_is_told_the_columns_of_the_one_wanted(tmp_path):
    of_teams = partial(read_team_results, teams=TeamNames([]))
    path = tmp_path / "roster.csv"
    path.write_text("name,rating\nAnn,600\n")
    for read, columns in ((of_teams, TEAM_RESULTS), (read_results, RESULTS)):
        with pytest.raises(DataError) as caught:
            read(path)
        needed = [name for name, column in columns.columns.items() if column.needed]
        assert (
            f"Is this the right file? Results have one match per row: {','.join(needed)}."
            in str(caught.value)
        )


def test_rows_that_are_all_wrong_in_one_way_are_one_problem(tmp_path):
    header = "home;away;home_score;away_score"
    for rows in (["Racks;Cues;3:2;"] * 37, ["Racks;Cues;3;2;x;y"] * 37):
        path = written(tmp_path / "t.csv", header, rows)
        with pytest.raises(DataError) as caught:
            read_team_results(path, TeamNames([]))
        assert 1 <= len(caught.value.problems) <= 2, caught.value.problems[:3]


def test_a_forfeit_needs_the_score_that_it_counts(tmp_path):
    path = written(tmp_path / "t.csv", "home;away;score;status", ["Racks;Cues;3-0;forfeit"])
    assert read_team_results(path, TeamNames([]))[0].scores.tolist() == [[3, 0]]
    written(path, "home;away;score", ["Racks;Cues;ff", "Cues;Racks;3-2"])
    with pytest.raises(DataError, match="forfeit without a score"):
        read_team_results(path, TeamNames([]))
