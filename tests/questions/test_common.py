"""What the values of fields that many questions have may look like."""

import pytest

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Kind
from evenbreak.questions.common import CHANCE, RACE, SCORE, SPAN, Lengths
from rows import each_of


@each_of(
    "kind, text, value",
    [
        (RACE, "7:5", (7, 5)),
        (RACE, " 7 : 5 ", (7, 5)),
        (RACE, "7-5", (7, 5)),
        (RACE, "7/5", (7, 5)),
        (RACE, "7 – 5", (7, 5)),
        (RACE, "7", (7, 7)),
        (SCORE, "0-3", (0, 3)),
        (SPAN, "7..13", (7, 13)),
        (CHANCE, " .5 ", 0.5),
        (CHANCE, "1e-3", 0.001),
    ],
)
def test_values(kind: Kind, text: str, value: object) -> None:
    assert kind.read(text) == value


@each_of(
    "kind, text",
    [
        (RACE, "7 5"),
        (RACE, "7:"),
        (RACE, ":5"),
        (RACE, "7::5"),
        (RACE, "-5"),
        (RACE, "7--5"),
        (RACE, "7.5"),
        (RACE, "0:5"),
        (RACE, "1001"),
        (RACE, "٧"),
        (SCORE, "7-5-3"),
        (SCORE, "-1:3"),
        (SPAN, "13..7"),
        (CHANCE, "1.5"),
        (CHANCE, "nan"),
        (CHANCE, "half"),
    ],
)
def test_other_texts_are_refused_and_shown(kind: Kind, text: str) -> None:
    with pytest.raises(InputError) as refused:
        kind.read(text)
    assert repr(text) in str(refused.value)


def test_races_by_games_or_by_what_the_stronger_player_needs() -> None:
    assert Lengths(games=(7, 9)).lengths == {"games": (7, 9), "race_to": None}
    assert Lengths(race_to=5).lengths == {"games": None, "race_to": 5}
    with pytest.raises(InputError, match="games and race_to"):
        Lengths(games=(7, 9), race_to=7)
