"""Score sheets with two rows a match: read where every match has both, and left alone else."""

import pytest

from evenbreak.files.foreign.results import paper_sheet

TITLES = "Date,Match,Player,SL,Wins"


@pytest.mark.parametrize(
    "text",
    [
        f"{TITLES}\n9/1,1,Ann,6,5\n9/1,1,Bo,4,2\n9/1,2,Cy,3,2\n",  # one row lacks its other
        "Match,Home Player,Away Player,Score\n1,Ann,Bo,5-2\n1,Cy,Di,5-3\n",
        "Match,Player,Player,Wins\n1,Ann,Bo,5\n1,Cy,Di,5\n",
        f"{TITLES}\n9/1,1,Ann,6\n9/1,1,Bo,4\n",
        f"{TITLES}\n",
        "Player,Rating\nAnn,500\nBo,510\n",
    ],
)
def test_what_is_no_such_sheet_is_left_alone(text):
    assert paper_sheet(text.encode(), "r.csv") is None


def test_the_same_number_on_another_day_is_another_match():
    text = f"{TITLES}\n9/1,1,Ann,6,5\n9/1,1,Bo,4,2\n9/8,1,Cy,3,2\n9/8,1,Ann,6,1\n"
    export = paper_sheet(text.encode(), "r.csv")
    assert export.sheet.lines == [1, 2, 4]
    assert [row[:3] for row in export.sheet.rows[1:]] == [["1", "9/1", "Ann"], ["1", "9/8", "Cy"]]
