import math
from fractions import Fraction

import pytest

from evenbreak.source_text.inputs import parse_inputs
from rows import each_of


@each_of(
    "text, numbers, words",
    [
        ("", {}, []),
        ("p=2/3", {"p": (Fraction(2, 3),)}, []),
        ("N=120 p=.52", {"N": (120,), "p": (Fraction(13, 25),)}, []),
        ("x=0 1 1 4 5", {"x": (0, 1, 1, 4, 5)}, []),
        ("scores 50 44", {"scores": (50, 44)}, ["scores"]),
        ("mean run 24", {"run": (24,)}, ["mean", "run"]),
        ("1 2 4 5", {"": (1, 2, 4, 5)}, []),
        ("3:1 sets of 3:3", {"": (3, 1), "of": (3, 3)}, ["sets", "of"]),
        ("p=0.5 p_i=p^(i-1)", {"p": (Fraction(1, 2),)}, []),
        (
            "winner breaks p1=.9 win 1.0 lose 2.0",
            {"p1": (Fraction(9, 10),), "win": (1,), "lose": (2,)},
            ["winner", "breaks", "win", "lose"],
        ),
    ],
)
def test_numbers_are_exact_and_belong_to_the_name_before_them(text, numbers, words):
    found = parse_inputs(text)
    assert (found.numbers, found.words) == (numbers, words)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("alpha=30deg", math.pi / 6),
        ("alpha=0.55", 0.55),
        ("Jz=-.2", -0.2),
        ("mu=4/72", 1 / 18),
        ("V_0=50in/s", 50 * 0.0254),
        ("D=36in", 36 * 0.0254),
        ("M=3oz", 3 * 0.028349523125),
        ("t=7.00s", 7.0),
    ],
)
def test_a_number_is_taken_in_si_units(text, value):
    name = text.partition("=")[0]
    assert parse_inputs(text)[name] == pytest.approx(value, rel=1e-15)


def test_a_text_is_kept_where_it_has_a_name():
    found = parse_inputs("nine-foot table class=very_slow")
    assert found["class"] == "very slow"
    assert found.get("balls", "pool") == "pool"
    with pytest.raises(KeyError):
        found["balls"]


def test_one_number_must_be_one():
    with pytest.raises(ValueError, match="unpack"):
        parse_inputs("1 2").one()
