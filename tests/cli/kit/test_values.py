"""What the values of options may look like."""

import click
import pytest

from evenbreak.cli.kit.said import number_of, refuse
from evenbreak.errors import InputError
from evenbreak.questions.common import CHANCE


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


def test_a_negative_rating_is_an_argument(run) -> None:
    negative = run("fair", "-20", "1e1", "--race-to", "3", "--scale", "npl", "--json")
    assert negative.exit_code == 0, negative.stderr


@pytest.mark.parametrize("word", ["-x", "--nope", "twenty", "24,5"])
def test_other_words_are_not_ratings(run, word: str) -> None:
    refused = run("fair", "-20", word, "--race-to", "3")
    assert refused.exit_code == 2
    assert word in refused.stderr
