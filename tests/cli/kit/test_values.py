"""What the values of options may look like."""

import click
import pytest

from evenbreak.cli.kit.values import SCORE, SPAN, Whole, number_of, refuse
from evenbreak.errors import InputError
from evenbreak.questions.common import CHANCE
from rows import each_of


@each_of(
    "kind, text, value",
    [
        (SCORE, "0-3", (0, 3)),
        (SCORE, "0:3", (0, 3)),
        (SPAN, "7..13", (7, 13)),
        (SPAN, " 7 .. 13", (7, 13)),
        (Whole(1, 9), "9", 9),
    ],
)
def test_values(kind: click.ParamType, text: str, value: object) -> None:
    assert kind.convert(text, None, None) == value


@each_of(
    "kind, text",
    [
        (SCORE, "7-5-3"),
        (SCORE, "3"),
        (SCORE, "-1:3"),
        (SPAN, "13..7"),
        (SPAN, "7"),
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
    assert str(number_of(text)) == str(CHANCE.read(text)) == "0.0"


@pytest.mark.parametrize(("text", "hint"), [("95", "0.95"), ("80%", "0.8"), ("0,5", "0.5")])
def test_percent_and_decimal_commas_get_a_hint(text: str, hint: str) -> None:
    with pytest.raises(InputError, match=hint):
        CHANCE.read(text)


def test_a_refusal_is_wrong_usage() -> None:
    with pytest.raises(click.UsageError) as refused:
        refuse("leave one out")
    assert refused.value.exit_code == 2
