"""Columns that become matches: scores that other cells stand in for, and contradictions."""

import pytest

from evenbreak.errors import DataError
from evenbreak.files.results.columns import NAMES, RESULTS_FILE
from evenbreak.files.results.matches import results_columns, results_rows
from evenbreak.files.tables.names import PlayerNames


@pytest.fixture
def matches(tmp_path):
    def read(header, *rows, means=None):
        path = tmp_path / "r.csv"
        path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
        table = RESULTS_FILE.text(path)
        names = PlayerNames(table, NAMES, means or {})
        return results_rows(table, names, results_columns(table, names)), table.problems

    return read


def test_columns_that_the_file_lacks_are_not_in_the_results(matches):
    results, problems = matches("player_a,player_b,score_a,score_b", "Ann,Bo,7,5")
    assert (results.date, results.racks, results.unscored) == (None, None, None)
    assert (results.score_a.tolist(), len(problems)) == ([7], 0)


def test_rows_that_cannot_be_read_are_left_out_of_the_results(matches):
    results, problems = matches("player_a,player_b,score_a,score_b", "Ann,Bo,x,5", "Bo,Cy,7,3")
    assert (results.score_a.tolist(), len(problems)) == ([7], 1)


def test_racks_fill_in_scores_and_races_make_them_unnecessary(matches):
    results, problems = matches(
        "player_a,player_b,score_a,score_b,racks,race_a,race_b,winner",
        "Ann,Bo,,,aba,,,",
        "Ann,Bo,,,,7,5,Bo",
    )
    assert len(problems) == 0
    assert results.score_a.tolist() == [2, 0]
    assert results.score_b.tolist() == [1, 0]
    assert results.unscored.tolist() == [False, True]


def test_contradictions_are_found_even_in_rows_with_other_problems(matches):
    _, problems = matches(
        "player_a,player_b,score_a,score_b,winner",
        "Ann,Bo,7,5,b",
        "Ann,Bobby,x,5,",
        means={"Bobby": "Ann"},
    )
    with pytest.raises(DataError) as caught:
        problems.raise_any()
    assert [p.rpartition("r.csv")[2].partition(": ")[0] for p in caught.value.problems] == [
        ":2",
        ":3",
        ":3",
    ]
    assert "'Ann' and 'Bobby'" in caught.value.problems[2]


def test_without_a_column_that_nothing_replaces_all_problems_so_far_are_raised(matches):
    with pytest.raises(DataError) as caught:
        matches("player_a,player_b,score_b,date", "Ann,Bo,7,soon")
    assert len(caught.value.problems) == 2
