"""What the values of options may look like."""

import click
import pytest

from evenbreak.cli.kit.values import CHANCE, PAIR, SCORE, SPAN, Whole, number_of, refuse
from rows import each_of


@each_of(
    "kind, text, value",
    [
        (PAIR, "7:5", (7, 5)),
        (PAIR, " 7 : 5 ", (7, 5)),
        (PAIR, "7-5", (7, 5)),
        (PAIR, "7/5", (7, 5)),
        (PAIR, "7 – 5", (7, 5)),
        (SCORE, "0-3", (0, 3)),
        (PAIR, "7", (7, 7)),
        (SCORE, "0:3", (0, 3)),
        (SPAN, "7..13", (7, 13)),
        (SPAN, " 7 .. 13", (7, 13)),
        (CHANCE, " .5 ", 0.5),
        (CHANCE, "1e-3", 0.001),
        (Whole(1, 9), "9", 9),
    ],
)
def test_values(kind: click.ParamType, text: str, value: object) -> None:
    assert kind.convert(text, None, None) == value


@each_of(
    "kind, text",
    [
        (PAIR, "7 5"),
        (PAIR, "7:"),
        (PAIR, ":5"),
        (PAIR, "7::5"),
        (PAIR, "-5"),
        (PAIR, "7--5"),
        (PAIR, "7.5"),
        (SCORE, "7-5-3"),
        (PAIR, "0:5"),
        (PAIR, "1001"),
        (PAIR, "٧"),
        (SCORE, "3"),
        (SCORE, "-1:3"),
        (SPAN, "13..7"),
        (SPAN, "7"),
        (CHANCE, "1.5"),
        (CHANCE, "nan"),
        (CHANCE, "half"),
        (Whole(1, 9), "10"),
        (Whole(1, 9), "2.5"),
    ],
)
def test_other_texts_are_refused_and_shown(kind: click.ParamType, text: str) -> None:
    with pytest.raises(click.BadParameter) as refused:
        kind.convert(text, None, None)
    assert repr(text) in refused.value.message


@pytest.mark.parametrize("text", ["-0", "-0.0", "-.0", "-0e5"])
def test_minus_nothing_is_nothing(text: str) -> None:
    assert str(number_of(text)) == str(CHANCE.convert(text, None, None)) == "0.0"


@pytest.mark.parametrize(("text", "hint"), [("95", "0.95"), ("80%", "0.8"), ("0,5", "0.5")])
def test_percent_and_decimal_commas_get_a_hint(text: str, hint: str) -> None:
    with pytest.raises(click.BadParameter, match=hint):
        CHANCE.convert(text, None, None)


def test_a_refusal_is_wrong_usage() -> None:
    with pytest.raises(click.UsageError) as refused:
        refuse("leave one out")
    assert refused.value.exit_code == 2
