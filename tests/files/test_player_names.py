"""Names as written, cleaned, and read as the player who is meant."""

import numpy as np
import pytest

from evenbreak.files.player_names import PlayerNames, clean_name
from evenbreak.files.text_table import read_table

COLUMNS = ("player_a", "player_b")


@pytest.fixture
def table(tmp_path):
    def make(*rows, header="player_a,player_b,winner"):
        path = tmp_path / "r.csv"
        path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
        return read_table(path, {"player_a": (), "player_b": ()}, {"winner": ()})

    return make


def test_clean_names():
    assert clean_name("\u00a0Zoe\u0308 \t Kestleman\n") == "Zoë Kestleman"
    assert clean_name("'+1") == "+1"
    assert clean_name("'t Hooft") == "'t Hooft"


def test_players_are_sorted_and_read_as_their_places(table):
    rows = table("Cy,Ann,", "Bob  S.,Cy,", "bobby,Ann,")
    names = PlayerNames(rows, COLUMNS, {"Bob S.": "Bob Smith", "bobby": "Bob Smith"})
    assert names.players == ("Ann", "Bob Smith", "Cy")
    assert names.read(rows, "player_a").values.tolist() == [2, 1, 1]
    assert names.renamed() == {"Bob S.": "Bob Smith", "bobby": "Bob Smith"}


def test_names_that_differ_in_blanks_are_one_and_listed(table):
    names = PlayerNames(table("Ann  Lee,Bo,", "Ann Lee,Bo,"), COLUMNS, {})
    assert names.players == ("Ann Lee", "Bo")
    assert names.merged() == {"Ann  Lee": "Ann Lee"}


def test_names_that_do_not_print_and_empty_ones_are_problems(table):
    rows = table("An\x1b,Bo,", ",Bo,")
    column = PlayerNames(rows, COLUMNS, {}).read(rows, "player_a")
    assert column.good.tolist() == [False, False]
    assert len(rows.problems) == 2


def test_sides_by_name_by_letter_and_in_any_case(table):
    rows = table(
        "Ann,Bo,Bo", "Ann,Bo,a", "Ann,Bo,ANN", "B,A,A", "Ann,Bo,bobby", "Ann,Bo,Cy", "Ann,Bo,"
    )
    names = PlayerNames(rows, COLUMNS, {"Bobby": "Bo"})
    a, b = (names.read(rows, name) for name in COLUMNS)
    column = names.read_side(rows, "winner", a, b)
    assert column.values.tolist() == [2, 1, 1, 2, 2, 0, 0]
    assert np.flatnonzero(~column.good).tolist() == [5]
    assert len(rows.problems) == 1
