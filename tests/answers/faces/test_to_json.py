import json
from typing import NamedTuple

import numpy as np

from evenbreak.answers.faces.to_json import as_dict, json_value, to_json
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Column, Quantities, Quantity, Table
from rows import each_of

ROWS = Table("rows", [Column(("race_a", "race_b"), "race")], [((7, 5),), (None,)])
VIEW = Table("", [Column("seen", "seen")], [(1,)])


class Pair(NamedTuple):
    a: float
    b: str


def test_all_numbers_are_there_once_and_views_of_them_are_not():
    answer = Answer(
        "Race 7:5",
        ["A wins.", Quantities([Quantity(Column("p"), 1 / 3)]), VIEW, ROWS],
        details=["The model.", Quantities([Quantity(Column("z", detail=True), -0.5)])],
        warnings=["Too few."],
        data={"n": np.int64(3)},
        csv=Table("other", [Column("k")], [(1,)]),
    )
    assert as_dict(answer) == {
        "p": 1 / 3,
        "rows": [{"race_a": 7, "race_b": 5}, {"race_a": None, "race_b": None}],
        "z": -0.5,
        "other": [{"k": 1}],
        "n": 3,
        "heading": "Race 7:5",
        "sentences": ["A wins."],
        "details": ["The model."],
        "warnings": ["Too few."],
        "schema_version": 1,
    }
    hidden = Quantities([Quantity(Column("p"), 0.5)], in_json=False)
    assert "p" not in as_dict(Answer("Heading", [hidden]))


def test_the_text_is_read_back_with_every_digit_and_letter():
    answer = Answer(
        "Zoë", [Quantities([Quantity(Column("p"), 0.1 + 0.2), Quantity(Column("q"), np.inf)])]
    )
    text = to_json(answer)
    assert json.loads(text) == as_dict(answer)
    assert ("Zoë" in text, "0.30000000000000004" in text, text[-2:]) == (True, True, "}\n")


@each_of(
    "value, expected",
    [
        (np.float64(0.25), 0.25),
        (np.array([[1, 2]]), [[1, 2]]),
        (np.array([1.5, np.nan]), [1.5, None]),
        (np.bool_(True), True),
        (float("-inf"), None),
        ({(7, 5): 0.5}, {"(7, 5)": 0.5}),
        ({7: {"p": np.float32(0.5)}}, {"7": {"p": 0.5}}),
        (Pair(float("nan"), "x"), {"a": None, "b": "x"}),
        (np.datetime64("2025-01-31"), "2025-01-31"),
        (True, True),
        (None, None),
    ],
)
def test_values_become_plain(value, expected):
    found = json_value(value)
    assert found == expected
    assert type(found) is type(expected)
