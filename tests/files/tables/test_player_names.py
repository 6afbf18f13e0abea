"""Names as written, cleaned, and read as the player who is meant."""

import numpy as np
import pytest

from evenbreak.files.tables.names import PlayerNames, clean_name, hidden_letter_warnings
from evenbreak.files.tables.table import read_table

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


@pytest.mark.parametrize(
    "hidden", ["\u202e", "\u2066", "\u200b", "\ufeff", "\uffff", "\U0001fffe", "\ufdd0", "\udc80"]
)
def test_letters_that_cannot_be_seen_or_turn_the_text_are_removed_with_a_warning(hidden, table):
    assert clean_name(f"{hidden}Ann{hidden} {hidden} Lee") == "Ann Lee"
    if hidden.isascii() or (hidden > "\ud7ff" and hidden < "\ue000"):
        return  # no file can hold it
    rows = table(f"An{hidden}n,Bo,", "Ann,Bo,")
    assert PlayerNames(rows, COLUMNS, {}).players == ("Ann", "Bo")
    (warning,) = hidden_letter_warnings(rows, COLUMNS)
    assert repr(f"An{hidden}n") in warning
    assert repr("Ann") in warning


def test_joiners_that_scripts_need_stay():
    assert clean_name("می\u200cخواهم") == "می\u200cخواهم"


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


def test_the_spelling_of_a_name_is_the_most_frequent_or_the_one_that_is_meant(table):
    rows = table("ann lee,Bo,", "ann lee,BO,", "Ann Lee,Bob,", "CY,Bo,", "Cy,DI,", "cy,DiDi,")
    names = PlayerNames(rows, COLUMNS, {"Bob": "BO"})
    assert names.players == ("BO", "Cy", "DI", "DiDi", "ann lee")
    assert names.read(rows, "player_b").values.tolist() == [0, 0, 0, 0, 2, 3]
    assert names.merged() == {"Ann Lee": "ann lee", "Bo": "BO", "CY": "Cy", "cy": "Cy"}


def test_aliases_are_found_in_any_case_and_keep_two_players_apart(table):
    rows = table("Bobby,Ann Lee,", "bobby,ann lee,")
    means = {"Bobby": "Bob Smith", "Ann Lee": "Ann Lee 1", "ann lee": "Ann Lee 2"}
    names = PlayerNames(rows, COLUMNS, means)
    assert names.players == ("Ann Lee 1", "Ann Lee 2", "Bob Smith")
    assert names.read(rows, "player_a").values.tolist() == [2, 2]
    assert names.merged() == {}
    assert names.renamed() == {**means, "bobby": "Bob Smith"}


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
