import pytest

from evenbreak.answers.kit.parts import Column, Quantities, Quantity, Table

RACES = Table(
    "races",
    [
        Column(("race_a", "race_b"), "race", "{0[0]}:{0[1]}".format),
        Column("p_win_a", "A wins", "{:.2f}".format),
        Column("z", "z", detail=True),
        Column("seed"),
    ],
    [((7, 5), 0.52, 0.4, 1), (None, None, None, 2)],
)
WIN = Quantity(Column("p_win_a", "A wins"), 0.875)


def test_a_race_is_one_column_to_read_and_two_in_files():
    assert RACES.names == ["race_a", "race_b", "p_win_a", "z", "seed"]
    assert list(RACES.records()) == [[7, 5, 0.52, 0.4, 1], [None, None, None, None, 2]]
    assert RACES.to_dicts()[0] == {"race_a": 7, "race_b": 5, "p_win_a": 0.52, "z": 0.4, "seed": 1}
    race = RACES.columns[0]
    assert (race.text((7, 5)), race.text(None)) == ("7:5", "")


def test_statistics_are_for_those_who_ask_and_the_rest_of_a_row_is_in_files_only():
    assert [k for k, _ in RACES.shown()] == [0, 1]
    assert [k for k, _ in RACES.shown(verbose=True)] == [0, 1, 2]


def test_a_row_must_fill_all_columns():
    with pytest.raises(ValueError, match="argument 2 is"):
        list(Table("rows", RACES.columns, [((7, 5), 0.5)]).records())


def test_quantities_without_words_or_value_are_in_files_only():
    listed = [
        WIN,
        Quantity(Column("a"), 1),
        Quantity(Column("b", "b"), None),
        Quantity(Column("c", "c", detail=True), 0.0),
    ]
    assert Quantities(listed).shown() == [WIN]
    assert [one.name for one in Quantities(listed).shown(verbose=True)] == ["p_win_a", "c"]
