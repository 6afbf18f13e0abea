import csv

import pytest

from evenbreak.answers.faces.to_csv import to_csv
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Column, Quantities, Quantity, Table


def rows_of(*parts, **more):
    return list(csv.reader(to_csv(Answer("Heading", ["Words.", *parts], **more))))


def test_quantities_are_a_row_each_with_or_without_words():
    win = Quantity(Column("p_win_a", "A wins"), 2 / 3)
    assert rows_of(
        Quantities([win, Quantity(Column("games"), 13), Quantity(Column("none"), None)])
    ) == [
        ["quantity", "value"],
        ["p_win_a", "0.666667"],
        ["games", "13"],
        ["none", ""],
    ]


@pytest.mark.parametrize(
    ("column", "value", "cell"),
    [
        (Column("p"), 2 / 3, "0.666667"),
        (Column("p", "A wins", "{:.1f}".format), 2 / 3, "0.666667"),  # what is shown is rounded
        (Column("p", exact=True), 2 / 3, "0.6666666666666666"),
        (Column("on_front", cell=lambda on: "1" if on else "0"), True, "1"),
        (Column("on_front", cell=lambda on: "1" if on else "0"), None, ""),
        (Column("p"), float("inf"), ""),
        (Column("name"), "=1+1", "'=1+1"),
    ],
)
def test_a_cell(column, value, cell):
    name = column.names[0]
    assert rows_of(Table("rows", [column, Column("k")], [(value, 1)])) == [[name, "k"], [cell, "1"]]


def test_a_race_is_two_cells_and_rows_are_written_as_they_come():
    def rows():
        yield ((7, 5),)
        raise RuntimeError

    table = Table("races", [Column(("race_a", "race_b"), "race", exact=True)], rows())
    lines = to_csv(Answer("Heading", [table]))
    assert [next(lines), next(lines)] == ["race_a,race_b\n", "7,5\n"]
    with pytest.raises(RuntimeError):
        next(lines)


def test_an_answer_in_words_alone_is_an_empty_file():
    assert rows_of() == []
