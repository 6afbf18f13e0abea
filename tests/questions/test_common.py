"""The values that several questions take, as they are typed."""

import pytest

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Kind
from evenbreak.questions.common import HIGHEST_SEED, RACE, SCALE, SCORE, SPAN, Lengths
from evenbreak.questions.games import Breaks
from rows import each_of


@each_of(
    "kind, text, value",
    [
        (RACE, "7", (7, 7)),
        (RACE, "7-5", (7, 5)),
        (SCORE, "0-3", (0, 3)),
        (SCORE, "0:3", (0, 3)),
        (SPAN, "7..13", (7, 13)),
        (SPAN, " 7 .. 13", (7, 13)),
    ],
)
def test_values(kind: Kind, text: str, value: object) -> None:
    assert kind.read(text) == value


@each_of(
    "kind, text",
    [(SCORE, "7-5-3"), (SCORE, "3"), (SCORE, "-1:3"), (SPAN, "13..7"), (SPAN, "7"), (RACE, "0")],
)
def test_other_texts_are_refused_and_shown(kind: Kind, text: str) -> None:
    with pytest.raises(InputError, match="Give") as refused:
        kind.read(text)
    assert repr(text) in str(refused.value)


@pytest.mark.parametrize(("text", "points"), [("npl", 30.0), ("fargo", 100.0), ("55", 55.0)])
def test_a_scale_by_name_or_points(text: str, points: float) -> None:
    assert SCALE.read(text).points_per_doubling == points
    with pytest.raises(InputError):
        SCALE.read("yards")


def test_a_seed_is_a_whole_number_of_32_bits() -> None:
    assert HIGHEST_SEED == 4294967295


def test_races_go_to_7_unless_a_limit_is_given() -> None:
    assert Lengths().lengths == {"games": None, "race_to": 7}
    assert Lengths(games=(5, 9)).lengths == {"games": (5, 9), "race_to": None}
    with pytest.raises(InputError, match="games and race_to"):
        Lengths(games=(5, 9), race_to=7)


def test_breaks_need_both_chances() -> None:
    with pytest.raises(InputError, match="p1 P and p2 P"):
        Breaks(p1=0.5)
