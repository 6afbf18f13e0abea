"""A night's results applied to a list, or all reasons against it."""

import pytest

from evenbreak.answers.league.rating_changes import rating_changes_of_files
from evenbreak.errors import DataError
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.results.results_file import read_results
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.catalog import system_of

NPL = system_of("npl")
LAST = "player,rating,games\nBo,80,120\nAnn,92,140\nCy,71,\n"
HEADER = "player_a,player_b,score_a,score_b"


@pytest.fixture
def apply(tmp_path):
    def night(rows, **options):
        (tmp_path / "last.csv").write_text(LAST, encoding="utf-8")
        (tmp_path / "night.csv").write_text(f"{HEADER}\n{rows}", encoding="utf-8")
        files = read_roster(tmp_path / "last.csv"), read_results(tmp_path / "night.csv")
        return rating_changes_of_files(NPL, *files, **options)

    return night


def problems(apply, rows, **options):
    with pytest.raises(DataError) as caught:
        apply(rows, **options)
    return [problem.rpartition("night.csv")[2] for problem in caught.value.problems]


def test_a_good_night_changes_the_ratings(apply):
    moves = apply("Ann,Bo,5,3\nCy,Ann,2,6\n", chart=chart("npl_10"))
    assert moves.after.rating.tolist() == [79, 94, 70]


def test_all_reasons_are_given_with_their_lines(apply):
    told = problems(apply, "\nAnn,Bo,5,3\nAnn,Boo,5,2\nAnn, cy ,5,2\nBo,Ann,5,3\n")
    assert [text.partition(" ")[0] for text in told] == [":3:", ":4:", ":5:"]
    assert "(2 such matches; chart NAME" in told[0]
    assert "'Boo'" in told[1]
    assert "'Cy'" in told[2]


def test_a_score_that_the_chart_does_not_allow(apply):
    (told,) = problems(apply, "Ann,Cy,5,3\n", chart=chart("npl_10"))
    assert told.startswith(":2: 5-3")
    assert "6:4" in told
