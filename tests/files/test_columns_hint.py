"""The option --columns that a message proposes, and that it works as it stands."""

import re

import pytest

from evenbreak.errors import DataError
from evenbreak.files.results import read_results


@pytest.mark.parametrize(
    ("content", "hint"),
    [
        (
            "Datum;Heim;Gast;Tore H;Tore G\n3.9.2024;Ann;Bo;7;5\n",
            "player_a=Heim,player_b=Gast,score_a=Tore H,score_b=Tore G,date=Datum",
        ),
        ("Wer,Gegen wen,Stand\nAnn,Bo,7-5\n", "player_a=Wer,player_b=Gegen wen,score=Stand"),
        ("Home,Gast,Stand\nAnn,Bo,7-5\n", "player_b=Gast,score=Stand"),
        ("player_a,player_b,P1,P2\nAnn,Bo,7,5\n", "score_a=P1,score_b=P2"),
        (
            "Club,X,Table,Y,Stand\nQ,Ann,Red,Bo,7-5\nR,Bo,Blue,Ann,7-4\n",
            "player_a=X,player_b=Y,score=Stand",
        ),
        ("winner,loser,Stand\nAnn,Bo,7-5\n", "score=Stand"),
    ],
)
def test_the_proposed_option_reads_the_file(tmp_path, content, hint):
    path = tmp_path / "r.csv"
    path.write_text(f"Our league\n{content}")
    with pytest.raises(DataError) as caught:
        read_results(path)
    (problem,) = caught.value.problems
    proposed = re.search(r'--columns "(.*)"', problem)[1]
    assert proposed == hint
    columns = dict(part.split("=") for part in proposed.split(","))
    file = read_results(path, columns=columns)
    assert {*file.results.players} == {"Ann", "Bo"}
    assert (file.results.score_a[0], file.results.score_b[0]) == (7, 5)


@pytest.mark.parametrize("content", ["what,ever\n", "player_a,player_b\nAnn,Bo\n", "a,a\nx,y\n"])
def test_where_nothing_fits_no_option_is_proposed(tmp_path, content):
    path = tmp_path / "r.csv"
    path.write_text(content)
    with pytest.raises(DataError) as caught:
        read_results(path)
    assert "--columns" not in caught.value.problems[0]
