import numpy as np
import pytest

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Column, Quantities, Quantity, Table

RACES = Table("races", [Column(("race_a", "race_b"), "race"), Column("seed")], [((7, 5), 1)])
WIN = Quantity(Column("p_win_a", "A wins"), 0.875)


@pytest.mark.parametrize(
    ("answer", "columns"),
    [
        (Answer("", ["Words.", Quantities([WIN]), RACES]), ["quantity", "value"]),
        (Answer("", ["Words.", Quantities([WIN])], csv=RACES), RACES.names),
        (Answer("", ["Words."], details=[RACES]), RACES.names),
        (Answer("", ["Words."]), []),
    ],
)
def test_files_get_what_was_chosen_for_them_or_the_first_numbers(answer, columns):
    assert list(answer.to_frame().columns) == columns


def test_the_sentences_are_the_paragraphs_without_the_details():
    answer = Answer("Heading", ["One.", RACES, "Two."], details=["Three."])
    assert answer.sentences == ["One.", "Two."]


def test_a_notebook_and_a_terminal_show_the_same_number():
    answer = Answer("Heading", ["Words.", Quantities([WIN])])
    assert "0.875" in str(answer)
    assert "0.875" in answer._repr_html_()
    assert answer.to_dict()["p_win_a"] == 0.875
    assert np.isclose(answer.to_frame()["value"][0], 0.875)
