import pytest

from evenbreak.answers.faces.to_text import paragraph, to_text
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Column, Quantities, Quantity, Table


def wide_table(columns):
    names = [Column("player", "", left=True), *(Column(f"c{k}", f"{k:03}") for k in range(columns))]
    return Table("", names, [(name, *range(columns)) for name in ("Ann", "Bo")])


def blocks_of(text):
    """Return the column headings of each part of the table below the heading."""
    return [part.splitlines()[0].split() for part in text.split("\n\n")[1:]]


@pytest.mark.parametrize(
    ("columns", "sizes"), [(5, [5]), (14, [14]), (16, [8, 8]), (31, [11, 11, 9])]
)
def test_a_wide_table_is_cut_into_parts_of_nearly_one_size(columns, sizes):
    text = to_text(Answer("Heading", [wide_table(columns)]))
    blocks = blocks_of(text)
    assert [len(block) for block in blocks] == sizes
    assert [head for block in blocks for head in block] == [f"{k:03}" for k in range(columns)]
    assert max(map(len, text.splitlines())) <= 80
    assert text.count("  Ann") == len(sizes)


def test_parts_differ_in_size_where_equal_ones_do_not_fit():
    heads = ["x" * 30, "y" * 30, *(f"{k}" for k in range(4))]
    table = Table("", [Column(head, head) for head in heads], [range(6)])
    text = to_text(Answer("Heading", [table]))
    assert max(map(len, text.splitlines())) <= 80
    assert [head for block in blocks_of(text) for head in block] == heads


def test_a_part_of_a_table_has_no_line_for_headings_of_other_parts():
    heads = ["x" * 50, "y" * 50 + "\ny"]
    table = Table("", [Column(head, head) for head in heads], [range(2)])
    assert "\n\n\n" not in to_text(Answer("Heading", [table]))


def test_items_of_a_list_are_indented_where_they_go_on():
    assert paragraph("- one two three\nfour five six", 9) == "- one two\n  three\nfour five\nsix"


def test_details_are_for_those_who_ask():
    numbers = Quantities(
        [Quantity(Column("a", "plain"), 1), Quantity(Column("b", "statistics", detail=True), 2)]
    )
    answer = Answer("Heading", [numbers], details=["The model."])
    assert "statistics" not in to_text(answer)
    assert "model" not in to_text(answer)
    assert "statistics" in to_text(answer, verbose=True)
    assert "model" in to_text(answer, verbose=True)


def test_numbers_stand_flush_right_and_names_flush_left():
    columns = [Column("player", "player", left=True), Column("games", "games")]
    table = Table("", columns, [("Ann", 7), ("Christopher", 1234), ("Bo", None)])
    assert to_text(Answer("Heading", [table])).splitlines()[2:] == [
        "  player       games",
        "  Ann              7",
        "  Christopher   1234",
        "  Bo",
    ]


def test_two_columns_of_long_names_are_folded_and_the_table_stays_whole():
    names = (
        "Maximilian Freiherr von Altenburg-Hohenstein",
        "Constantina Papadimitropoulou-Karagianni",
    )
    columns = [Column("a", "A", left=True), Column("b", "B", left=True), Column("p", "A wins")]
    lines = to_text(Answer("", [Table("", columns, [(*names, 0.5)])])).splitlines()
    assert sum("A wins" in line for line in lines) == 1
    assert all(len(line) <= 80 for line in lines)
    for name in names:
        for word in name.replace("-", " ").split():
            assert any(word in line for line in lines)
